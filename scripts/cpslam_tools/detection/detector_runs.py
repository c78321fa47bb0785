"""Runs of the program detect_people, which is the detector of rgbd_tum."""

import collections
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

from ..errors import InputError
from .boxes import as_boxes
from .ground_truth import nearest_boxes, read_stamped_boxes
from .pictures import picture_size

# network: its file; input_size: "320 x 320"; numbers: "float" or "int8"; boxes: {path: (boxes, scores)}; sizes: {path:
# (width, height)} of the pictures that could be read; detection_ms: {p50, p95, max}; time_ratio: int8 to float, median over
# the pictures. Recorded boxes have no times.
Run = collections.namedtuple("Run", "network input_size numbers boxes sizes detection_ms time_ratio")

DEFAULT_CONFIDENCE = 0.6  # DetectorSettings::confidence_threshold


class Detector:
    """How detect_people is to be run. options: passed on; calibration: pictures for 8-bit integers, None: floats only."""

    def __init__(self, program, options, calibration=None):
        self.program = program
        self.options = options
        self.calibration = calibration

    def run(self, pictures, model, size):
        """One Run, or with a calibration two, in floats and in 8-bit integers, measured picture by picture in turns.
        model: (cfg, weights), None for the bundled one; size: of the input, None for the network's own."""
        with tempfile.TemporaryDirectory() as folder:
            def path(name):
                return os.path.join(folder, name)
            with open(path("list.txt"), "w", encoding="utf-8", errors="surrogateescape") as file:
                file.write("".join(f"{picture.path}\n" for picture in pictures))
            command = [self.program, path("list.txt"), "--output", path("boxes"), "--report", path("report"), *self.options]
            command += ["--model", *model] if model else []
            command += ["--input-size", size] if size else []
            command += ["--quantise", self.calibration, "--compare-float", path("float")] if self.calibration else []
            _execute(command, path("report"))
            with open(path("report"), encoding="utf-8", errors="replace") as file:
                report = json.load(file)
            if report["left_out"]:
                print(f"warning: {len(report['left_out'])} pictures could not be read and do not count", file=sys.stderr)
            if not self.calibration:
                return [_as_run(report, "float", path("boxes"), report["detection_ms"], None)]
            compared = report["compared"]
            return [_as_run(report, "float", path("float"), compared["float_ms"], None),
                    _as_run(report, "int8", path("boxes"), report["detection_ms"], compared["time_ratio"]["p50"])]


def _execute(command, report):
    """Its progress and warnings go to the terminal. Unreadable pictures (status 1, with a report) are no failure."""
    try:
        process = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=False)
    except OSError as error:
        raise InputError(f"{command[0]}: {error.strerror}: build it with cmake --preset release && "
                         "cmake --build --preset release") from None
    if process.returncode not in (0, 1) or not os.path.exists(report):
        raise InputError(f"detect_people ended with status {process.returncode}")
    with open(report, encoding="utf-8", errors="replace") as file:
        if json.load(file)["interrupted"]:
            raise KeyboardInterrupt


def _as_run(report, numbers, boxes, detection_ms, time_ratio):
    sizes = {row["picture"]: (row["width"], row["height"]) for row in report["pictures"]}
    input_size = report["network"].removesuffix(", 8-bit").rsplit(", ", 1)[1]
    network = os.path.splitext(os.path.basename(report["settings"]["model_weights"]))[0]
    return Run(network, input_size, numbers, read_picture_boxes(boxes), sizes, detection_ms, time_ratio)


def read_picture_boxes(path):
    """{picture: (boxes, scores)} of "picture x y width height confidence" lines; names of pictures may hold blanks."""
    rows = collections.defaultdict(list)
    with open(path, encoding="utf-8", errors="surrogateescape") as lines:
        for line in lines:
            name, *values = line.rsplit(maxsplit=5)
            rows[name].append([float(value) for value in values])
    return {name: (as_boxes([row[:4] for row in found]), np.array([row[4] for row in found])) for name, found in rows.items()}


def recorded_run(path, pictures):
    """The boxes of a person_boxes.txt instead of a network's."""
    boxes = read_stamped_boxes(path)
    return Run(os.path.basename(path), "-", "recorded", {picture.path: nearest_boxes(boxes, picture.time_s) for picture in pictures},
               {picture.path: picture_size(picture.path) for picture in pictures}, None, None)
