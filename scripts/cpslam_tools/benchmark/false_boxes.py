"""Boxes where nobody is, on the recorded desk: what a detector's false alarms cost."""

import os

import numpy as np

from . import box_files, detectors, pair_table
from .execution import on_sequence, run_on
from .sequences import recorded_sequence

CLIP = "fr1_desk_dev"
IMAGE_SIZE = (640, 480)


def false_boxes(plan):
    """Per first frame: one run with random boxes on three of ten frames, other boxes each time, and one without."""
    def pairs(clip):
        stamps = box_files.read_stamps(os.path.join(clip.directory, "rgb.txt"))
        path = os.path.join(plan.work_dir, "false_boxes.txt")
        for start in range(plan.perturbations):
            box_files.write_boxes(path, box_files.false_boxes(stamps, np.random.default_rng(start), IMAGE_SIZE))
            for variant, detector in ((pair_table.WITH, detectors.recorded_boxes(path)),
                                      (pair_table.WITHOUT, detectors.NONE)):
                result = run_on(plan, clip, "sequential", arguments=(*detector.arguments, "--start", str(start)))
                yield {**result, "variant": variant, "perturbation": start}

    clip = recorded_sequence(plan.root, plan.data, CLIP)
    yield from ({"perturbation": "-", **result} for result in on_sequence(clip, pairs))


def count(plan):
    return 2 * plan.perturbations


def table(runs):
    return pair_table.render("Boxes where nobody is: with against without", runs, "sequence", all_tracked=True)
