"""Pictures and the people in them: YOLO-format folders and lists, MOT sequences, TUM sequences with reference boxes."""

import collections
import configparser
import math
import os
import sys

import numpy as np

from ..errors import InputError
from ..trajectory import read_file_list, read_rows
from .boxes import as_boxes

# path: absolute; boxes: (n, 4), in px, or in shares of the picture when `relative`; ignored: (n,) people who need not be
# found; time_s: of a sequence's picture, else None.
Picture = collections.namedtuple("Picture", "path boxes ignored time_s relative")
PICTURE_ENDINGS = (".png", ".jpg", ".jpeg")

# MOT16 and later. Who is none of these is no person at all.
MOT_PEDESTRIAN = 1
MOT_PERSON_LIKE = {2: "on a vehicle", 7: "static", 8: "distractor", 12: "reflection"}
MOT_ANY = -1  # MOT15 has no classes

BOX_STAMP_TOLERANCE_S = 0.001


def picture(path, boxes, ignored=None, time_s=None, relative=False):
    boxes = as_boxes(boxes)
    ignored = np.zeros(len(boxes), dtype=bool) if ignored is None else np.asarray(ignored, dtype=bool)
    return Picture(os.path.abspath(path), boxes, ignored, time_s, relative)


def read_yolo(source, classes=(0,)):
    """A list of pictures (.txt), or a folder: images/ in it, or itself. The labels of images/a.jpg are in
    labels/a.txt, or beside the picture: "class cx cy width height" a line, in shares of the picture."""
    paths = _listed(source) if os.path.isfile(source) else _in_folder(source)
    pictures, unlabelled = [], []
    for path in paths:
        labels = _labels_file(path)
        if labels is None:
            unlabelled.append(path)
        boxes = _yolo_boxes(labels, classes) if labels else []
        pictures.append(picture(path, boxes, relative=True))
    if len(unlabelled) == len(paths):
        raise InputError(f"{source}: no labels: {paths[0]} has none in a folder labels/ or beside it")
    if unlabelled:
        print(f"warning: {len(unlabelled)} pictures without a label file count as without people, the first is "
              f"{unlabelled[0]}", file=sys.stderr)
    return pictures


def _listed(path):
    folder = os.path.dirname(path)
    try:
        with open(path, encoding="utf-8", errors="surrogateescape") as lines:
            names = [line.strip() for line in lines]
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    paths = [os.path.join(folder, name) for name in names if name and not name.startswith("#")]
    if not paths:
        raise InputError(f"{path}: lists no picture")
    return paths


def _in_folder(folder):
    inner = os.path.join(folder, "images")
    folder = inner if os.path.isdir(inner) else folder
    try:
        names = sorted(name for name in os.listdir(folder) if name.lower().endswith(PICTURE_ENDINGS))
    except OSError as error:
        raise InputError(f"{folder}: {error.strerror}") from None
    if not names:
        raise InputError(f"{folder}: no pictures in this folder")
    return [os.path.join(folder, name) for name in names]


def _labels_file(path):
    folder, name = os.path.split(os.path.abspath(path))
    name = os.path.splitext(name)[0] + ".txt"
    parts = folder.split(os.sep)
    if "images" in parts:
        last = len(parts) - 1 - parts[::-1].index("images")
        labels = os.sep.join([*parts[:last], "labels", *parts[last + 1:], name])
        if os.path.isfile(labels):
            return labels
    beside = os.path.join(folder, name)
    return beside if os.path.isfile(beside) else None


def _yolo_boxes(path, classes):
    boxes = []
    for number, fields in read_rows(path):
        values = _numbers(path, number, fields)
        if len(values) != 5:
            raise InputError(f"{path}:{number}: expected 'class cx cy width height', found {len(values)} fields")
        index, cx, cy, width, height = values
        if width <= 0 or height <= 0 or max(abs(cx), abs(cy), width, height) > 2:
            raise InputError(f"{path}:{number}: centre and size must be shares of the picture's sides")
        if index in classes:
            boxes.append([cx - width / 2, cy - height / 2, width, height])
    return boxes


def read_mot(directory, least_visibility=0.0):
    """A MOTChallenge sequence: seqinfo.ini, img1/ and gt/gt.txt with "frame, id, left, top, width, height, counts, class,
    visibility" lines, frames and px from 1. People it says not to count (flag 0, vehicles' riders, statues, mirror
    images), and those less visible than asked for, are ignored."""
    info = _sequence_info(os.path.join(directory, "seqinfo.ini"))
    rows = collections.defaultdict(list)
    path = os.path.join(directory, "gt", "gt.txt")
    for number, fields in read_rows(path):
        values = _numbers(path, number, fields)
        if len(values) < 7:
            raise InputError(f"{path}:{number}: expected at least 7 numbers (frame, id, box, flag), found {len(values)}")
        frame = int(values[0])
        if not 1 <= frame <= info.length:
            raise InputError(f"{path}:{number}: frame {values[0]:g}, but seqinfo.ini says there are {info.length}")
        counts = _mot_counts(values, least_visibility)
        if counts is not None:
            rows[frame].append(([values[2] - 1, values[3] - 1, values[4], values[5]], not counts))
    if not rows:
        raise InputError(f"{path}: no person in this file")
    return [picture(os.path.join(directory, info.folder, f"{frame:06d}{info.ending}"), [box for box, _ in rows[frame]],
                    [ignored for _, ignored in rows[frame]], frame / info.rate_hz)
            for frame in range(1, info.length + 1)]


def _mot_counts(values, least_visibility):
    """Whether the person is to be found; None for what is no person."""
    kind = int(values[7]) if len(values) > 7 else MOT_ANY
    visibility = values[8] if len(values) > 8 and kind != MOT_ANY else 1.0
    if kind not in (MOT_PEDESTRIAN, MOT_ANY) and kind not in MOT_PERSON_LIKE:
        return None
    return kind not in MOT_PERSON_LIKE and values[6] != 0 and visibility >= least_visibility


SequenceInfo = collections.namedtuple("SequenceInfo", "folder length rate_hz ending")


def _sequence_info(path):
    parser = configparser.ConfigParser(interpolation=None)
    try:
        with open(path, encoding="utf-8") as file:
            parser.read_file(file)
        section = parser["Sequence"]
        info = SequenceInfo(section.get("imDir", "img1"), section.getint("seqLength"), section.getfloat("frameRate", 30.0),
                            section.get("imExt", ".jpg"))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    except (configparser.Error, KeyError, ValueError, UnicodeDecodeError):
        raise InputError(f"{path}: not a seqinfo.ini: it needs a section [Sequence] with seqLength") from None
    if info.length is None or not 1 <= info.length <= 1_000_000 or not info.rate_hz > 0:
        raise InputError(f"{path}: seqLength and frameRate must be positive")
    return info


def read_sequence(directory, reference):
    """A TUM-format sequence's colour pictures with boxes from a person_boxes.txt."""
    pictures = read_file_list(os.path.join(directory, "rgb.txt"))
    boxes = read_stamped_boxes(reference)
    stamps = sorted(pictures)
    result = []
    for stamp in stamps:
        if not pictures[stamp]:
            raise InputError(f"{os.path.join(directory, 'rgb.txt')}: stamp {stamp:f} has no file")
        result.append(picture(os.path.join(directory, pictures[stamp][0]), nearest_boxes(boxes, stamp)[0], time_s=stamp))
    if boxes and not any(len(item.boxes) for item in result):
        raise InputError(f"{reference}: none of its stamps is that of a picture of {directory}")
    return result


def read_stamped_boxes(path):
    """A person_boxes.txt as {stamp: (boxes, scores)}."""
    rows = collections.defaultdict(list)
    for number, fields in read_rows(path):
        values = _numbers(path, number, fields)
        if len(values) != 6:
            raise InputError(f"{path}:{number}: expected 'timestamp x y width height confidence', found {len(values)} fields")
        rows[values[0]].append(values[1:])
    return {stamp: (as_boxes([row[:4] for row in lines]), np.array([row[4] for row in lines]))
            for stamp, lines in rows.items()}


def nearest_boxes(boxes, stamp):
    """Boxes and scores of the stamp nearest to this one, as RecordedDetector takes them; none beyond a millisecond."""
    nearest = min(boxes, key=lambda other: abs(other - stamp), default=None)
    if nearest is None or abs(nearest - stamp) > BOX_STAMP_TOLERANCE_S + 1e-6:
        return as_boxes([]), np.zeros(0)
    return boxes[nearest]


def _numbers(path, number, fields):
    try:
        values = [float(field) for field in fields]
    except ValueError:
        values = [math.nan]
    if not all(map(math.isfinite, values)):
        raise InputError(f"{path}:{number}: not a number in '{' '.join(fields)[:80]}'")
    return values
