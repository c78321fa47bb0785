"""Boxes: xyxy (x0, y0, x1, y1) or cxcywh (centre, size), px. numpy for pictures, torch where gradients are needed."""

import numpy as np
import torch

EPSILON = 1e-7


def to_cxcywh(xyxy):
    return np.concatenate([(xyxy[..., :2] + xyxy[..., 2:]) / 2, xyxy[..., 2:] - xyxy[..., :2]], -1)


def to_xyxy(cxcywh):
    return np.concatenate([cxcywh[..., :2] - cxcywh[..., 2:] / 2, cxcywh[..., :2] + cxcywh[..., 2:] / 2], -1)


def areas(xyxy):
    return np.prod(np.maximum(xyxy[..., 2:] - xyxy[..., :2], 0), -1)


def overlaps(first, second):
    """Intersection over union of every first with every second box, xyxy; shape len(first), len(second)."""
    low = np.maximum(first[:, None, :2], second[None, :, :2])
    high = np.minimum(first[:, None, 2:], second[None, :, 2:])
    common = np.prod(np.maximum(high - low, 0), -1)
    return common / np.maximum(areas(first)[:, None] + areas(second)[None] - common, 1e-9)


def torch_iou(first, second):
    """Intersection over union, cxcywh, shapes that broadcast."""
    common, union = _common_and_union(first, second)
    return common / union


def complete_iou(predicted, target):
    """CIoU (Zheng et al. 2020) of cxcywh boxes, row by row: IoU less the centres' distance and the aspects' difference."""
    common, union = _common_and_union(predicted, target)
    iou = common / union
    low = torch.minimum(predicted[..., :2] - predicted[..., 2:] / 2, target[..., :2] - target[..., 2:] / 2)
    high = torch.maximum(predicted[..., :2] + predicted[..., 2:] / 2, target[..., :2] + target[..., 2:] / 2)
    diagonal = ((high - low) ** 2).sum(-1) + EPSILON
    distance = ((predicted[..., :2] - target[..., :2]) ** 2).sum(-1)
    angle = torch.atan(target[..., 2] / (target[..., 3] + EPSILON))
    angle = angle - torch.atan(predicted[..., 2] / (predicted[..., 3] + EPSILON))
    aspect = (2 / torch.pi * angle) ** 2
    with torch.no_grad():
        weight = aspect / (1 - iou + aspect + EPSILON)
    return iou - distance / diagonal - weight * aspect


def _common_and_union(first, second):
    low = torch.maximum(first[..., :2] - first[..., 2:] / 2, second[..., :2] - second[..., 2:] / 2)
    high = torch.minimum(first[..., :2] + first[..., 2:] / 2, second[..., :2] + second[..., 2:] / 2)
    common = (high - low).clamp(min=0).prod(-1)
    union = first[..., 2:].prod(-1) + second[..., 2:].prod(-1) - common + EPSILON
    return common, union
