import json
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


@pytest.fixture
def benchmark(run_script, tmp_path):
    """Runs benchmark.py around the fakes; returns the process and the JSON it wrote, None without."""
    from fakes import build_folder

    def run(*arguments):
        build = build_folder(tmp_path)
        result = run_script("benchmark.py", "--build-dir", build, "--work-dir", tmp_path / "work", "--json",
                            tmp_path / "results.json", *arguments)
        path = tmp_path / "results.json"
        return result, json.loads(path.read_text()) if path.exists() else None
    return run


def cells(markdown, *first):
    """The cells of the table row that starts with these."""
    for line in markdown.splitlines():
        row = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if row[:len(first)] == list(first):
            return row
    raise AssertionError(f"no row {first} in\n{markdown}")
