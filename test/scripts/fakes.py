"""Stand-ins for the built programs, so that the scripts around them can be tested in a second and made to fail."""

import stat

RGBD_TUM = '''#!/usr/bin/python3
"""Answers with the ground truth, 3 % too long in x when threaded. A file in the sequence makes it misbehave. With the
file "drift" sequential runs are 1 % too long, or more: what the options ask for is told by FACTORS."""
import json, os, sys, time
arguments = sys.argv[1:]
_, settings, sequence = arguments[:3]
output = arguments[arguments.index("--output") + 1]
def has(name): return os.path.exists(os.path.join(sequence, name))
def value(option, default): return arguments[arguments.index(option) + 1] if option in arguments else default
if has("crash"):
    sys.exit("rgbd_tum: the fake crashed as asked")
if has("hang"):
    time.sleep(60)
if has("report"):
    print("src/x.cpp:1:2: runtime error: signed integer overflow", file=sys.stderr)
rows = [line.split() for line in open(os.path.join(sequence, "groundtruth.txt")) if line[0] != "#"]
rows = rows[int(value("--start", 0)):]
rows = rows[:int(value("--max-frames", len(rows)))]
detector, boxes = value("--detector", None), 0
if detector == "boxes":
    path = value("--boxes", None)
    if not os.path.exists(path):
        sys.exit("rgbd_tum: " + path + ": no such file")
    boxes = sum(line[0] != "#" for line in open(path))
if detector == "none" and has("fails_without"):
    sys.exit("rgbd_tum: the fake needs a detector here")
FACTORS = {"boxes": 1.05, "none": 1.0, None: 1.0, "yolo": 2.0}
factor = FACTORS[detector] * {"boxes": 2.0, "paper": 1.5}.get(value("--people-filter", None), 1.0)
factor *= 1.0 + float(value("--boxes-delay", 0)) + (0.1 if "--no-reinstate" in arguments else 0.0)
if "--sequential" in arguments:
    scale = 1.0 + (0.01 * factor if has("drift") else 0.0)
else:
    scale = 1.03
with open(os.path.join(output, "CameraTrajectory.txt"), "w") as file:
    for row in rows:
        file.write(" ".join([row[0], str(scale * float(row[1])), *row[2:]]) + "\\n")
    if has("random"):
        file.write("# " + str(time.time_ns()) + "\\n")
# Boxes make of 18 ms 18 + 0.5 + 2 x 0.11. The wait is none of it.
tracking_ms = 21.0 if boxes else 20.0
stages = [("track", 1, tracking_ms), ("track: features", 1, 10.0), ("track: motion", 1, 8.0),
          ("track: wait for boxes", 1, 7.0)]
stages += [("people: carry", 1, 0.5), ("people: judge keypoints", 2, 0.11)] if boxes else []
statistics = {"version": "0", "frames": len(rows), "tracked": len(rows) - (0 if has("all_tracked") else 1),
              "keyframes": min(len(rows), 40), "map_points": 100, "peak_memory_mb": 200.0, "wall_s": 1.5,
              "tracking_ms": {"p50": tracking_ms, "p95": 30.0, "max": 40.0}, "boxes_read": boxes,
              "people": {"removed_ratio": 0.25, "boxes_age_s": {"mean": 0.125}} if boxes else None,
              "settings_read": os.path.basename(settings), "seed": "not the run's",
              "stages": [*({"stage": name, "count": times * len(rows), "p50_ms": ms, "p95_ms": ms, "max_ms": ms}
                           for name, times, ms in stages),
                         {"stage": "extract", "count": len(rows), "p50_ms": 9.0, "p95_ms": 12.0, "max_ms": 15.0}]}
with open(os.path.join(output, "stats.json"), "w") as file:
    json.dump(statistics, file)
'''

SIMULATE_TUM = '''#!/usr/bin/python3
"""Writes the lists of a sequence without the images, one box per person and frame, and with what options."""
import os, sys
preset, directory = sys.argv[1:3]
frames = int(sys.argv[sys.argv.index("--frames") + 1])
people = int(sys.argv[sys.argv.index("--people") + 1]) if "--people" in sys.argv else 1
if preset == "unknown":
    sys.exit("simulate_tum: no preset 'unknown'")
os.makedirs(os.path.join(directory, "rgb"), exist_ok=True)
os.makedirs(os.path.join(directory, "depth"), exist_ok=True)
open(os.path.join(directory, "settings.yaml"), "w").write("%YAML:1.0\\n")
def lines(data): return "".join(f"{10 + i / 30:.6f} {data(i)}\\n" for i in range(frames))
open(os.path.join(directory, "rgb.txt"), "w").write(lines(lambda i: f"rgb/{i}.png"))
open(os.path.join(directory, "depth.txt"), "w").write(lines(lambda i: f"depth/{i}.png"))
open(os.path.join(directory, "groundtruth.txt"), "w").write(lines(lambda i: f"{i / 30} {(i % 7) / 10} 0 0 0 0 1"))
open(os.path.join(directory, "person_boxes.txt"), "w").write(
    "".join(f"{10 + i / 30:.6f} 100 50 80 200 1.0\\n" for i in range(frames) for _ in range(people)))
open(os.path.join(directory, "options"), "w").write(" ".join(sys.argv[3:]))
open(os.path.join(directory, "drift"), "w").close()
if preset.startswith(("walking", "sitting")) and people < 6:
    open(os.path.join(directory, "all_tracked"), "w").close()
'''

BENCHMARK = '''#!/usr/bin/python3
import json
def row(name, time, unit, aggregate):
    return {"name": name + "_" + aggregate, "run_name": name, "aggregate_name": aggregate, "real_time": time,
            "time_unit": unit}
print(json.dumps({"context": {}, "benchmarks": [
    row("OrbExtractor", 8.0, "ms", "mean"), row("OrbExtractor", 6.0, "ms", "median"),
    row("OpenCvOrb", 12000.0, "us", "median")]}))
'''


def install(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


def build_folder(tmp_path, preset="release"):
    """A build directory whose programs are the fakes."""
    folder = tmp_path / "build" / preset
    install(folder / "bin" / "rgbd_tum", RGBD_TUM)
    install(folder / "bin" / "simulate_tum", SIMULATE_TUM)
    return folder


def sequence_folder(tmp_path, name, *markers):
    """A walk of 0.1 m per frame along x with a zigzag in y, 60 frames at 10 Hz."""
    folder = tmp_path / name
    folder.mkdir(parents=True)
    for kind in ("rgb", "depth"):
        (folder / f"{kind}.txt").write_text("".join(f"{i / 10:.6f} {kind}/{i}.png\n" for i in range(60)))
    rows = [f"{i / 10:.6f} {i / 10} {i % 2} 0 0 0 0 1\n" for i in range(60)]
    (folder / "groundtruth.txt").write_text("".join(rows))
    (folder / "settings.yaml").write_text("%YAML:1.0\n")
    for marker in markers:
        (folder / marker).touch()
    return folder
