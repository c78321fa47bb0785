"""benchmark.py --trials sessions: how the camera is carried, and when a run counts as reached."""

import os

import pytest
from cpslam_tools.benchmark import sessions
from cpslam_tools.benchmark.covers import LensCap
from cpslam_tools.benchmark.kidnapping import INTERVAL_S
from cpslam_tools.benchmark.sequences import Sequence, rows_of

N_FRAMES, N_FIRST, N_AWAY = 60, 12, 30


@pytest.fixture
def source(tmp_path):
    folder = tmp_path / "room"
    (folder / "rgb").mkdir(parents=True)
    (folder / "depth").mkdir()
    (folder / "settings.yaml").write_text("%YAML:1.0\nCamera.fx: 500\nTracking.newMapAfter: 3\n")
    for name, field in (("rgb.txt", "rgb/{}.png"), ("depth.txt", "depth/{}.png"), ("groundtruth.txt", "{} 0 0 0 0 0 1")):
        (folder / name).write_text("".join(f"{1000 + i * INTERVAL_S:.6f} {field.format(i)}\n" for i in range(N_FRAMES)))
    return Sequence("room", str(folder), str(folder / "settings.yaml"))


@pytest.mark.parametrize("after_s", [None, 1.0])
def test_the_camera_is_covered_and_uncovered_elsewhere(source, tmp_path, after_s):
    with sessions.CarriedSequence(source, str(tmp_path / "work"), N_FIRST, N_AWAY, after_s).ready() as ready:
        names = [fields[0] for _, fields in rows_of(os.path.join(ready.directory, "rgb.txt"))]
        with open(ready.settings, encoding="utf-8") as file:
            settings = file.read()
        truth = rows_of(ready.truth)
    assert names == ([f"rgb/{i}.png" for i in range(N_FIRST)] + [LensCap().files(0)[0]] * sessions.N_COVERED
                     + [f"rgb/{i}.png" for i in range(N_AWAY, N_FRAMES)])
    assert len(truth) == N_FIRST + N_FRAMES - N_AWAY
    assert settings.startswith("%YAML:1.0\nCamera.fx: 500\n")
    assert settings.splitlines()[2:] == [f"Tracking.newMapAfter: {after_s or 3}"]


def run(preset, joined, maps, ate=0.02, false=0, error=None):
    found = [{"time_s": 9.0, "matched_time_s": 1.0, "joined_map": 2 if joined else None}] if joined else []
    return {"preset": preset, "room": 1, "error": error, "frames": 100, "tracked": sum(maps), "ate": {"rmse_m": ate},
            "loops": {"events": found}, "false_loops": false, "mode": "threaded",
            "maps": {"started": 2, "joined": len(found), "at_end": [{"map": i + 1, "frames": n} for i, n in enumerate(maps)]}}


@pytest.mark.parametrize("result, expected", [
    (run("ring", True, [90]), True),
    (run("ring", False, [60, 30]), False),
    (run("ring", True, [60, 30]), False),
    (run("ring", True, [90], ate=0.06), False),
    (run("ring", True, [90], ate=None), False),
    (run("ring", True, [90], false=1), False),
    (run("ring", True, [90], error="crashed"), False),
    (run("twin_desks", False, [60, 30]), True),
    (run("twin_desks", True, [90]), False),
    (run("twin_desks", False, [90]), False),
])
def test_what_counts_as_reached(result, expected):
    assert sessions.is_reached(result) == expected
    assert sessions.verdict([result]).startswith("Reached" if expected else "NOT reached")


def test_the_table_tells_how_many_were_joined_and_what_the_maps_have():
    text = sessions.table([run("ring", True, [90]), run("ring", False, [60, 30]), run("twin_desks", False, [50, 40])])
    rows = {line.split("|")[1].strip(): [cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines()
            if line.startswith("| ")}
    assert rows["ring"][2:5] == ["2", "2", "1"]
    assert rows["ring"][9] == "1 of 2"
    assert rows["twin_desks"][7] == "50 + 40"
    assert "1 of 2 runs that come back" in text


def test_a_sequence_that_cannot_be_had_is_a_result():
    failed = {"preset": "ring", "room": 1, "mode": "-", "status": None, "error": "no simulator"}
    assert "no simulator" in sessions.table([failed])
    assert not sessions.is_reached(failed)
