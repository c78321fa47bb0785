#!/usr/bin/python3
"""Measures accuracy and speed: sequences x modes x repeats of rgbd_tum, as Markdown tables and JSON.

Without options: the clips fr1_desk_dev and bonn_crowd_dev where they are found, and simulated rooms. --sequence and
--simulated choose others. --trials paper runs the paper's sequences that are on disk and prints our numbers beside the
published ones; --trials people measures the people filter on recorded and simulated crowds. --full adds both, every
simulated room with and without sensor noise, ten rounds of one room, the sanitizer builds, and the speed ratios. Person
boxes come from person_boxes.txt where a sequence has one. Runs with threads vary, so cells are the median of the
repeats with (min-max). A run that fails is reported in the table and does not end the benchmark; Ctrl-C keeps
what is there. Exits with 0 when every run succeeded, else 1.
"""

import argparse
import os
import types

from cpslam_tools import errors, output
from cpslam_tools.benchmark import detectors, machine, sitting, walking
from cpslam_tools.benchmark.campaign import GROUPS, TRIALS, Campaign, expand
from cpslam_tools.benchmark.programs import Programs
from cpslam_tools.benchmark.runs import MODES
from cpslam_tools.benchmark.sequences import STATIC_PRESETS, Sequence, SimulatedSequence, recorded_sequences
from cpslam_tools.datasets import PAPER, find_dataset

PEOPLE_PRESETS = walking.PRESETS + sitting.PRESETS
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sequence", nargs=2, action="append", default=[], metavar=("DIR", "SETTINGS"),
                        help="run on this TUM-format sequence; may be given several times")
    parser.add_argument("--simulated", nargs="+", default=[], metavar="PRESET", help="run on these simulated rooms")
    parser.add_argument("--modes", nargs="+", choices=list(MODES), default=list(MODES))
    parser.add_argument("--repeats", type=positive, help="runs per sequence and mode (default 5; people_wait 10, people_cost 7)")
    parser.add_argument("--max-frames", type=positive, help="only the first frames of every sequence")
    trials = parser.add_mutually_exclusive_group()
    trials.add_argument("--full", action="store_true", help="add the long trials")
    trials.add_argument("--trials", nargs="+", choices=[*TRIALS, *GROUPS], metavar="TRIAL",
                        help=f"only these, of: {', '.join(TRIALS)}; people is all of people_*")
    parser.add_argument("--paper-sequences", nargs="+", default=[], metavar="NAME",
                        help="only these of the paper's sequences (rgbd_bonn_crowd or crowd, fr3_walking_xyz, ...)")
    parser.add_argument("--datasets", metavar="DIR",
                        default=os.environ.get("CPSLAM_DATASETS", os.path.join(os.path.expanduser("~"), "datasets")),
                        help="where the paper's sequences lie, in folders called as TUM and Bonn call them "
                        "(default: CPSLAM_DATASETS, else ~/datasets)")
    parser.add_argument("--detector-arguments", default="", metavar="TEXT",
                        help="options of rgbd_tum for sequences without person_boxes.txt, and for the trial people_detector, "
                        "in one argument: --detector-arguments='--detector yolo --model CFG WEIGHTS' (default: no detector, "
                        "in people_detector the network that comes with CP-SLAM)")
    parser.add_argument("--figures", metavar="DIR",
                        help="draw the median run's trajectory and RPE there (trials paper and people_wait)")
    parser.add_argument("--people-presets", nargs="+", choices=PEOPLE_PRESETS, default=list(PEOPLE_PRESETS),
                        metavar="PRESET", help="simulated rooms of people_walking and people_sitting (default: all eight)")
    parser.add_argument("--perturbations", type=positive, default=10,
                        help="pairs of runs per preset in people_sitting, and in people_false_boxes (default 10)")
    parser.add_argument("--frames", type=positive, default=300, help="length of simulated sequences (default 300)")
    parser.add_argument("--seeds", type=positive, default=5,
                        help="rooms per preset in static_rooms and people_walking, at most 3 in sessions (default 5)")
    parser.add_argument("--presets", nargs="+", default=list(STATIC_PRESETS),
                        help="simulated rooms of the long trials; the last one is walked ten times")
    parser.add_argument("--build-dir", default=os.path.join(ROOT, "build", "release"))
    parser.add_argument("--data", default=os.environ.get("CPSLAM_SHARED_DATA", os.path.join(ROOT, "..", "shared", "data")),
                        help="where the recorded clips are (default: CPSLAM_SHARED_DATA, else ../shared/data)")
    parser.add_argument("--work-dir", default=os.path.join(ROOT, "build", "benchmark"),
                        help="for simulated sequences and the last run's output")
    parser.add_argument("--keep", action="store_true", help="keep simulated sequences for the next time")
    parser.add_argument("--no-build", action="store_true", help="use the sanitizer builds as they are")
    parser.add_argument("--timeout", type=positive, default=1800, help="seconds a run may take (default 1800)")
    parser.add_argument("--json", metavar="FILE", help="write all results, after every run")
    parser.add_argument("--markdown", metavar="FILE", help="write the tables there as well")
    options = parser.parse_args(arguments)
    if options.json == "-":
        raise errors.InputError("--json needs a file: it is rewritten after every run, and the tables go to stdout")
    return options


def positive(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return value


def make_plan(options):
    programs = Programs(options.build_dir)
    if not programs.has("rgbd_tum"):
        raise errors.InputError(f"{programs.path('rgbd_tum')} is not there: build it with "
                                "cmake --preset release && cmake --build --preset release")
    plan = types.SimpleNamespace(
        root=ROOT, build_dir=os.path.abspath(options.build_dir), programs=programs, work_dir=options.work_dir,
        output_dir=os.path.join(options.work_dir, "output"), modes=options.modes, repeats=options.repeats or 5,
        wait_runs=options.repeats or 10, cost_runs=options.repeats or 7, perturbations=options.perturbations, people_presets=options.people_presets,
        data=options.data, datasets=options.datasets, figures=options.figures, keep=options.keep,
        paper_sequences=paper_names(options.paper_sequences), detector=detectors.from_text(options.detector_arguments),
        max_frames=options.max_frames, frames=options.frames, seeds=options.seeds, presets=options.presets,
        no_build=options.no_build, timeout_s=options.timeout)
    plan.sequences = choose_sequences(options, programs)
    if not plan.sequences and "accuracy" in trial_names(options):
        raise errors.InputError(f"no sequence: neither clips below {options.data} nor {programs.path('simulate_tum')}; "
                                "name one with --sequence DIR SETTINGS")
    return plan


def paper_names(names):
    full = [find_dataset(name).name for name in names]
    for name in full:
        if name not in PAPER:
            raise errors.InputError(f"{name} is not one of the paper's sequences: {', '.join(PAPER)}")
    return full


def trial_names(options):
    if options.full:
        return list(TRIALS)
    return expand(options.trials or ["accuracy"])


def choose_sequences(options, programs):
    sequences = [Sequence(os.path.basename(os.path.normpath(directory)), directory, settings)
                 for directory, settings in options.sequence]
    presets = options.simulated
    if not sequences and not presets:
        sequences = recorded_sequences(ROOT, options.data)
        presets = STATIC_PRESETS if programs.has("simulate_tum") else []
    return sequences + [SimulatedSequence(programs, preset, options.work_dir, options.frames, keep=options.keep)
                        for preset in presets]


def main(arguments):
    options = parse(arguments)
    plan = make_plan(options)
    campaign = Campaign(plan, machine.describe(ROOT), options.json)
    campaign.run(trial_names(options))
    text = campaign.markdown()
    print(text, end="")
    if options.markdown:
        output.write_text(options.markdown, text)
    return 1 if campaign.interrupted or campaign.failures() else 0


if __name__ == "__main__":
    errors.run(main)
