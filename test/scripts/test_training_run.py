"""Whole trainings, small ones: their schedule, interruption, command line."""

import os
import signal

import numpy as np
import pytest
from training_support import SMALL, cv2, network, person_folder, torch

from cpslam_tools.errors import InputError
from training.accuracy import average_precision, match, measure
from training.averaging import Average
from training.pictures import PictureStore
from training.records import Record
from training.samples import Samples, Source
from training.scenes import SceneMaker
from training.schedule import LAST_RATE, Schedule, parse_sizes
from training.trainer import CHECKPOINT, Trainer, TrainerSettings
from training.yolo_folder import read_yolo_folder


class Quiet:
    """A report that interrupts the process at a number of pictures."""

    def __init__(self, stop_at=None):
        self.stop_at = stop_at

    def progress(self, trainer, side, total, parts):
        assert np.isfinite(list(parts.values())).all()
        if trainer.n_pictures == self.stop_at:
            os.kill(os.getpid(), signal.SIGINT)

    def validated(self, row, is_best):
        pass


def trainer(folder, output, total=48, report=None, rate=1e-3, validate_every=1000):
    records = read_yolo_folder(str(folder), "train")
    store = PictureStore(records)
    samples = Samples(SceneMaker(records, store, []), [Source(1.0, np.arange(len(records)),
                                                              np.full(len(records), 1 / len(records)))], seed=1)
    schedule = Schedule(total, 8, 0.5, ((0.0, 32), (0.5, 48)), 8, 1)
    os.makedirs(output, exist_ok=True)
    settings = TrainerSettings(str(output), 4, rate, 0.01, validate_every, 48, 0, "cpu", 1)
    return Trainer(network(), samples, (records, store), schedule, settings, report or Quiet())


def test_interrupted_training_goes_on_as_if_nothing_had_been(tmp_path):
    folder = person_folder(tmp_path / "data", 9)
    whole = trainer(folder, tmp_path / "whole")
    assert whole.run()
    first = trainer(folder, tmp_path / "parts", report=Quiet(stop_at=20))
    assert not first.run()
    assert first.n_pictures == 20
    second = trainer(folder, tmp_path / "parts")
    second.resume(second.path(CHECKPOINT))
    assert second.run() and second.n_pictures == 48
    for ours, theirs in ((whole.network, second.network), (whole.average.network, second.average.network)):
        for (name, one), other in zip(ours.state_dict().items(), theirs.state_dict().values()):
            assert torch.equal(one, other), name
    assert whole.history[0]["ap"] == second.history[0]["ap"]


def test_training_learns_and_keeps_the_best(tmp_path):
    folder = person_folder(tmp_path / "data", 12)
    made = trainer(folder, tmp_path / "run", total=800, rate=5e-3, validate_every=400)
    assert made.run()
    assert made.history[-1]["box"] < made.history[0]["box"]
    assert made.history[-1]["objectness"] < 0.9 * made.history[0]["objectness"]
    for name in ("best.weights", "latest.weights", "curves.tsv", "curves.png", CHECKPOINT):
        assert os.path.getsize(tmp_path / "run" / name) > 0
    lines = (tmp_path / "run" / "curves.tsv").read_text().splitlines()
    assert len(lines) == 3 and lines[0].startswith("pictures\thours\tap")


def test_training_that_explodes_says_so_and_keeps_its_checkpoint(tmp_path):
    made = trainer(person_folder(tmp_path / "data", 3), tmp_path / "run")
    made.save()
    before = (tmp_path / "run" / CHECKPOINT).read_bytes()
    with torch.no_grad():
        made.network.layers[0].convolution.weight[0] = float("inf")
    with pytest.raises(InputError, match="not finite any more after 0 pictures.*lower --rate"):
        made.run()
    assert (tmp_path / "run" / CHECKPOINT).read_bytes() == before


def test_checkpoints_that_do_not_fit_are_refused(tmp_path):
    folder = person_folder(tmp_path / "data", 3)
    made = trainer(folder, tmp_path / "run")
    with pytest.raises(InputError, match="cannot read|is no checkpoint"):
        made.resume(made.path("none.pt"))
    (tmp_path / "run" / "broken.pt").write_bytes(b"PK not a checkpoint")
    with pytest.raises(InputError, match="cannot read|is no checkpoint"):
        made.resume(made.path("broken.pt"))


def test_schedule_by_hand():
    schedule = Schedule(1000, 100, 0.5, ((0.0, 64), (0.5, 128)), 32, 1)
    assert schedule.rate(0) == pytest.approx(0.01) and schedule.rate(49) == pytest.approx(0.5)
    assert schedule.rate(100) == schedule.rate(500) == 1
    assert schedule.rate(750) == pytest.approx((1 + LAST_RATE) / 2)
    assert schedule.rate(1000) == pytest.approx(LAST_RATE)
    assert {schedule.size(n) for n in range(0, 500, 4)} == {32, 64, 96}
    assert {schedule.size(n) for n in range(500, 1000, 4)} == {96, 128, 160}


@pytest.mark.parametrize("text", ["", "0:100", "0.2:96", "0:96,0.1", "0:96,0.5:96,0.4:96", "0:32"])
def test_broken_sizes_are_named(text):
    with pytest.raises(InputError, match="--sizes"):
        parse_sizes(text, 32)


def test_average_follows_and_settles():
    made = network()
    average = Average(made, decay=0.9, settle=1)
    start = average.network.layers[0].convolution.weight.clone()
    with torch.no_grad():
        made.layers[0].convolution.weight.add_(1.0)
    average.update(made)
    keep = 0.9 * (1 - np.exp(-1))
    torch.testing.assert_close(average.network.layers[0].convolution.weight, start + (1 - keep))
    for _ in range(200):
        average.update(made)
    torch.testing.assert_close(average.network.layers[0].convolution.weight, start + 1)


def test_average_precision_by_hand():
    # Right, wrong, right, ignored, wrong of three people: recall 1/3, 2/3; the envelope is 1, then 2/3.
    scores, verdicts = np.array([0.9, 0.8, 0.7, 0.65, 0.6]), np.array([1, 0, 1, -1, 0])
    area, ranked, recall, precision = average_precision(scores, verdicts, 3)
    assert area == pytest.approx(1 / 3 + 2 / 9)
    np.testing.assert_allclose(ranked, [0.9, 0.8, 0.7, 0.6])
    np.testing.assert_allclose(recall, [1 / 3, 1 / 3, 2 / 3, 2 / 3])
    np.testing.assert_allclose(precision, [1, 1 / 2, 2 / 3, 1 / 2])
    assert average_precision(np.zeros(0), np.zeros(0, int), 0)[0] == 0


def test_matching_by_hand():
    truth = np.array([[0.0, 0, 10, 10]])
    boxes = np.array([[0.0, 0, 10, 11], [0, 0, 10, 10], [20, 20, 30, 30], [50, 50, 60, 60]])
    assert match(boxes, truth, np.array([[19.0, 19, 40, 40]])).tolist() == [1, 0, -1, 0]
    assert match(boxes, np.zeros((0, 4)), np.zeros((0, 4))).tolist() == [0, 0, 0, 0]
    assert match(np.zeros((0, 4)), truth, truth).tolist() == []


def test_measuring_a_network_that_knows(tmp_path):
    """A network that answers red with objectness: finds the picture with a red patch, and where."""
    text = """[net]
width=32
height=32
channels=3
[maxpool]
size=8
stride=8
[convolutional]
filters=6
size=1
stride=1
activation=logistic
[yolo]
mask=0
anchors=8,8
classes=1
num=1
scale_x_y=1
new_coords=1
"""
    made = network(text).eval()
    last = made.head_convolutions()[0].convolution
    with torch.no_grad():
        last.weight.zero_()
        last.bias.copy_(torch.tensor([0.0, 0, 0, 0, -6, 9]))
        last.weight[4, 0] = 12.0
    records = []
    for i in range(2):
        picture = np.zeros((32, 32, 3), np.uint8)
        if i:
            picture[8:16, 16:24] = (0, 0, 255)
        cv2.imwrite(str(tmp_path / f"{i}.png"), picture)
        records.append(Record(str(tmp_path / f"{i}.png"), np.array([[16, 8, 24, 16]][:i]).reshape(-1, 4) / 32))
    result = measure(made, records, PictureStore(records), 32, 32)
    assert (result.average_precision, result.recall, result.precision) == (1, 1, 1)
    assert result.best_threshold > 0.99


def test_command_line_trains_goes_on_and_exports(run_script, tmp_path):
    folder = person_folder(tmp_path / "data", 6)
    (tmp_path / "small.cfg").write_text(SMALL)
    command = ["train_detector.py", "train", "--data", folder, "--cfg", tmp_path / "small.cfg", "--output",
               tmp_path / "run", "--sizes", "0:32", "--warm-up", 8, "--batch", 4, "--validate-every", 16,
               "--validation-size", 64, "--threads", 1, "--prefer", "p1=2"]
    first = run_script(*command, "--pictures", 16)
    assert first.returncode == 0, first.stderr
    assert "6 pictures to train on, 4 people; 6 to check with" in first.stdout and "AP@0.50" in first.stdout
    second = run_script(*command, "--pictures", 32, "--resume")
    assert second.returncode == 0 and "going on from" in second.stdout and "32 pictures" in second.stdout
    export = run_script("train_detector.py", "export", "--cfg", tmp_path / "small.cfg", "--checkpoint",
                        tmp_path / "run" / CHECKPOINT, "--weights", tmp_path / "out.weights")
    assert export.returncode == 0 and "after 32 pictures" in export.stdout
    assert (tmp_path / "out.weights").read_bytes() == (tmp_path / "run" / "latest.weights").read_bytes()
    anchors = run_script("train_detector.py", "anchors", "--data", folder, "--count", 2)
    assert anchors.returncode == 0 and anchors.stdout.startswith("anchors=")


@pytest.mark.parametrize("arguments, message", [
    (["train", "--data", "/nowhere", "--cfg", "CFG", "--output", "OUT"], "neither a folder"),
    (["train", "--data", "DATA", "--cfg", "/none.cfg", "--output", "OUT"], "cannot read /none.cfg"),
    (["train", "--data", "DATA", "--cfg", "CFG", "--output", "OUT", "--sizes", "0:33"], "multiples of 8 px"),
    (["train", "--data", "DATA", "--cfg", "CFG", "--output", "OUT", "--prefer", "p=0"], "leaves nothing"),
    (["train", "--data", "DATA", "--cfg", "CFG", "--output", "OUT", "--teacher", "CFG"], "cannot read"),
    (["export", "--cfg", "CFG", "--checkpoint", "/none.pt", "--weights", "OUT"], "cannot read /none.pt"),
    (["simulate", "--program", "/nowhere/simulate_tum", "--output", "OUT"], "cannot run"),
])
def test_wrong_arguments_are_one_line(run_script, tmp_path, arguments, message):
    (tmp_path / "small.cfg").write_text(SMALL)
    places = {"DATA": person_folder(tmp_path / "data", 3), "CFG": tmp_path / "small.cfg", "OUT": tmp_path / "out"}
    result = run_script("train_detector.py", *(places.get(argument, argument) for argument in arguments))
    assert result.returncode == 2 and message in result.stderr and len(result.stderr.splitlines()) == 1
