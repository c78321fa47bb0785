"""plot_cloud.py: reads what --save-cloud writes, draws what faces the viewer, names broken files."""

import numpy as np
import pytest
from cpslam_tools import clouds
from matplotlib.image import imread, imsave

FIELDS = [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("nx", "<f4"), ("ny", "<f4"), ("nz", "<f4"),
          ("red", "u1"), ("green", "u1"), ("blue", "u1")]
RED, GREEN = (255, 0, 0), (0, 255, 0)


def square(height_m, normal, colour, half_m=1.0, step_m=0.02):
    """A horizontal square; y points down."""
    grid = np.arange(-half_m, half_m, step_m)
    cloud = np.zeros(len(grid) ** 2, FIELDS)
    cloud["x"], cloud["z"] = (axis.ravel() for axis in np.meshgrid(grid, grid))
    cloud["y"] = -height_m
    for name, value in zip(("nx", "ny", "nz", "red", "green", "blue"), (*normal, *colour)):
        cloud[name] = value
    return cloud


def room():
    """A green floor, a red table on it, and a ceiling that faces down."""
    return np.concatenate([square(0.0, (0, -1, 0), GREEN), square(0.7, (0, -1, 0), RED, half_m=0.3),
                           square(2.5, (0, 1, 0), (0, 0, 255))])


def write_ply(path, cloud):
    names = {"<f4": "float", "u1": "uchar"}
    header = ["ply", "format binary_little_endian 1.0", "comment test", f"element vertex {len(cloud)}",
              *(f"property {names[kind]} {name}" for name, kind in FIELDS), "end_header\n"]
    path.write_bytes("\n".join(header).encode() + cloud.tobytes())
    return path


def test_the_floor_plan_shows_the_table_on_the_floor_and_no_ceiling(run_script, tmp_path):
    ply, png = write_ply(tmp_path / "room.ply", room()), tmp_path / "room.png"
    result = run_script("plot_cloud.py", ply, "--azimuth", 0, "--elevation", 90, "--width", 200, "-o", png)
    assert result.returncode == 0, result.stderr
    assert result.stdout == f"{len(room())} points, 1.98 x 2.50 x 1.98 m\n"
    picture = (imread(png)[:, :, :3] * 255).round().astype(int)
    assert picture.shape[1] == 200
    assert tuple(picture[100, 100]) == RED and tuple(picture[50, 100]) == GREEN
    assert not (picture == (0, 0, 255)).all(axis=2).any()
    reds = (picture == RED).all(axis=2)
    assert reds.sum() / 200**2 == pytest.approx((0.6 / 2.1) ** 2, rel=0.15)


def test_what_is_nearer_hides_what_is_behind():
    pixels, depth = np.array([[5, 5], [5, 5], [6, 5]]), np.array([1.0, 2.0, 3.0])
    picture = clouds.splat(pixels, depth, np.array([RED, GREEN, GREEN], np.uint8), 3, (10, 12))
    assert tuple(picture[5, 5]) == RED and tuple(picture[5, 6]) == RED and tuple(picture[5, 7]) == GREEN
    assert (picture != 255).any(axis=2).sum() == 12


def test_up_is_where_the_floor_says_not_where_the_camera_looked():
    tilted = np.array([0.0, -np.cos(0.4), -np.sin(0.4)])
    walls = np.tile([[1.0, 0, 0], [0, 0, -1.0]], (50, 1))
    assert np.allclose(clouds.upward(np.concatenate([np.tile(tilted, (80, 1)), walls])), tilted)
    axes = clouds.view_axes(tilted, 33, 40)
    assert np.allclose(axes @ axes.T, np.eye(3)) and np.linalg.det(axes) == pytest.approx(1)


def test_an_empty_cloud_is_a_white_picture(run_script, tmp_path):
    result = run_script("plot_cloud.py", write_ply(tmp_path / "a.ply", room()[:0]), "--width", 20, "-o", tmp_path / "a.png")
    assert result.returncode == 0, result.stderr
    assert (imread(tmp_path / "a.png") == 1).all()


def test_a_frame_stands_beside_the_cloud(run_script, tmp_path):
    ply, frame, png = write_ply(tmp_path / "a.ply", room()), tmp_path / "frame.png", tmp_path / "both.png"
    imsave(frame, np.full((30, 40, 3), (255, 0, 255), np.uint8))
    result = run_script("plot_cloud.py", ply, "--azimuth", 0, "--elevation", 90, "--width", 200, "--beside", frame, "-o", png)
    assert result.returncode == 0, result.stderr
    picture = (imread(png)[:, :, :3] * 255).round().astype(int)
    assert picture.shape == (200, 267 + 11 + 200, 3)
    assert tuple(picture[100, 100]) == (255, 0, 255) and tuple(picture[100, 270]) == (255, 255, 255)
    assert tuple(picture[100, 378]) == RED


def test_a_frame_that_is_no_picture_is_named(run_script, tmp_path):
    ply = write_ply(tmp_path / "a.ply", room())
    result = run_script("plot_cloud.py", ply, "--width", 50, "--beside", ply, "-o", tmp_path / "b.png")
    assert result.returncode == 2 and "a.ply" in result.stderr and len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize("content, reason", [
    (b"plywood", "no PLY"), (b"ply\nformat ascii 1.0\nelement vertex 1\nend_header\n1 2 3\n", "little-endian"),
    (b"ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty float x\nend_header\n", "normals"), (b"", "no PLY")])
def test_broken_files_are_named(run_script, tmp_path, content, reason):
    (tmp_path / "a.ply").write_bytes(content)
    result = run_script("plot_cloud.py", tmp_path / "a.ply", "-o", tmp_path / "a.png")
    assert result.returncode == 2 and reason in result.stderr and "a.ply" in result.stderr
    assert len(result.stderr.splitlines()) == 1


def test_a_file_that_ends_early(run_script, tmp_path):
    path = write_ply(tmp_path / "a.ply", room())
    path.write_bytes(path.read_bytes()[:-30])
    result = run_script("plot_cloud.py", path)
    assert result.returncode == 2 and "ends after" in result.stderr
