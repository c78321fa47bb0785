#!/usr/bin/python3
"""Draws estimated trajectories against the ground truth: top view, side view, error over time; prints ATE and RPE.

    plot_trajectory.py groundtruth.txt CameraTrajectory.txt -o trajectory.png
    plot_trajectory.py groundtruth.txt a.txt b.txt --labels threads sequential -o both.pdf

Every estimate is aligned rigidly on its own. RPE is over 1 s (needs rotations in both files).
"""

import argparse
import os

from cpslam_tools import errors, output, plots
from cpslam_tools.absolute_error import absolute_error
from cpslam_tools.relative_error import relative_error
from cpslam_tools.trajectory import read_trajectory


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("groundtruth_file")
    parser.add_argument("estimated_files", nargs="+")
    parser.add_argument("-o", "--output", metavar="FILE", default="trajectory.png",
                        help="picture to write: png, pdf or svg by its ending (default trajectory.png)")
    parser.add_argument("--labels", nargs="+", help="one per estimate (default: the file names)")
    parser.add_argument("--title", default="")
    parser.add_argument("--max_difference", type=float, default=0.02,
                        help="largest difference of associated stamps in seconds (default 0.02)")
    options = parser.parse_args(arguments)
    labels = options.labels or [os.path.basename(path) for path in options.estimated_files]
    if len(labels) != len(options.estimated_files):
        raise errors.InputError(f"{len(labels)} labels for {len(options.estimated_files)} estimates")
    options.labels = labels
    return options


def main(arguments):
    options = parse(arguments)
    truth = read_trajectory(options.groundtruth_file)
    runs = []
    for label, path in zip(options.labels, options.estimated_files):
        estimate = read_trajectory(path)
        runs.append((label, estimate, absolute_error(truth, estimate, max_difference=options.max_difference)))
    plots.plot_comparison(options.output, truth, runs, options.title)
    header = ["trajectory", "poses", "ATE RMSE m", "mean", "median", "max", "RPE 1 s m", "deg"]
    print(output.markdown_table(header, [row(truth, *run) for run in runs]))


def row(truth, label, estimate, result):
    ate = [f"{result.statistics[name]:.4f}" for name in ("rmse", "mean", "median", "max")]
    return [label, len(estimate), *ate, *drift(truth, estimate)]


def drift(truth, estimate):
    """RPE RMSE over one second, or dashes when the files or their length do not allow it."""
    if truth.quaternions is None or estimate.quaternions is None:
        return ["-", "-"]
    try:
        result = relative_error(truth, estimate, fixed_delta=True)
    except errors.InputError:
        return ["-", "-"]
    return [f"{result.translation['rmse']:.4f}", f"{result.rotation_deg['rmse']:.3f}"]


if __name__ == "__main__":
    errors.run(main)
