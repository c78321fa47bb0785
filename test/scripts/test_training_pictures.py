"""Boxes stay on their people, whatever is done to the pictures."""

import numpy as np
import pytest
from training_support import cv2

from cpslam_tools.errors import InputError
from training import scenes
from training.cutouts import load_cutouts, paste
from training.geometry import Window, affine, cut_boxes, linear_map, move_boxes
from training.photometry import weather
from training.pictures import PictureStore, letterbox
from training.records import Record
from training.samples import Batches, Collate, Samples, Source
from training.scenes import SceneMaker, SceneSettings

WIDTH, HEIGHT = 240, 180
PERSON = np.array([90.0, 30.0, 150.0, 140.0])
RED = (20, 20, 240)


@pytest.fixture
def maker(tmp_path, monkeypatch):
    """Makes scenes of one picture: a red ellipse, which is the person, on green; light stays as it is."""
    monkeypatch.setattr(scenes, "weather", lambda picture, generator: picture)
    monkeypatch.setattr(SceneMaker, "_prepare", lambda self, canvas, generator: None)  # it may be red
    picture = np.full((HEIGHT, WIDTH, 3), (20, 160, 20), np.uint8)
    centre, size = (PERSON[:2] + PERSON[2:]) / 2 - 0.5, PERSON[2:] - PERSON[:2]
    cv2.ellipse(picture, (tuple(centre), tuple(size), 0), RED, -1, cv2.LINE_AA)
    path = str(tmp_path / "person.png")
    cv2.imwrite(path, picture)
    record = Record(path, (PERSON / np.tile((WIDTH, HEIGHT), 2))[None].astype(np.float32))

    def make(settings=SceneSettings(pasted=0.0), cutouts=()):
        return SceneMaker([record], PictureStore([record]), list(cutouts), settings)
    return make


def red_places(picture):
    """Columns and rows of the person's pixels."""
    rows, columns = np.nonzero((np.abs(picture.astype(int) - RED) < 60).all(2))
    return np.column_stack([columns, rows]) + 0.5


@pytest.mark.parametrize("settings", [SceneSettings(pasted=0.0, mosaic=0.0, mosaic_of_nine=0.0),
                                      SceneSettings(pasted=0.0, mosaic=1.0, mosaic_of_nine=0.0),
                                      SceneSettings(pasted=0.0, mosaic=0.0, mosaic_of_nine=1.0)])
def test_boxes_lie_on_what_is_seen_of_people(maker, settings):
    made, n_people, n_ignored = maker(settings), 0, 0
    for seed in range(60):
        picture, people, ignored = made.make(224, lambda: 0, np.random.default_rng(seed))
        known = np.concatenate([people, ignored])
        assert np.all(known >= 0) and np.all(known <= 224) and np.all(known[:, 2:] > known[:, :2])
        n_people, n_ignored = n_people + len(people), n_ignored + len(ignored)
        places = red_places(picture)
        inside = [((places > box[:2] - 2) & (places < box[2:] + 2)).all(1) for box in known]
        assert not len(places) or np.any(inside, 0).all(), f"seed {seed}"
        for box in people:
            assert ((places > box[:2]) & (places < box[2:])).all(1).sum() > 0.3 * np.prod(box[2:] - box[:2])
    assert n_people >= 50 and n_people > n_ignored


def test_boxes_fit_tightly_when_nothing_is_cut(maker):
    made, tight = maker(SceneSettings(pasted=0.0, mosaic=0.0, mosaic_of_nine=0.0, turned=1.0)), 0
    for seed in range(80):
        picture, people, _ = made.make(256, lambda: 0, np.random.default_rng(seed))
        if len(people) != 1 or people.min() < 3 or people.max() > 253:
            continue
        places = red_places(picture)
        np.testing.assert_allclose([*places.min(0), *places.max(0)], people[0], atol=2.0)
        tight += 1
    assert tight > 15


def test_same_numbers_same_pictures_whoever_makes_them(maker):
    sources = [Source(0.5, np.array([0]), np.array([1.0])), Source(0.5, np.array([0]), np.array([1.0]))]
    first, second = (Samples(maker(), sources, seed=3) for _ in range(2))
    first[(0, 96)]
    for number in (5, 2):
        for one, other in zip(first[(number, 96)], second[(number, 96)]):
            np.testing.assert_array_equal(one, other)
    assert not np.array_equal(first[(5, 96)][0], first[(6, 96)][0])


def test_sources_are_drawn_from_as_often_as_asked():
    class Echo:
        def make(self, side, draw, generator):
            return draw()
    samples = Samples(Echo(), [Source(3.0, np.array([0, 1]), np.array([0.9, 0.1])),
                               Source(1.0, np.array([2]), np.array([1.0]))], seed=1)
    drawn = np.bincount([samples[(n, 1)] for n in range(4000)], minlength=3) / 4000
    np.testing.assert_allclose(drawn, [0.675, 0.075, 0.25], atol=0.03)


def test_half_a_turn_and_a_mirror_move_boxes_exactly():
    linear = linear_map(2.0, 1.0, np.pi / 2, False)
    moved = move_boxes(np.array([[10.0, 20, 14, 30]]), affine(linear, (12, 25), (50, 50)))
    np.testing.assert_allclose(moved, [[40, 46, 60, 54]])
    mirrored = move_boxes(np.array([[10.0, 20, 14, 30]]), affine(linear_map(1, 1, 0, True), (0, 0), (100, 0)))
    np.testing.assert_allclose(mirrored, [[86, 20, 90, 30]])


def test_turned_boxes_hold_the_ellipse_and_no_more():
    generator = np.random.default_rng(4)
    for _ in range(50):
        box = np.sort(generator.uniform(0, 100, (2, 2)), 0).reshape(1, 4)
        matrix = affine(linear_map(generator.uniform(0.3, 3), generator.uniform(0.6, 1.6), generator.uniform(-1, 1),
                                   generator.random() < 0.5), (0, 0), generator.uniform(-50, 50, 2))
        around = np.linspace(0, 2 * np.pi, 4000)
        points = (box[0, :2] + box[0, 2:]) / 2 + np.column_stack([np.cos(around), np.sin(around)]) \
            * (box[0, 2:] - box[0, :2]) / 2
        points = points @ matrix[:, :2].T + matrix[:, 2]
        np.testing.assert_allclose(move_boxes(box, matrix)[0], [*points.min(0), *points.max(0)], atol=1e-3)


def test_cut_people_are_found_ignored_or_gone():
    window = Window(0, 0, 100, 100)
    boxes = np.array([[-50.0, 10, 50, 60],  # half of it is there
                      [-95, 10, 5, 60],  # a twentieth
                      [-1000, -1000, 1100, 1100],  # a small part, but it fills the picture
                      [120, 10, 150, 60],  # beside it
                      [10, 10, 12, 40]])  # too thin
    found, ignored = cut_boxes(boxes, window)
    np.testing.assert_array_equal(found, [[0, 10, 50, 60], [0, 0, 100, 100]])
    np.testing.assert_array_equal(ignored, [[0, 10, 5, 60], [10, 10, 12, 40]])
    assert [len(part) for part in cut_boxes(np.zeros((0, 4)), window)] == [0, 0]


def cutout(tmp_path, name="a_f.png"):
    picture = np.zeros((120, 60, 4), np.uint8)
    picture[5:115, 5:55] = (*RED, 255)
    folder = tmp_path / "cutouts"
    folder.mkdir(exist_ok=True)
    cv2.imwrite(str(folder / name), picture)
    return folder


def test_pasted_people_have_boxes_on_what_is_seen(tmp_path):
    (figure, cut_below), = load_cutouts(cutout(tmp_path))
    assert not cut_below
    n_people = 0
    for seed in range(60):
        canvas = np.full((200, 200, 3), 60, np.uint8)
        people, ignored = paste(canvas, np.zeros((0, 4)), np.zeros((0, 4)), figure, cut_below,
                                np.random.default_rng(seed))
        changed = np.abs(canvas.astype(int) - 60).max(2) > 40
        if not changed.any():
            assert not len(people)
            continue
        box, = np.concatenate([people, ignored])
        rows, columns = np.flatnonzero(changed.any(1)), np.flatnonzero(changed.any(0))
        np.testing.assert_allclose([columns[0], rows[0], columns[-1] + 1, rows[-1] + 1], box, atol=2)
        n_people += len(people)
    assert n_people > 35


def test_pasted_people_hide_others(tmp_path):
    (figure, cut_below), = load_cutouts(cutout(tmp_path))
    n_hidden = 0
    for seed in range(80):
        canvas = np.full((200, 200, 3), 60, np.uint8)
        before = np.array([[90.0, 120, 110, 170]])
        people, ignored = paste(canvas, before, np.zeros((0, 4)), figure, cut_below, np.random.default_rng(seed))
        seen = np.abs(canvas[120:170, 90:110].astype(int) - 60).max(2) <= 40
        kept = len(people) and np.array_equal(people[0], before[0])
        assert kept == (seen.mean() > 0.25) or abs(seen.mean() - 0.25) < 0.05
        n_hidden += not kept
    assert 5 < n_hidden < 60


def test_cutouts_without_alpha_are_named(tmp_path):
    cv2.imwrite(str(cutout(tmp_path) / "b_b.png"), np.zeros((9, 9, 3), np.uint8))
    with pytest.raises(InputError, match="b_b.png is no picture with an alpha channel"):
        load_cutouts(tmp_path / "cutouts")


def test_weather_changes_pictures_within_bounds():
    picture = np.random.default_rng(0).integers(0, 256, (64, 64, 3), dtype=np.uint8)
    for seed in range(40):
        changed = weather(picture.copy(), np.random.default_rng(seed))
        assert changed.shape == picture.shape and changed.dtype == np.uint8
        assert not np.array_equal(changed, picture)
        np.testing.assert_array_equal(changed, weather(picture.copy(), np.random.default_rng(seed)))


def test_store_shrinks_and_reads_again_beyond_its_memory(tmp_path):
    paths = []
    for i in range(3):
        cv2.imwrite(str(tmp_path / f"{i}.png"), np.full((50, 100, 3), 40 * i, np.uint8))
        paths.append(Record(str(tmp_path / f"{i}.png")))
    store = PictureStore(paths, longest=50, memory=1)
    assert [store[i].shape for i in range(3)] == [(25, 50, 3)] * 3
    assert [int(store[i][0, 0, 0]) for i in (2, 0, 1)] == [80, 0, 40]
    with pytest.raises(InputError, match="cannot read the picture"):
        PictureStore([Record(str(tmp_path / "none.png"))])


def test_letterbox_by_hand():
    fitted, scale, left, top = letterbox(np.zeros((50, 100, 3), np.uint8), 64, 64)
    assert (scale, left, top) == (0.64, 0, 16)
    assert fitted[15].min() == 114 and fitted[16].max() == 0 and fitted[47].max() == 0 and fitted[48].min() == 114


def test_batches_go_on_where_they_stopped():
    plan = {0: 64, 4: 96, 8: 64}.get
    whole = list(Batches(0, 10, 4, plan))
    assert whole[2] == [(8, 64), (9, 64), (10, 64), (11, 64)]
    assert list(Batches(4, 10, 4, plan)) == whole[1:]
    assert len(Batches(4, 10, 4, plan)) == 2


def test_collate_puts_boxes_beside_their_pictures():
    pictures = [np.full((8, 8, 3), (1, 2, 3), np.uint8), np.zeros((8, 8, 3), np.uint8)]
    batch = Collate()([(pictures[0], np.zeros((0, 4)), np.array([[0.0, 0, 2, 2]])),
                       (pictures[1], np.array([[1.0, 2, 3, 6], [0, 0, 4, 4]]), np.zeros((0, 4)))])
    assert batch.pictures[0, :, 0, 0].tolist() == [3, 2, 1]
    assert batch.targets.boxes.tolist() == [[2, 4, 2, 4], [2, 2, 4, 4]]
    assert batch.targets.picture.tolist() == [1, 1]
    assert batch.targets.ignored_picture.tolist() == [0]
    assert batch.soft == []
