"""Which cells and anchors answer for which person.

Static, several per person: every anchor whose sides are within `ratio` of the box's, in the centre's cell and in the
neighbours nearest to the centre in x and in y, as far as scale_x_y lets a centre leave its cell. A box that no anchor
fits takes the best one.
"""

from dataclasses import dataclass

import torch


@dataclass
class Assignment:
    """Of one head: index vectors of equal length, and the boxes (cxcywh, px) that those places are to give."""
    picture: torch.Tensor
    anchor: torch.Tensor
    row: torch.Tensor
    column: torch.Tensor
    boxes: torch.Tensor


def assign(heads, boxes, picture, input_size, ratio=3.0):
    """boxes: M x 4 cxcywh, px; picture: the M pictures' indices; input_size: width, height. Returns an Assignment per
    head."""
    anchors = torch.tensor([anchor for head in heads for anchor in head.anchors], device=boxes.device)
    worst = worst_ratios(boxes[:, 2:], anchors)
    fits = worst < ratio
    if len(boxes):
        fits[torch.arange(len(boxes), device=boxes.device), worst.argmin(1)] = True
    result, first = [], 0
    for head in heads:
        count = len(head.anchors)
        which, anchor = fits[:, first:first + count].nonzero(as_tuple=True)
        first += count
        result.append(spread(head, boxes[which], picture[which], anchor, input_size))
    return result


def worst_ratios(sizes, anchors):
    """How many times larger or smaller the box is than the anchor, along the worse side; M x anchors."""
    ratio = sizes[:, None] / anchors[None]
    return torch.maximum(ratio, 1 / ratio).amax(2)


def spread(head, boxes, picture, anchor, input_size):
    """The cell of every centre and up to two neighbours."""
    columns, rows = (side // head.stride for side in input_size)
    centre = boxes[:, :2] / head.stride
    cell = centre.floor()
    inside = centre - cell
    reach = (head.scale_xy - 1) / 2  # cells a centre may leave its own by
    places = [(cell, torch.ones(len(boxes), dtype=torch.bool, device=boxes.device))]
    for axis in (0, 1):
        for step in (-1.0, 1.0):
            # A margin: the last bit of the reach needs an infinite logit.
            beyond = inside[:, axis] if step < 0 else 1 - inside[:, axis]
            moved = cell.clone()
            moved[:, axis] += step
            places.append((moved, beyond < reach * 0.999))
    chosen = torch.cat([mask for _, mask in places])
    cells = torch.cat([place for place, _ in places])
    chosen &= (cells[:, 0] >= 0) & (cells[:, 0] < columns) & (cells[:, 1] >= 0) & (cells[:, 1] < rows)
    cells = cells[chosen].long()
    repeated = [values.repeat(len(places), *([1] * (values.dim() - 1)))[chosen] for values in (picture, anchor, boxes)]
    return Assignment(repeated[0], repeated[1], cells[:, 1], cells[:, 0], repeated[2])
