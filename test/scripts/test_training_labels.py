"""Labels that cost nothing: simulated people, and a teacher's opinion."""

import numpy as np
import pytest
from fakes import install
from training_support import cv2, torch

from cpslam_tools.errors import InputError
from training.simulated import simulate
from training.teacher import LIMIT, Teacher
from training.yolo_folder import read_yolo_folder

# A grey picture, in some rooms with a box.
SIMULATOR = '''#!/usr/bin/python3
import os, shutil, sys
preset, folder, options = sys.argv[1], sys.argv[2], sys.argv[3:]
seed = int(options[options.index("--seed") + 1])
if FAILS(seed):
    sys.exit("out of rooms")
os.makedirs(folder + "/rgb")
shutil.copy(os.path.dirname(sys.argv[0]) + "/grey.jpg", folder + "/rgb/1.0.jpg")
open(folder + "/rgb.txt", "w").write("# stamps\\n1.0 rgb/1.0.jpg\\n")
open(folder + "/person_boxes.txt", "w").write("1.0 16 12 32 24 1.0\\n" if "rpy" in preset else "# nobody\\n")
'''


@pytest.fixture
def simulator(tmp_path):
    def make(fails):
        cv2.imwrite(str(tmp_path / "grey.jpg"), np.full((48, 64, 3), 90, np.uint8))
        install(tmp_path / "simulate_tum", SIMULATOR.replace("FAILS(seed)", fails))
        return str(tmp_path / "simulate_tum")
    return make


def test_simulated_folder_can_be_trained_on(simulator, tmp_path):
    messages = []
    count = simulate(simulator("seed % 19 == 0"), str(tmp_path / "sim"), 40, 3, messages.append)
    assert count == 40 - len(messages) and 0 < len(messages) < 4
    train, val = (read_yolo_folder(str(tmp_path / "sim"), split) for split in ("train", "val"))
    assert len(train) + len(val) == count and 2 <= len(val) <= 4
    people = [record for record in train if len(record.boxes)]
    assert 2 <= len(people) < len(train)
    np.testing.assert_allclose(people[0].boxes, [[0.25, 0.25, 0.75, 0.75]], atol=1e-5)


def test_simulation_that_fails_time_and_again_ends(simulator, tmp_path):
    messages = []
    with pytest.raises(InputError, match="failed 4 times: .*out of rooms"):
        simulate(simulator("True"), str(tmp_path / "sim"), 40, 3, messages.append)
    assert len(messages) == 4 and "--seed" in messages[0]


class Opinion(torch.nn.Module):
    """As YOLOX gives it: per stride boxes, objectness and two classes, the latter after the sigmoid."""

    def __init__(self):
        super().__init__()
        self.pools = torch.nn.ModuleList(torch.nn.AvgPool2d(stride) for stride in (8, 16))

    def forward(self, picture):
        maps = []
        for pool in self.pools:
            colour = pool(picture)
            scores = (colour / 255 * 4 - 2).sigmoid()
            maps.append(torch.cat([colour, colour[:, :1], scores], 1))
        return tuple(maps)


@pytest.fixture
def onnx(tmp_path):
    path = str(tmp_path / "teacher.onnx")
    torch.onnx.export(Opinion(), torch.zeros(1, 3, 192, 192), path, opset_version=11)
    return path


def test_teacher_gives_logits_at_the_heads_strides(onnx):
    teacher = Teacher(onnx, [16, 8])
    assert teacher.n_channels == 3
    picture = np.zeros((64, 64, 3), np.uint8)
    picture[:16, 32:48] = (255, 128, 0)
    coarse, fine = teacher([np.zeros((64, 64, 3), np.uint8), picture])
    assert coarse.shape == (2, 3, 4, 4) and fine.shape == (2, 3, 8, 8)
    np.testing.assert_allclose(coarse[1, :, 0, 2], [2, 128 / 255 * 4 - 2, -2], atol=0.01)
    np.testing.assert_allclose(coarse[0], -2, atol=0.01)
    assert np.abs(fine).max() <= LIMIT


def test_teachers_of_other_strides_are_refused(onnx):
    with pytest.raises(InputError, match="no scores at a stride of 32 px"):
        Teacher(onnx, [32, 16, 8])
