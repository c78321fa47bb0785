"""Simulated people who sit: what the filter costs where people hardly move, in pairs of runs with and without it."""

from . import detectors, pair_table
from .execution import on_sequence, run_on
from .sequences import SimulatedSequence

PRESETS = ("sitting_static", "sitting_xyz", "sitting_rpy", "sitting_halfsphere")
START_STEP_S = 0.7


def chosen(plan):
    return [preset for preset in plan.people_presets if preset.startswith("sitting")]


def sitting(plan):
    """Per preset and perturbation (another start on the path, another noise): one run with boxes, one without."""
    for preset in chosen(plan):
        for number in range(plan.perturbations):
            variation = {"start": f"{START_STEP_S * number:.1f}", "noise-seed": number + 1}
            room = SimulatedSequence(plan.programs, preset, plan.work_dir, plan.frames, keep=plan.keep,
                                     variation=variation)
            yield from on_sequence(room, lambda ready: _pair(plan, ready), preset=preset, perturbation=number)


def count(plan):
    return 2 * len(chosen(plan)) * plan.perturbations


def _pair(plan, room):
    for variant, detector in ((pair_table.WITH, detectors.recorded_boxes(room.boxes)),
                              (pair_table.WITHOUT, detectors.NONE)):
        yield {**run_on(plan, room, "sequential", max_frames=None, arguments=detector.arguments), "variant": variant}


def table(runs):
    return pair_table.render("Simulated people who sit: with the filter against without", runs, "preset")
