"""What a training run says: a line every so often, one per validation."""

import sys
import time

EVERY_S = 20.0


class Report:
    def __init__(self, stream=None):
        self._stream = stream or sys.stdout
        self._last = None  # time, pictures

    def progress(self, trainer, side, total, parts):
        now = time.monotonic()
        if self._last is None:
            self._last = (now, trainer.n_pictures)
            return
        if now - self._last[0] < EVERY_S:
            return
        per_s = (trainer.n_pictures - self._last[1]) / (now - self._last[0])
        self._last = (now, trainer.n_pictures)
        left_s = (total - trainer.n_pictures) / max(per_s, 1e-9)
        losses = " ".join(f"{name} {value:.3g}" for name, value in parts.items())
        self.say(f"{trainer.n_pictures}/{total} pictures, {side} px, {per_s:.1f}/s, {duration(left_s)} left at this "
                 f"pace; {losses}")

    def validated(self, row, is_best):
        self.say(f"{row['pictures']} pictures, {row['hours']:.2f} h: AP@0.50 {row['ap']:.4f}"
                 f"{' (best)' if is_best else ''}, recall {row['recall']:.3f} precision {row['precision']:.3f} at 0.3")

    def say(self, text):
        print(f"{time.strftime('%H:%M:%S')} {text}", file=self._stream, flush=True)


def duration(seconds):
    hours, minutes = divmod(int(seconds) // 60, 60)
    return f"{hours} h {minutes:02d} min"
