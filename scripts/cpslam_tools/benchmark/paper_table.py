"""Our results beside the paper's: one ATE and one RPE table per collection."""

import statistics

from ..output import markdown_table
from . import tables
from .published import SECTIONS, rmse

# What the published values are printed to: ours are compared at this, and equals share the first place.
DIGITS = 3
LEGEND = ("Ours: median of the repeats as RMSE/mean (least-greatest RMSE). Bold: the best RMSE at three digits, equals "
          "share it; ours takes part only when every run tracked every frame. RPE over 1 s; how the paper took its own "
          "is not known.")


def paper(runs):
    groups = {name: group for (name,), group in tables.grouped(runs, "sequence").items()}
    parts = ["### The paper's sequences", LEGEND]
    for section in SECTIONS:
        measured = [name for name in section.sequences if name in groups]
        if measured:
            parts += [_ate_table(section, measured, groups), _rpe_table(section, measured, groups)]
    return "\n\n".join(parts)


def _ate_table(section, names, groups):
    methods = list(next(iter(section.ate.values())))
    header = ["sequence", "detector", "tracked (worst)", "ours", *methods, "notes"]
    rows = []
    for name in names:
        group = groups[name]
        ours, published = _own(group, 4, "ate", "m"), section.ate[name]
        marked = bold([ours, *published.values()], [_own_rank(group, "ate", "rmse_m"), *map(rmse, published.values())])
        rows.append([name, group[0].get("detector", "-"), tables.tracked_cell(_good(group)), *marked, _notes(group)])
    return f"**{section.title}: ATE in metres**\n\n" + markdown_table(header, rows)


def _rpe_table(section, names, groups):
    methods = list(next(iter(section.rpe.values())))
    header = ["sequence", *(f"{method}, {unit}" for unit in ("m", "deg") for method in ["ours", *methods])]
    rows = []
    for name in names:
        row = [name]
        for part, (kind, unit, digits) in enumerate((("translation", "m", 4), ("rotation", "deg", 3))):
            published = [values[part] for values in section.rpe[name].values()]
            ours = _own(groups[name], digits, "rpe", unit, kind)
            rank = _own_rank(groups[name], "rpe", kind, f"rmse_{unit}")
            row += bold([ours, *published], [rank, *map(rmse, published)])
        rows.append(row)
    return f"**{section.title}: RPE**\n\n" + markdown_table(header, rows)


def bold(cells, ranks):
    """The cells, with those of the least rank in bold; a rank of None takes no part."""
    rounded = [None if rank is None else round(rank, DIGITS) for rank in ranks]
    best = min((rank for rank in rounded if rank is not None), default=None)
    return [f"**{cell}**" if rank is not None and rank == best else cell for cell, rank in zip(cells, rounded)]


def _good(group):
    return [run for run in group if not run["error"] and "skipped" not in run]


def _own(group, digits, error, unit, *kind):
    """median RMSE/median mean (min-max of the RMSE), or a dash."""
    values = ([tables.pick(run, error, *kind, f"{name}_{unit}") for run in _good(group)] for name in ("rmse", "mean"))
    rmses, means = ([value for value in of if value is not None] for of in values)
    if not rmses:
        return "-"
    text = f"{statistics.median(rmses):.{digits}f}/{statistics.median(means):.{digits}f}"
    return text if len(rmses) == 1 else f"{text} ({min(rmses):.{digits}f}-{max(rmses):.{digits}f})"


def _own_rank(group, *keys):
    """Our median, or None where it does not compare: a failed run, a frame without a pose."""
    values = [tables.pick(run, *keys) for run in group]
    complete = all(not run["error"] and run.get("tracked") == run.get("frames") for run in group)
    return statistics.median(values) if complete and None not in values else None


def _notes(group):
    return group[0].get("skipped") or tables.notes("threaded", group)
