"""Reading and writing TUM-format lists and trajectories, and rigid transforms as numpy arrays."""

import math
import sys

import numpy as np

from .errors import InputError


class Trajectory:
    """Poses in the order of their stamps.

    stamps       (n,)       seconds, strictly increasing
    positions    (n, 3)     metres
    quaternions  (n, 4)     x y z w, unit length; None when the file gave positions only
    """

    def __init__(self, stamps, positions, quaternions=None):
        self.stamps = np.asarray(stamps, dtype=float)
        self.positions = np.asarray(positions, dtype=float).reshape(-1, 3)
        self.quaternions = None if quaternions is None else np.asarray(quaternions, dtype=float).reshape(-1, 4)

    def __len__(self):
        return len(self.stamps)


def read_rows(path):
    """Yields (line number, fields) of every line that holds data: '#' starts a comment, commas count as blanks."""
    try:
        with open(path, encoding="utf-8") as lines:
            for number, line in enumerate(lines, 1):
                fields = line.split("#", 1)[0].replace(",", " ").split()
                if fields:
                    yield number, fields
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: not a text file") from None


def read_trajectory(path, need_rotation=False):
    """Reads "timestamp tx ty tz [qx qy qz qw]" lines in any order; the last line of a repeated stamp counts.

    Lines with NaN (how some systems write a lost frame) are left out with a warning. Anything else that is not a
    pose is an InputError naming file and line.
    """
    poses = {}
    widths = set()
    skipped = 0
    for number, fields in read_rows(path):
        values = _numbers(path, number, fields)
        if len(values) < 4 or (len(values) < 8 and need_rotation):
            wanted = "8 numbers (timestamp tx ty tz qx qy qz qw)" if need_rotation else "a timestamp and a position"
            raise InputError(f"{path}:{number}: expected {wanted}, found {len(values)} fields")
        if any(math.isnan(value) for value in values):
            skipped += 1
            continue
        poses[values[0]] = values[1:8] if len(values) >= 8 else values[1:4]
        widths.add(len(poses[values[0]]))
        if len(values) >= 8 and not any(values[4:8]):
            raise InputError(f"{path}:{number}: a quaternion of length zero")
    if skipped:
        print(f"warning: {path}: {skipped} lines with NaN left out", file=sys.stderr)
    if not poses:
        raise InputError(f"{path}: no pose in this file")
    if len(widths) > 1:
        raise InputError(f"{path}: some lines have a rotation and some have none")
    stamps = np.array(sorted(poses))
    rows = np.array([poses[stamp] for stamp in stamps])
    if widths == {3}:
        return Trajectory(stamps, rows)
    quaternions = rows[:, 3:7] / np.linalg.norm(rows[:, 3:7], axis=1, keepdims=True)
    return Trajectory(stamps, rows[:, 0:3], quaternions)


def _numbers(path, number, fields):
    try:
        values = [float(field) for field in fields]
    except ValueError:
        raise InputError(f"{path}:{number}: not a number in '{' '.join(fields)[:80]}'") from None
    if any(math.isinf(value) for value in values):
        raise InputError(f"{path}:{number}: an infinite value")
    return values


def read_file_list(path):
    """Reads "timestamp anything..." lines (rgb.txt, depth.txt, trajectories) as {stamp: [fields]}."""
    entries = {}
    for number, fields in read_rows(path):
        try:
            stamp = float(fields[0])
        except ValueError:
            raise InputError(f"{path}:{number}: '{fields[0][:80]}' is not a timestamp") from None
        if not math.isfinite(stamp):
            raise InputError(f"{path}:{number}: '{fields[0]}' is not a timestamp")
        entries[stamp] = fields[1:]
    if not entries:
        raise InputError(f"{path}: no entry in this file")
    return entries


def rotation_matrices(quaternions):
    """(n, 4) unit quaternions x y z w to (n, 3, 3) rotations."""
    x, y, z, w = np.asarray(quaternions, dtype=float).T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def rotation_angles(rotations):
    """(n, 3, 3) rotations to their angles in radians, [0, pi]; exact for the smallest of them as well."""
    skew = np.stack(
        [
            rotations[:, 2, 1] - rotations[:, 1, 2],
            rotations[:, 0, 2] - rotations[:, 2, 0],
            rotations[:, 1, 0] - rotations[:, 0, 1],
        ],
        axis=1,
    )
    return np.arctan2(np.linalg.norm(skew, axis=1), np.trace(rotations, axis1=1, axis2=2) - 1.0)
