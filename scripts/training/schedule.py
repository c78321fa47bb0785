"""What changes while training goes on, as functions of the number of pictures seen."""

import math
from dataclasses import dataclass

import numpy as np

from cpslam_tools.errors import InputError

LAST_RATE = 0.02  # of the highest learning rate


@dataclass(frozen=True)
class Schedule:
    """total: pictures in all; warm_up: pictures until the learning rate is at its highest; hold: share of total from
    which on it falls, along half a cosine; sizes: (share of total, px) from which on pictures are about so large."""
    total: int
    warm_up: int
    hold: float
    sizes: tuple
    stride: int
    seed: int

    def rate(self, n):
        """As a share of the highest."""
        if n < self.warm_up:
            return (n + 1) / self.warm_up
        done = max(0.0, n / self.total - self.hold) / max(1e-9, 1 - self.hold)
        return LAST_RATE + (1 - LAST_RATE) * (1 + math.cos(math.pi * min(1.0, done))) / 2

    def size(self, n):
        """Side of the pictures of the batch beginning with number n, px: the stage's, or one stride off."""
        stage = [px for share, px in self.sizes if n >= share * self.total][-1]
        return stage + self.stride * int(np.random.default_rng([self.seed, 1, n]).integers(-1, 2))


def parse_sizes(text, stride):
    """ "0:192,0.5:320" """
    try:
        sizes = tuple((float(share), int(px)) for share, px in (item.split(":") for item in text.split(",")))
    except ValueError:
        raise InputError(f"--sizes {text}: expected SHARE:PX,SHARE:PX,...") from None
    if sizes[0][0] != 0 or list(sizes) != sorted(sizes) or any(px % stride or px < 2 * stride for _, px in sizes):
        raise InputError(f"--sizes {text}: shares must grow from 0, sides be multiples of {stride} px from "
                         f"{2 * stride} on")
    return sizes
