"""A server on localhost with the manners and bad manners of real ones."""

import contextlib
import http.server
import io
import re
import tarfile
import threading
import zipfile


class Server:
    """files: {path: bytes}. The switches take effect at once."""

    def __init__(self):
        self.files = {}
        self.break_after = []  # of the next answers: bytes after which the connection ends
        self.statuses = []  # of the next answers: a status instead of the file
        self.resumes = True  # understands Range
        self.tag = '"one"'  # ETag, which If-Range is compared with
        self.wrong_total = 0  # added to the size in Content-Range
        self.requests = []  # (path, Range header or None)
        self.url = None


@contextlib.contextmanager
def serve():
    server = Server()

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            wanted = self.headers.get("Range")
            server.requests.append((self.path, wanted))
            if server.statuses:
                return self.send_error(server.statuses.pop(0))
            if self.path not in server.files:
                return self.send_error(404)
            return self._send(server.files[self.path], wanted)

        def _send(self, data, wanted):
            begin = 0
            if wanted and server.resumes and self.headers.get("If-Range") == server.tag:
                begin = int(re.fullmatch(r"bytes=(\d+)-", wanted).group(1))
            self.send_response(206 if begin else 200)
            if begin:
                self.send_header("Content-Range", f"bytes {begin}-{len(data) - 1}/{len(data) + server.wrong_total}")
            if server.tag:
                self.send_header("ETag", server.tag)
            self.send_header("Content-Length", str(len(data) - begin))
            self.end_headers()
            end = server.break_after.pop(0) if server.break_after else len(data)
            self.wfile.write(data[begin:begin + end])

        def log_message(self, *_):
            pass

    http_server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.url = f"http://127.0.0.1:{http_server.server_address[1]}"
    thread = threading.Thread(target=http_server.serve_forever, args=(0.01,), daemon=True)
    thread.start()
    try:
        yield server
    finally:
        http_server.shutdown()
        http_server.server_close()
        thread.join()


def tgz(files, edit=None):
    """An archive of {name: text}; edit(member) may spoil a member."""
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w:gz") as archive:
        for name, text in files.items():
            member = tarfile.TarInfo(name)
            member.size = len(text)
            if edit:
                edit(member)
            archive.addfile(member, io.BytesIO(text.encode()))
    return data.getvalue()


def zipped(files):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return data.getvalue()
