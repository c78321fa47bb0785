"""Finds out which format a training set has."""

import os

from cpslam_tools.errors import InputError

from .odgt import read_odgt
from .tum_folder import is_tum_folder, read_tum_folder
from .yolo_folder import read_yolo_folder


def split_option(text):
    """ "NAME=NUMBER", or "NAME" for 1. """
    name, equals, value = text.rpartition("=")
    if not equals:
        return text, 1.0
    try:
        number = float(value)
    except ValueError:
        number = -1.0
    if not 0 <= number < float("inf"):
        raise InputError(f"{text}: expected NAME=NUMBER, the number not negative")
    return name, number


def read_source(path, split, kind="visible"):
    """split: "train" or "val", for folders that have both. kind: which of CrowdHuman's boxes."""
    if path.endswith(".odgt"):
        return read_odgt(path, kind)
    if is_tum_folder(path):
        return read_tum_folder(path)
    if os.path.isdir(path):
        return read_yolo_folder(path, split)
    raise InputError(f"{path} is neither a folder with pictures nor a .odgt file")
