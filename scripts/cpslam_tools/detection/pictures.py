"""Reading pictures. Pillow comes with matplotlib and is loaded when it is needed."""

from ..errors import InputError


def open_picture(path):
    """A PIL.Image, not decoded yet."""
    try:
        from PIL import Image
    except ImportError:
        raise InputError("pictures need Pillow: sudo apt-get install python3-pil") from None
    try:
        return Image.open(path)
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or 'not a picture'}") from None


def picture_size(path):
    with open_picture(path) as image:
        return image.size
