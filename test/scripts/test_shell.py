"""The shell scripts, with a package manager, a CMake and programs that only pretend."""

import os
import subprocess

import pytest
from conftest import ROOT, SCRIPTS
from fakes import install

# All packages but those in MISSING are installed; calls are written to CALLS.
DPKG_QUERY = '''#!/bin/bash
for package in $MISSING; do [[ "${@: -1}" == "$package" ]] && exit 1; done
echo -n installed
'''
RECORDER = '''#!/bin/bash
echo "$(basename "$0") $*" >> "$CALLS"
'''


@pytest.fixture
def shell(tmp_path):
    """Runs a script with stand-ins first in PATH; returns the process and the calls they received."""
    bin_dir, calls = tmp_path / "fake_bin", tmp_path / "calls"
    install(bin_dir / "dpkg-query", DPKG_QUERY)
    for name in ("apt-get", "cmake", "ctest"):
        install(bin_dir / name, RECORDER)
    # Whoever runs the tests: as root sudo is not asked, else it is and passes on.
    install(bin_dir / "sudo", '#!/bin/bash\nexec "$@"\n')

    def run(script, *arguments, missing="", system='ID=debian\nVERSION_ID="12"\nPRETTY_NAME="Debian 12"\n', cwd="/"):
        (tmp_path / "os-release").write_text(system)
        environment = {**os.environ, "PATH": f"{bin_dir}:{os.environ['PATH']}", "MISSING": missing,
                       "CALLS": str(calls), "CPSLAM_OS_RELEASE": str(tmp_path / "os-release")}
        process = subprocess.run([script, *arguments], capture_output=True, text=True, cwd=cwd, env=environment,
                                 timeout=60, check=False, stdin=subprocess.DEVNULL)
        return process, calls.read_text().splitlines() if calls.exists() else []
    return run


def script(name):
    return os.path.join(SCRIPTS, name)


def test_nothing_is_touched_when_nothing_is_missing(shell):
    process, calls = shell(script("install_dependencies.sh"))
    assert process.returncode == 0 and calls == []


def test_only_the_missing_packages_are_installed(shell):
    process, calls = shell(script("install_dependencies.sh"), missing="libceres-dev cmake")
    assert process.returncode == 0, process.stderr
    assert calls == ["apt-get update", "apt-get install --yes --no-install-recommends cmake libceres-dev"]


def test_missing_packages_can_be_listed(shell):
    process, calls = shell(script("install_dependencies.sh"), "--missing", missing="libceres-dev")
    assert (process.stdout, calls) == ("libceres-dev\n", [])
    process, _ = shell(script("install_dependencies.sh"), "--missing")
    assert (process.returncode, process.stdout) == (0, "")


@pytest.mark.parametrize("system, known", [
    ('ID=ubuntu\nVERSION_ID="24.04"\n', True),
    ('ID=ubuntu\nVERSION_ID="26.04"\n', True),
    ('ID=ubuntu\nVERSION_ID="22.04"\n', False),
    ('ID=debian\nVERSION_ID="11"\n', False),
    ('ID=debian\nVERSION_ID="13"\n', True),
    ('ID=fedora\nVERSION_ID=40\nPRETTY_NAME="Fedora Linux 40"\n', False),
    ("", False),
])
def test_other_systems_are_told_what_to_install(shell, system, known):
    process, calls = shell(script("install_dependencies.sh"), missing="libceres-dev", system=system)
    assert process.returncode == (0 if known else 2)
    assert bool(calls) == known
    if not known:
        assert "only Debian 12 and Ubuntu 24.04" in process.stderr and "libceres-dev" in process.stderr


def test_what_training_needs_is_installed_where_it_is_missing(shell):
    process, calls = shell(script("training/install.sh"))
    assert process.returncode == 0 and calls == []
    process, calls = shell(script("training/install.sh"), missing="python3-torch")
    assert process.returncode == 0, process.stderr
    assert calls == ["apt-get update", "apt-get install --yes --no-install-recommends python3-torch"]
    process, calls = shell(script("training/install.sh"), "--all")
    assert process.returncode == 2 and "unknown option '--all'" in process.stderr


def test_a_failing_package_manager_ends_the_script(shell, tmp_path):
    install(tmp_path / "fake_bin" / "apt-get", "#!/bin/bash\nexit 100\n")
    process, _ = shell(script("test.sh"), missing="cmake")
    assert process.returncode == 100


def test_tests_are_built_and_run_from_any_directory(shell):
    process, calls = shell(os.path.join(ROOT, ".ci", "run"), cwd="/tmp")
    assert process.returncode == 0, process.stderr
    jobs = calls[-1].split()[-1]
    assert 1 <= int(jobs) <= os.cpu_count()
    assert calls == ["cmake --preset release", f"cmake --build --preset release --parallel {jobs}",
                     f"ctest --preset release --parallel {jobs}"]


def test_sanitizers_are_a_flag(shell):
    _, calls = shell(script("test.sh"), "--sanitizers", "--no-install")
    assert [call.split()[2] for call in calls if call.startswith("ctest")] == ["asan", "tsan", "release"]


def test_failing_tests_fail_the_script(shell, tmp_path):
    install(tmp_path / "fake_bin" / "ctest", "#!/bin/bash\necho '1 tests failed out of 2'\nexit 8\n")
    process, _ = shell(script("test.sh"), "--no-install")
    assert process.returncode == 8
    assert process.stdout.splitlines()[-1] == "1 tests failed out of 2"


def test_a_failing_build_fails_the_script(shell, tmp_path):
    install(tmp_path / "fake_bin" / "cmake", '#!/bin/bash\n[[ "$1" == --preset ]] || exit 3\n')
    process, calls = shell(script("test.sh"), "--no-install")
    assert process.returncode == 3 and calls == []


@pytest.mark.parametrize("name", ["demo.sh", "test.sh", "install_dependencies.sh"])
def test_unknown_options_are_refused(shell, name):
    process, calls = shell(script(name), "--frobnicate")
    assert process.returncode == 2 and calls == []
    assert process.stderr.count("\n") == 1 and "--frobnicate" in process.stderr


@pytest.mark.parametrize("network, options, detector", [
    (False, [], "--boxes {output}/sequence/person_boxes.txt"), (True, [], "--detector yolo"),
    (True, ["--exact-boxes"], "--boxes {output}/sequence/person_boxes.txt")])
def test_demo_goes_from_nothing_to_a_picture(shell, tmp_path, network, options, detector):
    # A copy of the scripts, so that the demo's output does not land in the real tree.
    root = tmp_path / "root"
    root.mkdir()
    subprocess.run(["cp", "-r", SCRIPTS, root], check=True)
    if network:
        install(root / "models" / "yc.weights", "")
    walk, astray = ("".join(f"{i / 10} {scale * i / 10} {(i % 5) / 5} 0 0 0 0 1\n" for i in range(40))
                    for scale in (1.0, 1.2))
    install(root / "build/release/bin/simulate_tum",
            f'#!/bin/bash\necho "simulate_tum $*" >> "$CALLS"\nmkdir -p "$2"\nprintf "{walk!s}" > "$2/groundtruth.txt"\n')
    # Goes astray without the people's boxes.
    install(root / "build/release/bin/rgbd_tum", f"""#!/bin/bash
echo "rgbd_tum $*" >> "$CALLS"
mkdir -p "$5"
if [[ " $* " != *" --detector none "* ]]; then cp "$3/groundtruth.txt" "$5/CameraTrajectory.txt"
else printf "{astray!s}" > "$5/CameraTrajectory.txt"; fi
""")
    output = root / "demo_output"
    (output / "pictures").mkdir(parents=True)
    (output / "pictures" / "of_an_earlier_run.jpg").touch()
    process, calls = shell(str(root / "scripts" / "demo.sh"), "--frames", "40", "--people", "5", "--no-install", *options)
    assert process.returncode == 0, process.stderr
    assert calls[1].endswith("--target simulate_tum rgbd_tum")
    assert calls[2].startswith("simulate_tum walking_")
    assert calls[2].endswith(f"{output}/sequence --frames 40 --noise --seed 1 --force --people 5")
    assert calls[3:] == [
        f"rgbd_tum - {output}/sequence/settings.yaml {output}/sequence --output {output}/filter --seed 1 "
        f"{detector.format(output=output)} --draw {output}/pictures",
        f"rgbd_tum - {output}/sequence/settings.yaml {output}/sequence --output {output}/no_filter --seed 1 --detector none"]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in process.stdout.splitlines() if "|" in line]
    assert rows[2][:3] == ["CP-SLAM", "40", "0.0000"]
    assert rows[3][:2] == ["no filter", "40"] and float(rows[3][2]) > 0.1
    assert (output / "trajectory.png").read_bytes().startswith(b"\x89PNG")
    assert str(output / "trajectory.png") in process.stdout
    assert not (output / "pictures" / "of_an_earlier_run.jpg").exists()


def test_a_failing_simulation_ends_the_demo(shell, tmp_path):
    root = tmp_path / "root"
    root.mkdir()
    subprocess.run(["cp", "-r", SCRIPTS, root], check=True)
    install(root / "build/release/bin/simulate_tum", '#!/bin/bash\necho "simulate_tum $*" >> "$CALLS"\nexit 9\n')
    process, calls = shell(str(root / "scripts" / "demo.sh"), "--preset", "office_xyz", "--no-install")
    assert process.returncode == 9
    assert calls[2].startswith("simulate_tum office_xyz") and calls[2].endswith("--force")
