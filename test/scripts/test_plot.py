"""plot_trajectory.py: the picture exists, the table is right, holes are not drawn across."""

import numpy as np
import pytest
from cpslam_tools import plots
from cpslam_tools.absolute_error import absolute_error
from cpslam_tools.plots import horizontal_axes, with_gaps
from cpslam_tools.trajectory import Trajectory


def walk(scale=1.0, skip=range(0)):
    return [f"{i / 10} {scale * i / 10} {(i % 5) / 5} 0 0 0 0 1" for i in range(50) if i not in skip]


def test_several_estimates_in_one_picture(run_script, write, tmp_path):
    truth, long = write("truth.txt", walk()), write("long.txt", walk(1.03, skip=range(20, 40)))
    result = run_script("plot_trajectory.py", truth, truth, long, "--labels", "same", "long", "-o", tmp_path / "p.pdf")
    assert result.returncode == 0, result.stderr
    assert (tmp_path / "p.pdf").read_bytes().startswith(b"%PDF")
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in result.stdout.splitlines()]
    assert rows[2][:3] == ["same", "50", "0.0000"]
    # 3 % of a metre per second.
    assert rows[3][0:2] == ["long", "30"] and float(rows[3][6]) == pytest.approx(0.03, abs=0.02)


def test_without_rotations_there_is_no_rpe(run_script, write, tmp_path):
    truth = write("truth.txt", [line.rsplit(" ", 4)[0] for line in walk()])
    result = run_script("plot_trajectory.py", truth, truth, "-o", tmp_path / "p.png")
    assert result.returncode == 0, result.stderr
    assert result.stdout.splitlines()[-1].split("|")[-3:-1] == [" -         ", " -   "]


def test_labels_must_fit(run_script, write, tmp_path):
    truth = write("truth.txt", walk())
    result = run_script("plot_trajectory.py", truth, truth, "--labels", "a", "b", "-o", tmp_path / "p.png")
    assert result.returncode == 2 and "2 labels for 1 estimates" in result.stderr


def test_every_axis_is_drawn_over_time_beside_the_truth(monkeypatch):
    saved = []
    monkeypatch.setattr(plots, "save_figure", lambda figure, path: saved.append(figure))
    stamps = np.arange(10.0, 20.0)
    positions = np.stack([stamps, stamps**2, np.sin(stamps)], axis=1)
    truth = Trajectory(stamps, positions)
    estimate = Trajectory(stamps[2:], positions[2:] + [5.0, 0.0, 0.0])
    plots.plot_trajectory("p.png", truth, estimate, absolute_error(truth, estimate))
    top, *axes = saved[0].axes
    assert [line.get_label() for line in top.lines] == ["ground truth", "estimated, ATE RMSE 0.0000 m"]
    assert len(axes) == 3
    for axis, of_axis in enumerate(axes):
        true_line, estimated_line = of_axis.lines
        assert np.allclose(true_line.get_xydata(), np.stack([stamps - 12, positions[:, axis]], axis=1))
        assert np.allclose(estimated_line.get_xydata(), np.stack([stamps[2:] - 12, positions[2:, axis]], axis=1))
        assert of_axis.get_ylabel() == f"{'xyz'[axis]} [m]"


def test_lines_are_not_drawn_across_holes():
    stamps = np.array([0.0, 0.1, 0.2, 1.2, 1.3])
    _, values = with_gaps(stamps, np.arange(5.0)[:, None])
    assert np.array_equal(values[:, 0], [0, 1, 2, np.nan, 3, 4], equal_nan=True)


def test_the_floor_plan_leaves_out_the_shortest_axis():
    assert horizontal_axes(np.array([[0, 0, 0], [5, 0.2, 3]])) == (0, 2, 1)
