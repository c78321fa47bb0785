"""Trial `loops`: which loops count as false, and when a walk counts as reached."""

import pytest

from cpslam_tools.benchmark import loops


@pytest.fixture
def truth(tmp_path):
    path = tmp_path / "groundtruth.txt"
    half_turn = "0 0 1 0"
    path.write_text("# stamp position quaternion\n"
                    "1.0 0 0 1 0 0 0 1\n"
                    "2.0 5 0 1 " + half_turn + "\n"
                    "3.0 0.5 0 1 0 0 0 -1\n"
                    "4.0 0.5 0 1 " + half_turn + "\n", encoding="utf-8")
    return str(path)


def event(time_s, matched_time_s):
    return {"time_s": time_s, "matched_time_s": matched_time_s}


def test_loops_between_views_of_one_place_are_true(truth):
    assert loops.false_loops(truth, [event(3.0, 1.0)]) == 0  # a quaternion's sign means nothing
    assert loops.false_loops(truth, [event(3.02, 0.99)]) == 0
    assert loops.false_loops(truth, []) == 0


def test_loops_between_two_places_or_directions_are_false(truth):
    assert loops.false_loops(truth, [event(2.0, 1.0)]) == 1
    assert loops.false_loops(truth, [event(4.0, 1.0), event(3.0, 1.0)]) == 1


def run(preset, variant, ate, closed=0, false=0, tracked=100, error=None):
    return {"preset": preset, "variant": variant, "error": error, "frames": 100, "tracked": tracked, "ate": {"rmse_m": ate},
            "loops": {"events": [event(1.0, 0.0)] * closed}, "false_loops": false, "mode": "threaded",
            "stages": [{"stage": "loop: moving the map", "max_ms": 7.0}]}


def row(runs):
    """Cells of the one row that is about runs with loop closing."""
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in loops.table(runs).splitlines() if "|" in line]
    found = [cells for cells in rows if cells[1] == loops.WITH]
    assert len(found) == 1
    return found[0]


def verdict(runs):
    return row(runs)[-2]


@pytest.mark.parametrize("spoil, expected", [
    ({}, "yes"),
    ({"ate": 0.0101}, "NO"),
    ({"closed": 0}, "NO"),
    ({"false": 1}, "NO"),
    ({"tracked": 99}, "NO"),
    ({"error": "crashed"}, "NO"),
])
def test_a_ring_is_reached_when_every_run_is_good(spoil, expected):
    good = {"ate": 0.01, "closed": 1}
    runs = [run("ring", loops.WITHOUT, 0.03), run("ring", loops.WITH, **{**good, **spoil})]
    assert verdict(runs) == expected


def test_one_run_above_the_aim_is_too_many():
    runs = [run("ring", loops.WITHOUT, 0.2), *(run("ring", loops.WITH, ate, closed=1) for ate in (0.01, 0.02, 0.031))]
    assert verdict(runs) == "NO"


def test_two_desks_need_no_loop_but_no_false_one():
    assert verdict([run("twin_desks", loops.WITH, 0.03)]) == "yes"
    assert verdict([run("twin_desks", loops.WITH, 0.03, closed=1, false=1)]) == "NO"


def test_the_map_standing_still_is_told():
    assert row([run("ring", loops.WITH, 0.01, closed=1)])[-3] == "7"
