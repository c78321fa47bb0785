#!/usr/bin/python3
"""Measures accuracy and speed: sequences x modes x repeats of rgbd_tum, as Markdown tables and JSON.

Without options: the clips fr1_desk_dev and bonn_crowd_dev where they are found, and simulated rooms. --sequence and
--simulated choose others. --full adds the long trials: every simulated room with and without sensor noise, ten
rounds of one room, the sanitizer builds, and the speed ratios. Runs with threads vary, so cells are the median of
the repeats with (min-max). A run that fails is reported in the table and does not end the benchmark; Ctrl-C keeps
what is there. Exits with 0 when every run succeeded, else 1.
"""

import argparse
import os
import types

from cpslam_tools import errors, output
from cpslam_tools.benchmark import machine
from cpslam_tools.benchmark.campaign import TRIALS, Campaign
from cpslam_tools.benchmark.programs import Programs
from cpslam_tools.benchmark.runs import MODES
from cpslam_tools.benchmark.sequences import STATIC_PRESETS, Sequence, SimulatedSequence, recorded_sequences

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sequence", nargs=2, action="append", default=[], metavar=("DIR", "SETTINGS"),
                        help="run on this TUM-format sequence; may be given several times")
    parser.add_argument("--simulated", nargs="+", default=[], metavar="PRESET", help="run on these simulated rooms")
    parser.add_argument("--modes", nargs="+", choices=list(MODES), default=list(MODES))
    parser.add_argument("--repeats", type=positive, default=5, help="runs per sequence and mode (default 5)")
    parser.add_argument("--max-frames", type=positive, help="only the first frames of every sequence")
    trials = parser.add_mutually_exclusive_group()
    trials.add_argument("--full", action="store_true", help="add the long trials")
    trials.add_argument("--trials", nargs="+", choices=list(TRIALS), metavar="TRIAL",
                        help=f"only these, of: {', '.join(TRIALS)}")
    parser.add_argument("--frames", type=positive, default=300, help="length of simulated sequences (default 300)")
    parser.add_argument("--seeds", type=positive, default=5, help="rooms per preset with --full (default 5)")
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
        output_dir=os.path.join(options.work_dir, "output"), modes=options.modes, repeats=options.repeats,
        max_frames=options.max_frames, frames=options.frames, seeds=options.seeds, presets=options.presets,
        no_build=options.no_build, timeout_s=options.timeout)
    plan.sequences = choose_sequences(options, programs)
    if not plan.sequences:
        raise errors.InputError(f"no sequence: neither clips below {options.data} nor {programs.path('simulate_tum')}; "
                                "name one with --sequence DIR SETTINGS")
    return plan


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
    campaign.run(options.trials or (list(TRIALS) if options.full else ["accuracy"]))
    text = campaign.markdown()
    print(text, end="")
    if options.markdown:
        output.write_text(options.markdown, text)
    return 1 if campaign.interrupted or campaign.failures() else 0


if __name__ == "__main__":
    errors.run(main)
