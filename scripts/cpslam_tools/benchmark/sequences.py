"""The sequences a benchmark runs on: recorded ones, simulated ones, and the same room many times over."""

import contextlib
import os
import shutil

from ..errors import InputError
from ..trajectory import read_rows
from .detectors import BOXES_FILE
from .programs import execute

# In the order of the README's table: (folder below the data directory, settings below Examples/RGB-D).
RECORDED = (("fr1_desk_dev", "TUM1.yaml"), ("bonn_crowd_dev", "Bonn.yaml"))
# Rooms without people, one per camera path of the simulator.
STATIC_PRESETS = ("office_static", "office_xyz", "office_rpy", "office_halfsphere", "office_rounds")
SIMULATION_TIMEOUT_S = 1800


class Sequence:
    """A TUM-format folder with the settings of its camera."""

    def __init__(self, name, directory, settings):
        self.name = name
        self.directory = directory
        self.settings = settings

    @contextlib.contextmanager
    def ready(self):
        """The folder is complete while this is entered."""
        for path in (self.directory, self.settings):
            if not os.path.exists(path):
                raise InputError(f"{path}: not there")
        yield self

    @property
    def truth(self):
        return os.path.join(self.directory, "groundtruth.txt")

    @property
    def boxes(self):
        return os.path.join(self.directory, BOXES_FILE)


class SimulatedSequence(Sequence):
    """Rendered when it is needed and removed after, unless it is to be kept: a sequence takes some hundred MB.

    variation: further options of simulate_tum, {name: value}: people, start, noise-seed."""

    def __init__(self, programs, preset, work_dir, frames, seed=1, noise=True, keep=False, variation=None):
        self.variation = variation or {}
        sensor = "noise" if noise else "clean"
        details = "".join(f", {name} {value}" for name, value in self.variation.items())
        label = f"sim {preset}, {sensor}, seed {seed}{details}"
        folder = "_".join(map(str, (preset, frames, sensor, seed, *(f"{k}{v}" for k, v in self.variation.items()))))
        directory = os.path.join(work_dir, folder)
        super().__init__(label, directory, os.path.join(directory, "settings.yaml"))
        self.programs = programs
        self.preset = preset
        self.frames = frames
        self.seed = seed
        self.noise = noise
        self.keep = keep

    @contextlib.contextmanager
    def ready(self):
        if not (self.keep and os.path.exists(self.truth)):
            self._simulate()
        try:
            yield self
        finally:
            if not self.keep:
                shutil.rmtree(self.directory, ignore_errors=True)

    def _simulate(self):
        os.makedirs(os.path.dirname(self.directory), exist_ok=True)
        command = [self.programs.path("simulate_tum"), self.preset, self.directory, "--frames", self.frames, "--seed",
                   self.seed, "--force", *(["--noise"] if self.noise else [])]
        for name, value in self.variation.items():
            command += [f"--{name}", value]
        finished = execute(command, SIMULATION_TIMEOUT_S)
        if finished.error:
            raise InputError(f"simulate_tum {self.preset}: {finished.error}")


class RearrangedSequence(Sequence):
    """Made of another sequence's frames when it is needed, and removed after: lists of its own, the pictures linked.

    what: added to the source's name; suffix: to its folder's."""

    def __init__(self, source, work_dir, what, suffix):
        directory = os.path.join(work_dir, f"{os.path.basename(source.directory)}_{suffix}")
        super().__init__(f"{source.name}, {what}", directory, source.settings)
        self.source = source

    @contextlib.contextmanager
    def ready(self):
        with self.source.ready():
            shutil.rmtree(self.directory, ignore_errors=True)
            os.makedirs(self.directory)
            try:
                self._write()
                yield self
            finally:
                shutil.rmtree(self.directory, ignore_errors=True)

    def _write(self):
        raise NotImplementedError

    def _rows(self, name):
        return rows_of(os.path.join(self.source.directory, name))

    def _link(self, folder):
        os.symlink(os.path.abspath(os.path.join(self.source.directory, folder)), os.path.join(self.directory, folder))


class RepeatedSequence(RearrangedSequence):
    """Another sequence forwards, backwards, forwards, ...: many rounds of one room without a jump between them."""

    def __init__(self, source, work_dir, rounds):
        super().__init__(source, work_dir, f"{rounds} rounds", f"{rounds}_rounds")
        self.rounds = rounds

    def _write(self):
        colour = self._rows("rgb.txt")
        begin, end = colour[0][0], colour[-1][0]
        period = end - begin + (end - begin) / max(len(colour) - 1, 1)
        for name in ("rgb.txt", "depth.txt", "groundtruth.txt"):
            rows = [(stamp, fields) for stamp, fields in self._rows(name) if begin - 0.02 < stamp < end + 0.02]
            with open(os.path.join(self.directory, name), "w", encoding="utf-8") as file:
                for stamp, fields in repeated(rows, begin, end, period, self.rounds):
                    file.write(f"{stamp:.6f} {' '.join(fields)}\n")
        for folder in {os.path.dirname(fields[0]) for _, fields in colour + self._rows("depth.txt")}:
            self._link(folder)


def rows_of(path):
    """[(stamp, further fields)] of a TUM-format list, by stamp."""
    return sorted((float(fields[0]), fields[1:]) for _, fields in read_rows(path))


def repeated(rows, begin, end, period, rounds):
    """Rows (stamp, data) between begin and end, played there and back with the given period per round."""
    for number in range(rounds):
        start = begin + number * period
        forwards = number % 2 == 0
        for stamp, data in rows if forwards else reversed(rows):
            yield start + (stamp - begin if forwards else end - stamp), data


def recorded_sequence(root, data_dir, folder):
    """A known recorded clip, there or not."""
    settings = dict(RECORDED)[folder]
    return Sequence(folder, os.path.join(data_dir, folder), os.path.join(root, "Examples", "RGB-D", settings))


def recorded_sequences(root, data_dir):
    """Those of the known recorded clips that are there."""
    clips = [recorded_sequence(root, data_dir, folder) for folder, _ in RECORDED]
    return [clip for clip in clips if os.path.isdir(clip.directory)]
