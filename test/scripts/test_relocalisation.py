"""benchmark.py --trials relocalisation: how kidnaps are made, judged and summed up."""

import itertools
import math
import os

import numpy as np
import pytest
from cpslam_tools.benchmark import box_files, covers, kidnapping, relocalisation
from cpslam_tools.benchmark.covers import LensCap, SomebodyInFront
from cpslam_tools.benchmark.kidnapping import INTERVAL_S, KidnappedSequence
from cpslam_tools.benchmark.sequences import Sequence, rows_of

N_FRAMES, N_MAP, SECOND_PASS, KIDNAPS, N_COVERED, N_BACK = 200, 40, 90, 5, 3, 4


@pytest.fixture
def source(tmp_path):
    folder = tmp_path / "room"
    (folder / "rgb").mkdir(parents=True)
    (folder / "depth").mkdir()
    (folder / "settings.yaml").write_text("")
    stamps = [f"{1000 + i * INTERVAL_S:.6f}" for i in range(N_FRAMES)]
    (folder / "rgb.txt").write_text("".join(f"{stamp} rgb/{i}.png\n" for i, stamp in enumerate(stamps)))
    (folder / "depth.txt").write_text("".join(f"{stamp} depth/{i}.png\n" for i, stamp in enumerate(stamps)))
    (folder / "groundtruth.txt").write_text("".join(
        f"{stamp} {math.cos(i / 20):.6f} {math.sin(i / 20):.6f} {i / 100} 0 0 {math.sin(i / 40):.8f} {math.cos(i / 40):.8f}\n"
        for i, stamp in enumerate(stamps)))
    return Sequence("room", str(folder), str(folder / "settings.yaml"))


def sequence_of(source, tmp_path, cover):
    return KidnappedSequence(source, str(tmp_path / "work"), N_MAP, SECOND_PASS, KIDNAPS, N_COVERED, N_BACK, 1, cover)


@pytest.fixture
def kidnapped(source, tmp_path):
    with sequence_of(source, tmp_path, LensCap()).ready() as ready:
        yield ready


def test_the_sequence_is_mapped_then_covered_and_uncovered_elsewhere(kidnapped):
    colour, depth = (rows_of(os.path.join(kidnapped.directory, name)) for name in ("rgb.txt", "depth.txt"))
    assert len(colour) == len(depth) == N_MAP + KIDNAPS * (N_COVERED + N_BACK)
    assert np.allclose(np.diff([stamp for stamp, _ in colour]), INTERVAL_S, atol=2e-6)
    assert [fields[0] for _, fields in colour[:N_MAP]] == [f"rgb/{i}.png" for i in range(N_MAP)]
    for k, (begin, end) in enumerate(kidnapped.visits):
        first = N_MAP + k * (N_COVERED + N_BACK) + N_COVERED
        assert {fields[0] for _, fields in colour[first - N_COVERED:first]} == {"covered_colour.png"}
        assert {fields[0] for _, fields in depth[first - N_COVERED:first]} == {"covered_depth.png"}
        assert abs(colour[first][0] - begin) < 1e-5 and abs(colour[first + N_BACK - 1][0] - end) < 1e-5
        start = int(colour[first][1][0].split("/")[1].split(".")[0])
        assert SECOND_PASS <= start <= N_FRAMES - N_BACK
        assert [row[1][0] for row in colour[first:first + N_BACK]] == [f"rgb/{start + i}.png" for i in range(N_BACK)]
    assert colour[N_MAP - 1][0] < kidnapped.end_of_mapping < colour[N_MAP][0]


def test_the_source_comes_back_to_what_it_was(source, tmp_path):
    with sequence_of(source, tmp_path, LensCap()).ready() as ready:
        directory = ready.directory
    assert not os.path.exists(directory)
    assert os.path.exists(source.directory)


@pytest.mark.parametrize("count", [5, 7, 8, 10, 20])
def test_no_visit_is_near_the_one_before(count):
    starts = kidnapping.visit_starts(1000, 2000, count, np.random.default_rng(3))
    parts = [int((start - 1000) * count / 1000) for start in starts]
    assert sorted(parts) == list(range(count))
    assert all((b - a) % count not in (1, count - 1) for a, b in itertools.pairwise(parts))


def test_a_covered_lens_sees_nothing(tmp_path):
    image = pytest.importorskip("matplotlib.image")
    LensCap().write(tmp_path)
    for name in LensCap().files(0):
        pixels = image.imread(tmp_path / name)
        assert pixels.shape == (480, 640) and not pixels.any()
    assert LensCap().box() is None


def test_who_stands_in_front_fills_the_picture_and_has_a_box(source, tmp_path):
    image = pytest.importorskip("matplotlib.image")
    cover = SomebodyInFront(seed=3)
    with sequence_of(source, tmp_path, cover).ready() as ready:
        boxes = box_files.read_boxes(ready.boxes)
        colour = rows_of(os.path.join(ready.directory, "rgb.txt"))
        shown = [(stamp, fields[0]) for stamp, fields in colour if fields[0].startswith("person")]
        assert [float(box[0]) for box in boxes] == [stamp for stamp, _ in shown]
        assert len(boxes) == KIDNAPS * N_COVERED
        assert boxes[0][1:5] == (0.0, 0.0, 640.0, 480.0)
        assert len({name for _, name in shown}) == covers.PHASES  # sways
        for name in cover.files(7):
            assert os.path.exists(os.path.join(ready.directory, name))
        pixels = image.imread(os.path.join(ready.directory, shown[0][1]))
        assert pixels.shape == (480, 640, 3) and pixels.std() > 0.05
        depth = image.imread(os.path.join(ready.directory, cover.files(0)[1])) * 65535 / covers.DEPTH_UNITS
        assert 0.6 < depth.min() and depth.max() < 0.75


def test_pixels_survive_being_written(tmp_path):
    image = pytest.importorskip("matplotlib.image")
    random = np.random.default_rng(1)
    for pixels in (random.integers(0, 65536, (5, 7)).astype(np.uint16), random.integers(0, 256, (5, 7, 3)).astype(np.uint8)):
        covers.write_png(tmp_path / "x.png", pixels)
        assert np.allclose(image.imread(tmp_path / "x.png") * np.iinfo(pixels.dtype).max, pixels, atol=0.01)


def written(path, rows):
    path.write_text("".join(" ".join(f"{value:.9f}" for value in row) + "\n" for row in rows))
    return path


def test_visits_are_judged_against_what_was_mapped_before(kidnapped, tmp_path):
    truth = [(stamp, *map(float, fields)) for stamp, fields in rows_of(kidnapped.truth)]
    visit_of = {}
    for k, (begin, end) in enumerate(kidnapped.visits):
        for i, row in enumerate(truth):
            if begin - 0.01 < row[0] < end + 0.01:
                visit_of[i] = (k, round((row[0] - begin) / INTERVAL_S))
    estimate = []
    for i, (stamp, x, y, z, *rotation) in enumerate(truth):
        # The estimate's world lies elsewhere, turned by 90 degrees about z.
        x, y, z = -y + 5, x - 3, z + 1
        s = math.sqrt(0.5)
        qz, qw = rotation[2], rotation[3]
        rotation = [0, 0, s * qw + s * qz, s * qw - s * qz]
        visit, frame = visit_of.get(i, (None, None))
        if visit == 0 and frame < 2:
            continue  # found after two frames
        if visit == 1:
            continue  # never
        if visit == 2:
            x += 0.02 if frame < 3 else 2.0  # lost its way at the end
        if visit == 3:
            half = math.radians(4) / 2
            rotation = [0, 0, rotation[2] * math.cos(half) + rotation[3] * math.sin(half),
                        rotation[3] * math.cos(half) - rotation[2] * math.sin(half)]
        estimate.append((stamp, x, y, z, *rotation))
    path = written(tmp_path / "trajectory.txt", estimate)
    visits = kidnapping.judge_visits(kidnapped.truth, path, kidnapped.end_of_mapping, kidnapped.visits)
    assert visits[0]["after"] == 2 and visits[0]["worst_m"] < 1e-3
    assert visits[1] == {"after": None}
    assert visits[2]["after"] == 0
    assert visits[2]["error_m"] == pytest.approx(0.02, abs=1e-3)
    assert visits[2]["worst_m"] == pytest.approx(2.0, abs=1e-2)
    assert visits[3]["error_deg"] == pytest.approx(4.0, abs=0.01) and visits[3]["error_m"] < 1e-3
    assert visits[4] == pytest.approx({"after": 0, "error_m": 0, "error_deg": 0, "worst_m": 0, "worst_deg": 0}, abs=1e-3)
    assert [relocalisation.is_wrong(visit) for visit in visits] == [False, False, True, False, False]
    assert [visit["after"] is not None and relocalisation.is_exact(visit) for visit in visits] == [
        True, False, True, False, True]


def run(variant, visits, error=None):
    return {"variant": variant, "cover": "covered lens", "room": 1, "visits": visits, "error": error}


GOOD = {"after": 3, "error_m": 0.01, "error_deg": 0.2, "worst_m": 0.02, "worst_deg": 0.3}
LATE = {**GOOD, "after": 11}
NEVER = {"after": None}
WRONG = {**GOOD, "worst_m": 3.0}


@pytest.mark.parametrize("known, others, text", [
    ([GOOD] * 20, [NEVER] * 20, "Reached: 20 of 20"),
    ([GOOD] * 19 + [NEVER], [], "Reached: 19 of 20"),
    ([GOOD] * 18 + [LATE, NEVER], [], "NOT reached: 18 of 20"),
    ([GOOD] * 20, [GOOD, WRONG], "NOT reached: 20 of 20"),
])
def test_the_verdict(known, others, text):
    runs = [run(relocalisation.ROUND, known), run(relocalisation.PART, others)]
    assert relocalisation.verdict(runs).startswith(text)
    assert text in relocalisation.table(runs)


def test_a_failed_run_does_not_reach_the_aim():
    runs = [run(relocalisation.ROUND, [GOOD] * 20), {"variant": relocalisation.PART, "cover": "covered lens", "room": 2, "error": "it broke"}]
    assert relocalisation.verdict(runs).startswith("NOT reached")
    assert "it broke" in relocalisation.table(runs)
