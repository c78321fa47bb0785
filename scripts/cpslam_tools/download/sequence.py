"""A sequence from the server to a folder that is either complete or not there."""

import os
import shutil

from .archive import unpack
from .errors import DownloadError
from .transfer import fetch


def download(dataset, into, mirror=None, keep_archive=False, retries=5):
    """Returns the sequence's folder; does nothing when it is there. mirror: a server that has the archives by the
    same relative paths."""
    folder = os.path.join(into, dataset.name)
    if os.path.isdir(folder):
        return folder
    os.makedirs(into, exist_ok=True)
    archive = os.path.join(into, os.path.basename(dataset.path))
    if not os.path.exists(archive):
        fetch(f"{(mirror or dataset.server).rstrip('/')}/{dataset.path}", archive, retries)
    temporary = os.path.join(into, f".{dataset.name}.unpacking")
    shutil.rmtree(temporary, ignore_errors=True)
    try:
        unpack(archive, temporary)
        os.replace(_root(temporary, archive), folder)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
    if not keep_archive:
        os.remove(archive)
    return folder


def _root(folder, archive):
    """Where rgb.txt is: usually in one folder at the top of the archive."""
    for candidate in [folder, *sorted(entry.path for entry in os.scandir(folder) if entry.is_dir())]:
        if os.path.isfile(os.path.join(candidate, "rgb.txt")):
            return candidate
    raise DownloadError(f"{archive} holds no sequence: there is no rgb.txt in it")
