"""What trials share: a run as the plan wants it, and sequences that are there only while they are used."""

from ..errors import InputError
from .runs import run_rgbd_tum


def run_on(plan, sequence, mode, **options):
    options.setdefault("max_frames", plan.max_frames)
    return run_rgbd_tum(plan.programs, sequence, mode, plan.output_dir, timeout_s=plan.timeout_s, **options)


def on_sequence(sequence, trial, **labels):
    """Runs a trial on a sequence; a sequence that cannot be had is one failed result, not the end."""
    try:
        with sequence.ready() as ready:
            for result in trial(ready):
                yield {**result, **labels}
    except (InputError, OSError) as error:
        yield {"sequence": sequence.name, "mode": "-", "status": None, "error": str(error), **labels}
