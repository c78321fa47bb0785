"""Table and verdict of paired runs: the same start and noise, with boxes and without."""

from ..output import markdown_table
from . import tables
from .paired import bootstrap_upper_bound, geometric_mean, identical, paired_ratios

WITH = "with boxes"
WITHOUT = "without"
AIM = 1.10


def render(title, runs, key, all_tracked=False):
    """One row per value of the key, a verdict on all; runs carry "variant" and "perturbation". The aim is a bound on
    the ratio, and that the runs with boxes tracked no fewer frames: every frame with all_tracked, else as many as the
    runs without. An error over fewer frames does not compare."""
    header = [key, "pairs", "tracked (worst) with", "without", "ATE RMSE m with", "without", "ratio", "greatest ratio",
              "notes"]
    rows, groups, complete = [], [], True
    for (name,), group in tables.grouped(runs, key).items():
        good = [run for run in group if not run["error"]]
        sides = [[run for run in good if run.get("variant") == side] for side in (WITH, WITHOUT)]
        ratios = list(paired_ratios(group, ("perturbation",), WITH, WITHOUT).values())
        known = [ratio for ratio in ratios if ratio is not None]
        complete = complete and len(known) == len(ratios)
        groups.append(known)
        rows.append([name, f"{len(known)}/{len(ratios)}", *map(tables.tracked_cell, sides),
                     *(tables.spread(side, "ate", "rmse_m") for side in sides), _number(geometric_mean, known),
                     _number(max, known), tables.joined(_identical(group), tables.notes("threaded", group))])
    text = f"### {title} (sequential)\n\n" + markdown_table(header, rows)
    if not any(groups):
        return text + "\n\nNo pair of runs to compare."
    lost = _lost(runs, key, "frames" if all_tracked else "tracked")
    if identical(runs, (key, "perturbation"), WITH, WITHOUT) == sum(map(len, groups)):
        return text + "\n\nNOT measured: the boxes changed nothing in any pair."
    bound = bootstrap_upper_bound(groups)
    everything = [ratio for group in groups for ratio in group]
    reached = bound <= AIM and complete and not lost
    frames = "every frame" if all_tracked else "no fewer frames"
    return text + (f"\n\nGeometric mean of the ratios {geometric_mean(everything):.3f} over {len(everything)} pairs, "
                   f"95 % upper bound {bound:.3f} (aim <= {AIM:.2f}, {frames} tracked): "
                   f"{'reached' if reached else 'NOT reached'}.")


def _identical(group):
    count = identical(group, ("perturbation",), WITH, WITHOUT)
    return f"boxes without effect in {count} pairs" if count else ""


def _lost(runs, key, wanted):
    """Whether some run with boxes tracked fewer frames than its partner has in the column wanted."""
    sides = {}
    for run in runs:
        if not run["error"]:
            sides.setdefault((run[key], run["perturbation"]), {})[run.get("variant")] = run
    return any(pair[WITH]["tracked"] < pair[WITHOUT][wanted] for pair in sides.values() if {WITH, WITHOUT} <= set(pair))


def _number(function, values):
    return f"{function(values):.3f}" if values else "-"
