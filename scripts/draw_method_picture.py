#!/usr/bin/python3
"""Draws docs/pictures/people_filter.png: a simulated frame with its boxes, what the filter takes for people in the depth
image, and which keypoints are kept.

    draw_method_picture.py [--bin DIR] [-o FILE] [--work-dir DIR]

Everything in it comes from simulate_tum and rgbd_tum. --draw is the only way out for the people's mask: it is read off
the tint there.
"""

import argparse
import os
import subprocess
import tempfile

import numpy as np
from cpslam_tools import errors
from PIL import Image, ImageDraw, ImageFilter, ImageFont

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FRAME = 75  # somebody near in mid-stride, a chair before him, screens beside him, three others behind
STAMP = f"{1000 + FRAME / 30:.6f}"
DEPTH_UNITS_PER_M = 5000
FARTHEST_M = 5.0
CAPTION_PX = 18  # --draw writes its numbers there
PANEL = (440, 318)
# Red, green, blue, and the weight, of Examples/common/frame_painter.cpp.
TINTS = ((0, 80, 255), (200, 0, 255), (0, 220, 255), (255, 140, 0), (120, 120, 255), (120, 40, 180))
TINT_WEIGHT = 0.4
BOX_COLOUR = (255, 220, 0)
BLACK = 40


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", metavar="DIR", default=os.path.join(ROOT, "build", "release", "bin"))
    parser.add_argument("-o", "--output", metavar="FILE",
                        default=os.path.join(ROOT, "docs", "pictures", "people_filter.png"))
    parser.add_argument("--work-dir", metavar="DIR", help="keep the sequence and the frames there")
    return parser.parse_args(arguments)


def simulate_and_track(bin_dir, work_dir):
    sequence, drawn = os.path.join(work_dir, "sequence"), os.path.join(work_dir, "drawn")
    run(bin_dir, "simulate_tum", "walking_xyz", sequence, "--people", "4", "--noise", "--seed", "2", "--frames",
        str(FRAME + 1), "--quiet", "--force")
    run(bin_dir, "rgbd_tum", "-", os.path.join(sequence, "settings.yaml"), sequence, "--sequential", "--quiet",
        "--boxes", os.path.join(sequence, "person_boxes.txt"), "--draw", drawn, "--output", work_dir)
    return sequence, os.path.join(drawn, f"{STAMP}.jpg")


def run(bin_dir, program, *arguments):
    try:
        subprocess.run([os.path.join(bin_dir, program), *arguments], check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise errors.InputError(f"{program}: {error}") from None


def boxes(sequence):
    """Left, top, right, bottom of the frame's boxes."""
    for line in open(os.path.join(sequence, "person_boxes.txt"), encoding="utf-8"):
        stamp, *numbers = line.split()
        if stamp == STAMP:
            x, y, width, height = map(float, numbers[:4])
            yield x, y, x + width, y + height


def people_mask(colour, drawn):
    """Number of the tint that explains each pixel, 0 where the picture was left as it is."""
    plain, seen = np.asarray(colour, float), np.asarray(drawn, float)
    choices = [plain] + [(1 - TINT_WEIGHT) * plain + TINT_WEIGHT * np.array(tint) for tint in TINTS]
    mask = np.argmin([np.abs(choice - seen).sum(axis=2) for choice in choices], axis=0)
    mask[seen.sum(axis=2) < BLACK] = 0  # labels
    # Keypoints and lines are small, people are not.
    return np.asarray(Image.fromarray(mask.astype(np.uint8)).filter(ImageFilter.ModeFilter(13)))


def depth_panel(sequence, mask):
    depth_m = np.asarray(Image.open(os.path.join(sequence, "depth", f"{STAMP}.png")), float) / DEPTH_UNITS_PER_M
    grey = np.where(depth_m > 0, 235 - 200 * np.clip(depth_m / FARTHEST_M, 0, 1), 0)
    panel = np.repeat(grey[:, :, None], 3, axis=2)
    for number, tint in enumerate(TINTS, 1):
        panel[mask == number] = 0.55 * panel[mask == number] + 0.45 * np.array(tint)
    return Image.fromarray(panel.astype(np.uint8))


def compose(panels):
    margin, caption = 6, 22
    width = len(panels) * (PANEL[0] + margin) - margin
    picture = Image.new("RGB", (width, PANEL[1] + caption), "white")
    draw = ImageDraw.Draw(picture)
    for number, (panel, text) in enumerate(panels):
        left = number * (PANEL[0] + margin)
        below_caption = panel.crop((0, CAPTION_PX, panel.width, panel.height))
        picture.paste(below_caption.resize(PANEL, Image.LANCZOS), (left, 0))
        draw.text((left + 4, PANEL[1] + 5), text, fill="black", font=font())
    return picture.quantize(160, dither=Image.NONE)  # a third of the size


def font():
    import matplotlib
    return ImageFont.truetype(os.path.join(matplotlib.get_data_path(), "fonts", "ttf", "DejaVuSans.ttf"), 13)


def draw_picture(options, work_dir):
    sequence, drawn_path = simulate_and_track(options.bin, work_dir)
    colour = Image.open(os.path.join(sequence, "rgb", f"{STAMP}.png")).convert("RGB")
    drawn = Image.open(drawn_path).convert("RGB")
    boxed = colour.copy()
    for box in boxes(sequence):
        ImageDraw.Draw(boxed).rectangle(box, outline=BOX_COLOUR, width=3)
    panels = [(boxed, "the image and the detector's boxes"),
              (depth_panel(sequence, people_mask(colour, drawn)), "depth (dark: far), and whose it is"),
              (drawn, "keypoints: kept green (bright: on the map), removed red")]
    os.makedirs(os.path.dirname(os.path.abspath(options.output)), exist_ok=True)
    compose(panels).save(options.output, optimize=True)


def main(arguments):
    options = parse(arguments)
    if options.work_dir:
        draw_picture(options, options.work_dir)
    else:
        with tempfile.TemporaryDirectory() as work_dir:
            draw_picture(options, work_dir)
    return 0


if __name__ == "__main__":
    errors.run(main)
