"""What keeps a camera from seeing: a covered lens, or somebody who stands right in front of it."""

import os
import struct
import zlib

import numpy as np

SIZE = (640, 480)  # the simulator's
DEPTH_UNITS = 5000.0
PERSON_M = 0.7
PHASES = 6  # pictures of the person, who does not stand quite still


class LensCap:
    """Black, without depth, with nobody there."""

    name = "covered lens"

    def write(self, directory):
        width, height = SIZE
        write_png(os.path.join(directory, "covered_colour.png"), np.zeros((height, width), np.uint8))
        write_png(os.path.join(directory, "covered_depth.png"), np.zeros((height, width), np.uint16))

    def files(self, _frame):
        """Colour and depth of the so-manieth covered frame."""
        return "covered_colour.png", "covered_depth.png"

    def box(self):
        """x, y, width, height, confidence of who is there; None: nobody."""
        return None


class SomebodyInFront:
    """A chequered shirt that fills the picture and sways, at arm's length: rich in corners, and found by a detector."""

    name = "somebody in front"

    def __init__(self, seed):
        self.seed = seed

    def write(self, directory):
        random = np.random.default_rng(self.seed)
        width, height = SIZE
        # Twice as wide as the picture, so that phases are windows of it.
        shirt = _shirt(random, 2 * width, height)
        chest = PERSON_M - 0.05 * np.cos(np.linspace(-1.2, 1.2, width))[None, :]
        for phase in range(PHASES):
            shift = round(40 * np.sin(2 * np.pi * phase / PHASES)) + width // 2
            noise = random.normal(0.0, 4.0, (height, width, 3))
            colour = np.clip(shirt[:, shift:shift + width] + noise, 0, 255).astype(np.uint8)
            depth = (chest + random.normal(0.0, 0.002, (height, width))) * DEPTH_UNITS
            write_png(os.path.join(directory, f"person_colour_{phase}.png"), colour)
            write_png(os.path.join(directory, f"person_depth_{phase}.png"), depth.astype(np.uint16))

    def files(self, frame):
        return f"person_colour_{frame % PHASES}.png", f"person_depth_{frame % PHASES}.png"

    def box(self):
        return 0.0, 0.0, float(SIZE[0]), float(SIZE[1]), 0.9


def _shirt(random, width, height):
    """A tartan: stripes across stripes, with creases that break them into corners."""
    across = np.repeat(random.uniform(30, 220, (1, width // 16 + 1, 3)), 16, axis=1)[:, :width]
    down = np.repeat(random.uniform(30, 220, (height // 16 + 1, 1, 3)), 16, axis=0)[:height]
    creases = np.kron(random.uniform(0.6, 1.0, (height // 24 + 1, width // 40 + 1)), np.ones((24, 40)))
    return 0.5 * (across + down) * creases[:height, :width, None]


def write_png(path, pixels):
    """Grey pixels of 8 or 16 bits (rows, columns), or colours of 8 (rows, columns, 3)."""
    height, width = pixels.shape[:2]

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    big_endian = pixels.astype(pixels.dtype.newbyteorder(">"))
    rows = b"".join(b"\0" + row.tobytes() for row in big_endian)
    header = struct.pack(">IIBBBBB", width, height, 8 * pixels.itemsize, 2 if pixels.ndim == 3 else 0, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
