"""What the people filter costs the tracking thread: the same simulated walkers with their boxes and with no detector,
in turns, so that whatever else the machine does meets both."""

import statistics

from ..output import markdown_table
from . import detectors, tables
from .execution import on_sequence, run_on
from .pair_table import WITH, WITHOUT
from .sequences import SimulatedSequence

PRESET = "walking_xyz"
PEOPLE = 6
AIM = 0.05
PEOPLE_STAGES = "people: "
TRACKING_STAGES = "track: "
WAITING = "track: wait for boxes"


def cost(plan):
    """Sequential runs in turns: without boxes, with them, without, ..."""
    def pairs(room):
        for number in range(plan.cost_runs):
            for variant, detector in ((WITHOUT, detectors.NONE), (WITH, detectors.recorded_boxes(room.boxes))):
                result = run_on(plan, room, "sequential", max_frames=None, arguments=detector.arguments)
                yield {**result, "variant": variant, "perturbation": number}

    room = SimulatedSequence(plan.programs, PRESET, plan.work_dir, plan.frames, keep=plan.keep,
                             variation={"people": PEOPLE})
    yield from ({"variant": "-", "perturbation": "-", **result} for result in on_sequence(room, pairs))


def count(plan):
    return 2 * plan.cost_runs


def stages_ms(run, prefixes):
    """{stage: its median time, as often as it comes in a frame} of the stages that are called so. A stage is short, so
    its median is right also where the other programs of a busy machine interrupt every second frame."""
    return {stage["stage"]: stage["p50_ms"] * stage["count"] / run["frames"] for stage in run.get("stages", [])
            if stage["stage"].startswith(prefixes) and stage["stage"] != WAITING}


def people_ms(run):
    return sum(stages_ms(run, PEOPLE_STAGES).values())


def tracking_ms(run):
    return sum(stages_ms(run, (PEOPLE_STAGES, TRACKING_STAGES)).values())


def share(run):
    """Of the tracking time, how much the people filter takes."""
    return people_ms(run) / tracking_ms(run)


def ratios(runs):
    """Tracking time with boxes by that without, of each pair of neighbouring runs."""
    pairs = {}
    for run in runs:
        pairs.setdefault(run["perturbation"], {})[run["variant"]] = tracking_ms(run)
    return [pair[WITH] / pair[WITHOUT] for pair in pairs.values() if {WITH, WITHOUT} <= set(pair)]


def table(runs):
    good = [run for run in runs if not run["error"]]
    header = ["runs", "tracked (worst)", "whole frame ms p50", "its stages ms", "people ms", "people by stages",
              "notes"]
    rows = []
    for (variant,), group in tables.grouped(runs, "variant").items():
        ours = [run for run in group if not run["error"]]
        rows.append([f"{variant}, {len(group)}", tables.tracked_cell(ours),
                     tables.spread(ours, "tracking_ms", "p50", digits=2),
                     *(_spread(list(map(measure, ours)), digits)
                       for measure, digits in ((tracking_ms, 2), (people_ms, 2), (share, 4))),
                     tables.notes("sequential", group)])
    text = f"### What people cost ({PEOPLE} who walk, sequential, in turns)\n\n" + markdown_table(header, rows)
    with_boxes = [run for run in good if run["variant"] == WITH]
    timed = [stages_ms(run, PEOPLE_STAGES) for run in with_boxes]
    stages = [[name, _spread([times[name] for times in timed if name in times], 3)]
              for name in dict.fromkeys(name for times in timed for name in times)]
    if stages:
        text += "\n\n" + markdown_table(["stage", "ms per frame"], stages)
    return text + "\n\n" + _verdict(good, with_boxes, len(runs))


def _verdict(good, with_boxes, n_runs):
    pairs = ratios(good)
    if not pairs:
        return "No pair of runs to compare."
    median_share = statistics.median(map(share, with_boxes))
    if median_share == 0.0:
        return "NOT measured: no stage of the people filter was timed."
    reached = median_share <= AIM and len(good) == n_runs
    return (f"Tracking time with boxes by that without: median {statistics.median(pairs):.3f} of {len(pairs)} pairs "
            "(without, people are tracked as furniture, so the work differs). The people filter takes "
            f"{100.0 * median_share:.1f} % of the tracking time (aim <= {100.0 * AIM:.0f} %, no masks in it): "
            f"{'reached' if reached else 'NOT reached'}.")


def _spread(values, digits):
    return tables.spread([{"value": value} for value in values], "value", digits=digits)
