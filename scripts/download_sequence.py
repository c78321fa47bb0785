#!/usr/bin/python3
"""Downloads public RGB-D sequences (TUM RGB-D, Bonn RGB-D Dynamic) and unpacks them.

    download_sequence.py fr3_walking_xyz bonn_crowd --into ~/datasets
    download_sequence.py --all-paper

A transfer that breaks off is gone on with, in this run or in the next one. A sequence's folder appears when it is
complete; one that is there is left as it is. The data stays its authors': see their pages for licence and citation.
"""

import argparse
import os
import sys

from cpslam_tools import datasets, errors
from cpslam_tools.download.errors import DownloadError
from cpslam_tools.download.sequence import download


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME",
                        help="rgbd_dataset_freiburg3_walking_xyz or fr3_walking_xyz, rgbd_bonn_crowd or crowd")
    parser.add_argument("--list", action="store_true", help="name the sequences and end; others of the two are known too")
    parser.add_argument("--all-paper", action="store_true", help="all sequences of the paper's tables")
    parser.add_argument("--into", metavar="DIR",
                        default=os.environ.get("CPSLAM_DATASETS", os.path.join(os.path.expanduser("~"), "datasets")),
                        help="folder of the sequences (default: CPSLAM_DATASETS, else ~/datasets)")
    parser.add_argument("--mirror", metavar="URL", help="another server with the same files below this address")
    parser.add_argument("--keep-archive", action="store_true", help="do not remove the archive once it is unpacked")
    parser.add_argument("--retries", type=int, default=5,
                        help="further attempts that bring nothing before it gives up (default 5)")
    options = parser.parse_args(arguments)
    if options.retries < 0:
        raise errors.InputError("--retries must not be negative")
    if not (options.names or options.all_paper or options.list):
        raise errors.InputError("name a sequence, or give --all-paper or --list")
    return options


def main(arguments):
    options = parse(arguments)
    if options.list:
        show_list(options.into)
        return 0
    names = [*options.names, *(datasets.PAPER if options.all_paper else ())]
    chosen = list(dict.fromkeys(datasets.find_dataset(name) for name in names))
    failed = 0
    for dataset in chosen:
        try:
            print(download(dataset, options.into, options.mirror, options.keep_archive, options.retries), flush=True)
        except DownloadError as error:
            failed += 1
            print(f"{os.path.basename(sys.argv[0])}: {error}", file=sys.stderr)
    return 1 if failed else 0


def show_list(into):
    for title, names in (("in the paper's tables", datasets.PAPER), ("others", datasets.OTHERS)):
        print(f"{title}:")
        for name in names:
            there = ", on disk" if os.path.isdir(os.path.join(into, name)) else ""
            print(f"  {name} ({datasets.find_dataset(name).settings}{there})")


if __name__ == "__main__":
    errors.run(main)
