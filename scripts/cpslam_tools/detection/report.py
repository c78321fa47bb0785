"""What comes out of an evaluation: tables for people, JSON for programs, and the curves."""

from .. import plots
from ..output import markdown_table
from .evaluation import LARGE_PERSON, SIZES

# A result is a dictionary: network, input, numbers, n_pictures, detection_ms and time_ratio as in detector_runs.Run; all and
# sizes[size]: Scores; recalls: of the pictures one by one; misses: of a sequence, else None.

LONG_MISSES_LISTED = 10


def share(value):
    return "-" if value is None else f"{value:.3f}"


def tables(results, threshold, iou, is_mot):
    """Markdown: one row a run."""
    covered, accurate = ("coverage", "accuracy") if is_mot else ("recall", "precision")
    people = results[0]["all"].counts.people if results else 0
    header = ["network", "input", "numbers", f"AP@{iou:.2f}", f"{covered} at {threshold:g}", accurate,
              "best F1 (at)", "ms, median", "ms, 95 %", "int8 / float"]
    lines = [f"{results[0]['n_pictures']} pictures, {people} people; a box counts from an overlap (IoU) of {iou:g} on", "",
             markdown_table(header, [_row(result) for result in results]), "",
             f"By height, as a share of the picture's ({', '.join(_size_text(size) for size in SIZES)}), at {threshold:g}:", "",
             markdown_table(_size_header(results, covered, accurate), [_size_row(result) for result in results])]
    if is_mot:
        lines += ["", markdown_table(["network", "input", "numbers", f"{covered}: worst picture", "median", "best"],
                                     [[*_name(result), *map(share, _extremes(result["recalls"]))] for result in results])]
    return "\n".join(lines)


def _name(result):
    return [result["network"], result["input"], result["numbers"]]


def _row(result):
    total = result["all"]
    times = result["detection_ms"]
    best = "-" if total.best is None else f"{total.best[0]:.3f} ({total.best[1]:.2f})"
    return [*_name(result), share(total.ap), share(total.counts.recall), share(total.counts.precision), best,
            *([f"{times['p50']:.1f}", f"{times['p95']:.1f}"] if times else ["-", "-"]),
            "-" if result["time_ratio"] is None else f"{result['time_ratio']:.2f}"]


def _size_text(size):
    least, limit = SIZES[size]
    return f"{size} below {limit:g}" if least == 0 else f"{size} from {least:g}"


def _size_header(results, covered, accurate):
    counts = {size: results[0]["sizes"][size].counts.people for size in SIZES}
    return ["network", "input", "numbers",
            *(f"{what}, {size}" + (f" ({counts[size]})" if what == "AP" else "") for what in ("AP", covered, accurate)
              for size in SIZES)]


def _size_row(result):
    sizes = [result["sizes"][size] for size in SIZES]
    return [*_name(result), *(share(one.ap) for one in sizes), *(share(one.counts.recall) for one in sizes),
            *(share(one.counts.precision) for one in sizes)]


def _extremes(recalls):
    recalls = sorted(recalls)
    return (recalls[0], recalls[len(recalls) // 2], recalls[-1]) if recalls else (None, None, None)


def miss_lines(result):
    """The longest stretches in which a large person was overlooked."""
    misses = result["misses"]
    title = f"{' '.join(_name(result))}: people of more than {100 * LARGE_PERSON:g} % of the picture overlooked"
    if not misses:
        return [f"{title}: never"]
    lines = [f"{title}: {len(misses)} times, {misses[0].end_s - misses[0].begin_s:.2f} s at the longest"]
    lines += [f"  {miss.end_s - miss.begin_s:5.2f} s from {miss.begin_s:.6f} on, {len(miss.sightings)} pictures"
              for miss in misses[:LONG_MISSES_LISTED]]
    return lines


def as_json(result):
    return {**{key: result[key] for key in ("network", "input", "numbers", "n_pictures", "detection_ms", "time_ratio")},
            **_score_json(result["all"]),
            "sizes": {size: {"share_of_height": [least, None if limit > 1e9 else limit],
                             **_score_json(result["sizes"][size])}
                      for size, (least, limit) in SIZES.items()},
            "recall_of_pictures": result["recalls"],
            "misses": None if result["misses"] is None else
            [{"begin_s": miss.begin_s, "duration_s": miss.end_s - miss.begin_s, "pictures": len(miss.sightings)}
             for miss in result["misses"]]}


def _score_json(score):
    counts = score.counts
    return {"people": counts.people, "ap": score.ap, "recall": counts.recall, "precision": counts.precision,
            "right": counts.right, "wrong": counts.wrong,
            "best_f1": None if score.best is None else {"f1": score.best[0], "threshold": score.best[1]}}


def plot_curves(path, results, threshold):
    """Precision over recall, one curve a run, the threshold marked."""
    figure = plots.new_figure(8, 6)
    axes = figure.add_subplot()
    colours = {}
    for result in results:
        total = result["all"]
        colour = colours.setdefault((result["network"], result["input"]), f"C{len(colours) % 10}")
        style = {"color": colour, "linestyle": "--" if result["numbers"] == "int8" else "-"}
        axes.plot(total.curve.recall, total.curve.precision, linewidth=1.2,
                  label=f"{' '.join(_name(result))}: AP {share(total.ap)}", **style)
        if total.counts.recall is not None and total.counts.precision is not None:
            axes.plot(total.counts.recall, total.counts.precision, "o", color=colour)
    axes.set_xlabel("recall")
    axes.set_ylabel("precision")
    axes.set_xlim(0, 1)
    axes.set_ylim(0, 1.01)
    axes.set_title(f"points: confidence {threshold:g}")
    axes.grid(alpha=0.3)
    axes.legend(loc="lower left")
    plots.save_figure(figure, path)
