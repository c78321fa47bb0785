"""What cameras and light do to a picture: colour, brightness, blur, noise, compression. Boxes stay as they are."""

import cv2
import numpy as np


def change_light(picture, generator):
    """Hue, saturation, contrast, gamma; at times all colour is lost. uint8 B,G,R in and out."""
    if generator.random() < 0.1:
        grey = cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY)
        picture = cv2.cvtColor(grey, cv2.COLOR_GRAY2BGR)
    elif generator.random() < 0.7:
        picture = change_colour(picture, generator)
    level = np.arange(256, dtype=np.float32) / 255
    gain, lift = generator.uniform(0.7, 1.3), generator.uniform(-0.1, 0.1)
    gamma = np.exp(generator.uniform(-0.45, 0.45))
    table = np.clip((level ** gamma - 0.5) * gain + 0.5 + lift, 0, 1) * 255
    return cv2.LUT(picture, table.astype(np.uint8))


def change_colour(picture, generator):
    hue, saturation = generator.uniform(-9, 9), generator.uniform(0.4, 1.7)
    hsv = cv2.cvtColor(picture, cv2.COLOR_BGR2HSV)
    level = np.arange(256)
    table = np.stack([(level + hue) % 180, np.clip(level * saturation, 0, 255), level], -1).astype(np.uint8)
    return cv2.cvtColor(cv2.LUT(hsv, table[None]), cv2.COLOR_HSV2BGR)


def blur(picture, generator):
    """Out of focus, or along the line a hand-held camera moves."""
    longest = max(3.0, max(picture.shape) / 24)
    if generator.random() < 0.4:
        sigma = generator.uniform(0.4, longest / 6 + 0.4)
        return cv2.GaussianBlur(picture, (0, 0), sigma)
    length = generator.uniform(2, longest)
    side = int(np.ceil(length)) | 1
    kernel = np.zeros((side, side), np.float32)
    angle, middle = generator.uniform(0, np.pi), side // 2
    step = np.array([np.cos(angle), np.sin(angle)]) * (length - 1) / 2
    ends = [tuple(int(v) for v in np.round((middle + sign * step) * 16)) for sign in (-1, 1)]
    cv2.line(kernel, ends[0], ends[1], 1.0, 1, cv2.LINE_AA, 4)
    return cv2.filter2D(picture, -1, kernel / kernel.sum(), borderType=cv2.BORDER_REFLECT_101)


def add_noise(picture, generator):
    noise = np.empty(picture.shape, np.int16)
    cv2.setRNGSeed(int(generator.integers(1 << 31)))
    sigma = generator.uniform(2, 14)
    cv2.randn(noise, 0, sigma)
    return cv2.add(picture, noise, dtype=cv2.CV_8U)


def compress(picture, generator):
    quality = int(generator.integers(25, 80))
    return cv2.imdecode(cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])[1], cv2.IMREAD_COLOR)


def weather(picture, generator):
    """A picture as it may have been taken on another day by another camera."""
    picture = change_light(picture, generator)
    for chance, change in ((0.2, blur), (0.15, add_noise), (0.1, compress)):
        if generator.random() < chance:
            picture = change(picture, generator)
    return picture
