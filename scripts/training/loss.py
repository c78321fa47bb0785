"""What the network is trained to make small: boxes by CIoU, objectness by cross entropy, both summed over all heads and
divided by the number of assigned places. Places where the right answer is not known are left out."""

import warnings
from dataclasses import dataclass

import torch
from torch.nn import functional

from .assignment import assign
from .boxes import complete_iou, torch_iou

warnings.filterwarnings("ignore", "scatter_reduce.* is in beta")


@dataclass(frozen=True)
class LossSettings:
    box_weight: float = 5.0
    objectness_weight: float = 1.0
    ignore_iou: float = 0.65  # an unassigned place that finds a person this well all the same is left in peace
    quality: float = 0.5  # how much of the objectness asked of a positive is its box's IoU; the rest is 1
    ratio: float = 3.0


@dataclass
class Targets:
    """Of a batch. boxes, ignored: M x 4 cxcywh, px of the input; *_picture: which picture each belongs to."""
    boxes: torch.Tensor
    picture: torch.Tensor
    ignored: torch.Tensor
    ignored_picture: torch.Tensor

    def to(self, device):
        return Targets(*(tensor.to(device) for tensor in vars(self).values()))


def detection_loss(raw, heads, targets, input_size, settings=LossSettings()):
    """raw: the network's outputs, a tensor a head. Returns the loss to be minimised and its parts (floats: box,
    objectness, mean IoU of the positives)."""
    assignments = assign(heads, targets.boxes, targets.picture, input_size, settings.ratio)
    count = max(1, sum(len(a.anchor) for a in assignments))
    box_sum, objectness_sum, iou_sum = 0.0, 0.0, 0.0
    for output, head, assignment in zip(raw, heads, assignments):
        boxes, logits = head.decode(output.float())
        wanted, weight = objectness_targets(boxes.detach(), head, targets, settings)
        if len(assignment.anchor):
            at = (assignment.picture, assignment.anchor, slice(None), assignment.row, assignment.column)
            found = boxes[at]
            box_sum = box_sum + (1 - complete_iou(found, assignment.boxes)).sum()
            iou = torch_iou(found, assignment.boxes).detach().clamp(0, 1)
            iou_sum += float(iou.sum())
            place = flat_places(assignment, wanted.shape)
            wanted.view(-1).scatter_reduce_(0, place, 1 - settings.quality + settings.quality * iou, "amax")
            weight.view(-1)[place] = 1.0
        entropy = functional.binary_cross_entropy_with_logits(logits[:, :, 0], wanted, reduction="none")
        objectness_sum = objectness_sum + (entropy * weight).sum()
    box, objectness = settings.box_weight * box_sum / count, settings.objectness_weight * objectness_sum / count
    return box + objectness, {"box": float(box), "objectness": float(objectness), "iou": iou_sum / count}


def flat_places(assignment, shape):
    """The assigned places as indices into a flattened tensor of shape N, anchors, rows, columns."""
    _, anchors, rows, columns = shape
    return ((assignment.picture * anchors + assignment.anchor) * rows + assignment.row) * columns + assignment.column


@torch.no_grad()
def objectness_targets(boxes, head, targets, settings):
    """For places without an assignment: nothing wanted, and weight 0 where a person is found all the same or nobody
    knows what is there. boxes: N, anchors, 4, rows, columns."""
    shape = (boxes.shape[0], boxes.shape[1], *boxes.shape[3:])
    wanted, weight = torch.zeros(shape, device=boxes.device), torch.ones(shape, device=boxes.device)
    for n in range(shape[0]):
        people = targets.boxes[targets.picture == n]
        if len(people):
            # Cheap first: only places whose centre is in a person can overlap it that much.
            places = inside_any(boxes[n], people).nonzero(as_tuple=True)
            candidates = boxes[n].permute(0, 2, 3, 1)[places]
            best = torch_iou(candidates[:, None], people[None]).amax(1)
            weight[n][places] = (best <= settings.ignore_iou).float()
        unknown = targets.ignored[targets.ignored_picture == n]
        if len(unknown):
            weight[n][inside_any(cell_centres(boxes[n], head), unknown)] = 0.0
    return wanted, weight


def inside_any(boxes, areas):
    """Whether centres lie in one of the areas (cxcywh). boxes: anchors, 4, rows, columns."""
    apart_x = (boxes[:, 0, ..., None] - areas[:, 0]).abs() < areas[:, 2] / 2
    apart_y = (boxes[:, 1, ..., None] - areas[:, 1]).abs() < areas[:, 3] / 2
    return (apart_x & apart_y).any(-1)


def cell_centres(boxes, head):
    rows, columns = boxes.shape[-2:]
    y, x = torch.meshgrid(torch.arange(rows, device=boxes.device), torch.arange(columns, device=boxes.device),
                          indexing="ij")
    centre = (torch.stack([x, y]) + 0.5) * head.stride
    return centre.expand(boxes.shape[0], 2, rows, columns)
