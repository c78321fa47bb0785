"""YOLO-format folders: images/NAME.jpg, labels/NAME.txt of lines "class cx cy w h" (shares of the sides)."""

import os

import numpy as np

from cpslam_tools.errors import InputError

from . import boxes
from .records import Record

PICTURES = (".jpg", ".jpeg", ".png")


def read_yolo_folder(folder, split, keep_class=0):
    """The records that FOLDER/SPLIT.txt lists, paths relative to the folder; without such a file and with split
    "train", all of images/. Boxes of other classes than keep_class are left out. A missing label file is an error,
    an empty one a picture without people."""
    listing = os.path.join(folder, f"{split}.txt")
    if os.path.exists(listing):
        with open(listing, encoding="utf-8") as file:
            names = [line.strip() for line in file if line.strip()]
    elif split == "train" and os.path.isdir(os.path.join(folder, "images")):
        names = [f"images/{name}" for name in sorted(os.listdir(os.path.join(folder, "images")))
                 if name.lower().endswith(PICTURES)]
    else:
        raise InputError(f"{folder} has neither {split}.txt nor images/")
    if not names:
        raise InputError(f"{listing} names no pictures")
    return [Record(os.path.join(folder, name), read_labels(label_path(folder, name), keep_class)) for name in names]


def label_path(folder, name):
    head, tail = os.path.split(name)
    parent = os.path.dirname(head) if os.path.basename(head) == "images" else head
    return os.path.join(folder, parent, "labels", os.path.splitext(tail)[0] + ".txt")


def read_labels(path, keep_class):
    rows = []
    try:
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                if line.strip():
                    rows.append(parse_label(line, path, number))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {path}: {getattr(error, 'strerror', error)}") from None
    kept = [row[1:] for row in rows if row[0] == keep_class]
    return np.clip(boxes.to_xyxy(np.array(kept, np.float32).reshape(-1, 4)), 0, 1)


def parse_label(line, path, number):
    try:
        values = [float(item) for item in line.split()]
    except ValueError:
        values = []
    if len(values) != 5 or not np.all(np.isfinite(values)) or min(values[3:]) <= 0:
        raise InputError(f"{path}:{number}: expected 'class cx cy w h', found '{line.strip()}'")
    return values
