"""Stores that were damaged, removed or taken by others while a sweep knew them."""

import os
import shutil
from pathlib import Path

import pytest

import asperity
from asperity.cli.main import main
from asperity.sweep import existing, run, store
from helpers.cases import case
from helpers.sweeps import SCENE, toml

xarray = pytest.importorskip("xarray", reason="a sweep needs asperity[sweep]")
zarr = pytest.importorskip("zarr", reason="a store needs asperity[sweep]")
pytest.importorskip("netCDF4", reason="a store needs asperity[sweep]")

OVER = {"surface.hurst": [0.7, 0.8, 0.9]}
JOURNAL, TOKEN = "_sweep/journal", "_sweep/token"
SWEEP = """
scene = "scene.toml"
variables = ["mu"]
[over]
surface.hurst = [0.7, 0.8, 0.9]
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(run, "cut_of", lambda *_: (1, 7))
    (tmp_path / "scene.toml").write_text(toml(SCENE))
    (tmp_path / "sweep.toml").write_text(SWEEP)
    return tmp_path


def sweep(**more):
    return asperity.sweep(SCENE, OVER, variables=["mu"], store="a.zarr", **more)


def refused(capsys, *line, status=2):
    assert main(["sweep", "sweep.toml", *line]) == status
    err = capsys.readouterr().err
    assert len(err.splitlines()) == 1
    return err


def lines_with(journal, changed):
    lines = journal.read_bytes().splitlines(keepends=True)
    return b"".join([lines[0], changed(lines[1]), lines[2]])


def test_damage_is_told_in_a_line_and_nothing_is_changed():
    with sweep():
        pass
    shutil.copytree("a.zarr", "whole.zarr")
    for damage, said in {
        "torn": "line 2 of _sweep/journal is none of this sweep",
        "list": "line 2 of _sweep/journal is none of this sweep",
        "foreign": "line 2 of _sweep/journal is none of this sweep",
        "box": "line 2 of _sweep/journal is none of this sweep",
        "journal": "is damaged: _sweep/journal cannot be opened: No such file",
        "token": "is damaged: _sweep/token cannot be read",
        "array": "is damaged: KeyError",
        "shape": "is damaged: the shape of mu",
    }.items():
        shutil.rmtree("a.zarr")
        shutil.copytree("whole.zarr", "a.zarr")
        journal = Path("a.zarr", JOURNAL)
        if damage == "torn":
            journal.write_bytes(lines_with(journal, lambda line: line[: len(line) // 2] + b"\n"))
        elif damage == "list":
            journal.write_bytes(lines_with(journal, lambda line: b"[1]\n"))
        elif damage == "foreign":
            journal.write_bytes(
                lines_with(journal, lambda line: line.replace(b"[1, 0]", b"[2, 0]"))
            )
        elif damage == "box":
            journal.write_bytes(
                lines_with(journal, lambda line: line.replace(b"[1, 7]", b"[1, 6]"))
            )
        elif damage in ("journal", "token"):
            os.remove(journal if damage == "journal" else Path("a.zarr", TOKEN))
        elif damage == "array":
            shutil.rmtree("a.zarr/mu")
        else:
            group = zarr.open_group("a.zarr", mode="r+", use_consolidated=False)
            group.create_array("mu", shape=(3, 8), chunks=(1, 7), dtype="f8", overwrite=True)
        before = journal.read_bytes() if journal.exists() else None
        with case(damage=damage):
            with pytest.raises(asperity.InvalidInput, match=said) as told:
                sweep(resume=True)
            assert "\n" not in str(told.value)
            assert before == (journal.read_bytes() if journal.exists() else None)


def test_a_last_line_that_was_not_ended_or_is_damaged_is_dropped():
    with sweep() as expected:
        mu = expected.mu.values
    journal = Path("a.zarr", JOURNAL)
    content = journal.read_bytes()
    last = content.splitlines(keepends=True)[-1]
    damaged = last.replace(b"start", b"stars")
    for rest in (content[:-20], content + b"\0" * 4096, content[: -len(last)] + damaged):
        journal.write_bytes(rest)
        with sweep(resume=True) as result:
            assert result.mu.values.tolist() == mu.tolist()
        assert journal.read_bytes().startswith(content)
    journal.write_bytes(content.splitlines(keepends=True)[0] + b"\0" * 4096)
    with sweep(resume=True) as result:
        assert result.mu.values.tolist() == mu.tolist()
    assert journal.read_bytes() == content  # nothing is left of a line that was longer


@pytest.mark.parametrize("boxes", [0, 1, 3])
def test_a_driver_whose_store_was_replaced_ends(boxes, monkeypatch):
    """Where locks do not reach: it neither writes into the new store nor calls it whole."""
    plain = run.work
    computed = []

    def work(task):
        if len(computed) == boxes:
            replace()
        computed.append(task.start)
        return plain(task)

    def replace():
        shutil.rmtree("a.zarr")
        shutil.copytree("other.zarr", "a.zarr")

    with asperity.sweep(SCENE, {"surface.hurst": [0.6, 0.65, 0.66]}, store="other.zarr"):
        pass
    if boxes == 3:
        finish = store.ZarrStore.finish
        monkeypatch.setattr(store.ZarrStore, "finish", lambda self: (replace(), finish(self))[1])
    else:
        monkeypatch.setattr(run, "work", work)
    with pytest.raises(asperity.Error, match=r"a\.zarr: was removed or replaced"):
        sweep()
    for root, _, names in os.walk("other.zarr"):
        for name in names:
            path = Path(root, name)
            assert Path("a.zarr", path.relative_to("other.zarr")).read_bytes() == path.read_bytes()


def test_force_leaves_a_store_that_another_sweep_writes(capsys):
    fcntl = pytest.importorskip("fcntl")
    with sweep():
        pass
    with open(Path("a.zarr", JOURNAL), "r+b") as journal:
        fcntl.flock(journal, fcntl.LOCK_EX)
        said = refused(capsys, "--output", "a.zarr", "--force")
    assert "a.zarr: another sweep is writing to it" in said
    with xarray.open_dataset("a.zarr") as result:
        assert result.attrs["complete"] == 1


def test_force_removes_nothing_before_the_new_sweep_is_known_to_work(folder, capsys):
    for name in ("a.zarr", "a.nc"):
        with asperity.sweep(SCENE, OVER, store=name):
            pass
    (folder / "sweep.toml").write_text(SWEEP.replace("hurst", "hurts"))
    assert "did you mean" in refused(capsys, "--output", "a.zarr", "--force")
    text = SWEEP.replace("hurst = [0.7, 0.8, 0.9]", "q1_per_m = [1.5e3, 1.6e3]")  # both below q0
    (folder / "sweep.toml").write_text(text)
    for name in ("a.zarr", "a.nc"):
        assert "q1" in refused(capsys, "--output", name, "--force")
        with xarray.open_dataset(name) as result:
            assert result.sizes["surface.hurst"] == 3
    (folder / "sweep.toml").write_text(SWEEP)
    for name in ("a.zarr", "a.nc"):
        assert main(["sweep", "sweep.toml", "--output", name, "--force"]) == 0
        with xarray.open_dataset(name) as result:
            assert "hysteresis" not in result
    assert sorted(os.listdir()) == ["a.nc", "a.zarr", "scene.toml", "sweep.toml"]


def test_force_removes_no_file_of_somebody_else(folder, capsys):
    (folder / "mine.nc").write_text("text")
    xarray.Dataset({"x": 1.0}).to_netcdf("other.nc")
    xarray.Dataset({"x": 1.0}).to_zarr("other.zarr", zarr_format=3, consolidated=False)
    with sweep():
        pass
    os.symlink("a.zarr", "link.zarr")
    for name in ("mine.nc", "other.nc", "other.zarr", "link.zarr"):
        with case(name=name):
            said = refused(capsys, "--output", name, "--force")
            assert f"{name}: is no store of a sweep: remove it yourself" in said
            assert os.path.lexists(name)
    assert os.path.exists("a.zarr/mu")


def test_a_store_that_cannot_be_removed_is_told(monkeypatch, capsys):
    with sweep():
        pass

    def full(*_):
        raise OSError(13, "Permission denied")

    monkeypatch.setattr(existing.os, "rename", full)
    said = refused(capsys, "--output", "a.zarr", "--force", status=1)
    assert "a.zarr: cannot be removed: Permission denied" in said
    with xarray.open_dataset("a.zarr") as result:
        assert result.attrs["complete"] == 1
