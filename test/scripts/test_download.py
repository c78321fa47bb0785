"""download_sequence.py against a server on this machine."""

import errno
import io
import os
import random
import shutil
import stat
import tarfile
import zipfile

import pytest
from cpslam_tools import datasets, errors
from cpslam_tools.download import archive, progress, transfer
from cpslam_tools.download.errors import DownloadError
from http_archive import serve, tgz, zipped

WALKING = "rgbd_dataset_freiburg3_walking_xyz"
WALKING_PATH = f"/freiburg3/{WALKING}.tgz"
# Does not compress, so that there is something to break off.
CONTENT = {f"{WALKING}/rgb.txt": "1.0 rgb/1.png\n", f"{WALKING}/rgb/1.png": random.Random(1).randbytes(60000).hex()}
DATA = bytes(random.Random(2).randbytes(100_000))


@pytest.fixture
def server():
    with serve() as running:
        yield running


@pytest.fixture
def fetch(server, tmp_path):
    def run(retries=0):
        path = tmp_path / "file.bin"
        transfer.fetch(f"{server.url}/file.bin", str(path), retries, pause_s=0.0)
        return path.read_bytes()
    server.files["/file.bin"] = DATA
    return run


def names(folder):
    return sorted(os.listdir(folder))


def test_a_tgz_and_a_zip_become_folders(run_script, server, tmp_path):
    server.files[WALKING_PATH] = tgz(CONTENT)
    server.files["/rgbd_bonn_crowd.zip"] = zipped({"rgbd_bonn_crowd/rgb.txt": "2.0 rgb/2.png\n"})
    result = run_script("download_sequence.py", "fr3_walking_xyz", "crowd", "--into", tmp_path / "sets", "--mirror",
                        server.url + "/")
    assert result.returncode == 0, result.stderr
    assert names(tmp_path / "sets") == ["rgbd_bonn_crowd", WALKING]
    for name, text in CONTENT.items():
        assert (tmp_path / "sets" / name).read_text() == text
    assert "(100 %)" in result.stderr
    # Once more: nothing is asked for.
    server.requests.clear()
    result = run_script("download_sequence.py", "crowd", "--into", tmp_path / "sets", "--mirror", server.url)
    assert (result.returncode, server.requests) == (0, [])
    assert result.stdout.strip() == str(tmp_path / "sets" / "rgbd_bonn_crowd")


def test_one_that_fails_does_not_stop_the_next(run_script, server, tmp_path):
    server.files["/rgbd_bonn_crowd.zip"] = zipped({"rgb.txt": ""})
    result = run_script("download_sequence.py", WALKING, "crowd", "--into", tmp_path, "--mirror", server.url,
                        "--keep-archive")
    assert result.returncode == 1
    assert result.stderr.splitlines()[0] == \
        f"download_sequence.py: {server.url}{WALKING_PATH}: the server answered 404 Not Found"
    assert names(tmp_path) == ["rgbd_bonn_crowd", "rgbd_bonn_crowd.zip"]


def test_a_broken_transfer_goes_on_in_the_next_run(run_script, server, tmp_path):
    server.files[WALKING_PATH] = tgz(CONTENT)
    server.break_after = [20_000]
    arguments = ["download_sequence.py", WALKING, "--into", tmp_path, "--mirror", server.url, "--retries", "0"]
    result = run_script(*arguments)
    assert result.returncode == 1
    assert "the connection ended after 20000 of" in result.stderr and "to go on from 20 kB" in result.stderr
    assert WALKING not in names(tmp_path)
    result = run_script(*arguments)
    assert result.returncode == 0, result.stderr
    assert server.requests[-1] == (WALKING_PATH, "bytes=20000-")
    assert names(tmp_path) == [WALKING]
    assert (tmp_path / WALKING / "rgb" / "1.png").read_text() == CONTENT[f"{WALKING}/rgb/1.png"]


def test_a_broken_transfer_goes_on_by_itself(server, fetch):
    server.break_after = [30_000, 30_000]
    assert fetch(retries=1) == DATA
    assert [wanted for _, wanted in server.requests] == [None, "bytes=30000-", "bytes=60000-"]


def test_it_gives_up_when_nothing_comes_any_more(server, fetch):
    server.break_after = [30_000, 0, 0, 0, 0]
    with pytest.raises(DownloadError, match="ended after 30000 of 100000 bytes"):
        fetch(retries=2)
    assert len(server.requests) == 3


def test_a_file_that_changed_meanwhile_is_begun_anew(server, fetch):
    server.break_after = [30_000]
    with pytest.raises(DownloadError):
        fetch()
    server.tag, server.files["/file.bin"] = '"two"', DATA[::-1]
    assert fetch() == DATA[::-1]


def test_a_server_that_cannot_resume_sends_it_all(server, fetch):
    server.resumes, server.break_after = False, [30_000]
    assert fetch(retries=1) == DATA


@pytest.mark.parametrize("tag", [None, 'W/"weak"'])
def test_without_a_mark_of_the_file_nothing_is_pieced_together(server, fetch, tag):
    server.tag, server.break_after = tag, [30_000]
    assert fetch(retries=1) == DATA
    assert [wanted for _, wanted in server.requests] == [None, None]


def test_a_part_of_another_address_is_not_gone_on_with(server, fetch, tmp_path):
    (tmp_path / "file.bin.part").write_bytes(b"of another file")
    (tmp_path / "file.bin.part.json").write_text('{"url": "http://elsewhere/file.bin", "mark": "\\"one\\""}')
    assert fetch() == DATA
    assert names(tmp_path) == ["file.bin"]


def test_a_part_that_is_all_needs_no_server(server, fetch, tmp_path):
    (tmp_path / "file.bin.part").write_bytes(DATA)
    (tmp_path / "file.bin.part.json").write_text(f'{{"url": "{server.url}/file.bin", "mark": "x", "total": {len(DATA)}}}')
    assert fetch() == DATA and server.requests == []


def test_more_bytes_than_the_server_has_are_thrown_away(server, fetch, tmp_path):
    server.break_after, server.wrong_total = [30_000], -10
    with pytest.raises(DownloadError, match="100000 bytes came where the server said 99990"):
        fetch(retries=1)
    assert "file.bin.part" not in names(tmp_path)


def test_a_busy_server_is_asked_again_and_an_absent_file_is_not(server, fetch):
    server.statuses = [503, 503]
    assert fetch(retries=3) == DATA
    server.statuses = [404, 200]
    server.requests.clear()
    with pytest.raises(DownloadError, match="404"):
        fetch(retries=3)
    assert len(server.requests) == 1


def test_a_server_that_cannot_resume_there_any_more(server, fetch):
    server.break_after = [30_000]
    with pytest.raises(DownloadError):
        fetch()
    server.statuses = [416]
    assert fetch(retries=1) == DATA


def test_an_unreachable_server_is_one_line(run_script, tmp_path):
    result = run_script("download_sequence.py", "crowd", "--into", tmp_path, "--mirror", "http://127.0.0.1:9", "--retries", 0)
    assert result.returncode == 1
    assert result.stderr.count("\n") == 1 and "cannot reach the server: Connection refused" in result.stderr


def test_too_little_space_is_said_before(server, fetch, monkeypatch, tmp_path):
    monkeypatch.setattr(shutil, "disk_usage", lambda _: shutil._ntuple_diskusage(10**6, 10**6 - 50_000, 50_000))
    with pytest.raises(DownloadError, match=r"not enough space in .*: 100 kB are to come, 50 kB free"):
        fetch()


def test_a_disk_that_fills_up_keeps_the_part(server, fetch, monkeypatch, tmp_path):
    class FullDisk(io.FileIO):
        def write(self, data):
            if self.tell() + len(data) > 40_000:
                super().write(data[:40_000])
                raise OSError(errno.ENOSPC, "No space left on device")
            return super().write(data)

    monkeypatch.setattr("builtins.open", lambda path, mode="r", **options: (
        FullDisk(path, mode) if str(path).endswith(".part") else io.open(path, mode, **options)))
    with pytest.raises(DownloadError, match=r"no space left in .* after 40 kB: make room"):
        fetch()
    monkeypatch.undo()
    assert fetch() == DATA
    assert server.requests[-1][1] == "bytes=40000-"


@pytest.mark.parametrize("build, suffix", [(tgz, "tgz"), (zipped, "zip")])
@pytest.mark.parametrize("name", ["../evil.txt", "/tmp/evil.txt", "a/../../evil.txt", "..\\evil.txt", "C:/evil.txt"])
def test_paths_that_lead_out_are_refused(tmp_path, build, suffix, name):
    path = tmp_path / f"bad.{suffix}"
    path.write_bytes(build({"good.txt": "x", name: "evil"}))
    with pytest.raises(DownloadError, match="leads out of the folder; nothing was unpacked"):
        archive.unpack(str(path), str(tmp_path / "folder"))
    assert names(tmp_path) == [path.name]


@pytest.mark.parametrize("kind", [tarfile.SYMTYPE, tarfile.LNKTYPE, tarfile.CHRTYPE, tarfile.FIFOTYPE])
def test_links_and_devices_are_refused(tmp_path, kind):
    def spoil(member):
        member.type, member.linkname = kind, "/etc/passwd"
    path = tmp_path / "bad.tgz"
    path.write_bytes(tgz({"link": ""}, spoil))
    with pytest.raises(DownloadError, match="'link' is neither file nor folder"):
        archive.unpack(str(path), str(tmp_path / "folder"))


def test_a_link_in_a_zip_is_refused(tmp_path):
    member = zipfile.ZipInfo("link")
    member.external_attr = (stat.S_IFLNK | 0o777) << 16
    with zipfile.ZipFile(tmp_path / "bad.zip", "w") as bad:
        bad.writestr(member, "/etc/passwd")
    with pytest.raises(DownloadError, match="'link' is neither file nor folder"):
        archive.unpack(str(tmp_path / "bad.zip"), str(tmp_path / "folder"))


def test_unpacked_files_are_never_executable(tmp_path):
    path = tmp_path / "a.tgz"
    path.write_bytes(tgz({"run.sh": "x"}, lambda member: setattr(member, "mode", 0o4777)))
    archive.unpack(str(path), str(tmp_path / "folder"))
    assert not (tmp_path / "folder" / "run.sh").stat().st_mode & 0o7111


@pytest.mark.parametrize("spoil", [lambda data: data[:len(data) // 2], lambda data: b"<html>sorry</html>",
                                   lambda data: data[:-20] + bytes(20), lambda data: data[:-8] + bytes(8)])
def test_a_damaged_archive_leaves_no_folder(run_script, server, tmp_path, spoil):
    server.files[WALKING_PATH] = spoil(tgz(CONTENT))
    result = run_script("download_sequence.py", WALKING, "--into", tmp_path, "--mirror", server.url)
    assert result.returncode == 1
    assert "is damaged" in result.stderr.splitlines()[-1]
    assert names(tmp_path) == [f"{WALKING}.tgz"]


def test_an_archive_without_a_sequence(run_script, server, tmp_path):
    server.files[WALKING_PATH] = tgz({"readme.txt": "moved"})
    result = run_script("download_sequence.py", WALKING, "--into", tmp_path, "--mirror", server.url)
    assert result.returncode == 1 and "holds no sequence" in result.stderr


def test_unpacking_needs_space_as_well(tmp_path, monkeypatch):
    path = tmp_path / "a.zip"
    path.write_bytes(zipped({"rgb.txt": "x" * 5000}))
    monkeypatch.setattr(shutil, "disk_usage", lambda _: shutil._ntuple_diskusage(10**6, 10**6, 1000))
    with pytest.raises(DownloadError, match="5 kB to unpack, 1 kB free"):
        archive.unpack(str(path), str(tmp_path / "folder"))


def test_names_and_addresses():
    assert datasets.find_dataset("fr1_desk")[1:] == (datasets.TUM_URL, "freiburg1/rgbd_dataset_freiburg1_desk.tgz", "TUM1.yaml")
    assert datasets.find_dataset("bonn_synchronous2")[1:] == (datasets.BONN_URL, "rgbd_bonn_synchronous2.zip", "Bonn.yaml")
    # Not listed, but named as its makers name theirs.
    assert datasets.find_dataset("rgbd_bonn_balloon").path == "rgbd_bonn_balloon.zip"
    assert len(set(datasets.PAPER)) == 13
    for name in ("walking", "rgbd_bonn_../x", "fr4_desk", ""):
        with pytest.raises(errors.InputError, match="--list names them"):
            datasets.find_dataset(name)


def test_the_list_marks_what_is_there(run_script, tmp_path):
    (tmp_path / "rgbd_bonn_crowd").mkdir()
    result = run_script("download_sequence.py", "--list", "--into", tmp_path)
    assert "  rgbd_bonn_crowd (Bonn.yaml, on disk)" in result.stdout.splitlines()
    assert f"  {WALKING} (TUM3.yaml)" in result.stdout.splitlines()


@pytest.mark.parametrize("arguments, complaint", [([], "name a sequence"), (["nonsense"], "no sequence 'nonsense'"),
                                                  (["crowd", "--retries", "-1"], "must not be negative")])
def test_bad_options(run_script, tmp_path, arguments, complaint):
    result = run_script("download_sequence.py", *arguments, "--into", tmp_path / "sets")
    assert result.returncode == 2 and complaint in result.stderr and not (tmp_path / "sets").exists()


def test_progress_tells_the_time_left():
    times = iter([0.0, 10.0, 10.0])
    shown = progress.Progress("x.zip", 100_000_000, 20_000_000, io.StringIO(), lambda: next(times))
    shown.advance(20_000_000)
    assert shown.stream.getvalue() == "x.zip: 40 MB of 100 MB (40 %), 2 MB/s, 30 s left\n"
    assert progress.duration(125) == "2 min 05 s"
