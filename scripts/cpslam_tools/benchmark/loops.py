"""Walks through simulated rooms and back to their start, with loop closing and without; and past two identical desks."""

import statistics

import numpy as np

from ..output import markdown_table
from ..trajectory import read_trajectory
from . import detectors, tables
from .execution import on_sequence, run_on
from .sequences import SimulatedSequence

# preset: (frames, whether there is a loop to be closed)
WALKS = {"ring": (1650, True), "ring_walking": (1650, True), "twin_desks": (960, False)}
WITH, WITHOUT = "loops", "no loops"
AIM_RATIO = 3.0
AIM_M = 0.03
# Nearer and less turned than this, two views show the same things: true loops of the ring join views up to 2.5 m apart,
# the desks that only look alike are seen from 4.5 m apart.
SAME_PLACE_M = 3.0
SAME_PLACE_DEG = 60.0


def loops(plan):
    """Per walk: one run without loop closing, the repeats with it; people with the boxes of every frame."""
    for preset, (frames, _) in WALKS.items():
        walk = SimulatedSequence(plan.programs, preset, plan.work_dir, frames, keep=plan.keep)
        yield from on_sequence(walk, lambda ready: _runs(plan, ready), preset=preset)


def count(plan):
    return len(WALKS) * (1 + plan.repeats)


def _runs(plan, walk):
    people = detectors.choose(walk.directory, detectors.NONE) if walk.preset == "ring_walking" else detectors.NONE
    for variant, repeats, options in ((WITHOUT, 1, ("--no-loop",)), (WITH, plan.repeats, ())):
        for _ in range(repeats):
            run = run_on(plan, walk, "threaded", arguments=(*people.arguments, *options))
            yield {**run, "variant": variant, "false_loops": false_loops(walk.truth, events(run))}


def events(run):
    return (run.get("loops") or {}).get("events", [])


def false_loops(truth_path, found):
    """How many of the loops join two views that cannot show the same things."""
    if not found:
        return 0
    truth = read_trajectory(truth_path, need_rotation=True)
    return sum(not _same_place(truth, event["time_s"], event["matched_time_s"]) for event in found)


def _same_place(truth, time_s, matched_time_s):
    first, second = (int(np.argmin(np.abs(truth.stamps - stamp))) for stamp in (time_s, matched_time_s))
    distance = np.linalg.norm(truth.positions[first] - truth.positions[second])
    cosine = min(1.0, abs(float(truth.quaternions[first] @ truth.quaternions[second])))
    return distance < SAME_PLACE_M and np.degrees(2.0 * np.arccos(cosine)) < SAME_PLACE_DEG


def table(runs):
    header = ["walk", "variant", "runs", "tracked (worst)", "ATE RMSE m", "without / with", "loops closed", "false loops",
              "map stood still ms", "reached", "notes"]
    rows = []
    for (preset, variant), group in tables.grouped(runs, "preset", "variant").items():
        good = [run for run in group if not run["error"]]
        row = [preset, variant, len(group), tables.tracked_cell(good), tables.spread(good, "ate", "rmse_m")]
        if variant == WITH:
            ratio = _ratio(runs, preset)
            row += [f"{ratio:.1f}" if ratio else "-", _numbers(len(events(run)) for run in good),
                    sum(run["false_loops"] for run in good), _longest_stop_ms(good),
                    "yes" if _reached(preset, group, good, ratio) else "NO"]
        else:
            row += ["-"] * 5
        rows.append([*row, tables.notes("threaded", group)])
    return ("### Loops (threaded, sensor noise)\n\n" + markdown_table(header, rows)
            + f"\n\nReached: every frame tracked and no false loop in any run; where there is a loop, closed in every run, an"
            f" ATE of at most {AIM_M} m in every run, and in the median {AIM_RATIO:.0f} times lower than without.")


def _ratio(runs, preset):
    ate = {variant: [tables.pick(run, "ate", "rmse_m") for run in runs
                     if run["preset"] == preset and run["variant"] == variant and not run["error"]]
           for variant in (WITH, WITHOUT)}
    known = {variant: [value for value in values if value] for variant, values in ate.items()}
    if not known[WITH] or not known[WITHOUT]:
        return None
    return statistics.median(known[WITHOUT]) / statistics.median(known[WITH])


def _reached(preset, group, good, ratio):
    sound = len(good) == len(group) and all(run["tracked"] == run["frames"] and not run["false_loops"] for run in good)
    if not sound or not WALKS[preset][1]:
        return sound
    closed = all(events(run) and tables.pick(run, "ate", "rmse_m") <= AIM_M for run in good)
    return closed and ratio is not None and ratio >= AIM_RATIO


def _numbers(values):
    return " ".join(map(str, values)) or "-"


def _longest_stop_ms(runs):
    stops = [stage["max_ms"] for run in runs for stage in run.get("stages", []) if stage["stage"] == "loop: moving the map"]
    return f"{max(stops):.0f}" if stops else "-"
