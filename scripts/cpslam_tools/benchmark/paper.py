"""The sequences of the paper: runs on those that are on disk, marks for those that are not."""

import os

from ..datasets import PAPER, find_dataset
from . import detectors
from .execution import on_sequence, run_on
from .figures import Figures
from .sequences import Sequence

LISTS = ("rgb.txt", "depth.txt", "groundtruth.txt")


def paper(plan):
    """Repeats of the threaded mode on each sequence; one skipped result for each that is not there."""
    for name in chosen(plan):
        sequence = _sequence(plan, name)
        if not os.path.isdir(sequence.directory):
            yield _skipped(name, f"not on disk: scripts/download_sequence.py {name}")
            continue
        missing = [file for file in LISTS if not os.path.exists(os.path.join(sequence.directory, file))]
        if missing:
            yield _skipped(name, f"incomplete, no {', '.join(missing)}: scripts/download_sequence.py {name}")
            continue
        yield from on_sequence(sequence, lambda ready: _repeats(plan, ready))


def paper_count(plan):
    on_disk = sum(os.path.isdir(_sequence(plan, name).directory) for name in chosen(plan))
    return on_disk * plan.repeats + len(chosen(plan)) - on_disk


def chosen(plan):
    return [name for name in PAPER if not plan.paper_sequences or name in plan.paper_sequences]


def _sequence(plan, name):
    settings = os.path.join(plan.root, "Examples", "RGB-D", find_dataset(name).settings)
    return Sequence(name, os.path.join(plan.datasets, name), settings)


def _skipped(name, reason):
    return {"sequence": name, "mode": "-", "error": None, "skipped": reason}


def _repeats(plan, sequence):
    detector = detectors.choose(sequence.directory, plan.detector)
    figures = Figures(plan.figures, sequence.name, sequence.truth, f"{sequence.name}, detector {detector.label}")
    for _ in range(plan.repeats):
        result = run_on(plan, sequence, "threaded", arguments=detector.arguments)
        figures.add(result, plan.output_dir)
        yield {**result, "detector": detector.label}
    figures.draw()
