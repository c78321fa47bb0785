"""What the loaders of every format give: pictures' paths with their boxes."""

from dataclasses import dataclass, field

import numpy as np


def no_boxes():
    return np.zeros((0, 4), np.float32)


@dataclass
class Record:
    """One picture. boxes, ignored: xyxy as shares of the picture's sides. ignored: places where nobody knows who is
    there; finding something there is neither right nor wrong."""
    path: str
    boxes: np.ndarray = field(default_factory=no_boxes)
    ignored: np.ndarray = field(default_factory=no_boxes)

    def name(self):
        return self.path.rsplit("/", 1)[-1].rsplit(".", 1)[0]
