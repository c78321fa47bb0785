#!/usr/bin/python3
"""Relative pose error (RPE) of an estimated trajectory, as the TUM RGB-D benchmark defines it.

Takes the options and gives the numbers of the benchmark's tool of the same name. Papers use --fixed_delta: the
drift over every interval of one length, 1 s unless --delta and --delta_unit say otherwise. Without it, pairs of all
lengths are compared, and which ones is a matter of the seed when there are more than --max_pairs.
"""

import argparse

from cpslam_tools import errors, output, plots
from cpslam_tools.relative_error import UNITS, relative_error
from cpslam_tools.trajectory import read_trajectory


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("groundtruth_file", help="ground truth (timestamp tx ty tz qx qy qz qw)")
    parser.add_argument("estimated_file", help="estimated trajectory (same format)")
    parser.add_argument("--max_pairs", type=int, default=10000,
                        help="compare at most this many pairs, chosen at random (default 10000, 0: all)")
    parser.add_argument("--fixed_delta", action="store_true", help="only pairs that are --delta apart")
    parser.add_argument("--delta", type=float, default=1.0, help="length of the interval (default 1)")
    parser.add_argument("--delta_unit", choices=UNITS, default="s",
                        help="of --delta: seconds, metres, radians, degrees or frames (default s)")
    parser.add_argument("--offset", type=float, default=0.0, help="seconds added to the estimate's stamps (default 0)")
    parser.add_argument("--scale", type=float, default=1.0, help="factor on the estimate's translations (default 1)")
    parser.add_argument("--save", metavar="FILE", help="write every pair: stamp_est0 stamp_est1 stamp_gt0 stamp_gt1 "
                        "trans_error rot_error (metres, radians)")
    parser.add_argument("--plot", metavar="FILE", help="draw the errors over time into a picture (png, pdf, svg); "
                        "needs --fixed_delta")
    parser.add_argument("--json", metavar="FILE", help="write all numbers as JSON ('-': to stdout and nothing else)")
    parser.add_argument("--seed", type=int, default=0, help="of the random choice of pairs (default 0)")
    parser.add_argument("--verbose", action="store_true", help="print all statistics, not the mean alone")
    options = parser.parse_args(arguments)
    if options.plot and not options.fixed_delta:
        raise errors.InputError("--plot needs --fixed_delta")
    if options.max_pairs < 0 or options.seed < 0:
        raise errors.InputError("--max_pairs and --seed must not be negative")
    if options.fixed_delta and not options.delta > 0:
        raise errors.InputError("--delta must be positive")
    return options


def main(arguments):
    options = parse(arguments)
    truth = read_trajectory(options.groundtruth_file, need_rotation=True)
    estimate = read_trajectory(options.estimated_file, need_rotation=True)
    result = relative_error(truth, estimate, options.max_pairs, options.fixed_delta, options.delta,
                            options.delta_unit, options.offset, options.scale, options.seed)
    if options.json != "-":
        report(result, options.verbose)
    if options.save:
        output.write_text(options.save, "".join(" ".join(f"{value:f}" for value in row) + "\n" for row in result.rows))
    if options.plot:
        plots.plot_relative(options.plot, result)
    if options.json:
        output.write_json(options.json, {"rpe": result.as_dict()})


def report(result, verbose):
    if not verbose:
        print(f"{result.translation['mean']:f}")
        return
    print(f"compared_pose_pairs {len(result.rows)} pairs")
    for name, value in result.translation.items():
        print(f"translational_error.{name} {value:f} m")
    for name, value in result.rotation_deg.items():
        print(f"rotational_error.{name} {value:f} deg")


if __name__ == "__main__":
    errors.run(main)
