"""The kinds of trial a benchmark is made of. Each yields one JSON-ready dict per run as soon as it is there."""

import json
import os
import re
import subprocess

from . import detectors
from .execution import on_sequence, run_on
from .programs import Programs, execute
from .runs import run_rgbd_tum
from .sequences import RepeatedSequence, SimulatedSequence

SENSORS = {"clean": False, "noise": True}
PLATEAU_ROUNDS = (1, 2, 5, 10)
SANITIZER_REPORT = re.compile(
    r"(ERROR: (?:AddressSanitizer|LeakSanitizer)|: runtime error: |WARNING: ThreadSanitizer)")
REFERENCE = re.compile(r"(open)?cv.{0,2}orb", re.IGNORECASE)
MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}


def accuracy(plan):
    """Sequences x modes x repeats, with recorded person boxes where there are some. Sequential runs are repeated
    once at most: they must be identical."""
    for sequence in plan.sequences:
        yield from on_sequence(sequence, lambda ready: _modes(plan, ready))


def accuracy_count(plan):
    return len(plan.sequences) * sum(_repeats(plan, mode) for mode in plan.modes)


def _repeats(plan, mode):
    return min(plan.repeats, 2) if mode == "sequential" else plan.repeats


def _modes(plan, sequence):
    detector = detectors.choose(sequence.directory, plan.detector)
    for mode in plan.modes:
        for _ in range(_repeats(plan, mode)):
            yield {**run_on(plan, sequence, mode, arguments=detector.arguments), "detector": detector.label}


def static_rooms(plan):
    """Every camera path in five rooms each, with and without sensor noise."""
    for preset in plan.presets:
        for sensor, noise in SENSORS.items():
            for seed in range(1, plan.seeds + 1):
                sequence = SimulatedSequence(plan.programs, preset, plan.work_dir, plan.frames, seed, noise)
                yield from on_sequence(sequence, lambda ready: [run_on(plan, ready, "threaded", max_frames=None)],
                               preset=preset, sensor=sensor)


def plateau(plan):
    """Ten rounds of one room, and shorter stretches of it: what lives must stop growing."""
    preset = plan.presets[-1]
    source = SimulatedSequence(plan.programs, preset, plan.work_dir, plan.frames)
    sequence = RepeatedSequence(source, plan.work_dir, PLATEAU_ROUNDS[-1])

    def rounds(ready):
        for count in PLATEAU_ROUNDS:
            yield {**run_on(plan, ready, "threaded", max_frames=count * plan.frames), "rounds": count}

    yield from ({"rounds": "-", **result} for result in on_sequence(sequence, rounds))


def sanitizers(plan):
    """A whole simulated sequence through the builds with ASan + UBSan and with TSan."""
    environment = {"TSAN_OPTIONS": "ignore_noninstrumented_modules=1", "UBSAN_OPTIONS": "print_stacktrace=1"}
    for preset in ("asan", "tsan"):
        build_error = None if plan.no_build else _build(plan.root, preset)
        if build_error:
            yield {"preset": preset, "error": build_error}
            continue
        programs = Programs(os.path.join(os.path.dirname(plan.build_dir), preset))
        source = SimulatedSequence(plan.programs, plan.presets[-1], plan.work_dir, plan.frames)

        def run(ready, programs=programs):
            result = run_rgbd_tum(programs, ready, "threaded", plan.output_dir, timeout_s=10 * plan.timeout_s,
                                  environment=environment)
            reports = count_reports(result["stderr"])
            # UBSan goes on after a report and exits with 0.
            error = result["error"] or (f"{reports} reports" if reports else None)
            yield {**result, "reports": reports, "error": error}

        yield from on_sequence(source, run, preset=preset)


def count_reports(stderr):
    return len(SANITIZER_REPORT.findall(stderr))


def _build(root, preset):
    """None, or one line on why the build failed."""
    script = 'source "$1/scripts/lib.sh" && build_preset "$2" rgbd_tum'
    process = subprocess.run(["bash", "-c", script, "bash", root, preset], stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, check=False)
    if process.returncode == 0:
        return None
    lines = [line for line in process.stdout.splitlines() if line.strip()]
    errors = [line for line in lines if "error" in line.lower()] or lines or ["no output"]
    return f"build failed: {errors[0].strip()[:200]}"


def speed(plan):
    """The Google Benchmark programs, as ratios to cv::ORB where a program has it: absolute times vary by machine."""
    for name in plan.programs.matching("bench_"):
        finished = execute([plan.programs.path(name), "--benchmark_format=json", "--benchmark_repetitions=5",
                            "--benchmark_report_aggregates_only=true"], plan.timeout_s)
        result = {"program": name, "error": finished.error, "benchmarks": []}
        if not finished.error:
            try:
                result["benchmarks"] = medians(json.loads(finished.stdout))
            except (ValueError, KeyError, TypeError):
                result["error"] = "its output is not Google Benchmark's JSON"
        yield result


def medians(document):
    """[{name, median_ms, ratio}] of a Google Benchmark report; ratio to the reference benchmark or None."""
    rows = [{"name": row["run_name"], "median_ms": row["real_time"] * MILLISECONDS[row["time_unit"]]}
            for row in document["benchmarks"] if row.get("aggregate_name") == "median"]
    references = [row["median_ms"] for row in rows if REFERENCE.search(row["name"])]
    for row in rows:
        row["ratio"] = row["median_ms"] / references[0] if references else None
    return rows
