"""Folders in the TUM RGB-D layout with a person_boxes.txt, as simulate_tum writes them."""

import os

import cv2
import numpy as np

from cpslam_tools.errors import InputError

from .records import Record

MATCH_S = 0.001  # boxes carry their picture's stamp


def is_tum_folder(path):
    return all(os.path.exists(os.path.join(path, name)) for name in ("rgb.txt", "person_boxes.txt"))


def read_tum_folder(folder):
    """A record per picture of rgb.txt."""
    pictures = [(stamp, os.path.join(folder, values[0]))
                for stamp, values in read_rows(os.path.join(folder, "rgb.txt"), 1)]
    boxes = read_rows(os.path.join(folder, "person_boxes.txt"), 4)
    stamps = np.array([stamp for stamp, _ in boxes])
    if not pictures:
        raise InputError(f"{folder}/rgb.txt names no pictures")
    records = []
    for stamp, path in pictures:
        picture = cv2.imread(path)
        if picture is None:
            raise InputError(f"cannot read the picture {path}")
        size = np.array(picture.shape[1::-1], np.float32)
        rows = np.array([[float(value) for value in boxes[i][1][:4]]
                         for i in np.flatnonzero(np.abs(stamps - stamp) < MATCH_S)], np.float32).reshape(-1, 4)
        corners = np.concatenate([rows[:, :2], rows[:, :2] + rows[:, 2:]], 1) / np.tile(size, 2)
        corners = np.clip(corners, 0, 1)
        records.append(Record(path, corners[(corners[:, 2:] > corners[:, :2]).all(1)]))
    return records


def read_rows(path, n_values):
    """(stamp, values as text) of every line that is no comment."""
    rows = []
    try:
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                items = line.split("#")[0].split()
                if items:
                    rows.append(parse_row(items, n_values, path, number))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {path}: {getattr(error, 'strerror', error)}") from None
    return rows


def parse_row(items, n_values, path, number):
    try:
        stamp = float(items[0])
        if n_values > 1:
            [float(item) for item in items[1:1 + n_values]]
    except ValueError:
        stamp = None
    if stamp is None or len(items) < 1 + n_values:
        raise InputError(f"{path}:{number}: expected a stamp and {n_values} value{'s' if n_values > 1 else ''}")
    return stamp, items[1:]
