"""CrowdHuman's annotation_*.odgt (Shao et al. 2018): a JSON document per line with a picture's ID and its "gtboxes"."""

import json
import math
import os

import cv2
import numpy as np

from cpslam_tools.errors import InputError

from .records import Record, no_boxes

KINDS = {"visible": "vbox", "full": "fbox"}


def read_odgt(path, kind="visible", pictures=None):
    """kind: the box around what is seen of a person, or around all of the person, hidden or beyond the border. The
    pictures are NAME.jpg in `pictures`, by default Images/ beside the file. What CrowdHuman marks as no person, or as
    a crowd nobody could count ("mask", extra.ignore), is to be ignored."""
    folder = pictures or os.path.join(os.path.dirname(path), "Images")
    records = []
    try:
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                if line.strip():
                    records.append(read_line(line, f"{path}:{number}", KINDS[kind], folder))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {path}: {getattr(error, 'strerror', error)}") from None
    if not records:
        raise InputError(f"{path} has no pictures")
    return records


def read_line(line, where, key, folder):
    try:
        document = json.loads(line)
        name, entries = document["ID"], document["gtboxes"]
        boxes = [(is_person(entry), read_box(entry[key if is_person(entry) else "fbox"])) for entry in entries]
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"{where}: not a CrowdHuman annotation: {type(error).__name__} {error}") from None
    if not isinstance(name, str) or "/" in name or name in ("", ".", ".."):
        raise InputError(f"{where}: ID is no file name")
    path = os.path.join(folder, f"{name}.jpg")
    shape = picture_size(path)
    return Record(path, shares([box for person, box in boxes if person], shape),
                  shares([box for person, box in boxes if not person], shape))


def is_person(entry):
    return entry["tag"] == "person" and not entry.get("extra", {}).get("ignore", 0)


def read_box(values):
    x, y, width, height = (float(value) for value in values)
    if not all(map(math.isfinite, (x, y, width, height))):
        raise ValueError("box that is not finite")
    return x, y, x + width, y + height


def shares(corners, size):
    """xyxy px to shares of the sides, cut at the border; empty boxes are left out."""
    if not corners:
        return no_boxes()
    boxes = np.clip(np.array(corners, np.float32) / np.tile(size, 2), 0, 1).astype(np.float32)
    return boxes[(boxes[:, 2:] > boxes[:, :2]).all(1)]


def picture_size(path):
    """Width, height. Without decoding where the file is a JPEG as cameras and editors write them."""
    try:
        with open(path, "rb") as file:
            size = jpeg_size(file)
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from None
    if size is None:
        picture = cv2.imread(path)
        if picture is None:
            raise InputError(f"cannot read the picture {path}")
        size = picture.shape[1::-1]
    return size


def jpeg_size(file):
    """From the frame header (marker SOF); None when there is none."""
    if file.read(2) != b"\xff\xd8":
        return None
    while True:
        marker = file.read(4)
        if len(marker) < 4 or marker[0] != 0xFF:
            return None
        length = int.from_bytes(marker[2:], "big")
        if 0xC0 <= marker[1] <= 0xCF and marker[1] not in (0xC4, 0xC8, 0xCC):
            header = file.read(5)
            return (int.from_bytes(header[3:], "big"), int.from_bytes(header[1:3], "big")) if len(header) == 5 else None
        file.seek(length - 2, os.SEEK_CUR)
