"""One file over HTTP, resumed where an earlier attempt ended (RFC 9110, section 14)."""

import errno
import http.client
import json
import os
import re
import shutil
import time
import urllib.error
import urllib.request

from .errors import DownloadError, megabytes
from .progress import Progress

BLOCK = 1 << 18
TIMEOUT_S = 60
LONGEST_PAUSE_S = 30


def fetch(url, path, retries=5, pause_s=2.0):
    """Downloads to path, through path + ".part". What has arrived stays when it fails, and is gone on with when the
    server still has the same file. Checks the size that the server names. Raises DownloadError."""
    failures = 0
    while True:
        before = _size(path + ".part")
        try:
            _attempt(url, path + ".part")
            break
        except (http.client.HTTPException, urllib.error.URLError, ConnectionError, TimeoutError, _Broken) as error:
            # What came through shows that the connection is worth going on with.
            failures = 1 if _size(path + ".part") > before else failures + 1
            if failures > retries:
                raise DownloadError(f"{url}: {_reason(error)}; run the same command again to go on from "
                                    f"{megabytes(_size(path + '.part'))}") from None
            time.sleep(min(pause_s * 2**(failures - 1), LONGEST_PAUSE_S))
    os.replace(path + ".part", path)
    _remove(path + ".part.json")


class _Broken(Exception):
    """The connection ended before the file did."""


def _attempt(url, part):
    have = _size(part)
    origin = _read_origin(part) if have else {}
    if have and origin.get("url") == url and origin.get("total") == have:
        return
    # Without a mark of the server's file there is no telling whether the rest belongs to what is here.
    if origin.get("url") != url or not origin.get("mark"):
        have = 0
    headers = {"User-Agent": "cpslam-download", "Accept-Encoding": "identity"}
    if have:
        headers.update({"Range": f"bytes={have}-", "If-Range": origin["mark"]})
    try:
        response = urllib.request.urlopen(urllib.request.Request(url, headers=headers), timeout=TIMEOUT_S)
    except urllib.error.HTTPError as error:
        error.close()
        if error.code == 416 and have:
            _remove(part)
            raise _Broken("the file on the server has changed") from None
        if error.code in (408, 429) or error.code >= 500:
            raise _Broken(f"the server answered {error.code} {error.reason}") from None
        raise DownloadError(f"{url}: the server answered {error.code} {error.reason}") from None
    with response:
        have, total = _extent(response, have)
        _write_origin(part, url, response, total)
        _check_space(part, total, have)
        _receive(response, url, part, have, total)


def _extent(response, have):
    """(bytes that are kept, bytes of the whole file or None). A server that does not resume sends it all."""
    if response.status == 206:
        match = re.fullmatch(r"bytes (\d+)-\d+/(\d+|\*)", response.headers.get("Content-Range", ""))
        if not match or int(match.group(1)) != have:
            raise DownloadError(f"{response.url}: the server resumes at another place than asked; remove the .part file")
        return have, None if match.group(2) == "*" else int(match.group(2))
    length = response.headers.get("Content-Length")
    return 0, int(length) if length else None


def _receive(response, url, part, have, total):
    progress = Progress(os.path.basename(url), total, have)
    try:
        with open(part, "ab" if have else "wb") as file:
            while block := _read(response):
                file.write(block)
                progress.advance(len(block))
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        raise DownloadError(f"no space left in {os.path.dirname(os.path.abspath(part))} after "
                            f"{megabytes(_size(part))}: make room and run the same command again to go on") from None
    finally:
        progress.finish()
    size = _size(part)
    if total is not None and size < total:
        raise _Broken(f"the connection ended after {size} of {total} bytes")
    if total is not None and size > total:
        _remove(part)
        raise DownloadError(f"{url}: {size} bytes came where the server said {total}")


def _read(response):
    try:
        return response.read(BLOCK)
    except OSError as error:
        raise _Broken(f"the connection broke: {error}") from None


def _check_space(part, total, have):
    folder = os.path.dirname(os.path.abspath(part))
    free = shutil.disk_usage(folder).free
    if total is not None and total - have > free:
        raise DownloadError(f"not enough space in {folder}: {megabytes(total - have)} are to come, "
                            f"{megabytes(free)} free")


def _write_origin(part, url, response, total):
    """What is needed to go on later. A weak ETag is not enough for that (RFC 9110, 13.1.5)."""
    tag = response.headers.get("ETag", "")
    mark = tag if tag and not tag.startswith("W/") else response.headers.get("Last-Modified")
    with open(part + ".json", "w", encoding="utf-8") as file:
        json.dump({"url": url, "mark": mark, "total": total}, file)


def _read_origin(part):
    try:
        with open(part + ".json", encoding="utf-8") as file:
            origin = json.load(file)
            return origin if isinstance(origin, dict) else {}
    except (OSError, ValueError):
        return {}


def _reason(error):
    if isinstance(error, urllib.error.URLError):
        return f"cannot reach the server: {getattr(error.reason, 'strerror', None) or error.reason}"
    return str(error) or type(error).__name__


def _size(path):
    try:
        return os.path.getsize(path)
    except FileNotFoundError:
        return 0


def _remove(path):
    try:
        os.remove(path)
    except FileNotFoundError:
        pass
