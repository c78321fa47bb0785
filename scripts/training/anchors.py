"""Anchors by k-means under 1 - IoU (Redmon and Farhadi 2017), at the network's input size."""

import numpy as np

SCALES = (0.4, 1.6)  # what augmentation does to a picture's size, most of the time


def training_sizes(records, picture_sizes, side, generator, copies=4):
    """Widths and heights of the boxes, px of a side x side input, as augmentation scales and cuts them."""
    sizes = []
    for record, (width, height) in zip(records, picture_sizes):
        if not len(record.boxes):
            continue
        shares = record.boxes[:, 2:] - record.boxes[:, :2]
        letterboxed = shares * np.array([width, height]) * (side / max(width, height))
        for _ in range(copies):
            sizes.append(np.minimum(letterboxed * np.exp(generator.uniform(*np.log(SCALES))), side))
    sizes = np.concatenate(sizes)
    return sizes[sizes.min(1) >= 3]


def size_overlaps(sizes, anchors):
    """IoU of boxes and anchors with their centres on one another."""
    common = np.minimum(sizes[:, None], anchors[None]).prod(-1)
    return common / (sizes.prod(-1)[:, None] + anchors.prod(-1)[None] - common)


def find_anchors(sizes, count, generator, rounds=100):
    """Returns count x 2 anchors, smallest area first, and the mean IoU of a box with its best one."""
    anchors = sizes[generator.choice(len(sizes), count, replace=False)]
    for _ in range(rounds):
        best = size_overlaps(sizes, anchors).argmax(1)
        moved = np.array([np.median(sizes[best == i], 0) if np.any(best == i) else anchors[i] for i in range(count)])
        if np.allclose(moved, anchors):
            break
        anchors = moved
    anchors = anchors[np.argsort(anchors.prod(1))]
    return anchors, float(size_overlaps(sizes, anchors).max(1).mean())
