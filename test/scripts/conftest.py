import os
import subprocess
import sys

import pytest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path.insert(0, SCRIPTS)


@pytest.fixture
def run_script():
    """Runs a script as a user does; returns the finished process with its text output."""
    def run(name, *arguments, **options):
        command = [os.path.join(SCRIPTS, name), *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False, **options)
    return run


@pytest.fixture
def write(tmp_path):
    """Writes lines into a file of the test's directory and returns its path."""
    def write_lines(name, lines):
        path = tmp_path / name
        path.write_text("".join(f"{line}\n" for line in lines))
        return path
    return write_lines
