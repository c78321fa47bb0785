"""How far a transfer is and how long it will take: one rewritten line on a terminal, else a line every ten percent."""

import sys
import time

from .errors import megabytes

INTERVAL_S = 0.5


class Progress:
    def __init__(self, name, total, done=0, stream=sys.stderr, clock=time.monotonic):
        """total: bytes, None when the server does not say; done: what an earlier attempt has brought."""
        self.name = name
        self.total = total
        self.done = self.first = done
        self.stream = stream
        self.clock = clock
        self.begin = self.shown_at = clock()
        self.shown_tenth = self._tenth()

    def advance(self, size):
        self.done += size
        if self.stream.isatty():
            if self.clock() - self.shown_at >= INTERVAL_S:
                self.shown_at = self.clock()
                self._write("\r" + self.line().ljust(79))
        elif self._tenth() != self.shown_tenth:
            self.shown_tenth = self._tenth()
            self._write(self.line() + "\n")

    def finish(self):
        if self.stream.isatty():
            self._write("\r" + self.line().ljust(79) + "\n")

    def line(self):
        elapsed_s = self.clock() - self.begin
        speed = (self.done - self.first) / elapsed_s if elapsed_s > 0 else 0.0
        text = f"{self.name}: {megabytes(self.done)}"
        if self.total:
            text += f" of {megabytes(self.total)} ({100 * self.done // self.total} %)"
        text += f", {megabytes(speed)}/s"
        if self.total and speed > 0 and self.done < self.total:
            text += f", {duration((self.total - self.done) / speed)} left"
        return text

    def _tenth(self):
        return 10 * self.done // self.total if self.total else self.done // 100_000_000

    def _write(self, text):
        self.stream.write(text)
        self.stream.flush()


def duration(seconds):
    minutes, seconds = divmod(round(seconds), 60)
    return f"{minutes} min {seconds:02d} s" if minutes else f"{seconds} s"
