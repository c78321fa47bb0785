"""Runs the trials of a plan, shows progress, and keeps what is there at any moment."""

import sys
import time

from .. import output
from . import tables, trials

# name: (trial, table)
TRIALS = {
    "accuracy": (trials.accuracy, tables.accuracy),
    "static_rooms": (trials.static_rooms, tables.static_rooms),
    "plateau": (trials.plateau, tables.plateau),
    "sanitizers": (trials.sanitizers, tables.sanitizers),
    "speed": (trials.speed, tables.speed),
}


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
        for name, (_, table) in TRIALS.items():
            if self.results.get(name):
                parts.append(table(self.results[name]))
        if self.results.get("accuracy"):
            parts.append(tables.stages(self.results["accuracy"]))
        return "\n\n".join(part for part in parts if part) + "\n"

    def _run_trial(self, name):
        trial, _ = TRIALS[name]
        collected = self.results.setdefault(name, [])
        total = trials.accuracy_count(self.plan) if name == "accuracy" else None
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
        what = ", ".join(str(result[key]) for key in ("program", "preset", "sequence", "mode", "rounds") if key in result)
        if result["error"]:
            outcome = f"FAILED: {result['error']}"
        else:
            outcome = f"tracked {tables.tracked_cell([result])}, ATE {tables.spread([result], 'ate', 'rmse_m')} m"
            if name == "speed":
                outcome = f"{len(result['benchmarks'])} benchmarks"
        of = f"/{total}" if total else ""
        print(f"[{name} {number}{of}, {elapsed_s:.0f} s] {what}: {outcome}", file=sys.stderr, flush=True)
