"""ATE on cases worked by hand."""

import json

import numpy as np
import pytest
from cpslam_tools.absolute_error import absolute_error
from cpslam_tools.alignment import align_rigidly
from cpslam_tools.errors import InputError
from cpslam_tools.trajectory import Trajectory, rotation_matrices

# A square with corners 1 m from its centre, and one point above and one below it so that it is not flat.
SQUARE = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]


def trajectory(positions, first_stamp=0.0):
    return Trajectory(first_stamp + 0.1 * np.arange(len(positions)), positions)


def lines(positions, stamps=None):
    stamps = stamps if stamps is not None else range(len(positions))
    return [f"{stamp} {x} {y} {z} 0 0 0 1" for stamp, (x, y, z) in zip(stamps, positions)]


def test_a_moved_and_turned_copy_has_no_error():
    # Turned by 90 degrees about z and moved: what alignment is for.
    moved = [[10 - y, 20 + x, 30 + z] for x, y, z in SQUARE]
    result = absolute_error(trajectory(SQUARE), trajectory(moved))
    assert result.statistics["max"] < 1e-12
    assert np.allclose(result.aligned, SQUARE)


def test_a_larger_square_is_not_scaled_away():
    # The same centre and directions, corners 1.5 m instead of 1 m away: every corner is 0.5 m off.
    result = absolute_error(trajectory(SQUARE), trajectory(1.5 * np.array(SQUARE)))
    assert [result.statistics[name] for name in ("rmse", "mean", "median", "min", "max")] == pytest.approx([0.5] * 5)
    assert result.statistics["std"] == pytest.approx(0.0, abs=1e-12)
    # ... unless the caller says so.
    result = absolute_error(trajectory(SQUARE), trajectory(1.5 * np.array(SQUARE)), scale=1 / 1.5)
    assert result.statistics["max"] < 1e-12


def test_one_corner_lifted():
    # Two opposite corners at z = +h, the other two at z = -h. The mean stays, and by symmetry no turn helps:
    # the cross-covariance is diag(2, 2, 0), so the best rotation is the identity. All errors are h.
    h = 0.03
    saddle = [[x, y, h if x else -h] for x, y, _ in SQUARE]
    result = absolute_error(trajectory(SQUARE), trajectory(saddle))
    assert result.statistics["rmse"] == pytest.approx(h)
    assert result.statistics["max"] == pytest.approx(h)


def test_statistics_of_unequal_errors():
    # Truth on the x axis at -3, -1, 1, 3; the estimate's outer points are at -4 and 4. The mean is 0 and the
    # direction the same, so the errors are 1, 0, 0, 1: rmse sqrt(2/4), mean 0.5, median 0.5, std 0.5.
    truth = [[x, 0, 0] for x in (-3, -1, 1, 3)]
    estimate = [[x, 0, 0] for x in (-4, -1, 1, 4)]
    statistics = absolute_error(trajectory(truth), trajectory(estimate)).statistics
    assert statistics["rmse"] == pytest.approx(np.sqrt(0.5))
    assert statistics["mean"] == pytest.approx(0.5)
    assert statistics["median"] == pytest.approx(0.5)
    assert statistics["std"] == pytest.approx(0.5)
    assert statistics["min"] == pytest.approx(0.0, abs=1e-12)
    assert statistics["max"] == pytest.approx(1.0)


def test_a_mirrored_path_is_not_mirrored_back():
    # A reflection would fit perfectly; a rigid body cannot do that.
    spread = np.diag([3.0, 2.0, 1.0])
    points = np.vstack([spread, -spread])
    mirrored = points * [1, 1, -1]
    rotation, _ = align_rigidly(mirrored, points)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    # Best is to leave it: only the two points on z (1 m out) are wrong, by 2 m each. rmse sqrt(2 * 4 / 6).
    result = absolute_error(trajectory(points), trajectory(mirrored))
    assert result.statistics["rmse"] == pytest.approx(np.sqrt(8 / 6))


@pytest.mark.parametrize("seed", range(10))
def test_alignment_undoes_any_rigid_motion(seed):
    generator = np.random.default_rng(seed)
    quaternion = generator.normal(size=4)
    rotation = rotation_matrices([quaternion / np.linalg.norm(quaternion)])[0]
    translation = generator.normal(size=3)
    source = generator.normal(size=(20, 3))
    found_rotation, found_translation = align_rigidly(source, source @ rotation.T + translation)
    assert np.allclose(found_rotation, rotation)
    assert np.allclose(found_translation, translation)


def test_only_associated_poses_count():
    # Truth at 100 Hz, estimate at 10 Hz, 4 ms late, with one pose half a second after the truth's end.
    stamps = 0.01 * np.arange(101)
    truth = Trajectory(stamps, np.stack([stamps, stamps**2, 0 * stamps], axis=1))
    late = 0.1 * np.arange(11) + 0.004
    estimate = Trajectory(np.append(late, 1.5), np.zeros((12, 3)))
    assert len(absolute_error(truth, estimate).errors) == 11
    with pytest.raises(InputError, match="only 0 of 12"):
        absolute_error(truth, estimate, max_difference=0.003)
    assert len(absolute_error(truth, estimate, offset=-0.004, max_difference=0.003).errors) == 11


def test_ten_thousand_poses_against_a_long_ground_truth_are_quick():
    # Only that it ends within the test's limit: with all n * m pairs it would not.
    stamps = 0.01 * np.arange(60000)
    truth = Trajectory(stamps, np.stack([np.cos(stamps), np.sin(stamps), 0.1 * stamps], axis=1))
    chosen = slice(0, 60000, 6)
    estimate = Trajectory(stamps[chosen] + 0.001, truth.positions[chosen])
    result = absolute_error(truth, estimate, max_difference=1e6)
    assert len(result.errors) == 10000
    assert result.statistics["max"] < 1e-9


def test_script_prints_the_rmse_alone(run_script, write):
    truth = write("truth.txt", lines(SQUARE))
    estimate = write("estimate.txt", lines(1.5 * np.array(SQUARE)))
    result = run_script("evaluate_ate.py", truth, estimate)
    assert (result.returncode, result.stdout) == (0, "0.500000\n")


def test_script_prints_all_when_verbose(run_script, write):
    truth = write("truth.txt", ["# timestamp tx ty tz", *lines(SQUARE)])
    estimate = write("estimate.txt", lines(1.5 * np.array(SQUARE)))
    result = run_script("evaluate_ate.py", truth, estimate, "--verbose")
    assert result.stdout.splitlines() == ["compared_pose_pairs 4 pairs",
                                          "absolute_translational_error.rmse 0.500000 m",
                                          "absolute_translational_error.mean 0.500000 m",
                                          "absolute_translational_error.median 0.500000 m",
                                          "absolute_translational_error.std 0.000000 m",
                                          "absolute_translational_error.min 0.500000 m",
                                          "absolute_translational_error.max 0.500000 m"]


def test_script_writes_what_it_is_asked_for(run_script, write, tmp_path):
    truth = write("truth.txt", lines(SQUARE))
    # The copy is moved by (1, 2, 3) and has a fifth pose that no ground truth belongs to.
    estimate = write("estimate.txt", lines([[x + 1, y + 2, z + 3] for x, y, z in [*SQUARE, [5, 5, 5]]]))
    result = run_script("evaluate_ate.py", truth, estimate, "--save", tmp_path / "aligned.txt", "--save_associations",
                        tmp_path / "pairs.txt", "--plot", tmp_path / "plot.png", "--json", tmp_path / "ate.json")
    assert result.returncode == 0, result.stderr
    aligned = np.loadtxt(tmp_path / "aligned.txt")
    assert np.allclose(aligned, [[i, *p] for i, p in enumerate([*SQUARE, [5, 5, 5]])], atol=1e-6)
    pairs = np.loadtxt(tmp_path / "pairs.txt")
    assert np.allclose(pairs, [[i, *p, i, *p] for i, p in enumerate(SQUARE)], atol=1e-6)
    assert (tmp_path / "plot.png").read_bytes().startswith(b"\x89PNG")
    ate = json.loads((tmp_path / "ate.json").read_text())["ate"]
    assert ate["pairs"] == 4 and ate["rmse_m"] < 1e-9


def test_json_on_stdout_stands_alone(run_script, write):
    truth = write("truth.txt", lines(SQUARE))
    result = run_script("evaluate_ate.py", truth, truth, "--json", "-", "--verbose")
    assert json.loads(result.stdout)["ate"]["pairs"] == 4


@pytest.mark.parametrize("content, complaint", [
    (["0 0 0 0 0 0 0 1", "1 0 zero 0 0 0 0 1"], "bad.txt:2: not a number"),
    (["0 1 2"], "bad.txt:1: expected a timestamp and a position, found 3 fields"),
    (["# nothing", ""], "bad.txt: no pose in this file"),
    (["0 0 0 0 0 0 0 0"], "bad.txt:1: a quaternion of length zero"),
    (["0 inf 0 0 0 0 0 1"], "bad.txt:1: an infinite value"),
    (["0 0 0 0", "1 0 0 0 0 0 0 1"], "some lines have a rotation and some have none"),
    (["100 0 0 0", "101 0 0 0"], "only 0 of 2 estimated poses have a ground truth within 0.02 s"),
])
def test_bad_input_is_one_line_and_status_2(run_script, write, content, complaint):
    result = run_script("evaluate_ate.py", write("truth.txt", lines(SQUARE)), write("bad.txt", content))
    assert result.returncode == 2
    assert result.stderr.count("\n") == 1 and complaint in result.stderr


def test_a_missing_file_and_an_unwritable_one_are_named(run_script, write, tmp_path):
    truth = write("truth.txt", lines(SQUARE))
    result = run_script("evaluate_ate.py", truth, tmp_path / "absent.txt")
    assert result.returncode == 2 and "absent.txt: No such file or directory" in result.stderr
    result = run_script("evaluate_ate.py", truth, truth, "--save", tmp_path / "no" / "such.txt")
    assert result.returncode == 2 and "cannot write" in result.stderr
    result = run_script("evaluate_ate.py", truth, truth, "--plot", tmp_path / "plot.xyz")
    assert result.returncode == 2 and "cannot write" in result.stderr and result.stderr.count("\n") == 1


def test_lines_with_nan_are_left_out_with_a_warning(run_script, write):
    estimate = write("estimate.txt", [*lines(SQUARE), "4 nan nan nan 0 0 0 1"])
    result = run_script("evaluate_ate.py", write("truth.txt", lines(SQUARE)), estimate)
    assert (result.returncode, result.stdout) == (0, "0.000000\n")
    assert "1 lines with NaN left out" in result.stderr


def test_commas_and_positions_without_rotation_are_read(run_script, write):
    truth = write("truth.csv", [f"{i}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(SQUARE)])
    assert run_script("evaluate_ate.py", truth, truth).stdout == "0.000000\n"
