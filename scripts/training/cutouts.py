"""Cut-out people (RGBA pictures) put on top of training pictures: crowds, people behind people, people at hand."""

import os

import cv2
import numpy as np

from cpslam_tools.errors import InputError

from .geometry import LABELLED_FILL, LABELLED_SHARE, SMALLEST_SIDE, affine, linear_map

HIDDEN = 0.75  # covered to this share, a person is ignored
GONE = 0.97  # and from here on no longer there


def load_cutouts(folder, longest=384):
    """A list of (B,G,R,alpha uint8, cut by the lower border): NAME_b.png is cut there, NAME_f.png shows the feet."""
    names = sorted(name for name in os.listdir(folder) if name.endswith(".png"))
    pictures = []
    for name in names:
        picture = cv2.imread(os.path.join(folder, name), cv2.IMREAD_UNCHANGED)
        if picture is None or picture.ndim != 3 or picture.shape[2] != 4:
            raise InputError(f"{folder}/{name} is no picture with an alpha channel")
        shrink = longest / max(picture.shape[:2])
        if shrink < 1:
            picture = cv2.resize(picture, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA)
        pictures.append((picture, name.endswith("_b.png")))
    if not pictures:
        raise InputError(f"{folder} has no .png files")
    return pictures


def paste(picture, people, ignored, cutout, cut_below, generator):
    """Puts one cut-out into the square picture (changed in place). Returns the boxes of the people and those ignored."""
    side = picture.shape[0]
    layer, full_area = placed(cutout, cut_below, side, generator)
    solid = layer[:, :, 3] > 127
    columns, rows = np.flatnonzero(solid.any(0)), np.flatnonzero(solid.any(1))
    if not len(columns):
        return people, ignored
    x0, y0, x1, y1 = columns[0], rows[0], columns[-1] + 1, rows[-1] + 1
    blend(picture[y0:y1, x0:x1], layer[y0:y1, x0:x1])
    people, covered = hide(people, solid)
    ignored = np.concatenate([hide(ignored, solid)[0], covered])
    found, area = np.array([[x0, y0, x1, y1]], np.float64), (x1 - x0) * (y1 - y0)
    clear = area >= LABELLED_SHARE * full_area or area >= LABELLED_FILL * side * side
    if clear and min(x1 - x0, y1 - y0) >= SMALLEST_SIDE:
        return np.concatenate([people, found]), ignored
    return people, np.concatenate([ignored, found])


def placed(cutout, cut_below, side, generator):
    """The cut-out on an empty picture of that side, anywhere and of any size; and its whole area, px."""
    height = side * np.exp(generator.uniform(np.log(0.12), np.log(1.5)))
    factor = height / cutout.shape[0]
    linear = linear_map(1.0, np.exp(generator.uniform(-0.15, 0.15)), np.radians(generator.normal(0, 6)),
                        generator.random() < 0.5)
    if cut_below:
        target = (generator.uniform(0, side), side + generator.uniform(0, 0.25) * height)
    else:
        target = (generator.uniform(0, side), generator.uniform(0.35 * side, side + 0.3 * height))
    source = shade(cutout, generator)
    if factor < 0.6:  # bilinear sampling would skip pixels
        source = cv2.resize(source, None, fx=factor, fy=factor, interpolation=cv2.INTER_AREA)
    linear = linear * (height / source.shape[0])
    matrix = affine(linear, (source.shape[1] / 2, source.shape[0]), target)
    layer = cv2.warpAffine(source, matrix, (side, side), flags=cv2.INTER_LINEAR)
    return layer, height * height * cutout.shape[1] / cutout.shape[0]


def blend(part, layer):
    alpha = layer[:, :, 3:].astype(np.float32) / 255
    part[:] = (part + alpha * (layer[:, :, :3].astype(np.float32) - part)).astype(np.uint8)


def hide(boxes, solid):
    """Splits boxes into those still seen and those hardly so; what is wholly covered is dropped."""
    share = np.array([covered_share(box, solid) for box in boxes]).reshape(-1)
    return boxes[share < HIDDEN], boxes[(share >= HIDDEN) & (share < GONE)]


def covered_share(box, solid):
    x0, y0 = np.floor(box[:2]).astype(int)
    x1, y1 = np.ceil(box[2:]).astype(int)
    part = solid[max(y0, 0):y1, max(x0, 0):x1]
    return part.mean() if part.size else 1.0


def shade(cutout, generator):
    """Another light than its own, so that a seam does not tell who was pasted."""
    gain = generator.uniform(0.6, 1.25) * generator.uniform(0.92, 1.08, 3)
    table = np.clip(np.arange(256)[:, None] * np.append(gain, 1.0), 0, 255).astype(np.uint8)
    return cv2.LUT(cutout, table[None])
