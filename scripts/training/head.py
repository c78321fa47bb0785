"""What a [yolo] section makes of the raw numbers that come in."""

from dataclasses import dataclass

import torch


@dataclass(frozen=True)
class Head:
    """One [yolo] section. Its raw outputs per anchor are x, y, w, h, objectness and the classes' scores."""
    stride: int
    anchors: tuple  # (width, height), px of the input
    n_classes: int
    scale_xy: float
    squared: bool  # new_coords=1: sizes are (2 sigmoid)^2 anchors instead of exp anchors

    def rows(self):
        return len(self.anchors) * (5 + self.n_classes)

    def decode(self, raw):
        """raw: N, anchors, 5 + classes, rows, columns. Returns boxes (cx, cy, w, h), px of the input, and logits."""
        height, width = raw.shape[-2:]
        column = torch.arange(width, device=raw.device, dtype=raw.dtype).view(1, 1, 1, width)
        row = torch.arange(height, device=raw.device, dtype=raw.dtype).view(1, 1, height, 1)
        anchors = torch.tensor(self.anchors, device=raw.device, dtype=raw.dtype).view(1, -1, 2, 1, 1)
        x = (self.offset(raw[:, :, 0]) + column) * self.stride
        y = (self.offset(raw[:, :, 1]) + row) * self.stride
        sizes = self.sizes(raw[:, :, 2:4], anchors)
        return torch.stack([x, y, sizes[:, :, 0], sizes[:, :, 1]], 2), raw[:, :, 4:]

    def offset(self, raw):
        """Where in its cell a centre lies; 0 to 1 is inside, scale_xy lets it leave."""
        return (raw.sigmoid() - 0.5) * self.scale_xy + 0.5

    def sizes(self, raw, anchors):
        if self.squared:
            return (2 * raw.sigmoid()) ** 2 * anchors
        return raw.clamp(max=8.0).exp() * anchors


def check_activation(section, yolo):
    """Darknet's new_coords leaves the sigmoid to the convolution before."""
    expected = "logistic" if yolo.integer("new_coords", 0) else "linear"
    if section.text("activation", "logistic") != expected:
        section.fail(f"stands before [yolo]: its activation must be {expected}", "activation")


def read_head(section, channels, stride):
    sides = section.reals("anchors")
    pairs = list(zip(sides[0::2], sides[1::2]))
    if len(sides) % 2 or section.integer("num") != len(pairs) or min(sides) <= 0:
        section.fail("anchors= must hold num= pairs of sides", "anchors")
    mask = section.integers("mask")
    if not all(0 <= i < len(pairs) for i in mask):
        section.fail("mask= names an anchor that is not there", "mask")
    head = Head(stride, tuple(pairs[i] for i in mask), section.integer("classes", lowest=1),
                section.real("scale_x_y", 1.0), section.integer("new_coords", 0) == 1)
    if head.rows() != channels:
        section.fail(f"takes {head.rows()} channels, anchors x (5 + classes), but gets {channels}")
    return head
