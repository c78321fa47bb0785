"""Soft labels from a detector of many classes: what it says at every place of a training picture, for all of its
classes. They teach what a room is made of besides people, which a few thousand pictures of people alone do not."""

import cv2
import numpy as np

from cpslam_tools.errors import InputError

BOX_VALUES = 4
TRY_SIDE = 192
LIMIT = 9.0  # logits beyond are all the same: certain


class Teacher:
    """A YOLOX network as ONNX: takes B,G,R in 0 to 255, gives per stride a map of box, objectness and class scores
    (after the sigmoid) that are joined by a Concat layer each. Loaded when first used: OpenCV's networks do not
    survive a fork."""

    def __init__(self, path, strides):
        """strides: of the maps wanted, in that order. Raises InputError when it does not give them."""
        self._path = path
        self._strides = strides
        self._net = None
        net = self._load()
        concats = [name for name in net.getLayerNames() if "Concat" in name]
        net.setInput(np.zeros((1, 3, TRY_SIDE, TRY_SIDE), np.float32))
        maps = dict(zip(concats, net.forward(concats))) if concats else {}
        self._names = [self._find(maps, TRY_SIDE // stride) for stride in strides]
        self.n_channels = maps[self._names[0]].shape[1] - BOX_VALUES

    def _load(self):
        try:
            return cv2.dnn.readNetFromONNX(self._path)
        except cv2.error:
            raise InputError(f"OpenCV cannot read {self._path}: expected a YOLOX network as ONNX") from None

    def _find(self, maps, side):
        fitting = [name for name, values in maps.items()
                   if values.ndim == 4 and values.shape[2:] == (side, side) and is_score(values[0, BOX_VALUES:])]
        if not fitting:
            raise InputError(f"{self._path} gives no scores at a stride of {TRY_SIDE // side} px")
        return fitting[-1]

    def __call__(self, pictures):
        """pictures: N square B,G,R pictures, uint8. Returns per stride logits N, channels, rows, columns (float16),
        objectness first."""
        if self._net is None:
            self._net = self._load()
        self._net.setInput(np.ascontiguousarray(np.stack(pictures).transpose(0, 3, 1, 2), np.float32))
        return [to_logits(values[:, BOX_VALUES:]) for values in self._net.forward(self._names)]


def is_score(values):
    return values.shape[0] > 1 and values.min() >= 0 and values.max() <= 1


def to_logits(scores):
    scores = np.clip(scores, 1e-5, 1 - 1e-5)
    return np.clip(np.log(scores / (1 - scores)), -LIMIT, LIMIT).astype(np.float16)
