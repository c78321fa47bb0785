"""The measures of evaluate_detector.py, by cases small enough to check by hand."""

import os
import re

import numpy as np
import pytest
from conftest import ROOT
from cpslam_tools.detection import detector_runs, evaluation, ground_truth, precision_recall
from cpslam_tools.detection.boxes import as_boxes, clipped, overlaps
from cpslam_tools.detection.detector_runs import Run
from cpslam_tools.detection.matching import IGNORED, WRONG, match
from cpslam_tools.detection.presence import link, misses
from cpslam_tools.errors import InputError


def matched(detections, scores, truth, ignored=None, least_overlap=0.5):
    truth = as_boxes(truth)
    ignored = np.zeros(len(truth), dtype=bool) if ignored is None else np.array(ignored)
    return list(match(as_boxes(detections), np.array(scores, dtype=float), truth, ignored, least_overlap))


def ap(scores, right, people):
    return precision_recall.average_precision(
        precision_recall.curve(np.array(scores, dtype=float), np.array(right, dtype=bool), people), people)


def test_overlap_of_boxes():
    first = as_boxes([[0, 0, 10, 10], [0, 0, 0, 0]])
    second = as_boxes([[0, 0, 10, 10], [5, 0, 10, 10], [10, 0, 10, 10], [2, 2, 5, 5], [3, 3, 0, 0]])
    assert overlaps(first, second)[0] == pytest.approx([1, 50 / 150, 0, 0.25, 0])
    assert overlaps(first, second)[1] == pytest.approx([0] * 5)
    assert overlaps(as_boxes([]), second).shape == (0, 5)


def test_boxes_are_clipped_to_the_picture():
    boxes = as_boxes([[-5, -5, 10, 10], [90, 40, 30, 30], [200, 0, 5, 5], [10, 10, 5, 5]])
    assert clipped(boxes, 100, 50).tolist() == [[0, 0, 5, 5], [90, 40, 10, 10], [100, 0, 0, 5], [10, 10, 5, 5]]


def test_the_most_confident_box_gets_the_person_and_the_next_is_wrong():
    person = [[0, 0, 10, 10]]
    boxes = [[0, 0, 10, 9], [0, 0, 10, 10]]
    assert matched(boxes, [0.9, 0.8], person) == [0, WRONG]
    assert matched(boxes, [0.8, 0.9], person) == [WRONG, 0]


def test_a_box_takes_the_person_it_overlaps_most_of_those_still_free():
    people = [[0, 0, 10, 10], [2, 0, 10, 10]]
    # The second box overlaps the first person more as well, who is taken.
    assert matched([[0, 0, 10, 10], [0.5, 0, 10, 10]], [0.9, 0.8], people) == [0, 1]
    assert matched([[2, 0, 10, 10], [0, 0, 10, 10]], [0.9, 0.8], people) == [1, 0]


def test_the_least_overlap_counts():
    # 10 x 10 against 10 x 5: exactly 0.5.
    assert matched([[0, 0, 10, 5]], [0.9], [[0, 0, 10, 10]]) == [0]
    assert matched([[0, 0, 10, 5]], [0.9], [[0, 0, 10, 10]], least_overlap=0.51) == [WRONG]
    assert matched([], [], [[0, 0, 1, 1]]) == []
    assert matched([[0, 0, 1, 1]], [0.9], []) == [WRONG]


def test_ignored_people_swallow_boxes_but_never_instead_of_others():
    people = [[0, 0, 10, 10], [0, 0, 10, 9]]
    boxes = [[0, 0, 10, 10], [0, 0, 10, 10], [0, 0, 10, 10], [50, 50, 10, 10]]
    assert matched(boxes, [0.9, 0.8, 0.7, 0.6], people, [True, False]) == [1, IGNORED, IGNORED, WRONG]


def test_average_precision_of_known_curves():
    assert ap([0.9, 0.8], [True, True], 2) == pytest.approx(1.0)
    assert ap([0.9, 0.8], [True, True], 4) == pytest.approx(0.5)
    assert ap([], [], 3) == 0.0
    assert ap([0.9], [False], 3) == 0.0
    assert ap([0.9], [False], 0) is None
    # right, wrong, right: precision 1 up to recall 1/2, 2/3 from there to 1.
    assert ap([0.9, 0.8, 0.7], [True, False, True], 2) == pytest.approx(0.5 + 0.5 * 2 / 3)
    # The envelope: wrong, right, right of 2: 1/2 and 2/3 become 2/3 throughout.
    assert ap([0.9, 0.8, 0.7], [False, True, True], 2) == pytest.approx(2 / 3)
    # A textbook's ten, five people, right at ranks 1 2 4 6 10: 1, 1, 3/4, 4/6, 5/10.
    right = [True, True, False, True, False, True, False, False, False, True]
    assert ap(np.linspace(0.95, 0.5, 10), right, 5) == pytest.approx((1 + 1 + 3 / 4 + 4 / 6 + 5 / 10) / 5)


def test_boxes_of_one_confidence_have_no_order():
    scores = [0.9, 0.5, 0.5, 0.5, 0.5]
    for right in ([True, True, True, False, False], [True, False, False, True, True]):
        assert ap(scores, right, 3) == pytest.approx(1 / 3 + 2 / 3 * 3 / 5)


def test_average_precision_is_the_integral_of_the_envelope():
    generator = np.random.default_rng(1)
    for _ in range(20):
        n = int(generator.integers(1, 60))
        scores, right = generator.random(n), generator.random(n) < 0.6
        people = int(right.sum() + generator.integers(1, 10))
        order = np.argsort(-scores)
        precision, recall = np.cumsum(right[order]) / np.arange(1, n + 1), np.cumsum(right[order]) / people
        # At every recall level k / people: the best precision that reaches it.
        levels = [max((p for p, r in zip(precision, recall) if r >= k / people - 1e-12), default=0) for k in range(1, people + 1)]
        assert ap(scores, right, people) == pytest.approx(np.mean(levels))


def test_precision_and_recall_at_a_threshold():
    scores, right = np.array([0.9, 0.3, 0.29, 0.8]), np.array([True, True, True, False])
    counts = precision_recall.at_threshold(scores, right, 4, 0.3)
    assert (counts.right, counts.wrong, counts.recall, counts.precision) == (2, 1, 0.5, pytest.approx(2 / 3))
    empty = precision_recall.at_threshold(scores, right, 0, 0.95)
    assert (empty.recall, empty.precision) == (None, None)


def test_best_f1():
    # Precision and recall of 2: 1, 1/2; then 1, 1; then 2/3, 1.
    points = precision_recall.curve(np.array([0.9, 0.6, 0.2]), np.array([True, True, False]), 2)
    assert precision_recall.best_f1(points) == (1.0, 0.6)
    assert precision_recall.best_f1(precision_recall.curve(np.zeros(0), np.zeros(0, dtype=bool), 2)) is None


def scene(people, detections, scores, size=(100, 100), ignored=None):
    return evaluation.scene(ground_truth.picture("p.png", people, ignored), size,
                            (as_boxes(detections), np.array(scores, dtype=float)), 0.5)


def test_sizes_count_apart():
    # 10, 30 and 80 px of 100: small, medium, large. The wrong box is medium.
    people = [[0, 0, 10, 10], [20, 0, 30, 30], [60, 0, 40, 80]]
    all_scenes = [scene(people, [[0, 0, 10, 10], [60, 0, 40, 80], [20, 60, 20, 30]], [0.9, 0.8, 0.7])]
    scores = {size: evaluation.score_of_size(all_scenes, size, 0.3, 0.5) for size in evaluation.SIZES}
    assert [scores[size].counts.people for size in ("small", "medium", "large")] == [1, 1, 1]
    assert [scores[size].ap for size in ("small", "medium", "large")] == [1.0, 0.0, 1.0]
    assert (scores["medium"].counts.right, scores["medium"].counts.wrong) == (0, 1)
    assert scores["large"].counts.precision == 1.0
    assert evaluation.score(all_scenes, 0.3).counts[:3] == (2, 1, 3)


def test_a_box_of_another_size_may_find_the_person():
    # The person's 21 of 100 px are medium, the box's 19 small: found, and not a wrong small box.
    all_scenes = [scene([[0, 0, 20, 21]], [[0, 0, 20, 19]], [0.9])]
    assert evaluation.score_of_size(all_scenes, "medium", 0.3, 0.5).counts.recall == 1.0
    assert evaluation.score_of_size(all_scenes, "small", 0.3, 0.5).counts[:3] == (0, 0, 0)


def test_people_and_boxes_end_at_the_border():
    # Outside the picture the box goes on for as much again; the second person is not in it at all.
    one = scene([[80, 0, 60, 100], [120, 0, 10, 10]], [[80, 0, 20, 100]], [0.9])
    assert list(one.found) == [0] and list(one.ignored) == [False, True]
    assert evaluation.score([one], 0.3).ap == 1.0


def test_relative_boxes_grow_with_the_picture():
    picture = ground_truth.picture("p.png", [[0.25, 0.5, 0.5, 0.5]], relative=True)
    one = evaluation.scene(picture, (200, 100), None, 0.5)
    assert one.people.tolist() == [[50, 50, 100, 50]] and len(one.found) == 0


def test_pictures_that_could_not_be_read_do_not_count():
    pictures = [ground_truth.picture(name, [[0, 0, 10, 10]]) for name in ("a.png", "b.png")]
    run = Run("n", "-", "float", {}, {pictures[1].path: (100, 100)}, None, None)
    assert [one.picture.path for one in evaluation.scenes(pictures, run, 0.5)] == [pictures[1].path]


def test_people_are_linked_by_overlap_until_they_are_gone_for_long():
    walker = [[x, 0, 10, 30] for x in (0, 3, 6, 9)]
    boxes = [as_boxes([walker[0], [50, 0, 10, 30]]), as_boxes([[50, 0, 10, 30], walker[1]]), as_boxes([]), as_boxes([walker[2]]),
             as_boxes([walker[3]])]
    people = link([0.0, 0.1, 0.2, 0.3, 1.0], boxes)
    assert [[tuple(one) for one in person] for person in people] == [[(0, 0), (1, 1), (3, 0)], [(0, 1), (1, 0)], [(4, 0)]]


def test_how_long_a_person_was_overlooked():
    stamps = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]
    boxes = [as_boxes([[0, 0, 10, 10]])] * 6
    counts = [np.array([True])] * 6

    def durations(found, counts=counts):
        return [round(miss.end_s - miss.begin_s, 6) for miss in misses(stamps, boxes, [np.array([f]) for f in found], counts)]

    assert durations([True] * 6) == []
    # Missed in the second and third picture, found in the fourth: from 0.1 to 0.3 s.
    assert durations([True, False, False, True, True, True]) == [0.2]
    # Never found again: until one usual interval after the last.
    assert durations([False, True, True, False, False, False]) == [0.3, 0.1]
    assert durations([False] * 6, [np.array([index != 2]) for index in range(6)]) == [0.3, 0.2]


def test_only_large_people_are_missed_for_long():
    pictures = [ground_truth.picture("p.png", [[0, 0, 30, 20], [50, 50, 10, 10]], time_s=time) for time in (0.0, 0.5)]
    scenes = [evaluation.scene(picture, (100, 100), None, 0.5) for picture in pictures]
    found = evaluation.long_misses(scenes, 0.3)
    assert len(found) == 1 and len(found[0].sightings) == 2 and found[0].end_s - found[0].begin_s == 1.0


def mot(tmp_path, lines, info="[Sequence]\nname=x\nimDir=img1\nframeRate=25\nseqLength=3\nimWidth=100\nimHeight=50\nimExt=.jpg\n"):
    (tmp_path / "gt").mkdir()
    (tmp_path / "gt" / "gt.txt").write_text("\n".join(lines) + "\n")
    (tmp_path / "seqinfo.ini").write_text(info)
    return ground_truth.read_mot(str(tmp_path))


def test_mot_ground_truth(tmp_path):
    pictures = mot(tmp_path, ["1,1,11,21,30,40,1,1,0.9", "3,1,1,1,10,10,1,1,1", "1,2,5,5,10,10,0,1,1", "1,3,5,5,10,10,1,7,1",
                              "1,4,5,5,10,10,1,3,1"])
    assert [os.path.basename(picture.path) for picture in pictures] == ["000001.jpg", "000002.jpg", "000003.jpg"]
    assert pictures[0].path == str(tmp_path / "img1" / "000001.jpg")
    # Pixels from 1; a pedestrian, one not to count, a statue; the car (3) is nobody.
    assert pictures[0].boxes.tolist() == [[10, 20, 30, 40], [4, 4, 10, 10], [4, 4, 10, 10]]
    assert pictures[0].ignored.tolist() == [False, True, True]
    assert len(pictures[1].boxes) == 0 and pictures[2].boxes.tolist() == [[0, 0, 10, 10]]
    assert pictures[2].time_s == pytest.approx(3 / 25)


def test_mot15_has_no_classes(tmp_path):
    pictures = mot(tmp_path, ["1, 1, 11, 21, 30, 40, 1, -1, -1, -1", "2,1,1,1,10,10,0,-1,-1,-1"])
    assert pictures[0].ignored.tolist() == [False] and pictures[1].ignored.tolist() == [True]


def test_mot_people_may_be_too_hidden_to_count(tmp_path):
    mot(tmp_path, ["1,1,1,1,10,10,1,1,0.2", "1,2,1,1,10,10,1,1,0.5"])
    assert ground_truth.read_mot(str(tmp_path), 0.3)[0].ignored.tolist() == [True, False]


@pytest.mark.parametrize("lines, complaint", [
    (["1,1,1,1,10,10"], "gt.txt:1: expected at least 7 numbers"), (["1,1,1,1,ten,10,1,1,1"], "gt.txt:1: not a number"),
    (["9,1,1,1,10,10,1,1,1"], "gt.txt:1: frame 9, but seqinfo.ini says there are 3"), ([""], "gt.txt: no person"),
    (["1,1,1,1,nan,10,1,1,1"], "not a number")])
def test_bad_mot_lines_are_named(tmp_path, lines, complaint):
    with pytest.raises(InputError, match=re.escape(complaint)):
        mot(tmp_path, lines)


@pytest.mark.parametrize("info", ["", "[Sequence]\nname=x\n", "[Sequence]\nseqLength=many\n", "[Sequence]\nseqLength=-1\n", "\x00"])
def test_bad_mot_information_is_named(tmp_path, info):
    with pytest.raises(InputError, match="seqinfo.ini"):
        mot(tmp_path, ["1,1,1,1,10,10,1,1,1"], info)


def test_yolo_labels(write, tmp_path):
    for folder in ("images", "labels"):
        (tmp_path / folder).mkdir()
    write("labels/a b.txt", ["0 0.5 0.5 0.2 0.4", "2 0.5 0.5 0.1 0.1"])
    write("labels/empty.txt", [])
    for name in ("a b.jpg", "empty.png"):
        (tmp_path / "images" / name).touch()
    pictures = ground_truth.read_yolo(str(write("val.txt", ["images/a b.jpg", "", "images/empty.png"])))
    assert [picture.path for picture in pictures] == [str(tmp_path / "images" / name) for name in ("a b.jpg", "empty.png")]
    assert pictures[0].boxes == pytest.approx(np.array([[0.4, 0.3, 0.2, 0.4]])) and pictures[0].relative
    assert len(pictures[1].boxes) == 0
    assert len(ground_truth.read_yolo(str(tmp_path), (0, 2))[0].boxes) == 2


def test_labels_may_lie_beside_the_pictures(write, tmp_path, capsys):
    (tmp_path / "a.jpg").touch()
    (tmp_path / "b.jpg").touch()
    with pytest.raises(InputError, match="no labels"):
        ground_truth.read_yolo(str(tmp_path))
    write("a.txt", ["0 0.5 0.5 1 1"])
    pictures = ground_truth.read_yolo(str(tmp_path))
    assert [len(picture.boxes) for picture in pictures] == [1, 0]
    assert "1 pictures without a label file" in capsys.readouterr().err


@pytest.mark.parametrize("line", ["0 0.5 0.5 0.2", "0 0.5 0.5 0.2 wide", "0 200 100 50 80", "0 0.5 0.5 0 0.1", "0 inf 0.5 0.1 0.1"])
def test_bad_labels_are_named(write, tmp_path, line):
    (tmp_path / "a.jpg").touch()
    write("a.txt", ["0 0.5 0.5 1 1", line])
    with pytest.raises(InputError, match=r"a\.txt:2: "):
        ground_truth.read_yolo(str(tmp_path))


def test_reference_boxes_belong_to_the_nearest_picture(write, tmp_path):
    write("rgb.txt", ["# stamp file", "10.0 rgb/a.png", "10.1 rgb/b.png"])
    reference = write("boxes.txt", ["# header", "10.0009 1 2 3 4 0.5", "10.0009 5 6 7 8 0.9", "10.05 1 1 1 1 1"])
    pictures = ground_truth.read_sequence(str(tmp_path), str(reference))
    assert [len(picture.boxes) for picture in pictures] == [2, 0] and pictures[0].time_s == 10.0
    with pytest.raises(InputError, match="none of its stamps"):
        ground_truth.read_sequence(str(tmp_path), str(write("other.txt", ["20.0 1 2 3 4 0.5"])))


def test_names_of_pictures_may_hold_blanks(write):
    boxes = detector_runs.read_picture_boxes(write("boxes", ["/a b/c 1.png 1 2 3 4 0.5", "/a b/c 1.png 5 6 7 8 0.25", "d 0 0 1 1 1"]))
    assert boxes["/a b/c 1.png"][0].tolist() == [[1, 2, 3, 4], [5, 6, 7, 8]] and boxes["/a b/c 1.png"][1].tolist() == [0.5, 0.25]
    assert list(boxes) == ["/a b/c 1.png", "d"]


def test_the_threshold_is_that_of_rgbd_tum():
    with open(os.path.join(ROOT, "include", "cpslam", "settings.h"), encoding="utf-8") as file:
        assert f"confidence_threshold = {detector_runs.DEFAULT_CONFIDENCE:g};" in file.read()
