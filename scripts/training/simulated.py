"""Simulated people: pictures of many rooms, seeds and moments from simulate_tum, as a YOLO-format folder."""

import os
import subprocess
import tempfile

import cv2
import numpy as np

from cpslam_tools.errors import InputError
from cpslam_tools.output import write_text

from .tum_folder import read_tum_folder

PRESETS = ("walking_static", "walking_xyz", "walking_rpy", "walking_halfsphere", "sitting_xyz", "sitting_rpy",
           "sitting_halfsphere", "ring_walking")
LENGTHS_S = {"ring_walking": 54.0}  # the others are
LENGTH_S = 19.0
PEOPLE = (0.08, 0.14, 0.18, 0.2, 0.16, 0.12, 0.12)  # chances of 0, 1, ... people
VALIDATED = 0.1  # share of the pictures that become val.txt
TIMEOUT_S = 120
FAILURES = 0.05  # share of the pictures


def simulate(program, folder, count, seed, report):
    """Writes images/, labels/, train.txt and val.txt. Every picture is of a room, a path and people of its own. Where
    the simulator fails, the picture is left out and report(message) called; too many of these raise InputError."""
    for name in ("images", "labels"):
        os.makedirs(os.path.join(folder, name), exist_ok=True)
    lists, n_failed = {"train": [], "val": []}, 0
    for i in range(count):
        name = f"sim_{seed}_{i:05d}"
        try:
            boxes = make_picture(program, os.path.join(folder, "images", name + ".jpg"),
                                 np.random.default_rng([seed, i]))
        except SimulatorError as error:
            n_failed += 1
            report(str(error))
            if n_failed > max(3, FAILURES * count):
                raise InputError(f"{program} failed {n_failed} times: {error}") from None
            continue
        write_labels(os.path.join(folder, "labels", name + ".txt"), boxes)
        lists["val" if i >= (1 - VALIDATED) * count else "train"].append(f"images/{name}.jpg")
    for split, names in lists.items():
        write_text(os.path.join(folder, f"{split}.txt"), "".join(f"{name}\n" for name in names))
    return sum(map(len, lists.values()))


class SimulatorError(Exception):
    pass


def make_picture(program, path, generator):
    """Writes one picture; returns its boxes, xyxy as shares of the sides."""
    with tempfile.TemporaryDirectory() as scene:
        render(program, scene, generator)
        record = read_tum_folder(scene)[0]
        cv2.imwrite(path, cv2.imread(record.path), [cv2.IMWRITE_JPEG_QUALITY, int(generator.integers(60, 95))])
    return record.boxes


def render(program, folder, generator):
    """One frame. Most with people, some without."""
    preset = PRESETS[generator.integers(len(PRESETS))]
    start = generator.uniform(0, LENGTHS_S.get(preset, LENGTH_S))
    arguments = [preset, folder, "--seed", str(generator.integers(1 << 31)), "--frames", "1", "--start", f"{start:.3f}",
                 "--jpeg", "--quiet", "--threads", "1", "--force", "--people", str(generator.choice(7, p=PEOPLE))]
    arguments += [flag for flag, chance in (("--noise", 0.5), ("--exposure", 0.5), ("--blur", 0.25))
                  if generator.random() < chance]
    try:
        result = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    except OSError as error:
        raise InputError(f"cannot run {program}: {error.strerror}") from None
    except subprocess.TimeoutExpired:
        raise SimulatorError(f"{' '.join(arguments)}: not ready after {TIMEOUT_S} s") from None
    if result.returncode:
        raise SimulatorError(f"{' '.join(arguments)}: {' '.join(result.stderr.split())[:200]}")


def write_labels(path, boxes):
    write_text(path, "".join(f"0 {(x0 + x1) / 2:.6f} {(y0 + y1) / 2:.6f} {x1 - x0:.6f} {y1 - y0:.6f}\n"
                             for x0, y0, x1, y1 in boxes))
