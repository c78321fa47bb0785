"""One run of rgbd_tum: its command, its statistics, its errors against the ground truth."""

import hashlib
import json
import os
import shutil

from ..absolute_error import absolute_error
from ..errors import InputError
from ..relative_error import relative_error
from ..trajectory import read_trajectory
from .programs import execute

MODES = {"threaded": [], "sequential": ["--sequential"], "realtime": ["--realtime"]}
# Of stats.json: told by the run itself, or of no use in a table.
LEFT_OUT = ("sequence", "mode", "seed", "settings", "ate", "rpe", "status", "error", "stderr", "arguments")


def run_rgbd_tum(programs, sequence, mode, output_dir, seed=0, max_frames=None, timeout_s=1800, environment=None,
                 arguments=()):
    """Runs it, with further arguments when given, and returns a JSON-ready dict. "error" is None or one line on what
    went wrong; the numbers that could be had all the same are there. "stderr" is the program's."""
    shutil.rmtree(output_dir, ignore_errors=True)
    os.makedirs(output_dir)
    command = [programs.path("rgbd_tum"), "-", sequence.settings, sequence.directory, "--output", output_dir, "--quiet",
               "--seed", seed, *MODES[mode], *arguments]
    if max_frames:
        command += ["--max-frames", max_frames]
    finished = execute(command, timeout_s, environment)
    result = {"sequence": sequence.name, "mode": mode, "seed": seed, "status": finished.status,
              "arguments": " ".join(map(str, arguments)), "error": finished.error,
              "stderr": finished.stderr}
    try:
        result.update(_statistics(os.path.join(output_dir, "stats.json")))
        result.update(_errors(sequence.truth, os.path.join(output_dir, "CameraTrajectory.txt")))
    except InputError as error:
        result["error"] = result["error"] or str(error)
    return result


def _statistics(path):
    try:
        with open(path, encoding="utf-8") as file:
            document = json.load(file)
        return {key: value for key, value in document.items() if key not in LEFT_OUT}
    except OSError as error:
        raise InputError(f"no statistics: {path}: {error.strerror}") from None
    except (ValueError, AttributeError):
        raise InputError(f"no statistics: {path} is not a JSON object") from None


def _errors(truth_path, trajectory_path):
    """ATE and RPE by the same code as evaluate_ate.py and evaluate_rpe.py --fixed_delta."""
    estimate = read_trajectory(trajectory_path, need_rotation=True)
    with open(trajectory_path, "rb") as file:
        result = {"trajectory_sha256": hashlib.sha256(file.read()).hexdigest()}
    if os.path.exists(truth_path):
        truth = read_trajectory(truth_path, need_rotation=True)
        result["ate"] = absolute_error(truth, estimate).as_dict()
        try:
            result["rpe"] = relative_error(truth, estimate, fixed_delta=True).as_dict()
        except InputError:
            result["rpe"] = None  # shorter than a second
    return result
