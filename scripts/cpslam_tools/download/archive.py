"""Unpacking .tgz and .zip archives of others: only plain files and folders, only below the given folder."""

import errno
import gzip
import os
import shutil
import stat
import tarfile
import zipfile
import zlib

from .errors import DownloadError, megabytes


def unpack(archive, folder):
    """Unpacks into the folder, which is made. The names of all members are checked before any is written: a path
    that leads outside, a link or a device makes it fail. Raises DownloadError; what was written stays."""
    opened = _Zip if zipfile.is_zipfile(archive) else _Tar
    try:
        with opened(archive) as members:
            entries = list(members)
            for name, *_ in entries:
                _inside(archive, name)
            _check_space(folder, sum(size for _, size, _ in entries))
            os.makedirs(folder, exist_ok=True)
            for name, _, source in entries:
                _write(members, source, os.path.join(folder, _inside(archive, name)))
    except (tarfile.TarError, gzip.BadGzipFile, zipfile.BadZipFile, zlib.error, EOFError) as error:
        reason = " ".join(str(error).split())
        raise DownloadError(f"{archive} is damaged ({reason}): remove it and download it again") from None
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        raise DownloadError(f"no space left in {os.path.dirname(folder)} while unpacking {archive}") from None


def _inside(archive, name):
    """The member's path below the folder."""
    parts = name.replace("\\", "/").split("/")
    if name.startswith(("/", "\\")) or ".." in parts or ":" in parts[0]:
        raise DownloadError(f"{archive}: refused, '{name[:100]}' leads out of the folder; nothing was unpacked")
    return os.path.join(*[part for part in parts if part not in ("", ".")] or ["."])


def _check_space(folder, size):
    parent = os.path.dirname(os.path.abspath(folder))
    free = shutil.disk_usage(parent).free
    if size > free:
        raise DownloadError(f"not enough space in {parent}: {megabytes(size)} to unpack, {megabytes(free)} free")


def _write(members, source, path):
    """source: the archive's own record of a file, None for a folder."""
    if source is None:
        os.makedirs(path, exist_ok=True)
        return
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with members.open(source) as data, open(path, "wb") as file:
        shutil.copyfileobj(data, file, 1 << 20)


class _Tar:
    """Yields (name, size, record); so does _Zip."""

    def __init__(self, path):
        self.path = path
        self.tar = tarfile.open(path, "r:*")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.tar.close()

    def __iter__(self):
        for member in self.tar:
            if not (member.isreg() or member.isdir()):
                raise DownloadError(f"{self.path}: refused, '{member.name[:100]}' is neither file nor folder; "
                                    "nothing was unpacked")
            yield member.name, member.size, member if member.isreg() else None
        # tarfile stops at the archive's end mark; the checksum of the compressed whole comes after it.
        while self.tar.fileobj.read(1 << 20):
            pass

    def open(self, record):
        return self.tar.extractfile(record)


class _Zip:
    def __init__(self, path):
        self.path = path
        self.zip = zipfile.ZipFile(path)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.zip.close()

    def __iter__(self):
        for member in self.zip.infolist():
            # orig_filename: before zipfile has made it harmless.
            name, kind = member.orig_filename, stat.S_IFMT(member.external_attr >> 16)
            if kind not in (0, stat.S_IFREG, stat.S_IFDIR):
                raise DownloadError(f"{self.path}: refused, '{name[:100]}' is neither file nor folder; "
                                    "nothing was unpacked")
            yield name, member.file_size, None if member.is_dir() else member

    def open(self, record):
        return self.zip.open(record)
