"""Precision, recall and average precision over the detections of many pictures."""

import collections

import numpy as np

# thresholds: confidences, falling; precision and recall: of all detections at least that confident.
Curve = collections.namedtuple("Curve", "thresholds precision recall")
# right: detections that found somebody; wrong: the others; people: those to be found. None where nothing is counted.
Counts = collections.namedtuple("Counts", "right wrong people recall precision")


def curve(scores, right, people):
    """scores (n,), right (n,) bool. Detections of one confidence come in together, so their order does not matter."""
    order = np.argsort(-scores, kind="stable")
    scores, right = scores[order], right[order]
    last_of_score = np.append(np.flatnonzero(np.diff(scores)), len(scores) - 1) if len(scores) else np.zeros(0, dtype=int)
    n_right = np.cumsum(right)[last_of_score]
    return Curve(scores[last_of_score], n_right / (last_of_score + 1), n_right / max(people, 1))


def average_precision(points, people):
    """Area under the precision's envelope: at each recall the best precision of this or a higher recall. None
    without people."""
    if not people:
        return None
    envelope = np.maximum.accumulate(points.precision[::-1])[::-1]
    return float(np.sum(np.diff(points.recall, prepend=0.0) * envelope))


def at_threshold(scores, right, people, threshold):
    kept = scores >= threshold
    n_right, n_kept = int(np.sum(right & kept)), int(np.sum(kept))
    return Counts(n_right, n_kept - n_right, people, n_right / people if people else None,
                  n_right / n_kept if n_kept else None)


def best_f1(points):
    """(F1, threshold) where the harmonic mean of precision and recall is highest; None without detections."""
    if not len(points.thresholds):
        return None
    total = points.precision + points.recall
    f1 = np.divide(2 * points.precision * points.recall, total, out=np.zeros_like(total), where=total > 0)
    best = int(np.argmax(f1))
    return float(f1[best]), float(points.thresholds[best])
