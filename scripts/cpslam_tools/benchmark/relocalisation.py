"""Kidnaps in simulated rooms: how soon and how well the camera's place is known again."""

import os

from ..errors import InputError
from ..output import markdown_table
from . import detectors, kidnapping, tables
from .covers import LensCap, SomebodyInFront
from .execution import on_sequence, run_on
from .kidnapping import KidnappedSequence
from .sequences import SimulatedSequence

PRESET = "office_rounds"
N_FRAMES = 1400  # two rounds
ROUND = 690  # the first of them
PART = 300  # of it: the other places are not mapped, and resemble those that are
ROOMS = 4
KIDNAPS = 10  # in each room
N_COVERED = 20
N_BACK = 20
SOON = 10  # frames
MAX_ERROR_M, MAX_ERROR_DEG = 0.03, 1.0
WRONG_M, WRONG_DEG = 0.15, 5.0
AIM_SHARE = 0.95


def relocalisation(plan):
    """Per room: one round is mapped, or a part of it; then the camera is covered, by a cap or by somebody who steps in front
    of it, carried, and uncovered in the second round, again and again. Sequential."""
    for seed in range(1, ROOMS + 1):
        source = SimulatedSequence(plan.programs, PRESET, plan.work_dir, N_FRAMES, seed, keep=plan.keep)
        for mapped, cover in ((ROUND, LensCap()), (ROUND, SomebodyInFront(seed)), (PART, LensCap())):
            sequence = KidnappedSequence(source, plan.work_dir, mapped, ROUND, KIDNAPS, N_COVERED, N_BACK, seed, cover)
            yield from on_sequence(sequence, lambda ready: [_run(plan, ready)], room=seed, variant=mapped, cover=cover.name)


def count(_plan):
    return 3 * ROOMS


def _run(plan, sequence):
    people = detectors.choose(sequence.directory, detectors.NONE)
    result = run_on(plan, sequence, "sequential", max_frames=None, arguments=people.arguments)
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
    header = ["mapped frames", "cover", "room", "kidnaps", f"back within {SOON} frames", "of these within 0.03 m, 1 deg", "wrong",
              "frames until back, median (worst)", "error m", "worst m", "error deg", "notes"]
    rows = []
    for labels, group in tables.grouped(runs, "variant", "cover").items():
        rows += [_row(labels, run.get("room", "-"), run.get("visits", []), run["error"] or "") for run in group]
        rows.append(_row(labels, "all", _visits(group), ""))
    return (f"### Relocalisation: carried while it sees nothing, {N_COVERED} frames ({PRESET}, sensor noise, sequential)\n\n"
            + markdown_table(header, rows) + "\n\n" + verdict(runs))


def _visits(runs):
    return [visit for run in runs for visit in run.get("visits", [])]


def _row(labels, room, visits, notes):
    known = [visit for visit in visits if visit["after"] is not None]
    soon = [visit for visit in visits if is_soon(visit)]
    frames = tables.spread(known, "after", digits=0)
    return [*labels, room, len(visits), len(soon), sum(map(is_exact, soon)), sum(map(is_wrong, visits)), frames,
            tables.spread(known, "error_m"), tables.spread(known, "worst_m"), tables.spread(known, "error_deg", digits=2),
            notes]


def verdict(runs):
    """Where a whole round is mapped every visit is to a known place; a part of it tests that others are not taken for
    known ones."""
    known = _visits([run for run in runs if run["variant"] == ROUND])
    if not known:
        return "Not measured."
    good = sum(is_soon(visit) and is_exact(visit) for visit in known)
    wrong = sum(map(is_wrong, _visits(runs)))
    reached = not any(run["error"] for run in runs) and good >= AIM_SHARE * len(known) and wrong == 0
    return (f"{'Reached' if reached else 'NOT reached'}: {good} of {len(known)} known places found within {SOON} frames "
            f"with an error of at most {MAX_ERROR_M} m and {MAX_ERROR_DEG:.0f} degree (aim: {AIM_SHARE:.0%}); {wrong} of "
            f"{len(_visits(runs))} wrong (more than {WRONG_M} m or {WRONG_DEG:.0f} degrees off anywhere; aim: none).")
