"""Reads pictures once and keeps them in memory, as far as allowed."""

import cv2
import numpy as np

from cpslam_tools.errors import InputError


class PictureStore:
    """uint8 B,G,R pictures whose longer side is at most `longest` px."""

    def __init__(self, records, longest=448, memory=6 << 30):
        self._paths = [record.path for record in records]
        self._longest = longest
        self._kept = []
        for path in self._paths:
            if memory <= 0:
                break
            self._kept.append(self._read(path))
            memory -= self._kept[-1].nbytes

    def __len__(self):
        return len(self._paths)

    def __getitem__(self, index):
        return self._kept[index] if index < len(self._kept) else self._read(self._paths[index])

    def _read(self, path):
        picture = cv2.imread(path, cv2.IMREAD_COLOR)
        if picture is None:
            raise InputError(f"cannot read the picture {path}")
        shrink = self._longest / max(picture.shape[:2])
        if shrink < 1:
            size = np.maximum(1, np.round(np.array(picture.shape[1::-1]) * shrink)).astype(int)
            picture = cv2.resize(picture, tuple(int(s) for s in size), interpolation=cv2.INTER_AREA)
        return picture


def letterbox(picture, width, height):
    """Scaled to fit, centred, the rest grey, as src/detect/letterbox does. Returns it with scale and left, top px."""
    scale = min(width / picture.shape[1], height / picture.shape[0])
    size = (max(1, round(picture.shape[1] * scale)), max(1, round(picture.shape[0] * scale)))
    smaller = cv2.resize(picture, size, interpolation=cv2.INTER_LINEAR)
    left, top = (width - size[0]) // 2, (height - size[1]) // 2
    canvas = np.full((height, width, 3), 114, np.uint8)
    canvas[top:top + size[1], left:left + size[0]] = smaller
    return canvas, scale, left, top
