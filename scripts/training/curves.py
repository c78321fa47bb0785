"""How training went: a table and a picture, a row per validation."""

import math

from cpslam_tools.output import write_text
from cpslam_tools.plots import new_figure, save_figure


def write_table(path, history):
    names = list(dict.fromkeys(name for row in history for name in row))
    lines = ["\t".join(names)]
    lines += ["\t".join(f"{row[name]:.6g}" if name in row else "" for name in names) for row in history]
    write_text(path, "\n".join(lines) + "\n")


def draw_curves(path, history):
    figure = new_figure(9, 7)
    accuracy, loss, rate = figure.subplots(3, 1, sharex=True)
    seen = [row["pictures"] / 1000 for row in history]
    for name in ("ap", "recall", "precision"):
        accuracy.plot(seen, [row[name] for row in history], ".-", label=name)
    accuracy.set_title(f"best AP {max(row['ap'] for row in history):.3f}")
    for name in ("box", "objectness", "iou"):
        loss.plot(seen, [row.get(name, math.nan) for row in history], ".-", label=name)
    loss.set_yscale("log")
    rate.plot(seen, [row.get("rate", math.nan) for row in history], ".-", color="black", label="learning rate")
    rate.set_xlabel("thousand pictures seen")
    for axes in (accuracy, loss, rate):
        axes.grid(alpha=0.3)
        axes.legend()
    save_figure(figure, path)
