"""Ratios of pairs and the bootstrap bound of their geometric mean; boxes made worse on purpose."""

import numpy as np
import pytest
from cpslam_tools.benchmark import box_files
from cpslam_tools.benchmark.paired import bootstrap_upper_bound, geometric_mean, paired_ratios
from cpslam_tools.errors import InputError


def run(variant, key, rmse_m, error=None):
    return {"variant": variant, "key": key, "error": error, "ate": rmse_m and {"rmse_m": rmse_m}}


def test_ratios_are_of_pairs():
    runs = [run("a", 1, 0.02), run("b", 1, 0.01), run("b", 2, 0.04), run("a", 2, 0.01), run("a", 3, 0.01),
            run("a", 4, 0.01), run("b", 4, 0.01, error="status 1"), run("a", 5, None), run("b", 5, 0.01)]
    assert paired_ratios(runs, ("key",), "a", "b") == {(1,): 2.0, (2,): 0.25, (3,): None, (4,): None, (5,): None}


def test_geometric_mean():
    assert geometric_mean([0.5, 2.0]) == pytest.approx(1.0)
    assert geometric_mean([1.0, 1.0, 8.0]) == pytest.approx(2.0)


def test_the_bound_of_two_values_by_hand():
    # Four resamples, equally likely: log means -l, 0, 0, l. The 95 % quantile is the greatest, l = log 2.
    assert bootstrap_upper_bound([[0.5, 2.0]]) == pytest.approx(2.0)
    # The 60 % quantile is the middle.
    assert bootstrap_upper_bound([[0.5, 2.0]], level=0.6) == pytest.approx(1.0)


def test_the_bound_is_that_of_the_normal_distribution_for_many():
    generator = np.random.default_rng(5)
    logs = 0.1 + 0.2 * generator.standard_normal(400)
    expected = np.exp(logs.mean() + 1.645 * logs.std() / 20)
    assert bootstrap_upper_bound([np.exp(logs)]) == pytest.approx(expected, rel=0.003)


def test_groups_are_resampled_on_their_own():
    # As one set the bound would be far above the mean 2; as two groups nothing varies.
    assert bootstrap_upper_bound([[1.0] * 10, [4.0] * 10]) == pytest.approx(2.0)
    assert bootstrap_upper_bound([[1.0] * 10 + [4.0] * 10]) > 2.2
    # A larger group weighs more: (1 * 1 * 8)^(1/3).
    assert bootstrap_upper_bound([[1.0, 1.0], [8.0], []]) == pytest.approx(2.0)


def test_the_bound_repeats_with_the_seed():
    ratios = [[0.9, 1.1, 1.3, 0.8, 1.05]]
    assert bootstrap_upper_bound(ratios, seed=3) == bootstrap_upper_bound(ratios, seed=3)
    with pytest.raises(ValueError):
        bootstrap_upper_bound([[], []])


def test_boxes_survive_writing_and_reading(tmp_path):
    boxes = [("1548339827.21561", 0.7, 312.0, 84.4, 166.3, 0.453), ("1548339827.28270", -1.2, 22.9, 61.4, 451.8, 0.439)]
    path = tmp_path / "folder" / "boxes.txt"
    box_files.write_boxes(str(path), boxes)
    assert box_files.read_boxes(path) == boxes
    assert path.read_text().startswith("# person boxes: timestamp x y width height confidence")


@pytest.mark.parametrize("line", ["1.0 2 3 4 5", "1.0 2 3 4 5 6 7", "1.0 2 3 4 x 1"])
def test_a_line_that_is_no_box(write, line):
    with pytest.raises(InputError, match=r"boxes.txt:2: expected timestamp x y width height confidence"):
        box_files.read_boxes(write("boxes.txt", ["# boxes", line]))


def test_jitter_moves_the_sides_by_a_tenth_and_drops_a_tenth():
    boxes = [(str(i), 100.0, 50.0, 80.0, 200.0, 0.9) for i in range(4000)]
    kept = box_files.jittered(boxes, np.random.default_rng(1))
    assert 0.88 < len(kept) / len(boxes) < 0.92
    x, y, width, height, confidence = np.array([values for _, *values in kept]).T
    for moved, side in ((x - 100, 80), (x + width - 180, 80), (y - 50, 200), (y + height - 250, 200)):
        assert abs(moved.min() + 0.1 * side) < 0.01 * side and abs(moved.max() - 0.1 * side) < 0.01 * side
        assert abs(moved.mean()) < 0.01 * side
    assert set(confidence) == {0.9}
    # The stamps stay with their boxes and in order, and the seed alone decides.
    assert [int(stamp) for stamp, *_ in kept] == sorted(int(stamp) for stamp, *_ in kept)
    assert kept == box_files.jittered(boxes, np.random.default_rng(1)) != box_files.jittered(boxes, np.random.default_rng(2))


def test_what_is_missing_does_not_change_the_others():
    boxes = [(str(i), 0.0, 0.0, 10.0, 10.0, 1.0) for i in range(200)]
    everything = dict((stamp, values) for stamp, *values in box_files.jittered(boxes, np.random.default_rng(1), missing=0.0))
    for stamp, *values in box_files.jittered(boxes, np.random.default_rng(1), missing=0.5):
        assert everything[stamp] == values


def test_false_boxes_are_like_people_and_in_the_image():
    stamps = [f"{i / 30:.6f}" for i in range(3000)]
    boxes = box_files.false_boxes(stamps, np.random.default_rng(1), (640, 480))
    assert 0.27 < len({stamp for stamp, *_ in boxes}) / len(stamps) < 0.33
    assert 1.4 < len(boxes) / len({stamp for stamp, *_ in boxes}) < 1.6
    x, y, width, height, confidence = np.array([values for _, *values in boxes]).T
    assert x.min() >= 0 and y.min() >= 0 and (x + width).max() <= 640 and (y + height).max() <= 480
    assert height.min() >= 0.3 * 480 and height.max() <= 0.9 * 480
    assert (width / height).min() >= 1 / 3 - 1e-9 and (width / height).max() <= 2 / 3 + 1e-9
    assert confidence.min() > 0 and confidence.max() <= 1
