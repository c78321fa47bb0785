#!/usr/bin/python3
"""Associates two TUM-format lists by their stamps and prints "stamp1 data1 stamp2 data2" lines.

For a sequence: associate.py rgb.txt depth.txt > associations.txt. rgbd_tum does the same on the fly when it gets no
associations file. Each stamp is used once, closest pairs first.
"""

import argparse

from cpslam_tools import errors
from cpslam_tools.association import associate_stamps
from cpslam_tools.trajectory import read_file_list


def associate(first_list, second_list, offset=0.0, max_difference=0.02):
    """The pairs of stamps (of first_list, of second_list) that belong together; both are dicts by stamp."""
    first, second = list(first_list), list(second_list)
    return [(first[i], second[j]) for i, j in associate_stamps(first, second, float(offset), float(max_difference))]


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first_file", help="first list (timestamp data)")
    parser.add_argument("second_file", help="second list (timestamp data)")
    parser.add_argument("--first_only", action="store_true", help="print the associated lines of the first list only")
    parser.add_argument("--offset", type=float, default=0.0,
                        help="seconds added to the second list's stamps for the comparison (default 0)")
    parser.add_argument("--max_difference", type=float, default=0.02,
                        help="largest difference of associated stamps in seconds (default 0.02)")
    return parser.parse_args(arguments)


def main(arguments):
    options = parse(arguments)
    first_list = read_file_list(options.first_file)
    second_list = read_file_list(options.second_file)
    for first, second in associate(first_list, second_list, options.offset, options.max_difference):
        line = f"{first:f} {' '.join(first_list[first])}"
        print(line if options.first_only else f"{line} {second:f} {' '.join(second_list[second])}")


if __name__ == "__main__":
    errors.run(main)
