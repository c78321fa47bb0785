"""Which detections are right: greedy matching within a picture, the most confident detection first."""

import numpy as np

from .boxes import overlaps

WRONG = -1
IGNORED = -2


def match(detections, scores, truth, ignored, least_overlap):
    """For every detection the index of the person it found, WRONG or IGNORED.

    A detection gets the person it overlaps most of those nobody more confident found. One that only fits people
    marked `ignored` (n,), who count neither as found nor as missed, is IGNORED; several may fit the same.
    """
    found = np.full(len(detections), WRONG)
    if not len(detections) or not len(truth):
        return found
    overlap = overlaps(detections, truth)
    free = ~ignored
    for index in np.argsort(-scores, kind="stable"):
        best = np.where(free, overlap[index], -1.0)
        person = int(np.argmax(best))
        if best[person] >= least_overlap:
            found[index] = person
            free[person] = False
        elif np.any(overlap[index][ignored] >= least_overlap):
            found[index] = IGNORED
    return found
