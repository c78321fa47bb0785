"""One-to-one, closest first, and the ways in which a list can be wrong."""

import random

import pytest
from cpslam_tools.association import associate_stamps


def by_definition(first, second, offset, max_difference):
    """The definition, word by word: all pairs by distance, each stamp used once."""
    candidates = sorted((abs(a - (b + offset)), a, b, i, j) for i, a in enumerate(first)
                        for j, b in enumerate(second) if abs(a - (b + offset)) < max_difference)
    used_first, used_second, pairs = set(), set(), []
    for _, a, _, i, j in candidates:
        if i not in used_first and j not in used_second:
            used_first.add(i)
            used_second.add(j)
            pairs.append((a, i, j))
    return [(i, j) for _, i, j in sorted(pairs)]


def test_the_closest_pair_wins():
    # 1.000 is 0.015 from 1.015 and 1.020 only 0.005: the latter pair is made and 1.000 stays alone,
    # although it came first.
    assert associate_stamps([1.000, 1.020], [1.015]) == [(1, 0)]


def test_the_loser_takes_its_next_best():
    # 1.010-1.012 (0.002) is taken first. 1.000 would have liked 1.012 (0.012) and gets 0.985 (0.015).
    assert associate_stamps([1.000, 1.010], [0.985, 1.012]) == [(0, 0), (1, 1)]


def test_of_equally_close_pairs_the_earlier_first_stamp_wins():
    # Binary fractions, so that the distances are exactly equal.
    assert associate_stamps([0.0, 2.0], [1.0], max_difference=1.5) == [(0, 0)]
    assert associate_stamps([1.0], [0.0, 2.0], max_difference=1.5) == [(0, 0)]


def test_the_limit_itself_is_too_far():
    assert associate_stamps([0.0], [0.25], max_difference=0.25) == []
    assert associate_stamps([0.0], [0.25], max_difference=0.26) == [(0, 0)]


def test_the_offset_is_added_to_the_second_list():
    assert associate_stamps([10.0, 11.0], [0.0, 1.0], offset=10.0) == [(0, 0), (1, 1)]


def test_unsorted_lists_come_back_in_the_order_of_the_first_stamps():
    assert associate_stamps([3.0, 1.0, 2.0], [2.01, 3.01, 1.01]) == [(1, 2), (2, 0), (0, 1)]


def test_empty_lists_have_no_pairs():
    assert associate_stamps([], [1.0]) == []
    assert associate_stamps([1.0], []) == []


@pytest.mark.parametrize("seed", range(30))
def test_agrees_with_the_definition(seed):
    generator = random.Random(seed)
    # Sixteenths: every sum is exact, and there are many ties.
    first = generator.sample([k / 16 for k in range(80)], 25)
    second = generator.sample([k / 16 for k in range(80)], 30)
    offset = generator.choice([0.0, 0.5, -1.0])
    limit = generator.choice([0.125, 0.25, 1.0, 100.0])
    assert associate_stamps(first, second, offset, limit) == by_definition(first, second, offset, limit)


def test_script_prints_both_lines(run_script, write):
    rgb = write("rgb.txt", ["# colour", "1.00 rgb/a.png", "2.00 rgb/b.png"])
    depth = write("depth.txt", ["2.01 depth/b.png", "1.01 depth/a.png", "9 depth/c.png"])
    result = run_script("associate.py", rgb, depth)
    assert result.stdout.splitlines() == ["1.000000 rgb/a.png 1.010000 depth/a.png",
                                          "2.000000 rgb/b.png 2.010000 depth/b.png"]
    result = run_script("associate.py", rgb, depth, "--first_only")
    assert result.stdout.splitlines() == ["1.000000 rgb/a.png", "2.000000 rgb/b.png"]
    assert run_script("associate.py", rgb, depth, "--max_difference", "0.005").stdout == ""


def test_module_keeps_the_functions_others_import():
    from associate import associate, read_file_list
    assert callable(read_file_list)
    assert associate({1.0: ["a"], 2.0: ["b"]}, {2.01: ["d"], 1.01: ["c"]}) == [(1.0, 1.01), (2.0, 2.01)]


@pytest.mark.parametrize("line, complaint", [("abc rgb/x.png", "rgb.txt:2: 'abc' is not a timestamp"),
                                             ("nan rgb/x.png", "rgb.txt:2: 'nan' is not a timestamp")])
def test_a_bad_line_is_named(run_script, write, line, complaint):
    good = write("depth.txt", ["1 d.png"])
    result = run_script("associate.py", write("rgb.txt", ["1 a.png", line]), good)
    assert result.returncode == 2
    assert result.stderr.count("\n") == 1 and complaint in result.stderr
