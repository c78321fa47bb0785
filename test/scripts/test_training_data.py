"""What the loaders make of their files, right and wrong ones."""

import json

import numpy as np
import pytest
from training_support import cv2

from cpslam_tools.errors import InputError
from training.anchors import find_anchors, size_overlaps, training_sizes
from training.odgt import picture_size, read_odgt
from training.records import Record
from training.sources import read_source, split_option
from training.tum_folder import read_tum_folder
from training.yolo_folder import read_yolo_folder


@pytest.fixture
def crowd(tmp_path):
    """Writes an .odgt with one picture of 200 x 100 px; returns its path."""
    (tmp_path / "Images").mkdir()
    cv2.imwrite(str(tmp_path / "Images" / "273271,1.jpg"), np.zeros((100, 200, 3), np.uint8))

    def write_lines(*boxes, **changes):
        document = {"ID": "273271,1", "gtboxes": list(boxes), **changes}
        path = tmp_path / "annotation_train.odgt"
        path.write_text(json.dumps(document) + "\n\n")
        return str(path)
    return write_lines


def person(visible, full, **extra):
    return {"tag": "person", "hbox": [0, 0, 1, 1], "vbox": visible, "fbox": full, "extra": {"box_id": 0, **extra}}


def test_odgt_visible_and_full_boxes(crowd):
    path = crowd(person([20, 10, 40, 50], [20, 10, 40, 120]), person([0, 0, 20, 20], [-20, 0, 40, 20]))
    visible, = read_odgt(path)
    np.testing.assert_allclose(visible.boxes, [[0.1, 0.1, 0.3, 0.6], [0, 0, 0.1, 0.2]], atol=1e-6)
    full, = read_odgt(path, "full")
    np.testing.assert_allclose(full.boxes, [[0.1, 0.1, 0.3, 1], [0, 0, 0.1, 0.2]], atol=1e-6)
    assert len(visible.ignored) == 0 and visible.name() == "273271,1"


def test_odgt_masks_and_ignored_people(crowd):
    path = crowd({"tag": "mask", "fbox": [100, 50, 100, 50], "extra": {"ignore": 1}},
                 person([20, 10, 40, 50], [10, 10, 60, 50], ignore=1), person([5, 5, 10, 10], [5, 5, 10, 10]),
                 person([300, 0, 10, 10], [300, 0, 10, 10]))
    record, = read_odgt(path)
    np.testing.assert_allclose(record.ignored, [[0.5, 0.5, 1, 1], [0.05, 0.1, 0.35, 0.6]], atol=1e-6)
    assert len(record.boxes) == 1


@pytest.mark.parametrize("boxes, changes", [
    ([{"tag": "person"}], {}), ([person([1, 2, 3], [1, 2, 3, 4])], {}), ([person([1, 2, 3, "a"], [1, 2, 3, 4])], {}),
    ([3], {}), ([person([0, 0, 1, float("nan")], [0, 0, 1, 1])], {}), ([], {"gtboxes": 7}), ([], {"ID": "../a"}),
    ([], {"ID": 7}),
])
def test_broken_odgt_lines_are_named(crowd, boxes, changes):
    with pytest.raises(InputError, match=r"annotation_train.odgt:1: "):
        read_odgt(crowd(*boxes, **changes))


def test_odgt_without_lines_or_pictures(tmp_path, crowd):
    empty = tmp_path / "e.odgt"
    empty.write_text("\n")
    with pytest.raises(InputError, match="no pictures"):
        read_odgt(str(empty))
    empty.write_text("{")
    with pytest.raises(InputError, match="e.odgt:1: not a CrowdHuman annotation"):
        read_odgt(str(empty))
    with pytest.raises(InputError, match="cannot read .*nobody.jpg"):
        read_odgt(crowd(ID="nobody"))


def test_picture_sizes_are_found_without_decoding(tmp_path):
    picture = np.zeros((37, 53, 3), np.uint8)
    for name in ("a.jpg", "a.png"):
        cv2.imwrite(str(tmp_path / name), picture)
        assert picture_size(str(tmp_path / name)) == (53, 37)
    (tmp_path / "b.jpg").write_bytes((tmp_path / "a.jpg").read_bytes()[:20])
    with pytest.raises(InputError, match="cannot read the picture"):
        picture_size(str(tmp_path / "b.jpg"))


@pytest.fixture
def folder(tmp_path):
    """A YOLO-format folder of one picture; the argument is its label file's text."""
    for name in ("images", "labels"):
        (tmp_path / name).mkdir()
    cv2.imwrite(str(tmp_path / "images" / "a.jpg"), np.zeros((10, 20, 3), np.uint8))

    def write_label(text):
        (tmp_path / "labels" / "a.txt").write_text(text)
        return str(tmp_path)
    return write_label


def test_yolo_folder(folder):
    record, = read_yolo_folder(folder("0 0.5 0.5 0.2 0.4\n3 0.1 0.1 0.1 0.1\n\n0 0.95 0.5 0.2 1.2\n"), "train")
    np.testing.assert_allclose(record.boxes, [[0.4, 0.3, 0.6, 0.7], [0.85, 0, 1, 1]], atol=1e-6)
    record, = read_yolo_folder(folder(""), "train")
    assert record.boxes.shape == (0, 4)


def test_yolo_folder_with_lists(folder, tmp_path):
    path = folder("0 0.5 0.5 0.2 0.4")
    (tmp_path / "val.txt").write_text("images/a.jpg\n\n")
    assert [record.name() for record in read_yolo_folder(path, "val")] == ["a"]
    (tmp_path / "val.txt").write_text("images/b.jpg\n")
    with pytest.raises(InputError, match="cannot read .*b.txt"):
        read_yolo_folder(path, "val")
    (tmp_path / "val.txt").write_text("")
    with pytest.raises(InputError, match="no pictures"):
        read_yolo_folder(path, "val")


@pytest.mark.parametrize("text", ["0 0.5 0.5 0.2", "0 0.5 0.5 0.2 nan", "person 0.5 0.5 0.2 0.2", "0 0.5 0.5 0 0.2"])
def test_broken_labels_are_named(folder, text):
    with pytest.raises(InputError, match="a.txt:2: expected"):
        read_yolo_folder(folder(f"0 0.5 0.5 0.2 0.2\n{text}\n"), "train")


def test_folder_without_validation_list(folder):
    with pytest.raises(InputError, match="val.txt"):
        read_yolo_folder(folder(""), "val")


@pytest.fixture
def sequence(tmp_path):
    (tmp_path / "rgb").mkdir()
    for stamp in ("1.000000", "1.033333"):
        cv2.imwrite(str(tmp_path / "rgb" / f"{stamp}.png"), np.zeros((48, 64, 3), np.uint8))
    (tmp_path / "rgb.txt").write_text("# timestamp filename\n1.000000 rgb/1.000000.png\n1.033333 rgb/1.033333.png\n")
    (tmp_path / "person_boxes.txt").write_text("# boxes\n1.033333 32 12 16 48 1.0\n1.033333 -8 0 16 12 0.5\n")
    return tmp_path


def test_simulated_sequences(sequence):
    nobody, two = read_source(str(sequence), "train")
    assert len(nobody.boxes) == 0
    np.testing.assert_allclose(two.boxes, [[0.5, 0.25, 0.75, 1], [0, 0, 0.125, 0.25]], atol=1e-6)


@pytest.mark.parametrize("line", ["1.0 1 2 3", "1.0 1 2 3 x", "one 1 2 3 4"])
def test_broken_sequences_are_named(sequence, line):
    (sequence / "person_boxes.txt").write_text(f"{line}\n")
    with pytest.raises(InputError, match="person_boxes.txt:1: expected"):
        read_tum_folder(str(sequence))


def test_sources_that_are_nothing(tmp_path):
    with pytest.raises(InputError, match="neither"):
        read_source(str(tmp_path / "none"), "train")


def test_options_with_shares():
    assert split_option("data/people=0.5") == ("data/people", 0.5)
    assert split_option("data/people") == ("data/people", 1.0)
    for text in ("a=x", "a=-1", "a=nan", "a=inf"):
        with pytest.raises(InputError, match="expected NAME=NUMBER"):
            split_option(text)


def test_anchors_of_clear_groups():
    generator = np.random.default_rng(0)
    sizes = np.concatenate([centre * generator.uniform(0.95, 1.05, (50, 2)) for centre in ([10, 20], [40, 90], [200, 300])])
    anchors, mean = find_anchors(sizes, 3, np.random.default_rng(1))
    np.testing.assert_allclose(anchors, [[10, 20], [40, 90], [200, 300]], rtol=0.05)
    assert mean > 0.9
    np.testing.assert_allclose(size_overlaps(np.array([[10.0, 20]]), np.array([[10.0, 20], [20, 10]])), [[1, 1 / 3]])


def test_anchor_sizes_are_letterboxed():
    record = Record("a", np.array([[0, 0, 0.5, 1]], np.float32))
    sizes = training_sizes([record, Record("b")], [(200, 100), (10, 10)], 400, np.random.default_rng(0), copies=500)
    np.testing.assert_allclose(sizes[:, 0], sizes[:, 1], rtol=1e-5)
    assert 80 < sizes.min() < 90 and 300 < sizes.max() < 321
