#!/usr/bin/python3
"""Absolute trajectory error (ATE) of an estimated trajectory, as the TUM RGB-D benchmark defines it.

Takes the options and gives the numbers of the benchmark's tool of the same name: stamps are associated one-to-one
within 0.02 s, the estimate is aligned rigidly (no scale) and the position errors are summed up.
"""

import argparse

from cpslam_tools import errors, output, plots
from cpslam_tools.absolute_error import absolute_error
from cpslam_tools.trajectory import read_trajectory


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first_file", help="ground truth (timestamp tx ty tz qx qy qz qw)")
    parser.add_argument("second_file", help="estimated trajectory (same format)")
    parser.add_argument("--offset", type=float, default=0.0, help="seconds added to the estimate's stamps (default 0)")
    parser.add_argument("--scale", type=float, default=1.0, help="factor on the estimate's positions (default 1)")
    parser.add_argument("--max_difference", type=float, default=0.02,
                        help="largest difference of associated stamps in seconds (default 0.02)")
    parser.add_argument("--save", metavar="FILE", help="write the aligned estimate: stamp x y z")
    parser.add_argument("--save_associations", metavar="FILE",
                        help="write the associated poses: stamp1 x1 y1 z1 stamp2 x2 y2 z2, the second ones aligned")
    parser.add_argument("--plot", metavar="FILE", help="draw both trajectories into a picture (png, pdf, svg)")
    parser.add_argument("--json", metavar="FILE", help="write all numbers as JSON ('-': to stdout and nothing else)")
    parser.add_argument("--verbose", action="store_true", help="print all statistics, not the RMSE alone")
    return parser.parse_args(arguments)


def main(arguments):
    options = parse(arguments)
    truth = read_trajectory(options.first_file)
    estimate = read_trajectory(options.second_file)
    result = absolute_error(truth, estimate, options.offset, options.scale, options.max_difference)
    if options.json != "-":
        report(result, options.verbose)
    if options.save:
        output.write_text(options.save, "".join(position_lines(estimate.stamps, result.aligned)))
    if options.save_associations:
        first, second = result.pairs.T
        lines = zip(position_lines(truth.stamps[first], truth.positions[first]),
                    position_lines(estimate.stamps[second], result.aligned[second]))
        output.write_text(options.save_associations, "".join(f"{a.rstrip()} {b}" for a, b in lines))
    if options.plot:
        plots.plot_absolute(options.plot, truth, estimate, result)
    if options.json:
        output.write_json(options.json, {"ate": result.as_dict()})


def report(result, verbose):
    if not verbose:
        print(f"{result.statistics['rmse']:f}")
        return
    print(f"compared_pose_pairs {len(result.errors)} pairs")
    for name, value in result.statistics.items():
        print(f"absolute_translational_error.{name} {value:f} m")


def position_lines(stamps, positions):
    return [f"{stamp:f} {x:f} {y:f} {z:f}\n" for stamp, (x, y, z) in zip(stamps, positions)]


if __name__ == "__main__":
    errors.run(main)
