"""Where a picture, and the boxes in it, come to lie in a training picture."""

from dataclasses import dataclass

import numpy as np

from . import boxes as box

# Of a person whose box is cut: shown at least this share of it, or filling that share of the window, it is to be
# found; below, nobody can tell, and it is ignored.
LABELLED_SHARE = 0.15
LABELLED_FILL = 0.20
SMALLEST_SIDE = 4.0  # px; smaller people are ignored


@dataclass
class Window:
    """A part of the training picture, px: what it shows does not reach beyond it."""
    x0: int
    y0: int
    x1: int
    y1: int

    def size(self):
        return np.array([self.x1 - self.x0, self.y1 - self.y0])

    def area(self):
        return float(self.size().prod())

    def clip(self, xyxy):
        low, high = np.array([self.x0, self.y0]), np.array([self.x1, self.y1])
        return np.concatenate([np.clip(xyxy[:, :2], low, high), np.clip(xyxy[:, 2:], low, high)], 1)


def linear_map(scale, stretch, angle, mirrored):
    """2 x 2: mirrored first, then widths stretched by `stretch` (and heights shrunk by as much), then turned."""
    root = np.sqrt(stretch)
    shape = scale * np.diag([-root if mirrored else root, 1 / root])
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) @ shape


def affine(linear, source_point, target_point):
    """2 x 3: linear, with source_point coming to lie on target_point (px)."""
    return np.column_stack([linear, np.asarray(target_point) - linear @ np.asarray(source_point)])


def move_boxes(xyxy, matrix):
    """The boxes around the ellipses that fill the boxes: turned by 45 degrees, the box around the turned box would be
    up to twice too large for a person, who fills no corner. Exact when nothing is turned."""
    half = (xyxy[:, 2:] - xyxy[:, :2]) / 2
    centre = (xyxy[:, :2] + xyxy[:, 2:]) / 2 @ matrix[:, :2].T + matrix[:, 2]
    reach = np.sqrt((half ** 2) @ (matrix[:, :2] ** 2).T)
    return np.concatenate([centre - reach, centre + reach], 1)


def cut_boxes(xyxy, window):
    """Clips boxes at the window's border. Returns those to be found and those to be ignored."""
    clipped = window.clip(xyxy)
    area = box.areas(clipped)
    share = area / np.maximum(box.areas(xyxy), 1e-9)
    sides = clipped[:, 2:] - clipped[:, :2]
    there = sides.min(1, initial=np.inf) > 0.5
    clear = ((share >= LABELLED_SHARE) | (area >= LABELLED_FILL * window.area())) & (sides.min(1) >= SMALLEST_SIDE) \
        if len(xyxy) else there
    return clipped[there & clear], clipped[there & ~clear]
