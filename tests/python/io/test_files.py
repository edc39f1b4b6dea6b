"""Files that are written: the old one or the new one whole, whoever dies or reads meanwhile."""

import os
import stat
import sys
import threading

import pytest

from asperity import InvalidInput
from asperity.cli.main import main
from asperity.io import files
from asperity.io.files import check_directory, check_output, write_files, write_whole


def at_every_line(folder, run):
    """The folder's files as a process would leave them that is killed at a line of `files`."""
    result = []

    def look(frame, event, _):
        if frame.f_code.co_filename != files.__file__:
            return None
        result.append({p.name: p.read_bytes() for p in folder.rglob("*") if p.is_file()})
        return look

    before = sys.gettrace()
    sys.settrace(look)
    try:
        run()
    finally:
        sys.settrace(before)
    return result


COMMANDS = {
    "friction": ["friction", "scene.toml", "--output", "out/a", "--plot", "out/b.png"],
    "area": ["area", "scene.toml", "--points", "5", "--output", "out/a", "--json"],
    "spectrum": [
        "spectrum",
        "scan.npy",
        "--pixel-size",
        "1e-5",
        "--unit",
        "m",
        "--output",
        "out/a",
    ],
    "map": ["map", "scene.toml", "--rtol", "0.1", "--checked", "0", "--output", "out/a"],
    "demo": ["demo", "--output", "out", "--force"],
}


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_that_is_killed_leaves_old_files_or_new_ones(folder, undrawn, capsys, command):
    out = folder / "out"
    out.mkdir(exist_ok=True)
    assert main(COMMANDS[command]) == 0
    new = {path.name: path.read_bytes() for path in out.iterdir()}
    old = {name: content + b"old" for name, content in new.items()}
    write_files({out / name: content for name, content in old.items()})
    result = at_every_line(out, lambda: main(COMMANDS[command]))
    assert len(result) > 10
    for left in result:
        kept = {name: left[name] for name in new}
        assert all(kept[name] in (old[name], new[name]) for name in new)
        strangers = set(left) - set(new)
        assert len(strangers) <= 1
        assert all(name.startswith(".asperity-") for name in strangers)
    assert result[0] == old
    assert {path.name: path.read_bytes() for path in out.iterdir()} == new
    for name in new:
        (out / name).unlink()


def test_two_writers_of_one_file_end_with_one_of_both(tmp_path):
    target = tmp_path / "a"
    contents = [bytes([number]) * 100_000 for number in range(4)]

    def write(content):
        for _ in range(25):
            write_whole(target, content)
            assert target.read_bytes() in contents

    failed: list[BaseException] = []

    def run(content):
        try:
            write(content)
        except BaseException as error:
            failed.append(error)

    threads = [threading.Thread(target=run, args=(content,)) for content in contents]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failed
    assert target.read_bytes() in contents
    assert os.listdir(tmp_path) == ["a"]


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o604, 0o755])
def test_permissions_of_a_file_stay(tmp_path, mode, monkeypatch):
    target = tmp_path / "a"
    target.write_bytes(b"old")
    target.chmod(mode)
    written = []  # the modes of the part while it is written
    monkeypatch.setattr(os, "fsync", lambda file: written.append(os.fstat(file).st_mode & 0o177))
    write_whole(target, b"new")
    assert written == [0]
    assert target.read_bytes() == b"new"
    assert stat.S_IMODE(target.stat().st_mode) == mode


def test_a_new_file_gets_what_the_process_gives_its_files(tmp_path):
    before = os.umask(0o027)
    try:
        write_whole(tmp_path / "a", b"new")
        assert os.umask(0o027) == 0o027
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == 0o640


@pytest.mark.parametrize("name", ["x" * 250, "x" * 255, "é" * 125])
def test_a_long_name_saves(tmp_path, name):
    check_output(tmp_path / name)
    write_whole(tmp_path / name, b"new")
    assert (tmp_path / name).read_bytes() == b"new"


def test_devices_and_pipes_are_written_into(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    read: list[bytes] = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()))
    reader.start()
    check_output(pipe)
    write_whole(pipe, b"new")
    reader.join()
    assert read == [b"new"]
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    null = os.stat("/dev/null")
    write_whole("/dev/null", b"new")
    assert os.path.samestat(os.stat("/dev/null"), null)
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


def test_what_a_link_leads_to_is_written(tmp_path):
    (tmp_path / "to").symlink_to("a")
    for content in (b"new", b"newer"):
        write_whole(tmp_path / "to", content)
        assert (tmp_path / "to").is_symlink()
        assert (tmp_path / "a").read_bytes() == content


@pytest.mark.parametrize("check", [check_output, lambda path: write_whole(path, b"new")])
def test_a_loop_of_links_is_refused(tmp_path, check):
    loop = tmp_path / "loop"
    if not loop.is_symlink():
        loop.symlink_to(loop)
    problem = "loop: cannot be written: Too many levels of symbolic links"
    with pytest.raises(InvalidInput, match=problem):
        check(loop)
    with pytest.raises(InvalidInput, match=r"loop: cannot be written: .*loop is no directory"):
        check_directory(loop, ["a"], force=False)
