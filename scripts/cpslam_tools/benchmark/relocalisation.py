"""Kidnaps in simulated rooms: how soon and how well the camera's place is known again."""

import os

from ..errors import InputError
from ..output import markdown_table
from . import kidnapping, tables
from .execution import on_sequence, run_on
from .kidnapping import KidnappedSequence
from .sequences import SimulatedSequence

PRESET = "office_rounds"
N_FRAMES = 1400  # two rounds
N_MAP = 690  # the first of them
ROOMS = 4
KIDNAPS = 10  # in each room
N_COVERED = 20
N_BACK = 20
SOON = 10  # frames
MAX_ERROR_M, MAX_ERROR_DEG = 0.03, 1.0
WRONG_M, WRONG_DEG = 0.15, 5.0
AIM_SHARE = 0.95


def relocalisation(plan):
    """Per room: one round is mapped; then the camera is covered, carried, and uncovered in the second round, again and
    again. Sequential."""
    for seed in range(1, ROOMS + 1):
        source = SimulatedSequence(plan.programs, PRESET, plan.work_dir, N_FRAMES, seed, keep=plan.keep)
        sequence = KidnappedSequence(source, plan.work_dir, N_MAP, KIDNAPS, N_COVERED, N_BACK, seed)
        yield from on_sequence(sequence, lambda ready: [_run(plan, ready)], room=seed)


def count(_plan):
    return ROOMS


def _run(plan, sequence):
    result = run_on(plan, sequence, "sequential", max_frames=None)
    if result["error"]:
        return result
    try:
        visits = kidnapping.judge_visits(sequence.truth, os.path.join(plan.output_dir, "CameraTrajectory.txt"),
                                         sequence.end_of_mapping, sequence.visits)
    except InputError as error:
        return {**result, "error": str(error)}
    return {**result, "visits": visits}


def is_soon(visit):
    return visit["after"] is not None and visit["after"] <= SOON


def is_exact(visit):
    return visit["error_m"] <= MAX_ERROR_M and visit["error_deg"] <= MAX_ERROR_DEG


def is_wrong(visit):
    return visit["after"] is not None and (visit["worst_m"] > WRONG_M or visit["worst_deg"] > WRONG_DEG)


def table(runs):
    header = ["room", "kidnaps", f"back within {SOON} frames", "of these within 0.03 m, 1 deg", "wrong",
              "frames until back, median (worst)", "error m", "worst m", "error deg", "notes"]
    rows = [_row(run.get("room", "-"), run.get("visits", []), run["error"] or "") for run in runs]
    everything = [visit for run in runs for visit in run.get("visits", [])]
    if len(runs) > 1:
        rows.append(_row("all", everything, ""))
    return (f"### Relocalisation: carried with a covered lens, {N_COVERED} frames ({PRESET}, sensor noise, sequential)\n\n"
            + markdown_table(header, rows) + "\n\n" + verdict(everything, failed=any(run["error"] for run in runs)))


def _row(name, visits, notes):
    known = [visit for visit in visits if visit["after"] is not None]
    soon = [visit for visit in visits if is_soon(visit)]
    frames = tables.spread(known, "after", digits=0)
    return [name, len(visits), len(soon), sum(map(is_exact, soon)), sum(map(is_wrong, visits)), frames,
            tables.spread(known, "error_m"), tables.spread(known, "worst_m"), tables.spread(known, "error_deg", digits=2),
            notes]


def verdict(visits, failed):
    if not visits:
        return "Not measured."
    good = sum(is_soon(visit) and is_exact(visit) for visit in visits)
    wrong = sum(map(is_wrong, visits))
    reached = not failed and good >= AIM_SHARE * len(visits) and wrong == 0
    return (f"{'Reached' if reached else 'NOT reached'}: {good} of {len(visits)} back within {SOON} frames with an error "
            f"below {MAX_ERROR_M} m and {MAX_ERROR_DEG:.0f} degree (aim: {AIM_SHARE:.0%}), {wrong} wrong (more than "
            f"{WRONG_M} m or {WRONG_DEG:.0f} degrees off anywhere; aim: none).")
