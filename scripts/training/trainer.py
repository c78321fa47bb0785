"""The training loop: batches, validation, checkpoints, and a stop at any time without loss."""

import json
import os
import signal
import time
from dataclasses import dataclass

import torch
from torch.utils import data

from cpslam_tools.errors import InputError

from .accuracy import measure
from .averaging import Average
from .checkpoint import read_checkpoint, write_checkpoint
from .curves import draw_curves, write_table
from .imitation import Imitation
from .loss import detection_loss
from .network import initialise
from .samples import Batches, Collate
from .weights import save_weights

CHECKPOINT = "checkpoint.pt"
SAVE_EVERY_S = 300.0
LONGEST_GRADIENT = 20.0


@dataclass(frozen=True)
class TrainerSettings:
    output: str
    batch: int
    rate: float
    decay: float
    validate_every: int  # pictures
    validation_size: int  # px
    n_workers: int
    device: str
    seed: int
    imitation: float = 3.0  # weight of the teacher's soft labels


class Trainer:
    """network: as built from the .cfg. samples: a Dataset for Batches' keys. validate: records and their pictures.
    teacher: a Teacher with the strides of the network's heads, or None."""

    def __init__(self, network, samples, validate, schedule, settings, report, teacher=None):
        if any(head.n_classes != 1 for head in network.heads):
            raise InputError("only networks of one class are trained")
        initialise(network, torch.Generator().manual_seed(settings.seed))
        self._device = torch.device(settings.device)
        self.network = network.to(self._device)
        self.average = Average(self.network)
        self._optimizer = torch.optim.AdamW(parameter_groups(network, settings.decay), lr=settings.rate,
                                            betas=(0.9, 0.99))
        self._teacher, self._imitation = teacher, None
        if teacher is not None:
            self._imitation = Imitation(network, teacher.n_channels, settings.rate, settings.imitation, self._device)
        self._samples, self._validate, self._schedule = samples, validate, schedule
        self._settings, self._report = settings, report
        self.n_pictures = 0
        self.history = []  # a dictionary per validation
        self.seconds = 0.0  # spent training, earlier runs included
        self._sums = {}
        self._stop = False

    def path(self, name):
        return os.path.join(self._settings.output, name)

    def save(self, name=CHECKPOINT):
        # Numbers as text: read_checkpoint() takes tensors and texts only. Rates and the like come with the command.
        progress = {"n_pictures": self.n_pictures, "steps": self.average.steps, "seconds": self.seconds,
                    "history": self.history}
        state = {"network": self.network.state_dict(), "average": self.average.network.state_dict(),
                 "optimizer": self._optimizer.state_dict()["state"], "progress": json.dumps(progress)}
        if self._imitation is not None:
            state["imitation"] = self._imitation.state_dict()
            state["imitation_optimizer"] = self._imitation.optimizer.state_dict()["state"]
        write_checkpoint(state, self.path(name))

    def resume(self, path):
        """Goes on where the checkpoint was written. One without a teacher can go on with one, and the other way round."""
        read_checkpoint(path, self._device, self._restore)

    def _restore(self, state):
        self.network.load_state_dict(state["network"])
        self.average.network.load_state_dict(state["average"])
        restore_optimizer(self._optimizer, state["optimizer"])
        if self._imitation is not None and "imitation" in state:
            self._imitation.load_state_dict(state["imitation"])
            restore_optimizer(self._imitation.optimizer, state["imitation_optimizer"])
        progress = json.loads(state["progress"])
        self.n_pictures, self.average.steps = progress["n_pictures"], progress["steps"]
        self.history, self.seconds = progress["history"], progress["seconds"]

    def run(self):
        """Trains up to the schedule's total, or until SIGINT or SIGTERM. Returns whether it got there."""
        before = {number: signal.signal(number, self._interrupt) for number in (signal.SIGINT, signal.SIGTERM)}
        try:
            self._train()
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)
        if not self._stop and (not self.history or self.history[-1]["pictures"] != self.n_pictures):
            self._check()
        return not self._stop

    def _train(self):
        batches = Batches(self.n_pictures, self._schedule.total, self._settings.batch, self._schedule.size)
        loader = data.DataLoader(self._samples, batch_sampler=batches, collate_fn=Collate(self._teacher),
                                 num_workers=self._settings.n_workers, worker_init_fn=start_worker,
                                 prefetch_factor=4 if self._settings.n_workers else 2)
        started = saved = time.monotonic()
        seconds = self.seconds
        for batch in loader:
            parts = self._step(batch)
            self.n_pictures += len(batch.pictures)
            self.seconds = seconds + time.monotonic() - started
            self._add(parts)
            self._report.progress(self, batch.pictures.shape[-1], self._schedule.total, parts)
            due = self.n_pictures // self._settings.validate_every
            if due > (self.n_pictures - len(batch.pictures)) // self._settings.validate_every:
                self._check()
            if time.monotonic() - saved > SAVE_EVERY_S or self._stop:
                self.save()
                saved = time.monotonic()
            if self._stop:
                return

    def _interrupt(self, *_):
        self._stop = True

    def _step(self, batch):
        self.network.train()
        optimizers = [self._optimizer] + ([self._imitation.optimizer] if self._imitation is not None else [])
        rate = self._settings.rate * self._schedule.rate(self.n_pictures)
        for group in [group for optimizer in optimizers for group in optimizer.param_groups]:
            group["lr"] = rate
        loss, parts = self._loss(batch)
        for optimizer in optimizers:
            optimizer.zero_grad(set_to_none=True)
        loss.backward()
        norm = torch.nn.utils.clip_grad_norm_(self.network.parameters(), LONGEST_GRADIENT)
        if not torch.isfinite(norm):
            raise InputError(f"the loss is not finite any more after {self.n_pictures} pictures: go on from the last "
                             "checkpoint with a lower --rate")
        for optimizer in optimizers:
            optimizer.step()
        self.average.update(self.network)
        return {**parts, "rate": rate, "gradient": float(norm)}

    def _loss(self, batch):
        pictures = batch.pictures.to(self._device).float() / 255
        with torch.autocast(self._device.type, torch.bfloat16, enabled=self._device.type == "cuda"):
            raw, features = self.network(pictures, features=True)
        loss, parts = detection_loss(raw, self.network.heads, batch.targets.to(self._device), pictures.shape[:1:-1])
        if self._imitation is not None:
            imitation = self._imitation.loss(features, [logits.to(self._device) for logits in batch.soft])
            loss, parts = loss + imitation, {**parts, "imitation": float(imitation)}
        return loss, parts

    def _add(self, parts):
        for name, value in parts.items():
            self._sums.setdefault(name, []).append(value)

    def _check(self):
        """Measures the averaged network; keeps its weights when they are the best so far."""
        records, pictures = self._validate
        size = self._settings.validation_size
        result = measure(self.average.network, records, pictures, size, size)
        best = max((row["ap"] for row in self.history), default=-1.0)
        row = {"pictures": self.n_pictures, "hours": self.seconds / 3600, "ap": result.average_precision,
               "recall": result.recall, "precision": result.precision, "best_threshold": result.best_threshold}
        row.update({name: sum(values) / len(values) for name, values in self._sums.items()})
        self._sums = {}
        self.history.append(row)
        if row["ap"] > best:
            save_weights(self.average.network, self.path("best.weights"), self.n_pictures)
        save_weights(self.average.network, self.path("latest.weights"), self.n_pictures)
        self.save()
        write_table(self.path("curves.tsv"), self.history)
        draw_curves(self.path("curves.png"), self.history)
        self._report.validated(row, row["ap"] > best)


def parameter_groups(network, decay):
    """Filters are kept small by weight decay; biases and normalisation are not."""
    filters = [layer.convolution.weight for layer in network.convolutions()]
    chosen = {id(parameter) for parameter in filters}
    others = [parameter for parameter in network.parameters() if id(parameter) not in chosen]
    return [{"params": filters, "weight_decay": decay}, {"params": others, "weight_decay": 0.0}]


def restore_optimizer(optimizer, state):
    optimizer.load_state_dict({"state": state, "param_groups": optimizer.state_dict()["param_groups"]})


def start_worker(_):
    import cv2
    cv2.setNumThreads(1)
    torch.set_num_threads(1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the trainer's
