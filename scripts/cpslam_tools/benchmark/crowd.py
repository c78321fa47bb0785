"""The recorded crowd with its reference boxes: waiting for boxes, late boxes, the detector's own boxes, and what each kind
of filter is worth."""

import statistics

from ..output import markdown_table
from . import detectors, tables
from .execution import on_sequence, run_on
from .figures import Figures
from .paired import identical, paired_ratios
from .sequences import recorded_sequence

CLIP = "bonn_crowd_dev"
WAIT_MEDIAN_AIM_M = 0.0150
WAIT_WORST_AIM_M = 0.018
# First frames of the sequential runs that are compared with each other.
STARTS = (0, 1, 2)
WAIT = ("--boxes-policy", "wait")
# variant: (rate in Hz, delay in s, aim of the ratio to waiting)
LATE = {"6/s, 150 ms late": (6, 0.15, 1.2), "3/s, 300 ms late": (3, 0.3, 1.4), "2/s, 500 ms late": (2, 0.5, 2.0)}
RECORDED, DETECTED = "recorded boxes", "detector"
DETECTED_AIM = 1.15
ABLATION = {
    "no filter": None,
    "whole boxes deleted": ("--people-filter", "boxes"),
    "the paper's filter": ("--people-filter", "paper"),
    "ours": ("--people-filter", "sdf"),
    "ours, nothing comes back": ("--people-filter", "sdf", "--no-reinstate"),
}


def wait(plan):
    """Threaded runs, of which each differs, and one sequential run."""
    def runs(clip):
        figures = Figures(plan.figures, CLIP, clip.truth, f"{CLIP}, recorded boxes")
        for mode, count in (("threaded", plan.wait_runs), ("sequential", 1)):
            for _ in range(count):
                result = run_on(plan, clip, mode, arguments=(*detectors.recorded_boxes(clip.boxes).arguments, *WAIT))
                if mode == "threaded":
                    figures.add(result, plan.output_dir)
                yield result
        figures.draw()

    yield from on_sequence(_clip(plan), runs)


def wait_count(plan):
    return plan.wait_runs + 1


def latest(plan):
    """Boxes that come seldom and late, beside boxes that come at once, from several first frames."""
    variants = {"wait": WAIT}
    for name, (rate_hz, delay_s, _) in LATE.items():
        variants[name] = ("--boxes-policy", "latest", "--boxes-rate", str(rate_hz), "--boxes-delay", str(delay_s))
    yield from _variants(plan, variants)


def latest_count(_):
    return (1 + len(LATE)) * len(STARTS)


def detected(plan):
    """The boxes of a network (--detector-arguments, else the bundled one) beside the recorded ones, from several first
    frames."""
    network = detectors.BUNDLED if plan.detector == detectors.NONE else plan.detector

    def runs(clip):
        for start in STARTS:
            for name, detector in ((RECORDED, detectors.recorded_boxes(clip.boxes)), (DETECTED, network)):
                result = run_on(plan, clip, "sequential", arguments=(*detector.arguments, *WAIT, "--start", str(start)))
                yield {**result, "variant": name, "start": start}

    for result in on_sequence(_clip(plan), runs):
        yield {"variant": "-", "start": "-", **result}


def detected_count(_):
    return 2 * len(STARTS)


def ablation(plan):
    """The filters, from several first frames."""
    variants = {name: arguments and (*WAIT, *arguments) for name, arguments in ABLATION.items()}
    yield from _variants(plan, variants)


def ablation_count(_):
    return len(ABLATION) * len(STARTS)


def _clip(plan):
    return recorded_sequence(plan.root, plan.data, CLIP)


def _variants(plan, variants):
    """Sequential runs; a variant without arguments is one without boxes."""
    def runs(clip):
        for start in STARTS:
            for name, arguments in variants.items():
                detector = detectors.recorded_boxes(clip.boxes) if arguments else detectors.NONE
                result = run_on(plan, clip, "sequential",
                                arguments=(*detector.arguments, *(arguments or ()), "--start", str(start)))
                yield {**result, "variant": name, "start": start}

    for result in on_sequence(_clip(plan), runs):
        yield {"variant": "-", "start": "-", **result}


def wait_table(runs):
    text = "### Crowd, boxes at once (bonn_crowd_dev)\n\n" + _table(runs, "mode")
    threaded = [run for run in runs if run["mode"] == "threaded"]
    errors = [tables.pick(run, "ate", "rmse_m") for run in threaded if not run["error"]]
    if not errors or None in errors:
        return text
    accurate = statistics.median(errors) <= WAIT_MEDIAN_AIM_M and max(errors) <= WAIT_WORST_AIM_M
    verdict = "reached" if accurate and _complete(threaded) else "NOT reached"
    return text + (f"\n\nAim (every frame tracked; median <= {WAIT_MEDIAN_AIM_M:.4f} m, worst <= "
                   f"{WAIT_WORST_AIM_M:.4f} m): {verdict} in {len(threaded)} threaded runs.")


def latest_table(runs):
    aims = {name: aim for name, (_, _, aim) in LATE.items()}
    return "### Crowd, boxes seldom and late (bonn_crowd_dev, sequential)\n\n" + _table_of_ratios(runs, aims, "wait")


def detected_table(runs):
    return "### Crowd, the detector's boxes (bonn_crowd_dev, sequential)\n\n" + \
        _table_of_ratios(runs, {DETECTED: DETECTED_AIM}, RECORDED)


def _table_of_ratios(runs, aims, reference):
    """aims: {variant: highest ratio of its ATE to the reference's}."""
    def columns(name, group):
        aim = aims.get(name)
        ratios = list(paired_ratios(runs, ("start",), name, reference).values())
        if aim is None or not ratios or None in ratios:
            return ["-", "-" if aim is None else f"<= {aim}", "-" if aim is None else "NO"]
        reached = "yes" if _complete(group) and statistics.median(ratios) <= aim else "NO"
        if identical(runs, ("start",), name, reference) == len(ratios):
            reached = "not measured"
        return [f"{statistics.median(ratios):.2f} ({min(ratios):.2f}-{max(ratios):.2f})", f"<= {aim}", reached]

    return _table(runs, "variant", [f"ATE x {reference}", "aim", "reached"], columns, reference) + _starts()


def ablation_table(runs):
    return "### Crowd, kinds of filter (bonn_crowd_dev, sequential)\n\n" + \
        _table(runs, "variant", reference=next(iter(ABLATION))) + _starts()


def _starts():
    return f"\n\nMedian (least-greatest) over runs from the frames {', '.join(map(str, STARTS))} on."


def _complete(group):
    return all(not run["error"] and run.get("tracked") == run.get("frames") for run in group)


def _table(runs, key, more=(), columns=lambda name, group: [], reference=None):
    """reference: the variant that the others must differ from, else what they ask for had no effect."""
    header = [key, "runs", "tracked (worst)", "ATE RMSE m", "ATE mean m", "ATE max m", "RPE 1 s m", "RPE 1 s deg",
              "keypoints removed", "boxes' age s", *more, "notes"]
    rows = []
    for (name,), group in tables.grouped(runs, key).items():
        good = [run for run in group if not run["error"]]
        rows.append([name, len(group), tables.tracked_cell(good), tables.spread(good, "ate", "rmse_m"),
                     tables.spread(good, "ate", "mean_m"), tables.spread(good, "ate", "max_m"),
                     tables.spread(good, "rpe", "translation", "rmse_m"),
                     tables.spread(good, "rpe", "rotation", "rmse_deg", digits=3),
                     tables.spread(good, "people", "removed_ratio", digits=3),
                     tables.spread(good, "people", "boxes_age_s", "mean", digits=3), *columns(name, group),
                     tables.joined(_identical(runs, name, reference), tables.notes("threaded", group))])
    return markdown_table(header, rows)


def _identical(runs, name, reference):
    count = identical(runs, ("start",), name, reference) if reference not in (None, name) else 0
    return f"same trajectory as '{reference}' in {count} runs" if count else ""
