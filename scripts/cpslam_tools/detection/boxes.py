"""Boxes as arrays (n, 4): x, y of the top left corner, width, height, in px of their picture."""

import numpy as np


def as_boxes(rows):
    return np.asarray(rows, dtype=float).reshape(-1, 4)


def clipped(boxes, width, height):
    """What of the boxes lies in the picture. People at its border are told apart by what is seen of them."""
    left, top = np.clip(boxes[:, 0], 0, width), np.clip(boxes[:, 1], 0, height)
    right, bottom = np.clip(boxes[:, 0] + boxes[:, 2], 0, width), np.clip(boxes[:, 1] + boxes[:, 3], 0, height)
    return np.stack([left, top, right - left, bottom - top], axis=1)


def areas(boxes):
    return boxes[:, 2] * boxes[:, 3]


def overlaps(first, second):
    """(n, m) intersections over unions; 0 where both boxes are empty."""
    begin = np.maximum(first[:, None, :2], second[None, :, :2])
    end = np.minimum(first[:, None, :2] + first[:, None, 2:], second[None, :, :2] + second[None, :, 2:])
    common = np.prod(np.maximum(end - begin, 0), axis=2)
    union = areas(first)[:, None] + areas(second)[None, :] - common
    return np.divide(common, union, out=np.zeros_like(common), where=union > 0)
