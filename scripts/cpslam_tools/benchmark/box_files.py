"""Files of person boxes, and boxes made worse on purpose. A box is (stamp, x, y, width, height, confidence): the
stamp is text, so that it stays what the sequence says; pixels, top-left corner."""

import os

from ..errors import InputError
from ..output import write_text
from ..trajectory import read_rows

HEADER = "# person boxes: timestamp x y width height confidence (px, top-left corner)\n"


def read_boxes(path):
    boxes = []
    for number, fields in read_rows(path):
        try:
            x, y, width, height, confidence = map(float, fields[1:])
        except ValueError:
            raise InputError(f"{path}:{number}: expected timestamp x y width height confidence") from None
        boxes.append((fields[0], x, y, width, height, confidence))
    return boxes


def write_boxes(path, boxes):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    rows = (f"{stamp} " + " ".join(f"{value:.2f}" for value in values[:4]) + f" {values[4]:.3f}\n"
            for stamp, *values in boxes)
    write_text(path, HEADER + "".join(rows))


def read_stamps(path):
    """The stamps of a list like rgb.txt, as text."""
    return [fields[0] for _, fields in read_rows(path)]


def jittered(boxes, generator, jitter=0.1, missing=0.1):
    """Every box is missing with the given probability; of those left, each side of length s moves by up to
    jitter * s, uniformly: width for left and right, height for top and bottom."""
    kept = []
    for stamp, x, y, width, height, confidence in boxes:
        drop = generator.random() < missing
        left, right, top, bottom = generator.uniform(-jitter, jitter, 4)
        if not drop:
            kept.append((stamp, x + left * width, y + top * height, width * (1.0 + right - left),
                         height * (1.0 + bottom - top), confidence))
    return kept


def false_boxes(stamps, generator, image_size, share=0.3):
    """Boxes of people who are not there: on the given share of the frames, at random, one or two of a person's
    proportions (0.3 to 0.9 of the image's height, a third to two thirds as wide as high), wholly in the image."""
    image_width, image_height = image_size
    boxes = []
    for stamp in stamps:
        if generator.random() >= share:
            continue
        for _ in range(generator.integers(1, 3)):
            height = generator.uniform(0.3, 0.9) * image_height
            width = generator.uniform(1 / 3, 2 / 3) * height
            x, y = generator.uniform(0, image_width - width), generator.uniform(0, image_height - height)
            boxes.append((stamp, x, y, width, height, generator.uniform(0.3, 0.9)))
    return boxes
