"""Folders that are locked while their process lives, and removed after it."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from asperity.io.aside import folder_beside, locked_folder, remove_left

pytest.importorskip("fcntl")

HOLD = """
import sys, time
from pathlib import Path
from asperity.io.aside import folder_beside
with folder_beside(Path(sys.argv[1])) as folder:
    (folder / "store").mkdir()
    print(folder, flush=True)
    time.sleep(60)
"""


def aged(folder):
    """As if it had been made an hour ago."""
    before = time.time() - 3600
    os.utime(folder, (before, before))
    return folder


def test_folders_of_a_killed_process_go_and_those_of_a_living_one_stay(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path / "a.zarr")], stdout=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout is not None
        held = aged(Path(process.stdout.readline().strip()))
        with folder_beside(tmp_path / "b.zarr") as mine:
            assert mine.is_dir()
        assert held.is_dir()
        assert not mine.exists()
    finally:
        process.send_signal(signal.SIGKILL)
        process.communicate()
    assert held.is_dir()
    with folder_beside(tmp_path / "b.zarr"):
        pass
    assert list(tmp_path.iterdir()) == []


def test_what_is_not_ours_stays(tmp_path):
    foreign, young, link = (
        tmp_path / f".asperity-{name}" for name in ("settings", "12345678", "l")
    )
    (foreign / "key").mkdir(parents=True)
    young.mkdir()
    link.symlink_to(foreign)
    for folder in (foreign, foreign / "key"):
        aged(folder)
    with folder_beside(tmp_path / "a.zarr"):
        pass
    assert {foreign, young, link} == set(tmp_path.iterdir())


def test_a_closed_folder_is_free(tmp_path):
    folder, handle = locked_folder("asperity-app-", tmp_path)
    remove_left(tmp_path, "asperity-app-")
    aged(folder)
    remove_left(tmp_path, "asperity-app-")
    assert folder.is_dir()
    os.close(handle)
    remove_left(tmp_path, "asperity-app-")
    assert not folder.exists()
