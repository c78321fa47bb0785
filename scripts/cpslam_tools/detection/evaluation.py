"""Puts pictures, their people and a detector's boxes together and counts."""

import collections

import numpy as np

from . import precision_recall
from .boxes import areas, as_boxes, clipped
from .matching import IGNORED, WRONG, match
from .presence import misses

# By height as a share of the picture's: at least, less than.
SIZES = {"small": (0.0, 0.2), "medium": (0.2, 0.5), "large": (0.5, np.inf)}
LARGE_PERSON = 0.05  # of the picture's area: nobody this large may be overlooked for long

# One picture with its people and detections, in px, clipped to it. found: per detection, see matching.match.
Scene = collections.namedtuple("Scene", "picture width height people ignored detections scores found")
# curve, ap, counts (at the threshold) and best (F1 and its threshold) as in precision_recall.
Score = collections.namedtuple("Score", "curve ap counts best")


def scenes(pictures, run, least_overlap):
    """One Scene for each picture that could be read."""
    return [scene(picture, run.sizes[picture.path], run.boxes.get(picture.path), least_overlap)
            for picture in pictures if picture.path in run.sizes]


def scene(picture, size, found, least_overlap):
    width, height = size
    detections, scores = found if found is not None else (as_boxes([]), np.zeros(0))
    people = picture.boxes * [width, height, width, height] if picture.relative else picture.boxes
    people, detections = clipped(people, width, height), clipped(detections, width, height)
    # Who lies wholly outside the picture cannot be seen in it.
    ignored = picture.ignored | (areas(people) <= 0)
    return Scene(picture, width, height, people, ignored, detections, scores,
                 match(detections, scores, people, ignored, least_overlap))


def score(all_scenes, threshold):
    parts = [(one.scores, one.found, np.sum(~one.ignored)) for one in all_scenes]
    return _score(parts, threshold)


def score_of_size(all_scenes, size, threshold, least_overlap):
    """As score(), of people of one of SIZES: others need not be found, and boxes of other sizes need not be right."""
    parts = []
    for one in all_scenes:
        others = ~_has_size(one.people, one.height, size)
        found = match(one.detections, one.scores, one.people, one.ignored | others, least_overlap)
        found[(found == WRONG) & ~_has_size(one.detections, one.height, size)] = IGNORED
        parts.append((one.scores, found, np.sum(~(one.ignored | others))))
    return _score(parts, threshold)


def _has_size(boxes, picture_height, size):
    least, limit = SIZES[size]
    share = boxes[:, 3] / picture_height
    return (share >= least) & (share < limit)


def _score(parts, threshold):
    scores = np.concatenate([scores for scores, _, _ in parts] or [np.zeros(0)])
    found = np.concatenate([found for _, found, _ in parts] or [np.zeros(0, dtype=int)])
    people = int(sum(count for _, _, count in parts))
    counted = found != IGNORED
    scores, right = scores[counted], found[counted] >= 0
    points = precision_recall.curve(scores, right, people)
    return Score(points, precision_recall.average_precision(points, people),
                 precision_recall.at_threshold(scores, right, people, threshold), precision_recall.best_f1(points))


def people_found(one, threshold):
    """(n,) bool: who of a scene's people has a detection at this threshold."""
    found = np.zeros(len(one.people), dtype=bool)
    found[one.found[(one.found >= 0) & (one.scores >= threshold)]] = True
    return found


def wrong_detections(one, threshold):
    """(m,) bool: detections at this threshold that are nobody's."""
    return (one.found == WRONG) & (one.scores >= threshold)


def long_misses(all_scenes, threshold):
    """The stretches in which a person of more than LARGE_PERSON of the picture had no detection, longest first."""
    stamps = [one.picture.time_s for one in all_scenes]
    counts = [~one.ignored & (areas(one.people) > LARGE_PERSON * one.width * one.height) for one in all_scenes]
    return misses(stamps, [one.people for one in all_scenes],
                  [people_found(one, threshold) for one in all_scenes], counts)


def recall_of_pictures(all_scenes, threshold):
    """Recall of each picture with people."""
    return [float(np.mean(people_found(one, threshold)[~one.ignored])) for one in all_scenes if np.any(~one.ignored)]
