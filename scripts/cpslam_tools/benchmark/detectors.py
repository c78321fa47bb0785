"""Where the person boxes of a run come from, as options of rgbd_tum."""

import collections
import os
import shlex

from ..errors import InputError

BOXES_FILE = "person_boxes.txt"

# label: for the tables; arguments: for rgbd_tum.
Detector = collections.namedtuple("Detector", "label arguments")

NONE = Detector("none", ("--detector", "none"))
# The network that comes with CP-SLAM; a failed run where there is none.
BUNDLED = Detector("yolo", ("--detector", "yolo"))


def recorded_boxes(path):
    return Detector("boxes", ("--detector", "boxes", "--boxes", path))


def from_text(text):
    """A detector from options in one text, as --detector-arguments takes them; an empty text is none."""
    try:
        arguments = shlex.split(text)
    except ValueError as error:
        raise InputError(f"--detector-arguments: {error}") from None
    if not arguments:
        return NONE
    if "--detector" not in arguments[:-1]:
        raise InputError(f"--detector-arguments '{text}' must hold --detector NAME")
    return Detector(arguments[arguments.index("--detector") + 1], tuple(arguments))


def choose(directory, otherwise):
    """Recorded boxes when the sequence has them, else the given detector."""
    path = os.path.join(directory, BOXES_FILE)
    return recorded_boxes(path) if os.path.exists(path) else otherwise
