"""benchmark.py --trials paper: our numbers beside the published ones, and what is missing said."""

import os

import pytest
from conftest import cells
from cpslam_tools.benchmark import detectors, figures, paper_table, published
from cpslam_tools.datasets import PAPER
from cpslam_tools.errors import InputError
from fakes import sequence_folder

CROWD, WALKING = "rgbd_bonn_crowd", "rgbd_dataset_freiburg3_walking_xyz"


def run(rmse_m, tracked=60, error=None, **more):
    rpe = {"translation": {"rmse_m": 2 * rmse_m, "mean_m": rmse_m}, "rotation": {"rmse_deg": 0.25, "mean_deg": 0.2}}
    return {"sequence": WALKING, "mode": "threaded", "error": error, "detector": "boxes", "frames": 60,
            "tracked": tracked, "ate": {"rmse_m": rmse_m, "mean_m": 0.8 * rmse_m}, "rpe": rpe, **more}


def test_those_on_disk_run_and_the_others_are_named(benchmark, tmp_path):
    folder = sequence_folder(tmp_path, f"sets/{CROWD}", "all_tracked")
    (folder / "person_boxes.txt").write_text("1.0 10 20 30 40 0.9\n")
    result, document = benchmark("--trials", "paper", "--datasets", tmp_path / "sets", "--repeats", "3", "--figures",
                                 tmp_path / "figures")
    assert result.returncode == 0, result.stderr
    runs = [entry for entry in document["paper"] if "skipped" not in entry]
    assert len(runs) == 3 and len(document["paper"]) == 3 + len(PAPER) - 1
    assert runs[0]["arguments"] == f"--detector boxes --boxes {folder}/person_boxes.txt" and runs[0]["boxes_read"] == 1
    assert "[paper 15/15," in result.stderr
    row = cells(result.stdout, CROWD, "boxes")
    # 3 % of 5.9 m, see test_benchmark.py; ORB-SLAM2's 0.914 m and the paper's 0.026 m beside it.
    assert row[2] == "60/60" and row[3].startswith("0.05") and row[4:] == ["0.914", "**0.026**", ""]
    assert cells(result.stdout, WALKING, "-")[-1] == f"not on disk: scripts/download_sequence.py {WALKING}"
    rpe = cells(result.stdout, CROWD, "**0.0300/0.0300 (0.0300-0.0300)**")
    assert rpe[2:4] == ["1.324", "0.317"] and rpe[5:] == ["39.463", "21.040"]
    assert sorted(os.listdir(tmp_path / "figures")) == [f"{CROWD}_rpe.png", f"{CROWD}_trajectory.png"]
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in (tmp_path / "figures").iterdir())


def test_the_settings_are_those_of_the_camera(benchmark, tmp_path):
    for name in (WALKING, CROWD):
        sequence_folder(tmp_path, f"sets/{name}")
    result, document = benchmark("--trials", "paper", "--datasets", tmp_path / "sets", "--repeats", "1",
                                 "--paper-sequences", "fr3_walking_xyz", "crowd",
                                 "--detector-arguments=--detector yolo --model 'my yc.cfg' yc.weights")
    assert result.returncode == 0, result.stderr
    assert [(entry["sequence"], entry["settings_read"]) for entry in document["paper"]] == \
        [(WALKING, "TUM3.yaml"), (CROWD, "Bonn.yaml")]
    assert document["paper"][0]["arguments"] == "--detector yolo --model my yc.cfg yc.weights"
    assert cells(result.stdout, WALKING)[1] == "yolo"
    assert "crowd2" not in result.stdout


def test_without_boxes_and_arguments_the_table_says_none(benchmark, tmp_path):
    sequence_folder(tmp_path, f"sets/{WALKING}")
    result, _ = benchmark("--trials", "paper", "--datasets", tmp_path / "sets", "--repeats", "1")
    assert cells(result.stdout, WALKING)[1] == "none"


def test_an_incomplete_folder_and_a_crash_are_told(benchmark, tmp_path):
    (sequence_folder(tmp_path, f"sets/{CROWD}") / "groundtruth.txt").unlink()
    sequence_folder(tmp_path, f"sets/{WALKING}", "crash")
    result, _ = benchmark("--trials", "paper", "--datasets", tmp_path / "sets", "--repeats", "2")
    assert result.returncode == 1
    assert cells(result.stdout, CROWD)[-1].startswith("incomplete, no groundtruth.txt")
    assert cells(result.stdout, WALKING)[-1].startswith("2 of 2 failed: status 1")


def test_a_figure_that_cannot_be_drawn_is_a_warning(benchmark, tmp_path):
    sequence_folder(tmp_path, f"sets/{CROWD}")
    (tmp_path / "figures").write_text("a file in the way")
    result, _ = benchmark("--trials", "paper", "--datasets", tmp_path / "sets", "--repeats", "1", "--figures",
                          tmp_path / "figures")
    assert result.returncode == 0
    assert "warning: no figure of rgbd_bonn_crowd" in result.stderr
    assert cells(result.stdout, CROWD)[2] == "59/60"


@pytest.mark.parametrize("errors_m, drawn_m", [([0.3, 0.1, 0.2], 0.2), ([0.4, 0.1, 0.2, 0.3], 0.2), ([0.1], 0.1)])
def test_the_median_run_is_drawn(tmp_path, monkeypatch, errors_m, drawn_m):
    folder = sequence_folder(tmp_path, "walk")
    truth = (folder / "groundtruth.txt").read_text()
    drawn = []
    monkeypatch.setattr("cpslam_tools.plots.plot_trajectory", lambda path, truth, estimate, *_: drawn.append(estimate))
    monkeypatch.setattr("cpslam_tools.plots.plot_relative", lambda *_: None)
    pictures = figures.Figures(str(tmp_path / "out"), "walk", str(folder / "groundtruth.txt"), "")
    for error_m in errors_m:
        # The first pose tells the runs apart.
        (tmp_path / "CameraTrajectory.txt").write_text(f"-1.0 {error_m} 0 0 0 0 0 1\n" + truth)
        pictures.add({"error": None, "ate": {"rmse_m": error_m}}, str(tmp_path))
    pictures.add({"error": "status 1", "ate": {"rmse_m": 0.0}}, str(tmp_path))
    pictures.draw()
    assert [estimate.positions[0, 0] for estimate in drawn] == [drawn_m]


def test_the_best_is_bold_and_equals_share_it():
    # Published: 0.739, 0.024, 0.015 (DynaSLAM), 0.020, 0.016, ..., 0.018.
    row = cells(paper_table.paper([run(0.0148), run(0.0150), run(0.0153)]), WALKING)
    assert row[3] == "**0.0150/0.0120 (0.0148-0.0153)**" and row[6] == "**0.015/0.013**"
    assert sum("**" in cell for cell in row) == 2
    assert cells(paper_table.paper([run(0.0153)]), WALKING)[3] == "**0.0153/0.0122**"
    assert cells(paper_table.paper([run(0.0144)]), WALKING)[3] == "**0.0144/0.0115**"
    assert "**" not in cells(paper_table.paper([run(0.0156)]), WALKING)[3]


@pytest.mark.parametrize("spoiled", [run(0.001, tracked=59), run(0.001, error="status 1: lost"), run(0.001, ate=None)])
def test_an_incomplete_run_cannot_be_the_best(spoiled):
    row = cells(paper_table.paper([run(0.001), spoiled]), WALKING)
    assert "**" not in row[3] and row[6] == "**0.015/0.013**"


def test_rotation_and_translation_are_ranked_apart():
    row = cells(paper_table.paper([run(0.020)]), WALKING, "0.0400/0.0200")
    assert row[3] == "**0.026/0.023**" and row[4] == "**0.250/0.200**" and row[6] == "0.668/0.530"


def test_published_numbers_are_complete():
    assert [name for section in published.SECTIONS for name in section.sequences] == list(PAPER)
    for section in published.SECTIONS:
        assert set(section.ate) == set(section.rpe) == set(section.sequences)
    tum, bonn = published.SECTIONS
    # Spot checks at the corners of the tables.
    assert tum.ate["rgbd_dataset_freiburg3_sitting_static"]["ORB-SLAM2"] == "0.008/0.007"
    assert tum.ate["rgbd_dataset_freiburg3_walking_halfsphere"]["CP-SLAM paper"] == "0.028/0.025"
    assert tum.ate["rgbd_dataset_freiburg3_walking_rpy"]["SOLO-SLAM"] == "0.1194"
    assert tum.rpe["rgbd_dataset_freiburg3_walking_rpy"]["CP-SLAM paper"] == ("0.059/0.049", "1.393/1.185")
    assert bonn.ate["rgbd_bonn_synchronous2"] == {"ORB-SLAM2": "1.484", "CP-SLAM paper": "0.008"}
    assert bonn.rpe["rgbd_bonn_crowd2"]["ORB-SLAM2"] == ("2.105", "85.735")
    assert published.rmse("-") is None and published.rmse("0.0206") == 0.0206 and published.rmse("0.018/0.015") == 0.018


@pytest.mark.parametrize("arguments, complaint", [
    (["--trials", "paper", "--paper-sequences", "fr1_desk"], "freiburg1_desk is not one of the paper's sequences"),
    (["--trials", "paper", "--detector-arguments", "yolo"], "must hold --detector NAME"),
    (["--trials", "paper", "--detector-arguments", "'"], "--detector-arguments: No closing quotation"),
    (["--trials", "crowds"], "invalid choice: 'crowds'"),
])
def test_bad_options(benchmark, arguments, complaint):
    result, _ = benchmark(*arguments)
    assert result.returncode == 2 and complaint in result.stderr


def test_detector_texts():
    assert detectors.from_text("") == detectors.NONE
    assert detectors.from_text("--boxes f --detector boxes") == ("boxes", ("--boxes", "f", "--detector", "boxes"))
    with pytest.raises(InputError):
        detectors.from_text("--detector")
