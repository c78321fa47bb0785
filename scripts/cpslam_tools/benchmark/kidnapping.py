"""A camera that is covered, carried elsewhere and uncovered where it has been before: sequences and their judgement."""

import math
import os

import numpy as np

from ..alignment import align_rigidly
from ..errors import InputError
from ..trajectory import read_trajectory, rotation_angles, rotation_matrices
from . import box_files
from .sequences import RearrangedSequence

INTERVAL_S = 1.0 / 30.0


class CoveredSequence(RearrangedSequence):
    """A source's frames in another order, with frames of the cover between them; stamps go on as if nothing were. Who covers
    the camera has a box."""

    def __init__(self, source, work_dir, what, suffix, cover):
        super().__init__(source, work_dir, what, suffix)
        self.cover = cover

    def _order(self, n_frames):
        """Frames of the source in the order in which they are shown; None for a covered one."""
        raise NotImplementedError

    def _write(self):
        colour, depth, truth = (self._rows(name) for name in ("rgb.txt", "depth.txt", "groundtruth.txt"))
        # The simulator stamps all three alike.
        if not len(colour) == len(depth) == len(truth):
            raise InputError(f"{self.source.directory}: colour, depth and ground truth are not of the same frames")
        order = self._order(len(colour))
        lists = {"rgb.txt": [], "depth.txt": [], "groundtruth.txt": []}
        covered = []
        for position, frame in enumerate(order):
            stamp = f"{colour[0][0] + position * INTERVAL_S:.6f} "
            if frame is None:
                its_colour, its_depth = self.cover.files(len(covered))
                lists["rgb.txt"].append(stamp + its_colour)
                lists["depth.txt"].append(stamp + its_depth)
                covered.append(stamp.strip())
                continue
            for name, rows in (("rgb.txt", colour), ("depth.txt", depth), ("groundtruth.txt", truth)):
                lists[name].append(stamp + " ".join(rows[frame][1]))
        for name, lines in lists.items():
            with open(os.path.join(self.directory, name), "w", encoding="utf-8") as file:
                file.write("".join(line + "\n" for line in lines))
        self.cover.write(self.directory)
        if self.cover.box():
            box_files.write_boxes(self.boxes, [(stamp, *self.cover.box()) for stamp in covered])
        for folder in ("rgb", "depth"):
            self._link(folder)
        return colour[0][0]


class KidnappedSequence(CoveredSequence):
    """Frames 0 to n_map - 1 of a source that passes everywhere twice, then `kidnaps` times: n_covered frames of the cover
    and n_back frames from a random place of the second pass, which begins at second_pass, never near the one before. With
    n_map below second_pass the rest is not mapped.

    visits: [(stamp of the first frame, stamp of the last)] of each coming back, once the sequence is ready."""

    def __init__(self, source, work_dir, n_map, second_pass, kidnaps, n_covered, n_back, seed, cover):
        super().__init__(source, work_dir, f"{kidnaps} kidnaps, {cover.name}", "kidnapped", cover)
        self.n_map = n_map
        self.second_pass = second_pass
        self.kidnaps = kidnaps
        self.n_covered = n_covered
        self.n_back = n_back
        self.seed = seed
        self.visits = []

    @property
    def end_of_mapping(self):
        """Stamp of the first covered frame."""
        return self.visits[0][0] - (self.n_covered + 0.5) * INTERVAL_S

    def _write(self):
        first = super()._write() + (self.n_map + self.n_covered) * INTERVAL_S
        period = (self.n_covered + self.n_back) * INTERVAL_S
        self.visits = [(first + k * period, first + k * period + (self.n_back - 1) * INTERVAL_S)
                       for k in range(self.kidnaps)]

    def _order(self, n_frames):
        order = list(range(self.n_map))
        for start in visit_starts(self.second_pass, n_frames - self.n_back, self.kidnaps,
                                  np.random.default_rng(self.seed)):
            order += [None] * self.n_covered + list(range(start, start + self.n_back))
        return order


def visit_starts(begin, end, count, random):
    """One random start in each of `count` equal parts of [begin, end), which goes round in a circle, in an order in
    which neighbours do not follow one another where that can be."""
    parts = np.linspace(begin, end, count + 1)
    stride = next(step for step in range(max(1, round(0.3 * count)), count + 1) if math.gcd(step, count) == 1)
    offset = int(random.integers(count))
    order = [(offset + stride * k) % count for k in range(count)]
    return [int(random.uniform(parts[k], parts[k + 1])) for k in order]


def judge_visits(truth_path, trajectory_path, end_of_mapping, visits):
    """What became of each coming back: [{"after": frames until the first pose or None, "error_m", "error_deg": of that
    pose, "worst_m", "worst_deg": of all poses of the visit}]. The estimate is aligned on what was mapped before."""
    truth = read_trajectory(truth_path, need_rotation=True)
    estimate = read_trajectory(trajectory_path, need_rotation=True)
    pairs = [(nearest(truth.stamps, stamp), i) for i, stamp in enumerate(estimate.stamps)]
    before = [(t, e) for t, e in pairs if truth.stamps[t] < end_of_mapping]
    if len(before) < 3:
        raise InputError(f"{trajectory_path}: only {len(before)} poses before the first kidnap")
    rotation, translation = align_rigidly(estimate.positions[[e for _, e in before]],
                                          truth.positions[[t for t, _ in before]])
    true_index = np.array([t for t, _ in pairs])
    distances = np.linalg.norm(estimate.positions @ rotation.T + translation - truth.positions[true_index], axis=1)
    turned = rotation @ rotation_matrices(estimate.quaternions)
    true_rotations = rotation_matrices(truth.quaternions)[true_index]
    angles = np.degrees(rotation_angles(np.swapaxes(true_rotations, 1, 2) @ turned))
    return [_visit(estimate.stamps, distances, angles, visit) for visit in visits]


def _visit(stamps, distances, angles, visit):
    begin, end = visit
    inside = np.flatnonzero((stamps > begin - 0.5 * INTERVAL_S) & (stamps < end + 0.5 * INTERVAL_S))
    if not len(inside):
        return {"after": None}
    first = inside[0]
    return {"after": int(round((stamps[first] - begin) / INTERVAL_S)), "error_m": float(distances[first]),
            "error_deg": float(angles[first]), "worst_m": float(distances[inside].max()),
            "worst_deg": float(angles[inside].max())}


def nearest(stamps, stamp):
    """Index of the nearest of ascending stamps."""
    after = min(int(np.searchsorted(stamps, stamp)), len(stamps) - 1)
    return after if after == 0 or stamps[after] - stamp < stamp - stamps[after - 1] else after - 1
