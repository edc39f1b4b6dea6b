"""Points that fail cost no others, and heat makes a sweep depend on neither cut nor order."""

import numpy as np
import pytest

import asperity
from asperity.sweep import plan, run
from helpers.sweeps import HEATED, SCENE, measured

xarray = pytest.importorskip("xarray", reason="a sweep needs asperity[sweep]")

HOT = HEATED | {
    "conditions": {
        "pressure_pa": [1e5, 4e5],
        "velocity_m_s": {"from": 0.1, "to": 10, "points": 5},
        "temperature_c": 20,
    },
}
FAST, SLOW = (plan.Cost(point=one, scene=one, change={}) for one in (1e-9, 10.0))


def test_heat_gives_the_same_bits_however_costs_cut_it(monkeypatch):
    result = []
    for cost in (FAST, SLOW):
        monkeypatch.setattr(run, "timed", lambda *_, cost=cost: cost)
        result.append(asperity.sweep(HOT, {"surface.hurst": [0.7, 0.8]}, variables=["mu"]).mu)
    velocities = {"conditions.velocity_m_s": np.geomspace(0.1, 10, 5)}
    turned = asperity.sweep(HOT, velocities | {"surface.hurst": [0.7, 0.8]}, variables=["mu"]).mu
    assert np.isfinite(result[0]).all()
    assert np.array_equal(result[0], result[1])
    assert np.array_equal(turned.transpose(*result[0].dims), result[0])


@pytest.mark.parametrize("wrong", [[], [1e3], [1e3, 1.1e3, 1.2e3]])
def test_whether_a_sweep_runs_does_not_depend_on_the_order_of_values(wrong):
    for values in ([*wrong, 1e5], [1e5, *wrong]):  # below q0 there is no spectrum
        result = asperity.sweep(SCENE, {"surface.q1_per_m": values}, variables=["mu"])
        assert result.attrs["failed"] == 7 * len(wrong)
        assert np.isfinite(result.mu.sel({"surface.q1_per_m": 1e5})).all()
    if wrong:
        with pytest.raises(asperity.InvalidInput, match="q1"):
            asperity.sweep(SCENE, {"surface.q1_per_m": wrong})


def test_the_velocity_of_a_scene_is_checked_as_that_of_any_other():
    def at(velocity):
        tables = SCENE | {"conditions": {"pressure_pa": 1e5, "velocity_m_s": velocity}}
        return asperity.sweep(tables, {"surface.hurst": [0.7, 0.8]}, variables=["mu"])

    assert "velocity_m_s = 500: unusual" in at(500.0).attrs["notes"]
    assert "velocity_m_s" not in at(5.0).attrs["notes"]
    with pytest.raises(asperity.InvalidInput, match=r"velocity_m_s = 1e\+09"):
        at(1e9)


def test_every_code_has_a_text(tmp_path):
    scene = SCENE | {
        "rubber": {"master_curve": measured(tmp_path / "curve.csv", np.geomspace(1e1, 1e7, 40))}
    }
    velocities = np.geomspace(2e2, 4e2, 1200)  # each fails with a text of its own
    over = {"conditions.velocity_m_s": velocities, "surface.q1_per_m": [1e3, 1e5]}
    result = asperity.sweep(scene, over, variables=["mu"])
    assert result.attrs["failed"] == 2 * velocities.size
    texts = [
        str(result.failure_message.sel(failure_code=code).values)
        for code in np.unique(result.failure)
    ]
    assert len(texts) == result.sizes["failure_code"] == 2
    assert sum("velocity_m_s" in text for text in texts) == 1


def test_a_point_without_a_band_takes_no_other_with_it(folder):
    tables = {
        "surface": {"file": "scan.npy", "pixel_size_m": [2e-5, 1e-5], "unit": "m"},
        "rubber": {"master_curve": measured(folder / "curve.csv", np.geomspace(1e-3, 1e7, 60))},
        "conditions": {"velocity_m_s": [1e-2, 1e-1], "pressure_pa": [1e5, 2e5]},
        "uncertainty": {"samples": 20},
    }
    whole = asperity.sweep(tables, {})
    assert np.isfinite(whole.mu_low).all()
    names = ["conditions.pressure_pa", "conditions.velocity_m_s"]
    values = dict(zip(names, ([1e5, 2e5], [1e-2, 1e-1, 1e3]), strict=True))
    for order in (names, names[::-1]):
        result = asperity.sweep(tables, {name: values[name] for name in order})
        result = result.transpose(*names, ...)
        assert result.attrs["failed"] == 2
        code = int(result.failure[0, 2])
        assert (result.failure == [[0, 0, code]] * 2).all()
        assert "velocity_m_s" in str(result.failure_message.sel(failure_code=code).values)
        for name in ("mu", "mu_low", "mu_high"):
            assert np.array_equal(result[name][:, :2], whole[name]), name
            assert np.isnan(result[name][:, 2]).all()
