"""Clouds of points as --save-cloud writes them, and pictures of them."""

import numpy as np

from .errors import InputError

TYPES = {"float": "<f4", "float32": "<f4", "double": "<f8", "float64": "<f8", "uchar": "u1", "uint8": "u1", "char": "i1",
         "int8": "i1", "short": "<i2", "int16": "<i2", "ushort": "<u2", "uint16": "<u2", "int": "<i4", "int32": "<i4",
         "uint": "<u4", "uint32": "<u4"}
NEEDED = ("x", "y", "z", "nx", "ny", "nz", "red", "green", "blue")
WHITE = 255
MOST_SPLAT_PX = 15
# A floor's normal is nowhere near so far off the first camera's upward axis.
MOST_TILT_DEG = 45


def read_ply(path):
    """The vertices of a binary little-endian PLY with normals and colours, as a structured array."""
    try:
        with open(path, "rb") as file:
            count, fields = read_header(path, file)
            size = np.dtype(fields).itemsize
            data = file.read(count * size)
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from None
    if len(data) < count * size:
        raise InputError(f"{path}: ends after {len(data) // size} of {count} points")
    return np.frombuffer(data, fields, count)


def read_header(path, file):
    if file.readline(100).strip() != b"ply":
        raise InputError(f"{path}: is no PLY file")
    count, fields, binary = None, [], False
    for _ in range(100):
        words = file.readline(1000).decode("ascii", "replace").split()
        if words == ["end_header"]:
            break
        if words[:2] == ["format", "binary_little_endian"]:
            binary = True
        elif words[:2] == ["element", "vertex"] and len(words) == 3 and words[2].isdigit():
            count = int(words[2])
        elif words[:1] == ["property"] and len(words) == 3 and words[1] in TYPES:
            fields.append((words[2], TYPES[words[1]]))
    missing = [name for name in NEEDED if name not in [field for field, _ in fields]]
    if not binary or count is None or missing:
        raise InputError(f"{path}: wanted is a binary little-endian PLY with points, normals and colours")
    return count, fields


def columns(cloud, *names):
    return np.stack([cloud[name] for name in names], axis=1).astype(float)


def upward(normals):
    """The direction of the floor's and the tables' normals, near the upward axis (-y) of the first camera."""
    near = normals[normals @ np.array([0.0, -1.0, 0.0]) > np.cos(np.radians(MOST_TILT_DEG))]
    if len(near) == 0:
        return np.array([0.0, -1.0, 0.0])
    up = np.median(near, axis=0)
    return up / np.linalg.norm(up)


def view_axes(up, azimuth_deg, elevation_deg):
    """Right, down and forward of one who looks down on the scene; azimuth 0 looks the way the first camera did."""
    forward = np.array([0.0, 0.0, 1.0]) - up * up[2]
    forward /= np.linalg.norm(forward)
    side = np.cross(forward, up)
    azimuth, elevation = np.radians(azimuth_deg), np.radians(elevation_deg)
    level = np.cos(azimuth) * forward + np.sin(azimuth) * side
    forward = np.cos(elevation) * level - np.sin(elevation) * up
    right = np.cross(level, up)
    return np.stack([right, np.cross(forward, right), forward])


def render(cloud, azimuth_deg=20.0, elevation_deg=50.0, width=1200, point_m=0.02):
    """An orthographic picture (height x width x 3) from outside. Surfaces that are turned away are not drawn, so that
    walls and the ceiling do not hide the room."""
    points, normals = columns(cloud, "x", "y", "z"), columns(cloud, "nx", "ny", "nz")
    axes = view_axes(upward(normals), azimuth_deg, elevation_deg)
    seen = normals @ axes[2] < 0
    if not seen.any():
        return np.full((width, width, 3), WHITE, np.uint8)
    points, normals = points[seen] @ axes.T, normals[seen]
    colours = columns(cloud, "red", "green", "blue")[seen]
    # A few stray points do not make the picture small.
    low, high = np.percentile(points, 0.2, axis=0), np.percentile(points, 99.8, axis=0)
    margin = 0.03 * (high - low).max()
    scale = width / (high[0] - low[0] + 2 * margin)
    height = max(1, round(scale * (high[1] - low[1] + 2 * margin)))
    if height > 4 * width:
        scale, height = scale * 4 * width / height, 4 * width
    pixels = np.floor(scale * (points[:, :2] - low[:2] + margin)).astype(int)
    side = min(MOST_SPLAT_PX, max(1, int(np.ceil(scale * point_m))))
    shade = 0.75 + 0.25 * np.abs(normals @ axes[2])
    return splat(pixels, points[:, 2], np.rint(colours * shade[:, None]).astype(np.uint8), side, (height, width))


def splat(pixels, depth, colours, side, shape):
    """Paints squares of side px, the nearest last."""
    picture = np.full((*shape, 3), WHITE, np.uint8)
    order = np.argsort(-depth, kind="stable")
    offsets = np.arange(side) - side // 2
    x = (pixels[order, 0][:, None, None] + offsets[None, None, :]) + 0 * offsets[None, :, None]
    y = (pixels[order, 1][:, None, None] + offsets[None, :, None]) + 0 * offsets[None, None, :]
    inside = (x >= 0) & (y >= 0) & (x < shape[1]) & (y < shape[0])
    point = np.broadcast_to(np.arange(len(order))[:, None, None], inside.shape)
    nearest = np.full(shape[0] * shape[1], -1)
    np.maximum.at(nearest, (y * shape[1] + x)[inside], point[inside])
    painted = nearest >= 0
    picture.reshape(-1, 3)[painted] = colours[order][nearest[painted]]
    return picture
