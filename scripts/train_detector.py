#!/usr/bin/python3
"""Trains a person detector (a Darknet network of one class) on pictures with boxes. models/README.md has the recipe.

  train_detector.py train --data people --cutouts people/cutouts --cfg models/yc.cfg --output run   begin, or go on
  train_detector.py anchors --data people                                  anchors for the .cfg's [yolo] sections
  train_detector.py export --cfg models/yc.cfg --checkpoint run/checkpoint.pt --weights yc.weights

Needs PyTorch and OpenCV for Python: scripts/training/install.sh.
"""

import os
import sys

# Threads that spin while they wait take the cores from those that work.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")

from cpslam_tools import errors  # noqa: E402


def main(arguments):
    try:
        from training.command_line import run
    except ImportError as error:
        raise errors.InputError(f"{error}: install what training needs with scripts/training/install.sh") from None
    return run(arguments, __doc__)


if __name__ == "__main__":
    errors.run(main)
