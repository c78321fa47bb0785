"""One way for every script to fail: one line on stderr; 2 for bad usage or input, 1 for a failure while running."""

import os
import sys


class InputError(Exception):
    """The caller's input is wrong: a file, a line, an option. The text is one line."""


def run(main):
    """Calls main(arguments) and exits the process with its status."""
    try:
        status = main(sys.argv[1:])
        sys.stdout.flush()
    except InputError as error:
        fail(error, 2)
    except BrokenPipeError:
        # The reader (head, less) went away. Point stdout elsewhere, or Python complains again when it exits.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    except OSError as error:
        fail(error, 1)
    except KeyboardInterrupt:
        fail("interrupted", 1)
    sys.exit(status or 0)


def fail(message, status):
    print(f"{os.path.basename(sys.argv[0])}: {message}", file=sys.stderr)
    sys.exit(status)
