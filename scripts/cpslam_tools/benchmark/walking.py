"""Simulated people who walk, with boxes that are not exact, against the same camera path without people."""

import os
import statistics

import numpy as np

from ..output import markdown_table
from . import box_files, detectors, tables
from .execution import on_sequence, run_on
from .paired import paired_ratios
from .sequences import SimulatedSequence

PRESETS = ("walking_static", "walking_xyz", "walking_rpy", "walking_halfsphere")
PEOPLE = (2, 6)
EMPTY = 0
AIM = 1.3


def chosen(plan):
    return [preset for preset in plan.people_presets if preset.startswith("walking")]


def walking(plan):
    """Per preset and room: nobody there, then each number of people; sensor noise, jittered and missing boxes."""
    for preset in chosen(plan):
        for seed in range(1, plan.seeds + 1):
            for people in (EMPTY, *PEOPLE):
                room = SimulatedSequence(plan.programs, preset, plan.work_dir, plan.frames, seed, keep=plan.keep,
                                         variation={"people": people})
                yield from on_sequence(room, lambda ready, people=people, seed=seed: [_run(plan, ready, people, seed)],
                                       preset=preset, room=seed, variant=people)


def count(plan):
    return len(chosen(plan)) * plan.seeds * (1 + len(PEOPLE))


def _run(plan, room, people, seed):
    detector = detectors.NONE
    if people:
        path = os.path.join(plan.work_dir, "jittered_boxes.txt")
        box_files.write_boxes(path, box_files.jittered(box_files.read_boxes(room.boxes), np.random.default_rng(seed)))
        detector = detectors.recorded_boxes(path)
    return run_on(plan, room, "sequential", max_frames=None, arguments=detector.arguments)


def _ratios(runs, preset, people):
    return paired_ratios([run for run in runs if run["preset"] == preset], ("room",), people, EMPTY)


def table(runs):
    header = ["preset", "people", "rooms", "tracked (worst)", "ATE RMSE m", "ATE x no people", "aim", "reached", "notes"]
    rows = []
    for (preset, people), group in tables.grouped(runs, "preset", "variant").items():
        good = [run for run in group if not run["error"]]
        complete = len(good) == len(group) and all(run.get("tracked") == run.get("frames") for run in group)
        row = [preset, people, len(group), tables.tracked_cell(good), tables.spread(good, "ate", "rmse_m")]
        if people == EMPTY:
            row += ["-", "-", "-"]
        else:
            ratios = list(_ratios(runs, preset, people).values())
            known = [ratio for ratio in ratios if ratio is not None]
            reached = complete and len(known) == len(ratios) and statistics.median(known) <= AIM
            row += [f"{statistics.median(known):.2f} ({min(known):.2f}-{max(known):.2f})" if known else "-", f"<= {AIM}",
                    "yes" if reached else "NO"]
        rows.append([*row, tables.notes("threaded", group)])
    return ("### Simulated people who walk (sequential, boxes jittered by 10 %, 10 % of them missing)\n\n"
            + markdown_table(header, rows)
            + "\n\nReached: every frame tracked, and the median of the rooms' ratios within the aim.")
