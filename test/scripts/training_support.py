"""What the tests of scripts/training share. Skips the test module that imports it where PyTorch or OpenCV is missing."""

import os

import numpy as np
import pytest

INSTALL = "not installed: scripts/training/install.sh"
torch = pytest.importorskip("torch", reason=f"PyTorch is {INSTALL}")
cv2 = pytest.importorskip("cv2", reason=f"OpenCV for Python is {INSTALL}")
torch.set_num_threads(1)
cv2.setNumThreads(1)

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
YC = os.path.join(ROOT, "models", "yc.cfg")
COMPARISON = os.path.join(ROOT, "scripts", "training", "yolov4-tiny-person.cfg")

# Two heads at strides 8 and 4, everything that a .cfg of ours may hold, and quick to train.
SMALL = """[net]
width=64
height=32
channels=3
[convolutional]
batch_normalize=1
filters=8
size=3
stride=2
pad=1
activation=swish
[convolutional]
batch_normalize=1
filters=8
size=3
stride=2
pad=1
activation=leaky
[route]
layers=-1
groups=2
group_id=1
[convolutional]
batch_normalize=1
filters=4
size=3
stride=1
pad=1
activation=swish
[route]
layers=-1,-3
[maxpool]
size=2
stride=2
[convolutional]
filters=12
size=1
stride=1
pad=1
activation=logistic
[yolo]
mask=1,2
anchors=6,12, 12,24, 24,30
classes=1
num=3
scale_x_y=2.0
new_coords=1
[route]
layers=-3
[upsample]
stride=2
[convolutional]
filters=6
size=3
stride=1
pad=1
activation=linear
[yolo]
mask=0
anchors=6,12, 12,24, 24,30
classes=1
num=3
"""


def network(text=SMALL):
    from training.config import parse_config
    from training.network import Network
    return Network(parse_config(text, "small.cfg"))


def shaken_network(config_path, seed=0):
    """A network in evaluation mode whose every number matters: nothing is zero or one, outputs spread."""
    from training.network import build_network
    made = build_network(config_path)
    generator = torch.Generator().manual_seed(seed)
    with torch.no_grad():
        for layer in made.convolutions():
            weight = layer.convolution.weight
            weight.normal_(0, (1.5 / weight[0].numel()) ** 0.5, generator=generator)
            if layer.normalisation is None:
                layer.convolution.bias.normal_(0, 1, generator=generator)
            else:
                layer.normalisation.weight.uniform_(0.7, 1.3, generator=generator)
                layer.normalisation.bias.normal_(0, 0.2, generator=generator)
                layer.normalisation.running_mean.normal_(0, 0.2, generator=generator)
                layer.normalisation.running_var.uniform_(0.7, 1.3, generator=generator)
    return made.eval()


def person_folder(folder, count, side=48):
    """A YOLO-format folder: on grey noise, a red ellipse a picture, every third without."""
    generator = np.random.default_rng(7)
    (folder / "images").mkdir(parents=True)
    (folder / "labels").mkdir()
    for i in range(count):
        picture = generator.integers(90, 130, (side, side, 3), dtype=np.uint8)
        lines = []
        if i % 3:
            half = generator.uniform(5, 9), generator.uniform(9, 14)
            centre = generator.uniform(16, side - 16, 2)
            cv2.ellipse(picture, (tuple(centre), (2 * half[0], 2 * half[1]), 0), (30, 30, 230), -1)
            lines.append(f"0 {centre[0] / side} {centre[1] / side} {2 * half[0] / side} {2 * half[1] / side}")
        cv2.imwrite(str(folder / "images" / f"p{i}.png"), picture)
        (folder / "labels" / f"p{i}.txt").write_text("\n".join(lines))
    names = "".join(f"images/p{i}.png\n" for i in range(count))
    (folder / "train.txt").write_text(names)
    (folder / "val.txt").write_text(names)
    return folder
