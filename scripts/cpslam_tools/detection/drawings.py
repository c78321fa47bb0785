"""Pictures of where detections and ground truth differ."""

import os
import re

import numpy as np

from ..errors import InputError
from ..output import make_folder
from .evaluation import people_found, wrong_detections
from .pictures import open_picture

GREEN, YELLOW, BLUE, RED, GREY = (0, 210, 0), (255, 220, 0), (60, 140, 255), (255, 30, 30), (150, 150, 150)


def draw_differences(folder, scenes, threshold):
    """Writes every picture in which somebody was missed or a detection is wrong; returns how many. Reference boxes are
    green, yellow when missed, grey when they do not count; detections blue, red when wrong."""
    make_folder(folder)
    written = 0
    for scene in scenes:
        found, wrong = people_found(scene, threshold), wrong_detections(scene, threshold)
        if np.all(found | scene.ignored) and not np.any(wrong):
            continue
        try:
            image = open_picture(scene.picture.path).convert("RGB")
            _draw(image, scene, threshold, found, wrong)
            image.save(os.path.join(folder, _name(scene.picture)), quality=90)
        except OSError as error:
            raise InputError(f"cannot draw {scene.picture.path} into {folder}: {error}") from None
        written += 1
    return written


def _draw(image, scene, threshold, found, wrong):
    from PIL import ImageDraw
    draw = ImageDraw.Draw(image)
    for box, is_found, is_ignored in zip(scene.people, found, scene.ignored):
        _rectangle(draw, box, GREY if is_ignored else GREEN if is_found else YELLOW, 3)
    for box, score, is_wrong in zip(scene.detections, scene.scores, wrong):
        if score < threshold:
            continue
        colour = RED if is_wrong else BLUE
        _rectangle(draw, box, colour, 1)
        draw.text((box[0] + 3, box[1] + 2), f"{score:.2f}", fill=colour)


def _rectangle(draw, box, colour, width):
    x, y, w, h = (float(value) for value in box)
    draw.rectangle([x, y, x + w, y + h], outline=colour, width=width)


def _name(picture):
    stem = os.path.splitext(os.path.basename(picture.path))[0]
    return f"{picture.time_s:.6f}.jpg" if picture.time_s is not None else re.sub(r"[^\w.-]", "_", stem) + ".jpg"
