"""benchmark.py around programs that answer at once, or fail in the ways that programs fail."""

import json
import os
import signal
import subprocess
import time

import pytest
from conftest import SCRIPTS, cells
from cpslam_tools.benchmark import sequences, tables, trials
from fakes import BENCHMARK, build_folder, install, sequence_folder


def test_runs_every_mode_as_often_as_asked(benchmark, tmp_path):
    folder = sequence_folder(tmp_path, "walk")
    result, document = benchmark("--sequence", folder, folder / "settings.yaml", "--repeats", "3")
    assert result.returncode == 0, result.stderr
    assert [run["mode"] for run in document["accuracy"]] == ["threaded"] * 3 + ["sequential"] * 2 + ["realtime"] * 3
    assert document["complete"] and document["machine"]["cores"] >= 1
    row = cells(result.stdout, "walk", "sequential")
    assert row[2:5] == ["2", "59/60", "0.0000 (0.0000-0.0000)"]
    assert row[-1] == "identical"
    # 3 % of x: x is uniform over 5.9 m, so the error's RMS is about 0.03 * 5.9 / sqrt(12) = 0.051 m, and the drift
    # in a second, which is a metre, 0.03 m.
    row = cells(result.stdout, "walk", "threaded")
    assert row[4].startswith("0.05") and row[5].startswith("0.0300 ")
    assert row[7] == "20.0 (20.0-20.0)"
    assert cells(result.stdout, "walk", "realtime")[2] == "3"
    assert cells(result.stdout, "walk", "threaded", "extract")[3] == "60 (60-60)"


def test_a_sequential_mode_that_varies_is_told(benchmark, tmp_path):
    folder = sequence_folder(tmp_path, "walk", "random")
    result, _ = benchmark("--sequence", folder, folder / "settings.yaml", "--modes", "sequential")
    assert cells(result.stdout, "walk", "sequential")[-1] == "NOT identical"


def test_a_failing_run_is_reported_and_the_next_sequence_runs(benchmark, tmp_path):
    bad, good = sequence_folder(tmp_path, "bad", "crash"), sequence_folder(tmp_path, "good")
    result, document = benchmark("--sequence", bad, bad / "settings.yaml", "--sequence", good, good / "settings.yaml",
                                 "--sequence", tmp_path / "absent", good / "settings.yaml",
                                 "--modes", "threaded", "--repeats", "1")
    assert result.returncode == 1
    assert cells(result.stdout, "bad", "threaded")[-1] == \
        "1 of 1 failed: status 1: rgbd_tum: the fake crashed as asked"
    assert cells(result.stdout, "good", "threaded")[3] == "59/60"
    assert "absent: not there" in cells(result.stdout, "absent", "-")[-1]
    assert len(document["accuracy"]) == 3


def test_a_hanging_run_is_killed(benchmark, tmp_path):
    folder = sequence_folder(tmp_path, "walk", "hang")
    result, _ = benchmark("--sequence", folder, folder / "settings.yaml", "--modes", "threaded", "--repeats", "1",
                          "--timeout", "1")
    assert result.returncode == 1
    assert "killed after 1 s" in cells(result.stdout, "walk", "threaded")[-1]


def test_ctrl_c_keeps_what_is_there(tmp_path):
    quick, slow = sequence_folder(tmp_path, "quick"), sequence_folder(tmp_path, "slow", "hang")
    results = tmp_path / "results.json"
    process = subprocess.Popen(
        [f"{SCRIPTS}/benchmark.py", "--build-dir", build_folder(tmp_path), "--work-dir", tmp_path / "work", "--json",
         results, "--sequence", quick, quick / "settings.yaml", "--sequence", slow, slow / "settings.yaml",
         "--modes", "threaded", "--repeats", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        start_new_session=True)
    assert process.stderr.readline().startswith("[accuracy 1/2")
    # The first line of progress is printed before the second run starts: give that a moment.
    time.sleep(0.5)
    # As a terminal does: to the whole group, which is the benchmark's own because of start_new_session. Never with the
    # program kill: without "--", procps takes the group's minus sign for an option and signals every process there is.
    os.killpg(process.pid, signal.SIGINT)
    stdout, stderr = process.communicate(timeout=30)
    assert process.returncode == 1 and "interrupted" in stderr
    assert cells(stdout, "quick", "threaded")[3] == "59/60"
    document = json.loads(results.read_text())
    assert len(document["accuracy"]) == 1 and not document["complete"]


def test_simulated_rooms_are_removed_unless_kept(benchmark, tmp_path):
    result, _ = benchmark("--simulated", "room", "unknown", "--frames", "40", "--modes", "threaded", "--repeats", "1")
    assert cells(result.stdout, "sim room, noise, seed 1", "threaded")[3] == "39/40"
    assert "no preset 'unknown'" in cells(result.stdout, "sim unknown, noise, seed 1", "-")[-1]
    assert not list((tmp_path / "work").glob("room*"))
    benchmark("--simulated", "room", "--frames", "40", "--modes", "threaded", "--repeats", "1", "--keep")
    assert list((tmp_path / "work").glob("room*"))


def test_full_adds_the_long_trials(benchmark, tmp_path):
    folder = sequence_folder(tmp_path, "walk")
    for preset in ("asan", "tsan"):
        build_folder(tmp_path, preset)
    install(tmp_path / "build" / "release" / "bin" / "bench_features", BENCHMARK)
    result, document = benchmark("--sequence", folder, folder / "settings.yaml", "--modes", "threaded", "--repeats", "1",
                                 "--full", "--no-build", "--presets", "room", "--frames", "30", "--seeds", "2",
                                 "--data", tmp_path / "no_clips", "--datasets", tmp_path / "no_datasets",
                                 "--people-presets", "walking_xyz", "sitting_xyz", "--perturbations", "2")
    # Everything is well but for the recorded clips, which are told to be missing.
    assert result.returncode == 1, result.stderr
    failed = {name for name, runs in document.items() if isinstance(runs, list) and any(run["error"] for run in runs)}
    assert failed == {"people_wait", "people_latest", "people_detector", "people_ablation", "people_false_boxes"}
    assert "bonn_crowd_dev: not there" in cells(result.stdout, "-", "1")[-1]
    # One frame of each run is not tracked, so the target is not reached.
    row = cells(result.stdout, "room", "noise")
    assert row[2:4] == ["2", "29/30"] and row[6] == "NO"
    assert [run["rounds"] for run in document["plateau"]] == [1, 2, 5, 10]
    assert [run["frames"] for run in document["plateau"]] == [30, 60, 150, 300]
    assert "Plateau (reached, limit x 1.10): from 5 to 10 rounds keyframes x 1.00" in result.stdout
    assert cells(result.stdout, "tsan", "sim room, noise, seed 1")[4] == "0"
    assert cells(result.stdout, "bench_features", "OrbExtractor")[2:] == ["6.000", "0.50"]
    assert cells(result.stdout, "bench_features", "OpenCvOrb")[2:] == ["12.000", "1.00"]


@pytest.mark.parametrize("arguments, complaint", [
    (["--repeats", "0"], "must be at least 1"),
    (["--json", "-"], "--json needs a file"),
    (["--data", "/nonexistent", "--build-dir", "/nonexistent"], "rgbd_tum is not there: build it"),
])
def test_bad_options(run_script, tmp_path, arguments, complaint):
    result = run_script("benchmark.py", "--build-dir", build_folder(tmp_path), *arguments)
    assert result.returncode == 2 and complaint in result.stderr


def test_rounds_go_there_and_back():
    # Three rows at 10, 11, 12; a round lasts 3 s, so the second starts at 13, with the last row.
    rows = [(10.0, "a"), (11.0, "b"), (12.0, "c")]
    assert list(sequences.repeated(rows, 10.0, 12.0, 3.0, 3)) == [
        (10.0, "a"), (11.0, "b"), (12.0, "c"), (13.0, "c"), (14.0, "b"), (15.0, "a"),
        (16.0, "a"), (17.0, "b"), (18.0, "c")]


def test_plateau_verdict_names_what_grows():
    five = {"rounds": 5, "error": None, "keyframes": 50, "map_points": 1000, "peak_memory_mb": 100.0}
    ten = {**five, "rounds": 10, "map_points": 2000}
    verdict = tables.plateau_verdict([five, ten])
    assert "NOT reached" in verdict and "map_points x 2.00" in verdict
    assert "not measured" in tables.plateau_verdict([{**ten, "error": "status 1"}, five])


def test_sanitizer_reports_are_counted():
    text = ("==1==ERROR: AddressSanitizer: heap-use-after-free\n"
            "/src/a.cpp:3:4: runtime error: shift exponent 64 is too large\n"
            "WARNING: ThreadSanitizer: data race (pid=1)\n"
            "rgbd_tum: a warning of our own\n")
    assert trials.count_reports(text) == 3
    assert trials.count_reports("all is well\n") == 0


def test_a_signal_is_named(benchmark, tmp_path):
    folder = sequence_folder(tmp_path, "walk")
    build = build_folder(tmp_path, "dying")
    install(build / "bin" / "rgbd_tum", "#!/bin/bash\nkill -SEGV $$\n")
    result, document = benchmark("--build-dir", build, "--sequence", folder, folder / "settings.yaml", "--modes",
                                 "threaded", "--repeats", "1")
    assert result.returncode == 1
    assert document["accuracy"][0]["error"] == f"signal {signal.SIGSEGV.value}"
