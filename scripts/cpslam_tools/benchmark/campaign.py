"""Runs the trials of a plan, shows progress, and keeps what is there at any moment."""

import sys
import time

from .. import output
from . import (cost, crowd, false_boxes, loops, paper, paper_table, relocalisation, sessions, sitting, tables,
               trials, walking)

# name: (trial, table, number of its results where that is known beforehand)
TRIALS = {
    "accuracy": (trials.accuracy, tables.accuracy, trials.accuracy_count),
    "paper": (paper.paper, paper_table.paper, paper.paper_count),
    "people_wait": (crowd.wait, crowd.wait_table, crowd.wait_count),
    "people_latest": (crowd.latest, crowd.latest_table, crowd.latest_count),
    "people_detector": (crowd.detected, crowd.detected_table, crowd.detected_count),
    "people_ablation": (crowd.ablation, crowd.ablation_table, crowd.ablation_count),
    "people_walking": (walking.walking, walking.table, walking.count),
    "people_sitting": (sitting.sitting, sitting.table, sitting.count),
    "people_false_boxes": (false_boxes.false_boxes, false_boxes.table, false_boxes.count),
    "people_cost": (cost.cost, cost.table, cost.count),
    "relocalisation": (relocalisation.relocalisation, relocalisation.table, relocalisation.count),
    "loops": (loops.loops, loops.table, loops.count),
    "sessions": (sessions.sessions, sessions.table, sessions.count),
    "static_rooms": (trials.static_rooms, tables.static_rooms, None),
    "plateau": (trials.plateau, tables.plateau, None),
    "sanitizers": (trials.sanitizers, tables.sanitizers, None),
    "speed": (trials.speed, tables.speed, None),
}
GROUPS = {"people": [name for name in TRIALS if name.startswith("people_")]}
LABELS = ("program", "preset", "sequence", "mode", "rounds", "variant", "start", "perturbation")


def expand(names):
    """The names with groups replaced by their trials, each once."""
    return list(dict.fromkeys(trial for name in names for trial in GROUPS.get(name, [name])))


class Campaign:
    def __init__(self, plan, facts, json_path):
        self.plan = plan
        self.json_path = json_path
        self.interrupted = False
        self.results = {"machine": facts, "command": " ".join(sys.argv), "complete": False}

    def run(self, names):
        """Runs the named trials. A Ctrl-C ends them and keeps the results so far."""
        try:
            for name in names:
                self._run_trial(name)
            self.results["complete"] = True
        except KeyboardInterrupt:
            self.interrupted = True
            print("interrupted: these are the results so far", file=sys.stderr)
        self._save()

    def failures(self):
        return sum(1 for name in TRIALS for result in self.results.get(name, []) if result["error"])

    def markdown(self):
        parts = [tables.machine(self.results["machine"])]
        for name, (_, table, _) in TRIALS.items():
            if self.results.get(name):
                parts.append(table(self.results[name]))
        if self.results.get("accuracy"):
            parts.append(tables.stages(self.results["accuracy"]))
        return "\n\n".join(part for part in parts if part) + "\n"

    def _run_trial(self, name):
        trial, _, count = TRIALS[name]
        collected = self.results.setdefault(name, [])
        total = count(self.plan) if count else None
        begin = time.monotonic()
        for result in trial(self.plan):
            # The whole text is only of use while counting reports; a line of it stands in "error".
            result.pop("stderr", None)
            collected.append(result)
            self._save()
            self._show(name, len(collected), total, result, time.monotonic() - begin)

    def _save(self):
        if self.json_path:
            output.write_json(self.json_path, self.results)

    @staticmethod
    def _show(name, number, total, result, elapsed_s):
        what = ", ".join(str(result[key]) for key in LABELS if key in result)
        if result["error"]:
            outcome = f"FAILED: {result['error']}"
        elif "skipped" in result:
            outcome = result["skipped"]
        else:
            outcome = f"tracked {tables.tracked_cell([result])}, ATE {tables.spread([result], 'ate', 'rmse_m')} m"
            if name == "speed":
                outcome = f"{len(result['benchmarks'])} benchmarks"
        of = f"/{total}" if total else ""
        print(f"[{name} {number}{of}, {elapsed_s:.0f} s] {what}: {outcome}", file=sys.stderr, flush=True)
