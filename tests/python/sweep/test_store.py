"""Stores: what is written can be opened, resumed, and told from that of another sweep."""

import errno
import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.sweep import chunks, existing, run, store, task
from helpers.cases import case
from helpers.sweeps import SCENE as STIFF

xarray = pytest.importorskip("xarray", reason="a sweep needs asperity[sweep]")
zarr = pytest.importorskip("zarr", reason="a store needs asperity[sweep]")
pytest.importorskip("netCDF4", reason="a store needs asperity[sweep]")

SCENE = STIFF | {  # 3 MPa at most, for pressures that squash it
    "rubber": {
        "equilibrium_modulus_pa": 3e6,
        "moduli_pa": [1e7, 2e7],
        "relaxation_times_s": [1e-6, 1e-4],
    }
}
OVER = {
    "surface.hurst": [0.7, 0.8, 0.9],
    "road": {"correction.kind": ["none", "s-factor"], "surface.rms_height_m": [1e-4, 2e-4]},
    "conditions.pressure_pa": [1e5, 2e5, 9e8],  # the last squashes a soft rubber
}
CUT = (1, 1, 2, 7)
BOTH = ["mu", "hysteresis"]
ENDED = 4  # boxes that are written before the driver ends


def sweep(scene, over, **more):
    """Two of the variables, which are written sooner than all."""
    return asperity.sweep(scene, over, **{"variables": BOTH, **more})


@pytest.fixture(autouse=True)
def _small_boxes(monkeypatch, tmp_path):
    monkeypatch.setattr(run, "cut_of", lambda *_: CUT)
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="module")
def expected():
    return sweep(SCENE, OVER)


def same(result, expected):
    assert set(result.data_vars) == set(expected.data_vars)
    assert set(result.coords) == set(expected.coords)
    for name, one in expected.variables.items():
        assert result[name].dims == one.dims
        if one.dtype.kind in "UT":
            assert result[name].values.tolist() == one.values.tolist()
        else:
            assert np.array_equal(result[name], one, equal_nan=one.dtype.kind == "f"), name
            assert result[name].dtype == one.dtype
    for name in ("notes", "failed", "sweep", "title"):
        assert result.attrs[name] == expected.attrs[name], name


@pytest.mark.parametrize("name", ["a.zarr", "a.nc"])
def test_plain_xarray_opens_a_store(name, expected):
    with sweep(SCENE, OVER, store=name) as returned:
        same(returned, expected)
    engine = "netcdf4" if name == "a.nc" else "zarr"
    with xarray.open_dataset(name, engine=engine) as opened:
        same(opened, expected)
        assert opened.mu.attrs == {"units": "1", "long_name": "friction coefficient"}
        assert opened["surface.rms_height_m"].attrs["units"] == "m"
        assert opened.attrs["complete"] == 1
        hurst = opened.mu.sel({"surface.hurst": 0.8, "road": "s-factor"})
        assert np.isfinite(hurst[:2]).all()
        assert opened.attrs["failed"] == 3 * 2 * 7
        code = opened.failure.values[0, 0, 2, 0]
        message = str(opened.failure_message.sel(failure_code=code).values)
        assert "must be at most 10 times" in message
    assert os.listdir() == [name]


class Ended(BaseException):
    """As a signal ends a driver: nothing is cleaned up by it."""


def ended_after(monkeypatch, boxes):
    """Let the driver end in the middle of writing a box, after so many whole ones."""
    plain = store.ZarrStore.write
    written = []

    def write(self, outcome):
        if len(written) == boxes:
            half = self.group["mu"]
            half[tuple(slice(s, s + c) for s, c in zip(outcome.start, CUT, strict=True))] = 7.0
            self._journal._file.write(b'{"start": [')
            raise Ended
        written.append(outcome.start)
        plain(self, outcome)

    monkeypatch.setattr(store.ZarrStore, "write", write)
    return written, plain


def counting(monkeypatch, computed):
    """Let a list have the boxes that are computed."""
    work = run.work
    monkeypatch.setattr(run, "work", lambda task: (computed.append(task.start), work(task))[1])


@pytest.mark.parametrize("name", ["a.zarr", "a.nc"])
def test_resume_computes_what_is_missing(name, expected, monkeypatch):
    written, plain = ended_after(monkeypatch, ENDED)
    with pytest.raises(Ended):
        sweep(SCENE, OVER, store=name)
    part = name if name == "a.zarr" else "a.nc.part"
    assert os.listdir() == [part]
    with xarray.open_dataset(part, engine="zarr") as result:
        assert result.attrs["complete"] == 0
    monkeypatch.setattr(store.ZarrStore, "write", plain)
    computed = []
    counting(monkeypatch, computed)
    with sweep(SCENE, OVER, store=name, resume=True) as result:
        same(result, expected)
    assert len(written) == ENDED
    assert not set(computed) & set(written)
    assert len(computed) == 3 * 2 * 2 - ENDED
    with sweep(SCENE, OVER, store=name, resume=True) as again:
        same(again, expected)
    assert len(computed) == 3 * 2 * 2 - ENDED
    assert os.listdir() == [name]


def test_a_box_whose_numbers_are_not_those_of_its_line_is_computed_again(expected, monkeypatch):
    with sweep(SCENE, OVER, store="a.zarr"):
        pass
    lines = Path("a.zarr/_sweep/journal").read_text().splitlines()
    assert len(lines) == 12
    assert len({json.loads(line)["digest"] for line in lines}) == 12
    array = zarr.open_group("a.zarr", mode="r+")["hysteresis"]
    array[2, 1, 0, 0] += 1e-16
    array[1, 0, 0, :2] = array[1, 0, 0, :2][::-1]  # the same numbers in another order
    zarr.open_group("a.zarr", mode="r+")["failure"][0, 1, 0, 0] = 7  # where nothing fails
    chunks = sorted(os.listdir("a.zarr/mu/c/0/0/0"))
    os.remove(f"a.zarr/mu/c/0/0/0/{chunks[0]}")
    computed = []
    counting(monkeypatch, computed)
    with sweep(SCENE, OVER, store="a.zarr", resume=True) as result:
        same(result, expected)
    assert sorted(computed) == [(0, 0, 0, 0), (0, 1, 0, 0), (1, 0, 0, 0), (2, 1, 0, 0)]


@pytest.mark.parametrize("name", ["a.zarr", "a.nc"])
def test_the_store_of_another_sweep_is_refused_by_its_key(name):
    with sweep(SCENE, OVER, store=name):
        pass
    before = {path: os.path.getmtime(path) for path, _, _ in os.walk(".")}
    rubber = {**SCENE["rubber"], "equilibrium_modulus_pa": 4e6}
    for key, scene, over, variables in (
        (
            "rubber.equilibrium_modulus_pa is 3000000.0 there and 4000000.0 here",
            SCENE | {"rubber": rubber},
            OVER,
            None,
        ),
        ("over surface.hurst is", SCENE, OVER | {"surface.hurst": [0.7, 0.8, 0.95]}, None),
        (
            "solver.rtol is null there and 1e-05 here",
            SCENE | {"solver": {"rtol": 1e-5}},
            OVER,
            None,
        ),
        ("variables is", SCENE, OVER, ["mu"]),
        ('over is ["surface.hurst", "road"', SCENE, dict(reversed(OVER.items())), None),
    ):
        with case(key=key):
            with pytest.raises(asperity.InvalidInput, match="is the store of another") as no:
                sweep(scene, over, store=name, resume=True, variables=variables or BOTH)
            assert key in str(no.value)
            assert "\n" not in str(no.value)
    with pytest.raises(asperity.InvalidInput, match="exists already"):
        sweep(SCENE, OVER, store=name)
    assert before == {path: os.path.getmtime(path) for path, _, _ in os.walk(".")}


def test_what_is_no_store_is_refused_and_stays(tmp_path):
    (tmp_path / "a.zarr").mkdir()
    (tmp_path / "a.zarr" / "mine").write_text("text")
    (tmp_path / "b.nc").write_text("text")
    for name in ("a.zarr", "b.nc"):
        for resume in (False, True):
            with pytest.raises(asperity.InvalidInput, match=name):
                sweep(SCENE, OVER, store=name, resume=resume)
    for name in ("a.zarr", "gone/a.zarr"):
        with pytest.raises(asperity.InvalidInput):
            sweep(SCENE, {"surface.hurst": []}, store=name)
    with pytest.raises(asperity.InvalidInput, match="gone does not exist"):
        sweep(SCENE, OVER, store="gone/a.zarr")
    with pytest.raises(asperity.InvalidInput, match=r"must end in \.zarr or \.nc"):
        sweep(SCENE, OVER, store="a.csv")
    assert (tmp_path / "a.zarr" / "mine").read_text() == "text"
    assert sorted(os.listdir()) == ["a.zarr", "b.nc"]


def test_a_worker_that_does_not_see_the_store_sends_its_numbers(expected, monkeypatch):
    sent = []
    plain = store.ZarrStore.write
    monkeypatch.setattr(
        store.ZarrStore, "write", lambda self, one: (sent.append(one.contents), plain(self, one))
    )
    with sweep(SCENE, OVER, store="a.zarr") as result:
        same(result, expected)
    assert sent == [None] * 12
    monkeypatch.setattr(task, "_sees", lambda *_: False)
    with sweep(SCENE, OVER, store="b.zarr") as result:
        same(result, expected)
    assert all(sent[12:])
    assert [*map(bool, sent[12])] == [True, True, False]  # no file where nothing fails
    lines = [Path(name, "_sweep/journal").read_text() for name in ("a.zarr", "b.zarr")]
    assert lines[0] == lines[1]


def test_two_drivers_do_not_write_to_one_store(monkeypatch):
    _, plain = ended_after(monkeypatch, 3)
    with pytest.raises(Ended):
        sweep(SCENE, OVER, store="a.zarr")
    monkeypatch.setattr(store.ZarrStore, "write", plain)
    with open("a.zarr/_sweep/journal", "r+b") as journal:
        fcntl = pytest.importorskip("fcntl")
        fcntl.flock(journal, fcntl.LOCK_EX)
        with pytest.raises(asperity.InvalidInput, match="another sweep is writing"):
            sweep(SCENE, OVER, store="a.zarr", resume=True)
    with sweep(SCENE, OVER, store="a.zarr", resume=True) as result:
        assert result.attrs["complete"] == 1


@pytest.mark.parametrize("full", ["hysteresis", "journal"])
def test_a_full_disk_ends_in_a_line_and_can_be_resumed(full, expected, monkeypatch):
    """Half of a file is written, which has to be no box."""
    plain = {"hysteresis": chunks.os.replace, "journal": existing.Journal.add}[full]
    count = []

    def replace(part, file):
        if file.parent.is_relative_to(f"{os.getcwd()}/a.zarr/hysteresis"):
            count.append(1)
            if len(count) > 3:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        plain(part, file)

    def add(self, line):
        count.append(1)
        if len(count) > 3:
            os.write(self._file.fileno(), line[:30])
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        plain(self, line)

    with monkeypatch.context() as patched:
        if full == "journal":
            patched.setattr(existing.Journal, "add", add)
        else:
            patched.setattr(chunks.os, "replace", replace)
        with pytest.raises(asperity.Error, match=r"a\.zarr: cannot be written: No space") as told:
            sweep(SCENE, OVER, store="a.zarr")
    assert "\n" not in str(told.value)
    assert not list(Path("a.zarr").rglob("*.partial"))
    computed = []
    counting(monkeypatch, computed)
    with sweep(SCENE, OVER, store="a.zarr", resume=True) as result:
        same(result, expected)
    assert len(computed) == 12 - 3


def test_netcdf_that_cannot_be_written_leaves_what_can_be_resumed(expected, monkeypatch):
    def full(*_, **__):
        raise RuntimeError("NetCDF: HDF error")  # as it says of a full disk

    with monkeypatch.context() as patched:
        patched.setattr(xarray.Dataset, "to_netcdf", full)
        with pytest.raises(asperity.Error, match=r"a\.nc: cannot be written: NetCDF"):
            sweep(SCENE, OVER, store="a.nc")
    assert os.listdir() == ["a.nc.part"]
    with sweep(SCENE, OVER, store="a.nc", resume=True) as result:
        same(result, expected)


def test_a_file_that_changes_ends_the_sweep(tmp_path, monkeypatch):
    road = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=1e4, q1=3e5)
    for seed in (1, 2, 3):
        heights = asperity.synthesize(road, shape=(40, 40), pixel_size=1e-5, seed=seed).heights
        np.save(f"{seed}.npy", heights)
    scene = SCENE | {"surface": {"pixel_size_m": 1e-5, "unit": "m"}}
    over = {"surface.file": ["1.npy", "2.npy", "3.npy"]}
    monkeypatch.setattr(run, "cut_of", lambda *_: (1, 7))
    plan = run.planned(scene, over)
    shutil.copy("1.npy", "3.npy")
    monkeypatch.setattr(run, "planned", lambda *_: plan)
    with pytest.raises(asperity.InvalidInput, match=r"3\.npy: was changed while the sweep ran"):
        sweep(scene, over, store="a.zarr")
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path)
    with pytest.raises(asperity.InvalidInput, match=r"content of .*3\.npy is"):
        sweep(scene, over, store="a.zarr", resume=True)
    os.remove("2.npy")
    with pytest.raises(asperity.InvalidInput, match=r"2\.npy: cannot be read: No such file"):
        sweep(scene, over, store="b.zarr")
    assert not os.path.exists("b.zarr")
