"""Average precision of a network over records: the area under the envelope of precision over recall at IoU 0.5."""

from dataclasses import dataclass

import cv2
import numpy as np
import torch

from cpslam_tools.detection import precision_recall

from .boxes import overlaps, to_xyxy
from .pictures import letterbox

LOWEST_SCORE = 0.01
NMS_IOU = 0.45
MATCH_IOU = 0.5


@dataclass
class Accuracy:
    average_precision: float
    recall: float  # at the threshold
    precision: float  # at the threshold
    threshold: float
    best_threshold: float  # where 2 P R / (P + R) is largest


def detect(network, picture, width, height):
    """Boxes (xyxy, px of the picture) and scores of one B,G,R picture, most confident first."""
    fitted, scale, left, top = letterbox(picture, width, height)
    device = next(network.parameters()).device
    blob = torch.from_numpy(np.ascontiguousarray(fitted[:, :, ::-1].transpose(2, 0, 1))[None]).to(device).float() / 255
    with torch.no_grad():
        outputs = [head.decode(raw) for head, raw in zip(network.heads, network(blob))]
    boxes, scores = [], []
    for found, logits in outputs:
        score = (logits[:, :, 0].sigmoid() * logits[:, :, 1].sigmoid()).flatten()
        kept = score >= LOWEST_SCORE
        boxes.append(found.permute(0, 1, 3, 4, 2).reshape(-1, 4)[kept].cpu().numpy())
        scores.append(score[kept].cpu().numpy())
    boxes, scores = to_xyxy(np.concatenate(boxes).astype(np.float64)), np.concatenate(scores)
    boxes, scores = suppress(boxes, scores)
    boxes = (boxes - np.array([left, top, left, top])) / scale
    limits = np.array([picture.shape[1], picture.shape[0]] * 2)
    return np.clip(boxes, 0, limits), scores


def suppress(boxes, scores):
    """Of boxes that overlap the most confident stays."""
    rows = [[x0, y0, x1 - x0, y1 - y0] for x0, y0, x1, y1 in boxes]
    kept = cv2.dnn.NMSBoxes(rows, [float(s) for s in scores], 0.0, NMS_IOU) if rows else []
    kept = np.array(kept, int).reshape(-1)
    return boxes[kept], scores[kept]


def match(boxes, truth, ignored):
    """Per box, most confident first: 1 right, 0 wrong, -1 on a place that is ignored. Each truth counts once."""
    verdicts = np.zeros(len(boxes), int)
    taken = np.zeros(len(truth), bool)
    iou = overlaps(boxes, truth)
    for i in range(len(boxes)):
        free = np.where(taken, 0, iou[i])
        if len(truth) and free.max() >= MATCH_IOU:
            taken[free.argmax()] = True
            verdicts[i] = 1
        elif len(ignored) and share_inside(boxes[i], ignored).max() >= 0.5:
            verdicts[i] = -1
    return verdicts


def share_inside(box, areas):
    """What share of the box lies in each area."""
    low, high = np.maximum(box[:2], areas[:, :2]), np.minimum(box[2:], areas[:, 2:])
    return np.prod(np.maximum(high - low, 0), 1) / max(np.prod(box[2:] - box[:2]), 1e-9)


def average_precision(scores, verdicts, n_truth):
    """The area under the envelope, and recall and precision after each score, highest first."""
    counted = verdicts >= 0
    points = precision_recall.curve(scores[counted], verdicts[counted] == 1, n_truth)
    area = precision_recall.average_precision(points, n_truth) or 0.0
    return area, points.thresholds, points.recall, points.precision


def measure(network, records, pictures, width, height, threshold=0.3):
    """network: in evaluation mode. pictures: a PictureStore of the records."""
    scores, verdicts, n_truth = [], [], 0
    for i, record in enumerate(records):
        size = np.tile(pictures[i].shape[1::-1], 2)
        boxes, found = detect(network, pictures[i], width, height)
        scores.append(found)
        verdicts.append(match(boxes, record.boxes * size, record.ignored * size))
        n_truth += len(record.boxes)
    area, ranked, recall, precision = average_precision(np.concatenate(scores), np.concatenate(verdicts), n_truth)
    if not len(ranked):
        return Accuracy(0.0, 0.0, 0.0, threshold, threshold)
    _, best_threshold = precision_recall.best_f1(precision_recall.Curve(ranked, precision, recall))
    last = np.searchsorted(-ranked, -threshold, "right") - 1
    return Accuracy(area, float(recall[last]) if last >= 0 else 0.0, float(precision[last]) if last >= 0 else 0.0,
                    threshold, best_threshold)
