#!/usr/bin/python3
"""Draws a cloud that --save-cloud wrote, as seen from outside and above; prints how large it is.

    plot_cloud.py room.ply -o room.png
    plot_cloud.py room.ply --elevation 90 -o floor_plan.png

What is turned away from the viewer is not drawn: walls and ceiling do not hide the room.
"""

import argparse

import numpy as np
from cpslam_tools import clouds, errors


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cloud", help="binary PLY with normals and colours")
    parser.add_argument("-o", "--output", metavar="FILE", default="cloud.png", help="picture to write (default cloud.png)")
    parser.add_argument("--azimuth", type=float, default=20.0, metavar="DEG",
                        help="from where: 0 from behind the first camera (default 20)")
    parser.add_argument("--elevation", type=float, default=50.0, metavar="DEG",
                        help="from how high: 90 is a floor plan (default 50)")
    parser.add_argument("--width", type=int, default=1200, metavar="PX", help="of the picture (default 1200)")
    parser.add_argument("--point", type=float, default=0.02, metavar="M", help="side of a point (default 0.02)")
    parser.add_argument("--beside", metavar="PICTURE", help="put this picture to the left, such as a frame of the sequence")
    options = parser.parse_args(arguments)
    if not 1 <= options.width <= 10000:
        raise errors.InputError("--width must lie in 1 to 10000")
    return options


def main(arguments):
    options = parse(arguments)
    cloud = clouds.read_ply(options.cloud)
    picture = clouds.render(cloud, options.azimuth, options.elevation, options.width, options.point)
    if options.beside:
        picture = np.concatenate([load(options.beside, picture.shape[0]), picture], axis=1)
    save(picture, options.output)
    points = clouds.columns(cloud, "x", "y", "z")
    extent = np.ptp(points, axis=0) if len(points) else np.zeros(3)
    print(f"{len(points)} points, {extent[0]:.2f} x {extent[1]:.2f} x {extent[2]:.2f} m")


def load(path, height):
    """A picture scaled to a height, with a white margin to the right."""
    try:
        from PIL import Image
    except ImportError:
        raise errors.InputError("--beside needs Pillow: sudo apt-get install python3-pil") from None
    try:
        with Image.open(path) as image:
            width = max(1, round(image.width * height / image.height))
            pixels = np.asarray(image.convert("RGB").resize((width, height), Image.LANCZOS))
    except OSError as error:
        raise errors.InputError(f"cannot read {path}: {error.strerror or 'it is no picture'}") from None
    return np.concatenate([pixels, np.full((height, height // 20 + 1, 3), clouds.WHITE, np.uint8)], axis=1)


def save(picture, path):
    try:
        from matplotlib.image import imsave
    except ImportError:
        raise errors.InputError("plots need matplotlib: sudo apt-get install python3-matplotlib") from None
    try:
        imsave(path, picture)
    except ValueError as error:
        raise errors.InputError(f"cannot write {path}: {' '.join(str(error).split())}") from None


if __name__ == "__main__":
    errors.run(main)
