"""Absolute trajectory error, ATE (Sturm et al. 2012): how far aligned positions are from the truth."""

import numpy as np

from .alignment import align_rigidly
from .association import associate_stamps
from .errors import InputError
from .statistics import summarize


class AbsoluteError:
    """pairs: (n, 2) indices into truth and estimate; errors: (n,) metres; aligned: every estimated position (m, 3)
    in the truth's frame; statistics: of the errors."""

    def __init__(self, pairs, errors, aligned):
        self.pairs = pairs
        self.errors = errors
        self.aligned = aligned
        self.statistics = summarize(errors)

    def as_dict(self):
        return {"pairs": len(self.errors), **{f"{name}_m": value for name, value in self.statistics.items()}}


def absolute_error(truth, estimate, offset=0.0, scale=1.0, max_difference=0.02):
    """Associates, scales the estimate by the given factor, aligns it rigidly to the truth and measures."""
    pairs = np.array(associate_stamps(truth.stamps, estimate.stamps, offset, max_difference), dtype=int).reshape(-1, 2)
    if len(pairs) < 2:
        raise InputError(
            f"only {len(pairs)} of {len(estimate)} estimated poses have a ground truth within {max_difference:g} s: "
            "are these two trajectories of the same recording?"
        )
    positions = scale * estimate.positions
    reference = truth.positions[pairs[:, 0]]
    rotation, translation = align_rigidly(positions[pairs[:, 1]], reference)
    aligned = positions @ rotation.T + translation
    return AbsoluteError(pairs, np.linalg.norm(aligned[pairs[:, 1]] - reference, axis=1), aligned)
