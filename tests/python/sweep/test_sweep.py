"""A sweep is the plain loop over its scenes: same numbers, whichever way it is cut."""

import json
import time
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

import asperity
from asperity.scene.kept import Kept
from asperity.sweep import parts, plan, run
from helpers.sweeps import COLUMNS, HEATED, RUBBER, SCENE, measured, plain_loop

xarray = pytest.importorskip("xarray", reason="a sweep needs asperity[sweep]")

OVER = {
    "correction.kind": ["none", "s-factor", "partial-contact"],
    "conditions.pressure_pa": [1e5, 2e5, 4e5, 5e5],
    "surface.hurst": [0.7, 0.8, 0.9],
}
SINGLE = {key: {key: values} for key, values in OVER.items()}


@pytest.fixture(scope="module")
def swept():
    return asperity.sweep(SCENE, OVER)


def same(result, expected, names=None):
    for name in names or expected.data_vars:
        kind = expected[name].dtype.kind
        assert np.array_equal(result[name], expected[name], equal_nan=kind == "f"), name


def test_it_is_the_plain_loop(swept):
    assert swept.mu.dims == (*OVER, "conditions.velocity_m_s")
    for name, values in plain_loop(SCENE, SINGLE).items():
        assert np.array_equal(swept[name], values), name
    for key, values in OVER.items():
        assert swept[key].values.tolist() == values
    assert swept["conditions.velocity_m_s"].attrs["units"] == "m/s"
    assert swept.mu.attrs["units"] == "1"
    assert swept.attrs["failed"] == 0
    assert "flash heating" in swept.attrs["notes"]
    assert json.loads(swept.attrs["sweep"])["rubber.moduli_pa"] == RUBBER["moduli_pa"]
    assert np.isfinite(swept.model_error.sel({"correction.kind": "partial-contact"})).any()


CUTS = [(1, 1, 1, 1), (3, 4, 3, 7), (2, 3, 2, 4), (1, 4, 1, 7), (3, 1, 3, 2)]


@pytest.mark.parametrize("cut", CUTS)
def test_numbers_and_notes_do_not_depend_on_the_cut(swept, cut, monkeypatch):
    monkeypatch.setattr(run, "cut_of", lambda *_: cut)
    result = asperity.sweep(SCENE, OVER)
    same(result, swept)
    assert result.attrs == swept.attrs


class LastFirst:
    """An executor of one thread that takes the latest of the tasks that wait."""

    _max_workers = 5

    def __init__(self):
        self._waiting = []
        self.order = []
        self._pool = ThreadPoolExecutor(1)

    def submit(self, function, *arguments):
        future = Future()
        self._waiting.append((future, function, arguments))
        self._pool.submit(self._one)
        return future

    def _one(self):
        time.sleep(0.01)
        future, function, arguments = self._waiting.pop()
        self.order.append(arguments[0].start)
        future.set_result(function(*arguments))


@pytest.mark.parametrize("kind", ["threads", "processes", "last first"])
def test_numbers_do_not_depend_on_the_executor(swept, kind, monkeypatch):
    monkeypatch.setattr(run, "cut_of", lambda *_: (2, 2, 2, 4))
    if kind == "threads":
        with ThreadPoolExecutor(4) as pool:
            result = asperity.sweep(SCENE, OVER, executor=pool)
    elif kind == "processes":
        with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
            result = asperity.sweep(SCENE, OVER, executor=pool)
    else:
        pool = LastFirst()
        result = asperity.sweep(SCENE, OVER, executor=pool)
        tasks = pool.order[-16:]
        assert tasks != sorted(tasks)
    same(result, swept)


def test_axes_are_zipped_under_a_name(swept):
    together = {"road": {"surface.hurst": [0.7, 0.9], "surface.rms_height_m": [2e-4, 1e-4]}}
    result = asperity.sweep(SCENE, {**together, "conditions.pressure_pa": [1e5, 3e5]})
    assert result.mu.dims == ("road", "conditions.pressure_pa", "conditions.velocity_m_s")
    assert result["surface.rms_height_m"].dims == ("road",)
    loop = plain_loop(
        SCENE, {**together, "p": {"conditions.pressure_pa": [1e5, 3e5]}}, columns=("mu",)
    )
    assert np.array_equal(result.mu, loop["mu"])
    pairs = {"at": {"conditions.pressure_pa": [1e5, 4e5], "conditions.velocity_m_s": [1e-6, 1e-6]}}
    result = asperity.sweep(SCENE, pairs)
    assert result.mu.dims == ("at",)
    where = {"correction.kind": 0, "surface.hurst": 1, "conditions.velocity_m_s": 0}
    assert np.array_equal(result.mu, swept.mu.isel(where)[[0, 2]])


def test_lists_of_the_scene_are_dimensions_and_axes_take_their_place():
    scene = SCENE | {"conditions": {"pressure_pa": [1e5, 2e5], "velocity_m_s": [1e-3, 1e-2]}}
    assert asperity.sweep(scene, {}).mu.dims == (
        "conditions.pressure_pa",
        "conditions.velocity_m_s",
    )
    result = asperity.sweep(scene, {"conditions.velocity_m_s": [1e-2, 1e-1, 1.0]})
    assert result.mu.shape == (3, 2)
    alone = SCENE | {"conditions": {"pressure_pa": 1e5, "velocity_m_s": 1e-2}}
    assert asperity.sweep(alone, {}).mu.shape == ()
    assert float(asperity.sweep(alone, {}).mu) == result.mu.values[0, 0]


def test_files_are_an_axis_and_each_is_read_once(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = {
        "surface": {"pixel_size_m": 1e-5, "unit": "m"},
        "rubber": {"extrapolation": "power-law"},
        "conditions": SCENE["conditions"],
        "correction": {"kind": "local-peaks", "min_distance_m": 5e-5},
    }
    for seed in (1, 2):
        road = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=1e4, q1=3e5)
        np.save(
            f"{seed}.npy",
            asperity.synthesize(road, shape=(64, 64), pixel_size=1e-5, seed=seed).heights,
        )
    for k, name in enumerate(("soft.csv", "hard.csv")):
        measured(tmp_path / name, np.geomspace(1e-4, 1e12, 60), 1 + k)
    over = {
        "surface.file": ["1.npy", "2.npy"],
        "rubber.master_curve": ["soft.csv", "hard.csv"],
        "conditions.pressure_pa": [1e5, 2e5],
    }
    built = []
    for name in ("build_surface", "build_rubber", "build_correction"):
        plain = getattr(asperity.scene.scene, name)

        def counted(path, table, *more, name=name, plain=plain):
            built.append(name)
            return plain(path, table, *more)

        monkeypatch.setattr(parts, name, counted)
    monkeypatch.setattr(run, "cut_of", lambda *_: (1, 1, 1, 3))
    result = asperity.sweep(scene, over)
    loop = plain_loop(scene, {key: {key: one} for key, one in over.items()}, tmp_path)
    for name in COLUMNS:
        assert np.array_equal(result[name], loop[name]), name
    assert sorted(built) == ["build_correction"] * 2 + ["build_rubber"] * 2 + ["build_surface"] * 2
    assert len(json.loads(result.attrs["sweep"])) > 10
    assert sum("sha" in key or "content" in key for key in json.loads(result.attrs["sweep"])) == 4


def test_heat_and_temperatures_are_in_it():
    conditions = {"pressure_pa": 1e5, "velocity_m_s": [1e-3, 1.0], "temperature_c": 20}
    scene = HEATED | {"conditions": conditions}
    over = {"conditions.temperature_c": [10.0, 40.0], "heating.contact_diameter_m": [1e-3, 2e-3]}
    result = asperity.sweep(scene, over)
    loop = plain_loop(
        scene,
        {key: {key: one} for key, one in over.items()},
        columns=("mu", "mu_cold", "hot_temperature"),
    )
    assert np.array_equal(result.mu, loop["mu"])
    assert np.array_equal(result.mu_cold, loop["mu_cold"])
    assert np.array_equal(result.temperature, loop["hot_temperature"])
    kelvin = asperity.sweep(scene, {"conditions.temperature_k": [283.15, 313.15]})
    assert np.array_equal(kelvin.mu, result.mu[:, 0])


def test_a_band_has_two_variables(folder):
    tables = {
        "surface": {"file": "scan.npy", "pixel_size_m": [2e-5, 1e-5], "unit": "m"},
        "rubber": RUBBER,
        "conditions": {"velocity_m_s": [1e-3, 1e-2, 1e-1], "pressure_pa": [1e5, 2e5]},
        "uncertainty": {"samples": 20},
    }
    result = asperity.sweep(tables, {"correction.kind": ["none", "partial-contact"]})
    for k, kind in enumerate([None, {"kind": "partial-contact"}]):
        one = tables if kind is None else tables | {"correction": kind}
        made = asperity.scene.scene.build_scene(folder / "x", one, for_friction=True)
        curves = made.friction()
        band = made.band(curves.mu)
        assert np.array_equal(result.mu_low[k], band.lower)
        assert np.array_equal(result.mu_high[k], band.upper)
    turned = asperity.sweep(
        tables,
        {"conditions.velocity_m_s": [1e-3, 1e-2, 1e-1], "conditions.pressure_pa": [1e5, 2e5]},
        variables=["mu_low"],
    )
    assert np.array_equal(turned.mu_low, result.mu_low[0].T)


@pytest.mark.parametrize("cut", [(1, 1, 1), (2, 3, 9), (2, 2, 4), (1, 3, 5)])
def test_what_fails_leaves_nan_and_its_message(cut, monkeypatch, tmp_path):
    """A point out of range, and a scene that is none; neither takes others with it."""
    curve = measured(tmp_path / "curve.csv", np.geomspace(1e1, 1e7, 40))
    scene = SCENE | {"rubber": {"master_curve": curve}}
    over = {
        "surface.q1_per_m": [1e5, 1e4],
        "surface.q0_per_m": [2e3, 2e4, 1e3],
        "conditions.velocity_m_s": np.geomspace(1e-5, 1e3, 9),
    }
    monkeypatch.setattr(run, "cut_of", lambda *_: cut)
    result = asperity.sweep(scene, over)
    v, q1, q0 = (
        result["conditions.velocity_m_s"],
        result["surface.q1_per_m"],
        result["surface.q0_per_m"],
    )
    whole = (v * q0 >= 1e1) & (v * q1 <= 1e7) & (q0 < q1)
    whole = whole.transpose(*result.mu.dims)
    assert 5 < int(whole.sum()) < whole.size - 9
    for name in COLUMNS:
        assert np.array_equal(np.isfinite(result[name]), whole), name
    assert np.array_equal(result.failure == 0, whole)
    assert result.attrs["failed"] == int((~whole).sum())
    messages = dict(zip(result.failure_code.values, result.failure_message.values, strict=True))
    lost = messages[int(result.failure.sel({"surface.q1_per_m": 1e4, "surface.q0_per_m": 2e4})[0])]
    assert "q1" in lost
    fast = messages[int(result.failure[0, 0, -1])]
    assert "velocity_m_s" in fast
    assert "1000" in fast
    if cut == (2, 3, 9):
        monkeypatch.setattr(run, "cut_of", lambda *_: (1, 1, 2))
        other = asperity.sweep(scene, over)
        same(other, result, ["failure", "mu", "failure_code"])
        assert other.failure_message.values.tolist() == result.failure_message.values.tolist()


def test_tasks_take_about_a_second():
    made = run.planned(SCENE, {"conditions.velocity_m_s": np.geomspace(1e-6, 1, 90_000), **OVER})
    cost = plan.Cost(point=2e-5, scene=1e-3, change={1: 1e-3, 3: 0.5})
    cut = plan.cut_of(made, cost)
    assert 0.5 < np.prod(cut) * cost.point < 1.01
    many = run.planned(SCENE, {"surface.hurst": np.linspace(0.7, 0.9, 1000).tolist()})
    cost = plan.Cost(point=1e-6, scene=1e-2, change={0: 1e-2})
    assert plan.cut_of(many, cost) == (91, 7)  # eleven parts of about 1 s
    slow = plan.Cost(point=5.0, scene=1.0, change={0: 7.0})
    assert plan.cut_of(many, slow) == (1, 1)
    with_band = SCENE | {"uncertainty": {}}
    made = run.planned(with_band, {"surface.hurst": [0.7, 0.8]})
    assert plan.cut_of(made, slow) == (1, 7)


def test_a_worker_keeps_what_it_built():
    built = []
    kept = Kept(2)
    for key in "aabbcca":
        kept.get(key, lambda key=key: built.append(key))
    assert built == ["a", "b", "c", "a"]
    with pytest.raises(ZeroDivisionError):
        kept.get("x", lambda: 1 / 0)
    assert kept.get("x", lambda: 7) == 7


def test_variables_that_are_wanted_are_all_that_is_kept():
    result = asperity.sweep(SCENE, {}, variables=["contact_area", "mu"])
    assert [*result.data_vars] == ["mu", "contact_area", "failure", "failure_message"]


def test_progress_is_told():
    steps = []
    asperity.sweep(SCENE, OVER, progress=lambda done, points: steps.append((done, points)))
    assert steps[-1] == (252, 252)
