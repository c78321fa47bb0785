"""evaluate_detector.py as a whole, around a stand-in for detect_people."""

import json

import pytest
from conftest import cells
from fakes import install

# The boxes of p.png are the lines of p.found; 8-bit boxes lack the last. Every picture is 100 x 100 px.
DETECT_PEOPLE = '''#!/usr/bin/python3
import json, os, sys
arguments = sys.argv[1:]
def value(option, count=1): return arguments[arguments.index(option) + count] if option in arguments else None
open(os.path.join(os.path.dirname(sys.argv[0]), "calls"), "a").write(" ".join(arguments[3:]) + "\\n")
if value("--model") == "broken.cfg":
    sys.exit(2)
paths = [line.strip() for line in open(arguments[0])]
left_out = [path for path in paths if os.path.exists(path + ".unreadable")]
def lines(path):
    found = path.rsplit(".", 1)[0] + ".found"
    return [f"{path} {line.strip()}" for line in open(found)] if os.path.exists(found) else []
int8 = value("--quantise")
pictures, boxes, floats = [], [], []
for path in paths:
    if path in left_out: continue
    pictures.append({"picture": path, "width": 100, "height": 100})
    boxes += lines(path)[:-1] if int8 else lines(path)
    floats += lines(path)
open(value("--output"), "w").write("".join(line + "\\n" for line in boxes))
if int8: open(value("--compare-float"), "w").write("".join(line + "\\n" for line in floats))
size = value("--input-size") or "416"
times = {"p50": 10.0, "p95": 20.0, "max": 30.0}
json.dump({"network": f"YOLO x, {size} x {size}" + (", 8-bit" if int8 else ""), "interrupted": False, "left_out": left_out,
           "settings": {"model_weights": value("--model", 2) or "/data/models/yc.weights"}, "pictures": pictures,
           "detection_ms": times, "compared": {"float_ms": {**times, "p50": 16.0}, "time_ratio": {"p50": 0.625}} if int8 else None},
          open(value("--report"), "w"))
sys.exit(1 if left_out else 0)
'''


@pytest.fixture
def evaluate(run_script, tmp_path):
    """Runs the script on the fake; returns the process and the calls the fake received."""
    install(tmp_path / "build" / "bin" / "detect_people", DETECT_PEOPLE)

    def run(*arguments):
        result = run_script("evaluate_detector.py", "--build-dir", tmp_path / "build", *arguments)
        calls = tmp_path / "build" / "bin" / "calls"
        return result, calls.read_text().splitlines() if calls.exists() else []
    return run


@pytest.fixture
def labelled(write, tmp_path):
    """Two pictures: two people, one of them found and one box wrong; one person, found."""
    for name in ("images", "labels"):
        (tmp_path / "set" / name).mkdir(parents=True)
    write("set/labels/a.txt", ["0 0.1 0.1 0.2 0.2", "0 0.7 0.5 0.2 0.8"])
    write("set/labels/b.txt", ["0 0.5 0.5 0.4 0.4"])
    write("set/images/a.found", ["60 10 20 80 0.9", "0 60 20 20 0.7"])
    write("set/images/b.found", ["30 30 40 40 0.8"])
    for name in ("a.png", "b.png"):
        picture(tmp_path / "set" / "images" / name)
    return write("set/val.txt", ["images/a.png", "images/b.png"])


def picture(path):
    from PIL import Image
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.new("RGB", (100, 100)).save(path)


def test_a_labelled_list(evaluate, labelled, tmp_path):
    result, calls = evaluate(labelled, "--model", "m.cfg", "/x/m.weights", "--output", tmp_path / "out", "--threads", "1")
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith("2 pictures, 3 people")
    # By confidence right, right, wrong of three people: AP 2/3, precision 2/3.
    assert cells(result.stdout, "m", "416 x 416", "float")[3:6] == ["0.667", "0.667", "0.667"]
    assert len(calls) == 1 and "--confidence 0.01" in calls[0] and "--detector-threads 1" in calls[0]
    document = json.loads((tmp_path / "out" / "results.json").read_text())
    only = document["results"][0]
    assert only["ap"] == pytest.approx(2 / 3) and (only["right"], only["wrong"], only["people"]) == (2, 1, 3)
    assert only["sizes"]["large"]["recall"] == 1.0 and only["sizes"]["small"]["recall"] is None
    assert only["sizes"]["medium"]["people"] == 2 and only["sizes"]["medium"]["wrong"] == 1
    assert (tmp_path / "out" / "precision_recall.png").read_bytes().startswith(b"\x89PNG")


def test_every_network_at_every_size_in_both_numbers(evaluate, labelled):
    result, calls = evaluate(labelled, "--model", "a.cfg", "a.weights", "--model", "b.cfg", "b.weights", "--sizes", "256,320",
                             "--int8", "pictures")
    assert result.returncode == 0, result.stderr
    assert len(calls) == 4 and all("--quantise pictures" in call for call in calls)
    for network in "ab":
        for size in ("256 x 256", "320 x 320"):
            # Without the last box of each picture: one of three found, nothing wrong.
            assert cells(result.stdout, network, size, "int8")[4:6] == ["0.333", "1.000"]
            assert cells(result.stdout, network, size, "int8")[7:10] == ["10.0", "20.0", "0.62"]
            assert cells(result.stdout, network, size, "float")[7:10] == ["16.0", "20.0", "-"]
            assert cells(result.stdout, network, size, "float")[4:6] == ["0.667", "0.667"]


def test_the_bundled_network_is_the_default(evaluate, labelled):
    result, calls = evaluate(labelled)
    assert "--model" not in calls[0] and cells(result.stdout, "yc")[1] == "416 x 416"


def test_other_thresholds_and_overlaps(evaluate, labelled):
    result, _ = evaluate(labelled, "--threshold", "0.85")
    assert cells(result.stdout, "yc")[4:6] == ["0.333", "1.000"]
    result, calls = evaluate(labelled, "--iou", "1", "--nms", "0.6", "--classes", "person", "--every", "2")
    assert "--nms 0.6 --classes person" in calls[1] and result.stdout.startswith("1 pictures, 2 people")


def test_differences_are_drawn(evaluate, labelled, tmp_path):
    from PIL import Image
    result, _ = evaluate(labelled, "--draw", tmp_path / "drawn")
    assert result.returncode == 0, result.stderr
    folder = tmp_path / "drawn" / "yc_416x416_float"
    assert [path.name for path in folder.iterdir()] == ["a.jpg"] and f"{folder}/: 1 pictures" in result.stdout
    image = Image.open(folder / "a.jpg")

    def is_near(place, colour):
        return all(abs(have - want) < 90 for have, want in zip(image.getpixel(place), colour))
    assert is_near((10, 19), (255, 220, 0)), "missed: yellow"
    assert is_near((20, 70), (255, 30, 30)), "wrong: red"


def test_unreadable_pictures_do_not_count(evaluate, labelled, tmp_path):
    (tmp_path / "set" / "images" / "a.png.unreadable").touch()
    result, _ = evaluate(labelled)
    assert result.returncode == 0 and result.stdout.startswith("1 pictures, 1 people")
    assert "1 pictures could not be read" in result.stderr
    (tmp_path / "set" / "images" / "b.png.unreadable").touch()
    assert evaluate(labelled)[0].returncode == 2


@pytest.fixture
def sequence(write, tmp_path):
    """Five pictures at 10 Hz; a large person in all, without a box in the third and the fourth."""
    folder = tmp_path / "clip"
    folder.mkdir()
    write("clip/rgb.txt", [f"{1 + i / 10} {i}.png" for i in range(5)])
    write("clip/reference.txt", [f"{1 + i / 10} 10 10 40 60 0.9" for i in range(5)])
    write("clip/found.txt", [f"{1 + i / 10} 10 10 40 60 0.7" for i in (0, 1, 4)])
    for i in range(5):
        picture(folder / f"{i}.png")
        if i not in (2, 3):
            write(f"clip/{i}.found", ["10 10 40 60 0.7"])
    return folder


def test_a_sequence_tells_how_long_people_were_overlooked(evaluate, sequence, tmp_path):
    result, _ = evaluate("--sequence", sequence, "--reference", sequence / "reference.txt", "--boxes", sequence / "found.txt",
                         "--model", "m.cfg", "m.weights", "--output", tmp_path)
    assert result.returncode == 0, result.stderr
    for name in ("m", "found.txt"):
        assert cells(result.stdout, name)[4:6] == ["0.600", "1.000"]
    assert "overlooked: 1 times, 0.20 s at the longest" in result.stdout
    assert "   0.20 s from 1.200000 on, 2 pictures" in result.stdout
    results = json.loads((tmp_path / "results.json").read_text())["results"]
    assert [one["misses"][0]["duration_s"] for one in results] == [pytest.approx(0.2)] * 2
    assert [one["detection_ms"] for one in results][1] is None


def test_recorded_boxes_need_no_network(evaluate, sequence):
    result, calls = evaluate("--sequence", sequence, "--reference", sequence / "reference.txt", "--boxes", sequence / "found.txt")
    assert result.returncode == 0 and calls == []


def test_mot_tells_coverage_and_accuracy(evaluate, tmp_path, write):
    (tmp_path / "mot" / "gt").mkdir(parents=True)
    (tmp_path / "mot" / "img1").mkdir()
    write("mot/seqinfo.ini", ["[Sequence]", "imDir=img1", "frameRate=30", "seqLength=2", "imExt=.jpg"])
    write("mot/gt/gt.txt", ["1,1,1,1,20,40,1,1,1", "1,2,51,1,20,40,1,1,1", "2,1,1,1,20,40,1,1,1"])
    write("mot/img1/000001.found", ["0 0 20 40 0.9"])
    write("mot/img1/000002.found", ["0 0 20 40 0.9", "50 50 20 40 0.8"])
    result, _ = evaluate("--mot", tmp_path / "mot")
    assert result.returncode == 0, result.stderr
    assert "coverage at 0.6 | accuracy" in result.stdout
    assert cells(result.stdout, "yc")[4:6] == ["0.667", "0.667"]
    assert "| yc      | 416 x 416 | float   | 0.500" in result.stdout, "one of two in the worst picture"


@pytest.mark.parametrize("arguments, complaint", [
    ([], "give one of PICTURES, --mot DIR and --sequence DIR"), (["a", "--mot", "b"], "give one of"),
    (["--sequence", "a"], "go together"), (["a", "--reference", "b"], "go together"), (["a", "--boxes", "b"], "--boxes goes with"),
    (["no_such_list.txt"], "no_such_list.txt: No such file"), (["--mot", "no_such"], "seqinfo.ini: No such file"),
    (["--sequence", "no_such", "--reference", "b.txt"], "rgb.txt: No such file"),
    (["a", "--sizes", "big"], "--sizes"), (["a", "--threshold", "2"], "--threshold"), (["a", "--every", "0"], "--every")])
def test_bad_usage_is_told(evaluate, arguments, complaint):
    result, _ = evaluate(*arguments)
    assert result.returncode == 2 and complaint in result.stderr and "Traceback" not in result.stderr


def test_a_failing_program_is_told(evaluate, labelled, tmp_path):
    result, _ = evaluate(labelled, "--model", "broken.cfg", "x")
    assert result.returncode == 2 and "detect_people ended with status 2" in result.stderr
    (tmp_path / "build" / "bin" / "detect_people").unlink()
    result, _ = evaluate(labelled)
    assert result.returncode == 2 and "build it" in result.stderr
