"""The endless row of training pictures. Number n is a function of the seed and n alone, whoever makes it: an
interrupted run goes on with the pictures it would have seen."""

from dataclasses import dataclass

import numpy as np
import torch
from torch.utils import data

from .boxes import to_cxcywh
from .loss import Targets


@dataclass
class Source:
    """Record indices with their chances, and the share of all training pictures drawn from here."""
    share: float
    indices: np.ndarray
    chances: np.ndarray


class Samples(data.Dataset):
    """Keys are (n, side in px)."""

    def __init__(self, maker, sources, seed):
        self._maker = maker
        self._sources = sources
        self._shares = np.array([source.share for source in sources]) / sum(source.share for source in sources)
        self._seed = seed

    def __getitem__(self, key):
        number, side = key
        generator = np.random.default_rng([self._seed, number])
        source = self._sources[generator.choice(len(self._sources), p=self._shares)]
        steps = np.cumsum(source.chances)

        def draw():
            return int(source.indices[min(np.searchsorted(steps, generator.random()), len(steps) - 1)])

        return self._maker.make(side, draw, generator)


@dataclass
class Batch:
    """pictures: uint8 N x 3 x rows x columns, R,G,B; soft: the teacher's logits per head, or empty."""
    pictures: torch.Tensor
    targets: Targets
    soft: list


class Collate:
    """Makes a Batch of samples; teacher: a Teacher or None."""

    def __init__(self, teacher=None):
        self._teacher = teacher

    def __call__(self, items):
        pictures = [picture for picture, _, _ in items]
        soft = [torch.from_numpy(logits) for logits in self._teacher(pictures)] if self._teacher else []
        stack = np.stack([np.ascontiguousarray(picture[:, :, ::-1].transpose(2, 0, 1)) for picture in pictures])
        people, of_people = join([boxes for _, boxes, _ in items])
        ignored, of_ignored = join([boxes for _, _, boxes in items])
        return Batch(torch.from_numpy(stack), Targets(people, of_people, ignored, of_ignored), soft)


def join(lists):
    picture = np.repeat(np.arange(len(lists)), [len(boxes) for boxes in lists])
    return torch.from_numpy(to_cxcywh(np.concatenate(lists)).astype(np.float32)), torch.from_numpy(picture)


class Batches(data.Sampler):
    """The keys of every batch from a number of pictures on; plan(n): the side of the batch that begins with n."""

    def __init__(self, first, last, size, plan):
        self._first, self._last, self._size, self._plan = first, last, size, plan

    def __iter__(self):
        for n in range(self._first, self._last, self._size):
            side = self._plan(n)
            yield [(i, side) for i in range(n, n + self._size)]

    def __len__(self):
        return max(0, -(-(self._last - self._first) // self._size))
