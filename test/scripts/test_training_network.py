"""The network from its .cfg, and what OpenCV makes of the exported weights."""

import os

import numpy as np
import pytest
from training_support import COMPARISON, SMALL, YC, cv2, network, shaken_network, torch

from cpslam_tools.errors import InputError
from training.config import parse_config
from training.network import PRIOR_LOGIT, build_network, initialise
from training.weights import HEADER, load_weights, save_weights


def test_yc_is_what_the_paper_describes():
    yc = build_network(YC)
    assert len(yc.layers) == 45
    assert [head.stride for head in yc.heads] == [32, 16, 8]
    assert 6.10e6 < sum(parameter.numel() for parameter in yc.parameters()) < 6.13e6
    assert {type(layer.activation).__name__ for layer in yc.convolutions()} == {"SiLU", "Identity"}
    areas = [width * height for head in reversed(yc.heads) for width, height in head.anchors]
    assert areas == sorted(areas) and len(areas) == 9


def test_comparison_has_two_leaky_heads():
    other = build_network(COMPARISON)
    assert [head.stride for head in other.heads] == [32, 16]
    assert {type(layer.activation).__name__ for layer in other.convolutions()} == {"LeakyReLU", "Identity"}


@pytest.mark.parametrize("config, size", [(YC, (416, 416)), (YC, (352, 224)), (COMPARISON, (320, 320)),
                                          ("small", (64, 32))])
def test_exported_weights_give_the_same_in_opencv(config, size, tmp_path):
    path = tmp_path / "net.cfg"
    text = SMALL if config == "small" else open(config, encoding="utf-8").read()
    # As src/detect/darknet_network does: OpenCV zeroes scores below 0.2 otherwise.
    path.write_text(text.replace("[yolo]", "[yolo]\nthresh=0\nnms_threshold=0"))
    made = shaken_network(str(path))
    save_weights(made, tmp_path / "net.weights", 1234)
    assert os.path.getsize(tmp_path / "net.weights") == HEADER.size + 4 * sum(
        values.numel() for name, values in made.state_dict().items() if not name.endswith("num_batches_tracked"))
    width, height = size
    picture = np.random.default_rng(3).random((1, 3, height, width), dtype=np.float32)
    opencv = cv2.dnn.readNetFromDarknet(str(path), str(tmp_path / "net.weights"))
    opencv.setInput(picture)
    outputs = opencv.forward(opencv.getUnconnectedOutLayersNames())
    with torch.no_grad():
        raw = made(torch.from_numpy(picture))
    assert len(outputs) == len(made.heads)
    for theirs, head, ours in zip(outputs, made.heads, raw):
        boxes, logits = head.decode(ours)
        shares = boxes / torch.tensor([width, height, width, height]).view(1, 1, 4, 1, 1)
        scores = logits.sigmoid()
        rows = torch.cat([shares, scores[:, :, :1] * scores[:, :, 1:2]], 2).permute(0, 3, 4, 1, 2).reshape(-1, 5)
        assert np.ptp(rows[:, 4].numpy()) > 0.1
        np.testing.assert_allclose(theirs[:, [0, 1, 2, 3, 5]], rows.numpy(), rtol=1e-5, atol=1e-5)


def test_weights_survive_the_round_trip(tmp_path):
    first, second = shaken_network(YC, 1), shaken_network(YC, 2)
    save_weights(first, tmp_path / "yc.weights", 77)
    assert load_weights(second, tmp_path / "yc.weights") == 77
    for (name, one), other in zip(first.state_dict().items(), second.state_dict().values()):
        assert name.endswith("num_batches_tracked") or torch.equal(one, other), name


def test_weights_of_another_network_are_refused(tmp_path):
    save_weights(network(), tmp_path / "small.weights", 0)
    with pytest.raises(InputError, match="bytes, the network's weights take"):
        load_weights(build_network(YC), tmp_path / "small.weights")


def test_training_begins_with_one_cell_in_a_hundred():
    yc = build_network(YC)
    initialise(yc, torch.Generator().manual_seed(0))
    with torch.no_grad():
        raw = yc.eval()(torch.rand(1, 3, 96, 96))
    for head, values in zip(yc.heads, raw):
        _, logits = head.decode(values)
        assert abs(float(logits[:, :, 0].mean()) - PRIOR_LOGIT) < 1.0
        assert torch.all(logits[:, :, 1] == logits[0, 0, 1, 0, 0]) and float(logits[0, 0, 1, 0, 0].sigmoid()) > 0.99


def test_decoding_by_hand():
    squared, exponential = network().heads
    raw = torch.zeros(1, 2, 6, 2, 3)
    raw[0, 1, 0, 1, 2] = 1.0986123  # sigmoid 0.75: half a cell to the right of the middle
    raw[0, 1, 2, 1, 2] = 1.0986123
    boxes, _ = squared.decode(raw)
    np.testing.assert_allclose(boxes[0, 1, :, 1, 2], [8 * (2 + 1.0), 8 * 1.5, 2.25 * 24, 30], rtol=1e-6)
    raw = torch.zeros(1, 1, 6, 2, 3)
    raw[0, 0, 3] = 0.6931472
    boxes, _ = exponential.decode(raw)
    np.testing.assert_allclose(boxes[0, 0, :, 1, 2], [4 * 2.5, 4 * 1.5, 6, 24], rtol=1e-6)


def test_input_size_and_stride_come_from_the_file():
    small = network()
    assert small.input_size() == (64, 32)
    assert small.stride() == 8


@pytest.mark.parametrize("old, new, message", [
    ("[net]", "[person]", "begins with"),
    ("filters=8", "filters=eight", "small.cfg:7: .*filters=eight is not a number"),
    ("filters=8\n", "", "filters= is missing"),
    ("filters=8", "filters=8\nfilters=8", "filters= stands twice"),
    ("stride=2", "stride 2", "expected .section. or key=value"),
    ("stride=2", "stride=0", "below 1"),
    ("activation=swish", "activation=silu", "activation=silu: known are"),
    ("layers=-1,-3", "layers=-1,-30", "there is no layer -30"),
    ("layers=-1,-3", "layers=-1,0", "different sizes"),
    ("groups=2", "groups=3", "groups must divide"),
    ("[maxpool]", "[avgpool]", "not supported"),
    ("filters=12", "filters=13", "takes 12 channels"),
    ("activation=logistic", "activation=linear", "must be logistic"),
    ("mask=0", "mask=7", "mask= names"),
    ("num=3", "num=4", "anchors= must hold"),
    ("classes=1", "classes=0", "below 1"),
])
def test_broken_configs_are_named(old, new, message):
    assert old in SMALL
    with pytest.raises(InputError, match=message):
        network(SMALL.replace(old, new, 1))


def test_config_without_heads():
    with pytest.raises(InputError, match=r"no \[yolo\]"):
        network(SMALL.split("[route]")[0])


def test_config_comments_and_blanks():
    sections = parse_config("# a\n[ net ]\n width = 8 # px\n; b\n\n[x]\n", "c.cfg")
    assert [section.kind for section in sections] == ["net", "x"]
    assert sections[0].integer("width") == 8


def test_config_that_is_not_there():
    with pytest.raises(InputError, match="cannot read"):
        build_network("/nowhere/yc.cfg")
