"""Starting the built programs: a time limit, Ctrl-C, and errors in one line."""

import os
import subprocess


class Programs:
    """The programs of one build directory."""

    def __init__(self, build_dir):
        self.folder = os.path.join(build_dir, "bin")

    def path(self, name):
        return os.path.join(self.folder, name)

    def has(self, name):
        return os.access(self.path(name), os.X_OK)

    def matching(self, prefix):
        names = os.listdir(self.folder) if os.path.isdir(self.folder) else []
        return sorted(name for name in names if name.startswith(prefix) and self.has(name))


class Finished:
    """status: exit status, negative for a signal; error: one line, None when the status is 0."""

    def __init__(self, status, stdout, stderr, error):
        self.status = status
        self.stdout = stdout
        self.stderr = stderr
        self.error = error


def execute(command, timeout_s, environment=None):
    """Runs a command to its end. Never raises for what the command does; a Ctrl-C is passed on after the command,
    which gets it as well, had ten seconds to save its work."""
    command = [str(argument) for argument in command]
    try:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, errors="replace", env={**os.environ, **(environment or {})})
    except OSError as error:
        return Finished(None, "", "", f"{command[0]}: {error.strerror}")
    try:
        stdout, stderr = process.communicate(timeout=timeout_s)
    except subprocess.TimeoutExpired:
        process.kill()
        stdout, stderr = process.communicate()
        return Finished(process.returncode, stdout, stderr, f"killed after {timeout_s:g} s")
    except KeyboardInterrupt:
        _let_finish(process)
        raise
    return Finished(process.returncode, stdout, stderr, _complaint(process.returncode, stderr))


def _let_finish(process):
    try:
        process.communicate(timeout=10)
    except (subprocess.TimeoutExpired, KeyboardInterrupt):
        process.kill()
        process.communicate()


def _complaint(status, stderr):
    if status == 0:
        return None
    how = f"signal {-status}" if status < 0 else f"status {status}"
    lines = [line.strip() for line in stderr.splitlines() if line.strip()]
    return f"{how}: {lines[-1][:200]}" if lines else how
