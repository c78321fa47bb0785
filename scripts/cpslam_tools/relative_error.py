"""Relative pose error, RPE (Sturm et al. 2012): the drift of the motion over an interval."""

import numpy as np

from .errors import InputError
from .statistics import summarize
from .trajectory import rotation_angles, rotation_matrices

UNITS = ("s", "m", "rad", "deg", "f")


class RelativeError:
    """rows: (n, 6): stamps of the estimate's start and end, of the truth's start and end, translation error in
    metres, rotation error in radians."""

    def __init__(self, rows):
        self.rows = rows
        self.translation = summarize(rows[:, 4])
        self.rotation_deg = summarize(np.degrees(rows[:, 5]))

    def as_dict(self):
        return {
            "pairs": len(self.rows),
            "translation": {f"{name}_m": value for name, value in self.translation.items()},
            "rotation": {f"{name}_deg": value for name, value in self.rotation_deg.items()},
        }


def relative_error(truth, estimate, max_pairs=10000, fixed_delta=False, delta=1.0, delta_unit="s", offset=0.0,
                   scale=1.0, seed=0):
    """Compares the estimate's motions with the truth's, over pairs of any length or (fixed_delta) of one length.

    delta_unit says what the length is: seconds, metres travelled, radians or degrees turned, frames. max_pairs
    bounds the work by a random choice (0: no bound). A motion whose ends have no ground truth within two of its
    sampling intervals is left out.
    """
    estimate = _with_truth(truth, estimate, offset)
    generator = np.random.default_rng(seed)
    if fixed_delta:
        pairs = _fixed_pairs(_path_parameter(estimate, delta_unit), delta, max_pairs, generator)
    else:
        pairs = _free_pairs(len(estimate), max_pairs, generator)
    start, end = pairs[:, 0], pairs[:, 1]

    nearest = _nearest(truth.stamps, estimate.stamps + offset)
    gap = np.abs(truth.stamps[nearest] - (estimate.stamps + offset))
    covered = gap <= 2 * np.median(np.diff(truth.stamps))
    keep = covered[start] & covered[end]
    start, end = start[keep], end[keep]
    if len(start) < 2:
        raise InputError("fewer than two motions to compare: the interval is too long for this trajectory, or the "
                         "ground truth has holes there")

    translation, rotation = _motion_errors(truth, nearest[start], nearest[end], estimate, start, end, scale)
    stamps = [estimate.stamps[start], estimate.stamps[end], truth.stamps[nearest[start]], truth.stamps[nearest[end]]]
    return RelativeError(np.stack([*stamps, translation, rotation], axis=1))


class _Poses:
    def __init__(self, stamps, positions, rotations):
        self.stamps = stamps
        self.positions = positions
        self.rotations = rotations

    def __len__(self):
        return len(self.stamps)


def _with_truth(truth, estimate, offset):
    """The estimated poses that are the closest ones to the ground truth that is closest to some pose."""
    if len(truth) < 2:
        raise InputError(f"the ground truth has {len(truth)} pose, at least 2 are needed")
    nearest_truth = _nearest(truth.stamps, estimate.stamps + offset)
    chosen = np.unique(_nearest(estimate.stamps, truth.stamps[nearest_truth] - offset))
    if len(chosen) < 2:
        raise InputError("the two trajectories overlap in fewer than 2 timestamps: are they of the same recording?")
    return _Poses(estimate.stamps[chosen], estimate.positions[chosen],
                  rotation_matrices(estimate.quaternions[chosen]))


def _nearest(sorted_values, values):
    """The index of the closest of sorted_values for each value; the earlier one of two equally close ones."""
    right = np.clip(np.searchsorted(sorted_values, values), 1, max(len(sorted_values) - 1, 1))
    left = right - 1
    right = np.minimum(right, len(sorted_values) - 1)
    return np.where(np.abs(sorted_values[right] - values) < np.abs(values - sorted_values[left]), right, left)


def _path_parameter(estimate, unit):
    """How far along the path each pose is, in the given unit; never decreases."""
    if unit == "s":
        return estimate.stamps
    if unit == "f":
        return np.arange(len(estimate), dtype=float)
    if unit == "m":
        steps = np.linalg.norm(np.diff(estimate.positions, axis=0), axis=1)
    else:
        steps = rotation_angles(np.swapaxes(estimate.rotations[:-1], 1, 2) @ estimate.rotations[1:])
        if unit == "deg":
            steps = np.degrees(steps)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _fixed_pairs(parameter, delta, max_pairs, generator):
    """Every pose with the one that is closest to delta further on. A partner that is the last pose is left out:
    the path may have ended before the interval did."""
    partner = _nearest(parameter, parameter + delta)
    start = np.flatnonzero(partner != len(parameter) - 1)
    if max_pairs and len(start) > max_pairs:
        start = np.sort(generator.choice(start, max_pairs, replace=False))
    return np.stack([start, partner[start]], axis=1)


def _free_pairs(count, max_pairs, generator):
    """All ordered pairs when they are few, else max_pairs random ones."""
    if max_pairs == 0 or count < np.sqrt(max_pairs):
        return np.stack(np.meshgrid(np.arange(count), np.arange(count), indexing="ij"), axis=-1).reshape(-1, 2)
    return generator.integers(0, count, size=(max_pairs, 2))


def _motion_errors(truth, truth_start, truth_end, estimate, start, end, scale):
    """Translation (m) and rotation (rad) of (estimated motion)^-1 (true motion), in the start's frame."""
    true_rotation, true_translation = _motion(rotation_matrices(truth.quaternions[truth_start]),
                                              rotation_matrices(truth.quaternions[truth_end]),
                                              truth.positions[truth_start], truth.positions[truth_end])
    rotation, translation = _motion(estimate.rotations[start], estimate.rotations[end],
                                    estimate.positions[start], estimate.positions[end])
    difference = true_translation - scale * translation
    return np.linalg.norm(difference, axis=1), rotation_angles(np.swapaxes(rotation, 1, 2) @ true_rotation)


def _motion(rotation_start, rotation_end, position_start, position_end):
    inverse = np.swapaxes(rotation_start, 1, 2)
    return inverse @ rotation_end, (inverse @ (position_end - position_start)[:, :, None])[:, :, 0]
