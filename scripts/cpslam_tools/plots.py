"""Pictures of trajectories and errors. matplotlib is loaded on the first plot only, and never opens a window."""

import numpy as np

from .errors import InputError


def new_figure(width, height):
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        raise InputError("plots need matplotlib: sudo apt-get install python3-matplotlib") from None
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def save_figure(figure, path):
    try:
        figure.savefig(path, dpi=120)
    except OSError as error:
        raise InputError(f"cannot write {path}: {error.strerror}") from None
    except ValueError as error:
        raise InputError(f"cannot write {path}: {' '.join(str(error).split())}") from None


def horizontal_axes(positions):
    """The two axes of the widest view and the remaining one: for a camera carried through a room, the floor plan."""
    extent = np.ptp(positions, axis=0)
    height = int(np.argmin(extent))
    first, second = [axis for axis in range(3) if axis != height]
    return first, second, height


def with_gaps(stamps, values):
    """values with NaN rows where more than five usual intervals pass, so that lines are not drawn across holes."""
    if len(stamps) < 3:
        return stamps, values
    steps = np.diff(stamps)
    holes = np.flatnonzero(steps > 5 * np.median(steps)) + 1
    return np.insert(stamps, holes, stamps[holes]), np.insert(values, holes, np.nan, axis=0)


def plot_absolute(path, truth, estimate, result):
    """The truth, the aligned estimate and the differences between them, in the floor plan."""
    figure = new_figure(7, 6)
    axes = figure.add_subplot()
    first, second, _ = horizontal_axes(truth.positions)
    draw_path(axes, truth.stamps, truth.positions, first, second, "black", "ground truth")
    draw_path(axes, estimate.stamps, result.aligned, first, second, "tab:blue", "estimated")
    reference = truth.positions[result.pairs[:, 0]]
    aligned = result.aligned[result.pairs[:, 1]]
    segments = np.full((3 * len(reference), 3), np.nan)
    segments[0::3], segments[1::3] = reference, aligned
    axes.plot(segments[:, first], segments[:, second], color="tab:red", linewidth=0.8, label="difference")
    axes.set_title(f"ATE RMSE {result.statistics['rmse']:.4f} m over {len(result.errors)} pairs")
    axes.legend()
    save_figure(figure, path)


def plot_relative(path, result, title=""):
    """Translation and rotation error over the time at which each motion starts."""
    figure = new_figure(8, 5)
    stamps, errors = with_gaps(result.rows[:, 0] - result.rows[0, 0], result.rows[:, 4:6])
    translation, rotation = figure.subplots(2, 1, sharex=True)
    translation.plot(stamps, errors[:, 0], ".-", color="tab:blue", linewidth=0.8, markersize=3)
    translation.set_ylabel("translation error [m]")
    translation.set_title(f"RMSE {result.translation['rmse']:.4f} m, {result.rotation_deg['rmse']:.3f} deg")
    rotation.plot(stamps, np.degrees(errors[:, 1]), ".-", color="tab:red", linewidth=0.8, markersize=3)
    rotation.set_ylabel("rotation error [deg]")
    rotation.set_xlabel("time [s]")
    if title:
        figure.suptitle(title)
    save_figure(figure, path)


def plot_trajectory(path, truth, estimate, result, title=""):
    """The floor plan, and each axis over time, of the truth and the aligned estimate."""
    figure = new_figure(12, 6)
    grid = figure.add_gridspec(3, 2)
    top = figure.add_subplot(grid[:, 0])
    first, second, _ = horizontal_axes(truth.positions)
    begin = estimate.stamps[0]
    lines = ((truth.stamps, truth.positions, "black", "ground truth"),
             (estimate.stamps, result.aligned, "tab:blue", f"estimated, ATE RMSE {result.statistics['rmse']:.4f} m"))
    for stamps, positions, colour, label in lines:
        draw_path(top, stamps, positions, first, second, colour, label)
    top.legend()
    top.set_title("top view")
    axes = [figure.add_subplot(grid[axis, 1]) for axis in range(3)]
    for axis, of_axis in enumerate(axes):
        for stamps, positions, colour, _ in lines:
            seconds, values = with_gaps(stamps - begin, positions[:, axis:axis + 1])
            of_axis.plot(seconds, values[:, 0], color=colour, linewidth=1.0)
        of_axis.set_ylabel(f"{'xyz'[axis]} [m]")
        of_axis.grid(alpha=0.3)
        # The truth often begins before the images and ends after.
        of_axis.set_xlim(0, estimate.stamps[-1] - begin)
    axes[-1].set_xlabel("time [s]")
    if title:
        figure.suptitle(title)
    save_figure(figure, path)


def plot_comparison(path, truth, runs, title):
    """Floor plan, side view and error over time of several estimates: runs is a list of (label, estimate, result)."""
    figure = new_figure(12, 8)
    grid = figure.add_gridspec(2, 2, height_ratios=[3, 2])
    top, side = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[0, 1])
    error = figure.add_subplot(grid[1, :])
    first, second, height = horizontal_axes(truth.positions)
    for axes, vertical in ((top, second), (side, height)):
        draw_path(axes, truth.stamps, truth.positions, first, vertical, "black", "ground truth")
    begin = truth.stamps[0]
    for number, (label, estimate, result) in enumerate(runs):
        colour = f"C{number}"
        draw_path(top, estimate.stamps, result.aligned, first, second, colour, label)
        draw_path(side, estimate.stamps, result.aligned, first, height, colour, label)
        stamps, errors = with_gaps(estimate.stamps[result.pairs[:, 1]] - begin, result.errors[:, None])
        error.plot(stamps, 100 * errors, color=colour, label=f"{label}: RMSE {result.statistics['rmse']:.4f} m")
    top.set_title("top view")
    side.set_title("side view")
    top.legend()
    error.set_xlabel("time [s]")
    error.set_ylabel("position error [cm]")
    error.set_ylim(bottom=0)
    error.grid(alpha=0.3)
    error.legend()
    if title:
        figure.suptitle(title)
    save_figure(figure, path)


def draw_path(axes, stamps, positions, horizontal, vertical, colour, label):
    _, points = with_gaps(stamps, positions)
    axes.plot(points[:, horizontal], points[:, vertical], color=colour, linewidth=1.2, label=label)
    axes.set_xlabel(f"{'xyz'[horizontal]} [m]")
    axes.set_ylabel(f"{'xyz'[vertical]} [m]")
    axes.set_aspect("equal", adjustable="datalim")
    axes.grid(alpha=0.3)
