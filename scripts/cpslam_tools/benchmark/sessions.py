"""A camera that is carried to rooms it has not seen, walks on there, and comes back: two maps, and a loop that joins them."""

import os

from ..output import markdown_table
from . import tables
from .covers import LensCap
from .execution import on_sequence, run_on
from .kidnapping import INTERVAL_S, CoveredSequence
from .loops import events, false_loops
from .sequences import SimulatedSequence

N_COVERED = 45
SEEDS = 3
AIM_M = 0.05
NEW_MAP_AFTER = "Tracking.newMapAfter:"
# preset: frames of the walk, of them mapped at first, the one at which the lens is uncovered, seconds until another map is
# begun (None: as it comes), and whether the camera comes back to what was mapped. In the desks' room it does not: the first
# map has one desk, the second the other.
WALKS = {"office_rounds": (1000, 150, 300, None, True), "ring": (1650, 300, 600, None, True),
         "twin_desks": (660, 180, 300, 1.0, False)}


class CarriedSequence(CoveredSequence):
    """Frames 0 to n_first - 1 of a source, covered ones, and what follows from n_away on."""

    def __init__(self, source, work_dir, n_first, n_away, new_map_after_s=None):
        super().__init__(source, work_dir, f"carried from {n_first} to {n_away}", "carried", LensCap())
        self.n_first = n_first
        self.n_away = n_away
        self.new_map_after_s = new_map_after_s
        self.settings = os.path.join(self.directory, "settings.yaml")

    def _order(self, n_frames):
        return [*range(self.n_first), *[None] * N_COVERED, *range(self.n_away, n_frames)]

    def _write(self):
        first = super()._write()
        with open(self.source.settings, encoding="utf-8") as file:
            lines = file.read().splitlines()
        if self.new_map_after_s is not None:
            lines = [line for line in lines if not line.startswith(NEW_MAP_AFTER)] + [f"{NEW_MAP_AFTER} {self.new_map_after_s}"]
        with open(self.settings, "w", encoding="utf-8") as file:
            file.write("".join(line + "\n" for line in lines))
        return first


def sessions(plan):
    """Per walk and room: the repeats, threaded."""
    for preset, (frames, n_first, n_away, after_s, _) in WALKS.items():
        for seed in range(1, _rooms(plan) + 1):
            source = SimulatedSequence(plan.programs, preset, plan.work_dir, frames, seed, keep=plan.keep)
            walk = CarriedSequence(source, plan.work_dir, n_first, n_away, after_s)
            yield from on_sequence(walk, lambda ready: _runs(plan, ready), preset=preset, room=seed)


def count(plan):
    return len(WALKS) * _rooms(plan) * plan.repeats


def _rooms(plan):
    return min(plan.seeds, SEEDS)


def _runs(plan, walk):
    for _ in range(plan.repeats):
        run = run_on(plan, walk, "threaded", max_frames=None)
        yield {**run, "false_loops": false_loops(walk.truth, events(run))}


def joined_at_s(run):
    """Stamp of the loop that joined the two maps, or None."""
    return next((event["time_s"] for event in events(run) if event.get("joined_map")), None)


def frames_of_maps(run):
    return [entry["frames"] for entry in (tables.pick(run, "maps", "at_end") or [])]


def _is_exact(run):
    rmse_m = tables.pick(run, "ate", "rmse_m")
    return rmse_m is not None and rmse_m < AIM_M


def is_reached(run):
    """One map of all frames where the camera comes back, else two; nothing joined that is not one, and all in its place."""
    if run["error"] or run["false_loops"] or not _is_exact(run):
        return False
    comes_back = WALKS[run["preset"]][4]
    return len(frames_of_maps(run)) == (1 if comes_back else 2) and (joined_at_s(run) is not None) == comes_back


def table(runs):
    header = ["walk", "rooms", "runs", "began another map", "joined", "false loops", "ATE RMSE m (largest map)", "frames of the maps",
              "tracked (worst)", "reached", "notes"]
    rows = []
    for (preset,), group in tables.grouped(runs, "preset").items():
        good = [run for run in group if not run["error"]]
        rows.append([preset, len({run["room"] for run in group}), len(group), sum(_started(run) > 1 for run in good),
                     sum(joined_at_s(run) is not None for run in good), sum(run["false_loops"] for run in good),
                     tables.spread(good, "ate", "rmse_m"), _typical(good), tables.tracked_cell(good),
                     f"{sum(map(is_reached, group))} of {len(group)}", tables.notes("threaded", group)])
    return (f"### Several maps: carried with a covered lens, {N_COVERED * INTERVAL_S:.1f} s (threaded, sensor noise)\n\n"
            + markdown_table(header, rows) + "\n\n" + verdict(runs))


def _started(run):
    return tables.pick(run, "maps", "started") or 0


def _typical(runs):
    """Of the run whose largest map is the median."""
    parts = sorted((frames_of_maps(run) for run in runs), key=lambda frames: frames[:1])
    return " + ".join(map(str, parts[len(parts) // 2])) if parts else "-"


def verdict(runs):
    back = [run for run in runs if WALKS[run["preset"]][4]]
    joined = sum(joined_at_s(run) is not None for run in back if not run["error"])
    false = sum(run.get("false_loops", 0) for run in runs)
    reached = bool(runs) and all(map(is_reached, runs))
    return (f"{'Reached' if reached else 'NOT reached'}: {joined} of {len(back)} runs that come back joined their maps (aim: all), "
            f"{false} loops to another place (aim: none), ATE below {AIM_M} m in {sum(map(_is_exact, runs))} of {len(runs)}.")
