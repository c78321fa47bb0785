"""What goes wrong on the way: the server, the connection, the disk, a damaged archive. One line each."""


class DownloadError(OSError):
    """The program fails while running (exit 1), and running it again may help."""

    def __init__(self, text):
        super().__init__(text)
        self.text = text

    def __str__(self):
        return self.text


def megabytes(size):
    return f"{size / 1e6:.0f} MB" if size >= 1e6 else f"{size / 1e3:.0f} kB"
