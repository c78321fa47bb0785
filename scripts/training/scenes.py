"""Training pictures put together from source pictures: a part of one, or a mosaic of four or nine, with cut-out people
on top. The same generator state gives the same picture."""

from dataclasses import dataclass

import cv2
import numpy as np

from .cutouts import paste
from .geometry import Window, affine, cut_boxes, linear_map, move_boxes
from .photometry import weather

GREY = 114  # what the letterbox fills with


@dataclass(frozen=True)
class SceneSettings:
    mosaic: float = 0.4  # chance of four pictures in one,
    mosaic_of_nine: float = 0.08  # and of nine
    turned: float = 0.3  # chance of a turn of up to +-45 degrees
    pasted: float = 0.3  # chance of cut-out people
    most_pasted: int = 4
    plain: float = 0.1  # chance of a letterboxed picture as the detector will see it


class SceneMaker:
    """pictures: a PictureStore of the records; cutouts: from load_cutouts(), may be empty."""

    def __init__(self, records, pictures, cutouts, settings=SceneSettings()):
        self._records = records
        self._pictures = pictures
        self._cutouts = cutouts
        self._settings = settings
        self._empty = [i for i, r in enumerate(records) if not len(r.boxes) and not len(r.ignored)]

    def make(self, side, draw, generator):
        """A side x side picture (B,G,R), boxes to be found and boxes to be ignored (xyxy, px). draw(): the index of a
        picture."""
        settings, chance = self._settings, generator.random()
        canvas = np.full((side, side, 3), GREY, np.uint8)
        if chance < settings.mosaic_of_nine:
            found = [self._fill(canvas, window, draw(), generator, (0.8, 1.8)) for window in split(side, 3, generator)]
        elif chance < settings.mosaic_of_nine + settings.mosaic:
            found = [self._fill(canvas, window, draw(), generator, (0.8, 2.5)) for window in split(side, 2, generator)]
        else:
            found = [self._single(canvas, draw(), generator)]
        people = np.concatenate([boxes for boxes, _ in found])
        ignored = np.concatenate([boxes for _, boxes in found])
        if self._cutouts and generator.random() < settings.pasted:
            for _ in range(generator.integers(1, settings.most_pasted + 1)):
                cutout, cut_below = self._cutouts[generator.integers(len(self._cutouts))]
                people, ignored = paste(canvas, people, ignored, cutout, cut_below, generator)
        return weather(canvas, generator), people.astype(np.float32), ignored.astype(np.float32)

    def _single(self, canvas, index, generator):
        side = canvas.shape[0]
        window = Window(0, 0, side, side)
        if generator.random() < self._settings.plain:
            return self._place(canvas, window, index, linear_map(self._fit(index, window), 1, 0, False),
                               self._middle(index), window.size() / 2)
        if generator.random() < 0.5:
            self._prepare(canvas, generator)
        return self._fill(canvas, window, index, generator, (0.5, 2.8))

    def _prepare(self, canvas, generator):
        """Something else than grey behind a small picture: a colour, or a picture without people."""
        if self._empty and generator.random() < 0.6:
            picture = self._pictures[self._empty[generator.integers(len(self._empty))]]
            canvas[:] = cv2.resize(picture, canvas.shape[1::-1], interpolation=cv2.INTER_LINEAR)
        else:
            canvas[:] = generator.integers(0, 256, 3)

    def _fill(self, canvas, window, index, generator, zooms):
        """Puts a picture into the window, scaled from where it fits by a factor of that range, at random around a
        person or any place."""
        zoom = np.exp(generator.uniform(*np.log(zooms)))
        angle = np.radians(generator.uniform(-45, 45) if generator.random() < self._settings.turned
                           else generator.normal(0, 3))
        stretch = np.exp(generator.normal(0, 0.25))
        linear = linear_map(zoom * self._fit(index, window), stretch, angle, generator.random() < 0.5)
        size = np.array(self._pictures[index].shape[1::-1])
        boxes = self._records[index].boxes
        if len(boxes) and zoom > 1 and generator.random() < 0.7:
            x0, y0, x1, y1 = boxes[generator.integers(len(boxes))]
            source = np.array([generator.uniform(x0, x1), generator.uniform(y0, y1)]) * size
            target = (window.x0, window.y0) + window.size() * generator.uniform(0.2, 0.8, 2)
        else:
            # So that the picture covers the window, or the window the picture, as far as their sizes allow.
            room = np.abs(window.size() - np.abs(linear) @ size) / 2
            source, target = size / 2, self._centre(window) + generator.uniform(-1, 1, 2) * room
        return self._place(canvas, window, index, linear, source, target)

    def _place(self, canvas, window, index, linear, source_point, target_point):
        picture, record = self._pictures[index], self._records[index]
        size = np.array(picture.shape[1::-1])
        matrix = affine(linear, source_point, target_point)
        found = move_boxes(record.boxes * np.tile(size, 2), matrix)
        unknown = move_boxes(record.ignored * np.tile(size, 2), matrix)
        draw_into(canvas, window, picture, matrix)
        people, lost = cut_boxes(found, window)
        left_out = window.clip(unknown)
        left_out = left_out[(left_out[:, 2:] - left_out[:, :2]).min(1, initial=np.inf) > 0.5]
        return people, np.concatenate([lost, left_out])

    def _fit(self, index, window):
        height, width = self._pictures[index].shape[:2]
        return min(window.size() / (width, height))

    def _middle(self, index):
        height, width = self._pictures[index].shape[:2]
        return np.array([width, height]) / 2

    @staticmethod
    def _centre(window):
        return np.array([window.x0 + window.x1, window.y0 + window.y1]) / 2


def split(side, parts, generator):
    """parts x parts windows whose inner borders lie anywhere near the even places."""
    cuts = []
    for _ in range(2):
        inner = (np.arange(1, parts) + generator.uniform(-0.4, 0.4, parts - 1)) / parts
        cuts.append([0, *(int(c) for c in np.round(inner * side)), side])
    return [Window(cuts[0][i], cuts[1][j], cuts[0][i + 1], cuts[1][j + 1])
            for j in range(parts) for i in range(parts)]


def draw_into(canvas, window, picture, matrix):
    """Warps the picture into the window of the canvas; what it does not cover stays."""
    scale = np.sqrt(abs(np.linalg.det(matrix[:, :2])))
    matrix = matrix.copy()
    if scale < 0.6:  # bilinear sampling would skip pixels
        before = np.array(picture.shape[1::-1])
        picture = cv2.resize(picture, tuple(int(s) for s in np.maximum(1, np.round(before * scale))),
                             interpolation=cv2.INTER_AREA)
        matrix[:, :2] = matrix[:, :2] * (before / np.array(picture.shape[1::-1]))
    matrix[:, 2] -= (window.x0, window.y0)
    # Half a pixel: boxes are in coordinates of borders, OpenCV's pixels have their centres at whole numbers.
    matrix[:, 2] += matrix[:, :2] @ (0.5, 0.5) - 0.5
    part = canvas[window.y0:window.y1, window.x0:window.x1]
    drawn = np.ascontiguousarray(part)
    cv2.warpAffine(picture, matrix, tuple(int(s) for s in window.size()), drawn, cv2.INTER_LINEAR,
                   cv2.BORDER_TRANSPARENT)
    part[:] = drawn

