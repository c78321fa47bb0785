"""Results as Markdown tables. A cell is the median of the runs, with (min-max) when there are several."""

import statistics

from ..output import markdown_table

STATIC_TARGETS_M = {"clean": 0.005, "noise": 0.012}
PLATEAU_RATIO = 1.10


def pick(run, *keys):
    """run[key][key]... or None where the chain breaks."""
    for key in keys:
        run = run.get(key) if isinstance(run, dict) else None
    return run


def spread(runs, *keys, digits=4):
    values = [value for value in (pick(run, *keys) for run in runs) if value is not None]
    if not values:
        return "-"
    text = f"{statistics.median(values):.{digits}f}"
    return text if len(values) == 1 else f"{text} ({min(values):.{digits}f}-{max(values):.{digits}f})"


def grouped(runs, *keys):
    """Runs with the same values of the keys, in the order of their first appearance."""
    groups = {}
    for run in runs:
        groups.setdefault(tuple(run[key] for key in keys), []).append(run)
    return groups


def tracked_cell(runs):
    """The worst run's tracked/all."""
    counts = [(run["tracked"], run["frames"]) for run in runs if run.get("frames") and "tracked" in run]
    if not counts:
        return "-"
    tracked, frames = min(counts, key=lambda count: count[0] / count[1])
    return f"{tracked}/{frames}"


def accuracy(runs):
    header = ["sequence", "mode", "runs", "tracked (worst)", "ATE RMSE m", "RPE 1 s m", "RPE 1 s deg",
              "tracking ms p50", "p95", "memory MB", "wall s", "detector", "notes"]
    rows = []
    for (sequence, mode), group in grouped(runs, "sequence", "mode").items():
        # A failed run has no say in the numbers: it is told of in the notes.
        good = [run for run in group if not run["error"]]
        rows.append([sequence, mode, len(group), tracked_cell(good), spread(good, "ate", "rmse_m"),
                     spread(good, "rpe", "translation", "rmse_m"),
                     spread(good, "rpe", "rotation", "rmse_deg", digits=3), spread(good, "tracking_ms", "p50", digits=1),
                     spread(good, "tracking_ms", "p95", digits=1), spread(good, "peak_memory_mb", digits=0),
                     spread(good, "wall_s", digits=1), group[0].get("detector", "-"), notes(mode, group)])
    return "### Accuracy\n\n" + markdown_table(header, rows)


def notes(mode, group):
    remarks = []
    failed = [run["error"] for run in group if run["error"]]
    if failed:
        remarks.append(f"{len(failed)} of {len(group)} failed: {failed[0]}")
    hashes = [run["trajectory_sha256"] for run in group if not run["error"] and run.get("trajectory_sha256")]
    if mode == "sequential" and len(hashes) > 1:
        remarks.append("identical" if len(set(hashes)) == 1 else "NOT identical")
    return "; ".join(remarks)


def joined(*remarks):
    return "; ".join(remark for remark in remarks if remark)


def stages(runs):
    header = ["sequence", "mode", "stage", "calls", "p50 ms", "p95 ms", "max ms"]
    rows = []
    for (sequence, mode), group in grouped([run for run in runs if not run["error"]], "sequence", "mode").items():
        names = {stage["stage"]: None for run in group for stage in run.get("stages", [])}
        for name in names:
            timed = [stage for run in group for stage in run.get("stages", []) if stage["stage"] == name]
            rows.append([sequence, mode, name, spread(timed, "count", digits=0),
                         *(spread(timed, key, digits=2) for key in ("p50_ms", "p95_ms", "max_ms"))])
    return "### Time per stage\n\n" + markdown_table(header, rows) if rows else ""


def static_rooms(runs):
    header = ["preset", "sensor", "seeds", "tracked (worst)", "ATE RMSE m", "target", "reached", "notes"]
    rows = []
    for (preset, sensor), group in grouped(runs, "preset", "sensor").items():
        target = STATIC_TARGETS_M[sensor]
        errors = [pick(run, "ate", "rmse_m") for run in group if not run["error"]]
        complete = all(not run["error"] and run.get("tracked") == run.get("frames") for run in group)
        reached = complete and all(error is not None and error <= target for error in errors)
        good = [run for run in group if not run["error"]]
        rows.append([preset, sensor, len(group), tracked_cell(good), spread(good, "ate", "rmse_m"), f"<= {target}",
                     "yes" if reached else "NO", notes("threaded", group)])
    return "### Simulated rooms without people\n\n" + markdown_table(header, rows)


def plateau(runs):
    """Growth of what lives in memory with the rounds of one room."""
    header = ["rounds", "frames", "tracked (worst)", "keyframes", "map points", "memory MB", "tracking ms p50", "notes"]
    rows = [[run["rounds"], run.get("frames", "-"), tracked_cell([run]), spread([run], "keyframes", digits=0),
             spread([run], "map_points", digits=0), spread([run], "peak_memory_mb", digits=0),
             spread([run], "tracking_ms", "p50", digits=1), run["error"] or ""] for run in runs]
    text = f"### Many rounds of one room ({runs[0]['sequence']})\n\n" + markdown_table(header, rows)
    return text + "\n\n" + plateau_verdict(runs)


def plateau_verdict(runs):
    by_rounds = {run["rounds"]: run for run in runs if not run["error"]}
    if not {5, 10} <= set(by_rounds):
        return "Plateau: not measured (needs 5 and 10 rounds)."
    growth = {}
    for key in ("keyframes", "map_points", "peak_memory_mb"):
        before, after = by_rounds[5].get(key), by_rounds[10].get(key)
        if before and after is not None:
            growth[key] = after / before
    reached = len(growth) == 3 and max(growth.values()) <= PLATEAU_RATIO
    ratios = ", ".join(f"{key} x {value:.2f}" for key, value in growth.items())
    return f"Plateau ({'reached' if reached else 'NOT reached'}, limit x {PLATEAU_RATIO:.2f}): from 5 to 10 rounds {ratios}."


def sanitizers(runs):
    header = ["sanitizers", "sequence", "mode", "frames", "reports", "notes"]
    rows = [[run["preset"], run.get("sequence", "-"), run.get("mode", "-"), run.get("frames", "-"),
             run.get("reports", "-"), run["error"] or ""] for run in runs]
    return "### Sanitizers\n\n" + markdown_table(header, rows)


def speed(results):
    header = ["program", "benchmark", "median ms", "x reference"]
    rows = []
    for result in results:
        if result["error"]:
            rows.append([result["program"], "-", "-", result["error"]])
        for row in result["benchmarks"]:
            ratio = "-" if row["ratio"] is None else f"{row['ratio']:.2f}"
            rows.append([result["program"], row["name"], f"{row['median_ms']:.3f}", ratio])
    return "### Speed (reference: cv::ORB on the same frames, same run)\n\n" + markdown_table(header, rows)


def machine(facts):
    return (f"Measured {facts['date']}, commit {facts['commit'] or 'unknown'}, on {facts['cores']} x {facts['cpu']}, "
            f"{facts['memory_gib']} GiB, {facts['system']}.")
