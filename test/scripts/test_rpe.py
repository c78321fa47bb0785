"""RPE on cases worked by hand."""

import json
import math

import numpy as np
import pytest
from cpslam_tools.relative_error import relative_error
from cpslam_tools.trajectory import Trajectory, rotation_angles, rotation_matrices

IDENTITY = [0.0, 0.0, 0.0, 1.0]


def line_along_x(speed, seconds=10, rate=10, stamp_shift=0.0):
    stamps = np.arange(seconds * rate + 1) / rate
    positions = np.stack([speed * stamps, 0 * stamps, 0 * stamps], axis=1)
    return Trajectory(stamps + stamp_shift, positions, np.tile(IDENTITY, (len(stamps), 1)))


def turning_about_z(radians_per_second, seconds=10, rate=10):
    """Stands still and turns."""
    stamps = np.arange(seconds * rate + 1) / rate
    half = radians_per_second * stamps / 2
    quaternions = np.stack([0 * half, 0 * half, np.sin(half), np.cos(half)], axis=1)
    return Trajectory(stamps, np.zeros((len(stamps), 3)), quaternions)


def lines(trajectory):
    rows = np.column_stack([trajectory.stamps, trajectory.positions, trajectory.quaternions])
    return [" ".join(f"{value:.9f}" for value in row) for row in rows]


def test_constant_drift():
    # The estimate walks 1.05 m/s instead of 1 m/s: it is 5 cm off after every second, never turned.
    result = relative_error(line_along_x(1.0), line_along_x(1.05), fixed_delta=True, delta=1.0)
    assert [result.translation[name] for name in ("rmse", "mean", "median", "min", "max")] == pytest.approx([0.05] * 5)
    assert result.rotation_deg["max"] == pytest.approx(0.0, abs=1e-9)
    # 101 poses at 10 Hz: the partners of 0 .. 9.0 s are 1 s on; that of 9.0 s and of all later ones is the last pose.
    assert len(result.rows) == 90


def test_drift_grows_with_the_interval():
    result = relative_error(line_along_x(1.0), line_along_x(1.05), fixed_delta=True, delta=2.0)
    assert result.translation["mean"] == pytest.approx(0.10)


def test_units_of_the_interval():
    truth, estimate = line_along_x(1.0), line_along_x(1.05)
    # 5 frames are half a second: 2.5 cm. 2.1 m of the estimate's path are 2 s: 10 cm.
    assert relative_error(truth, estimate, fixed_delta=True, delta=5, delta_unit="f").translation["mean"] == \
        pytest.approx(0.025)
    assert relative_error(truth, estimate, fixed_delta=True, delta=2.1, delta_unit="m").translation["mean"] == \
        pytest.approx(0.10)


def test_constant_turn():
    # The estimate turns 0.22 rad/s instead of 0.20: 0.02 rad = 1.1459 degrees a second, and it never moves.
    truth, estimate = turning_about_z(0.20), turning_about_z(0.22)
    result = relative_error(truth, estimate, fixed_delta=True)
    assert result.rotation_deg["mean"] == pytest.approx(math.degrees(0.02))
    assert result.translation["max"] == pytest.approx(0.0, abs=1e-12)
    # 0.44 rad of the estimate's turning are 2 s: 0.04 rad. The same in degrees.
    result = relative_error(truth, estimate, fixed_delta=True, delta=0.44, delta_unit="rad")
    assert result.rotation_deg["mean"] == pytest.approx(math.degrees(0.04))
    result = relative_error(truth, estimate, fixed_delta=True, delta=math.degrees(0.44), delta_unit="deg")
    assert result.rotation_deg["mean"] == pytest.approx(math.degrees(0.04))


def test_motion_is_measured_in_the_moving_frame():
    # The estimate's whole world is turned and moved: no motion changes, so there is no error at all.
    truth = line_along_x(1.0)
    half = math.sqrt(0.5)
    turned = np.stack([5 - truth.positions[:, 1], 7 + truth.positions[:, 0], truth.positions[:, 2]], axis=1)
    estimate = Trajectory(truth.stamps, turned, np.tile([0, 0, half, half], (len(truth), 1)))
    result = relative_error(truth, estimate, fixed_delta=True)
    assert result.translation["max"] == pytest.approx(0.0, abs=1e-12)
    # A wrong heading alone is no drift of the heading, but the steps point elsewhere: after 1 m straight on in a
    # frame turned by 90 degrees the end is sqrt(2) m off.
    result = relative_error(truth, Trajectory(truth.stamps, truth.positions, estimate.quaternions), fixed_delta=True)
    assert result.translation["mean"] == pytest.approx(math.sqrt(2))
    assert result.rotation_deg["max"] == pytest.approx(0.0, abs=1e-6)


def test_scale_applies_to_the_estimated_motion():
    result = relative_error(line_along_x(1.0), line_along_x(2.0), fixed_delta=True, scale=0.5)
    assert result.translation["max"] == pytest.approx(0.0, abs=1e-12)


def test_offset_shifts_the_estimate():
    # The truth moves 1 m/s in the first five seconds and stands still after. An estimate that does so 1 s later by
    # its own clock has no error once the clock is set right.
    stamps = np.arange(101) / 10
    walk = np.stack([np.minimum(stamps, 5.0), 0 * stamps, 0 * stamps], axis=1)
    rotations = np.tile(IDENTITY, (101, 1))
    truth, late = Trajectory(stamps, walk, rotations), Trajectory(stamps + 1.0, walk, rotations)
    assert relative_error(truth, late, fixed_delta=True).translation["max"] > 0.9
    assert relative_error(truth, late, fixed_delta=True, offset=-1.0).translation["max"] == pytest.approx(0, abs=1e-12)


def test_motions_in_a_hole_of_the_truth_are_left_out():
    # 10 Hz truth without anything between 4 s and 6 s. Poses between 4.2 and 5.8 s have no truth within two
    # intervals (0.2 s); they may neither start nor end a motion.
    whole = line_along_x(1.0)
    keep = (whole.stamps <= 4.0) | (whole.stamps >= 6.0)
    holed = Trajectory(whole.stamps[keep], whole.positions[keep], whole.quaternions[keep])
    result = relative_error(holed, line_along_x(1.05), fixed_delta=True)
    inside = (result.rows[:, 0:2] > 4.21) & (result.rows[:, 0:2] < 5.79)
    assert len(result.rows) > 0 and not inside.any()


def test_all_pairs_when_there_are_few():
    # 5 poses, 25 ordered pairs. The error of a pair k seconds apart is 0.05 k: 5 times 0, 8 times 0.05, 6 times
    # 0.10, 4 times 0.15, 2 times 0.20: the mean is (0.4 + 0.6 + 0.6 + 0.4) / 25 = 0.08.
    truth = line_along_x(1.0, seconds=4, rate=1)
    result = relative_error(truth, line_along_x(1.05, seconds=4, rate=1), max_pairs=0)
    assert len(result.rows) == 25
    assert result.translation["mean"] == pytest.approx(0.08)


def test_random_pairs_repeat_with_their_seed():
    truth, estimate = line_along_x(1.0), line_along_x(1.05)
    one, two, other = (relative_error(truth, estimate, max_pairs=200, seed=seed) for seed in (3, 3, 4))
    assert len(one.rows) == 200
    assert np.array_equal(one.rows, two.rows) and not np.array_equal(one.rows, other.rows)
    fixed = relative_error(truth, estimate, max_pairs=10, fixed_delta=True, seed=3)
    assert len(fixed.rows) == 10 and fixed.translation["mean"] == pytest.approx(0.05)


def test_angles_are_exact_at_both_ends():
    for angle in (0.0, 1e-9, 0.5, math.pi - 1e-6, math.pi):
        quaternion = [math.sin(angle / 2), 0, 0, math.cos(angle / 2)]
        assert rotation_angles(rotation_matrices([quaternion]))[0] == pytest.approx(angle, abs=1e-12)


def test_script_prints_the_mean_alone(run_script, write):
    truth = write("truth.txt", lines(line_along_x(1.0)))
    estimate = write("estimate.txt", lines(line_along_x(1.05)))
    result = run_script("evaluate_rpe.py", truth, estimate, "--fixed_delta")
    assert (result.returncode, result.stdout) == (0, "0.050000\n"), result.stderr


def test_script_prints_all_when_verbose(run_script, write):
    truth = write("truth.txt", lines(turning_about_z(0.20)))
    estimate = write("estimate.txt", lines(turning_about_z(0.22)))
    result = run_script("evaluate_rpe.py", truth, estimate, "--fixed_delta", "--verbose")
    printed = result.stdout.splitlines()
    assert printed[0] == "compared_pose_pairs 90 pairs"
    assert "translational_error.rmse 0.000000 m" in printed
    assert "rotational_error.rmse 1.145916 deg" in printed
    assert len(printed) == 13


def test_script_writes_what_it_is_asked_for(run_script, write, tmp_path):
    truth = write("truth.txt", lines(line_along_x(1.0)))
    estimate = write("estimate.txt", lines(line_along_x(1.05, stamp_shift=0.01)))
    result = run_script("evaluate_rpe.py", truth, estimate, "--fixed_delta", "--save", tmp_path / "pairs.txt",
                        "--plot", tmp_path / "rpe.png", "--json", tmp_path / "rpe.json")
    assert result.returncode == 0, result.stderr
    rows = np.loadtxt(tmp_path / "pairs.txt")
    assert rows[0] == pytest.approx([0.01, 1.01, 0.0, 1.0, 0.05, 0.0], abs=1e-6)
    assert (tmp_path / "rpe.png").read_bytes().startswith(b"\x89PNG")
    rpe = json.loads((tmp_path / "rpe.json").read_text())["rpe"]
    assert rpe["pairs"] == 90 and rpe["translation"]["rmse_m"] == pytest.approx(0.05)


@pytest.mark.parametrize("options, complaint", [
    (["--plot", "x.png"], "--plot needs --fixed_delta"),
    (["--fixed_delta", "--delta", "0"], "--delta must be positive"),
    (["--fixed_delta", "--delta", "100"], "fewer than two motions"),
    (["--max_pairs", "-1"], "must not be negative"),
])
def test_bad_options_are_one_line_and_status_2(run_script, write, options, complaint):
    truth = write("truth.txt", lines(line_along_x(1.0)))
    result = run_script("evaluate_rpe.py", truth, truth, *options)
    assert result.returncode == 2
    assert result.stderr.count("\n") == 1 and complaint in result.stderr


def test_rotations_are_required(run_script, write):
    result = run_script("evaluate_rpe.py", *[write("positions.txt", ["0 0 0 0", "1 0 0 0"])] * 2)
    assert result.returncode == 2 and "positions.txt:1: expected 8 numbers" in result.stderr
