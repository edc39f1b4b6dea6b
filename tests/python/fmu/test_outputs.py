"""Outputs and slopes of an FMU are those of its map, inside and outside of the box."""

import ctypes

import fmpy
import numpy as np
import pytest

from helpers.fmus import A_T, MAX_ERROR, NAN, OUTPUTS, of_map, on_linux, points, same


@on_linux
def test_outputs_are_those_of_the_map(host, road):
    for pressure, velocity in zip(*points(200), strict=True):
        result = host.at(float(pressure), float(velocity))
        assert result == same(of_map(road, float(pressure), float(velocity)))
        assert host.inside() == 1


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_simulation_with_variable_steps(files, road, fmi):
    times = np.array([0, 0.03, 0.1, 0.37, 0.4, 1.0])
    signals = np.array(
        [(t, 1e5 * (1 + t), 0.3 - 0.29 * t) for t in times],
        dtype=[("time", float), ("pressure", float), ("velocity", float)],
    )
    result = fmpy.simulate_fmu(
        str(files[fmi, None]),
        input=signals,
        output=["mu", "time"] if fmi == "3.0" else ["mu"],
        stop_time=1.0,
        output_interval=0.05,
        start_values={"clamp": False},
    )
    # inputs are held through a step
    before = result["time"][1:] - 0.05
    expected = road.mu(
        np.interp(before, times, signals["pressure"]), np.interp(before, times, signals["velocity"])
    )
    np.testing.assert_allclose(result["mu"][1:], expected, rtol=1e-13)


@on_linux
@pytest.mark.parametrize(
    ("pressure", "velocity"), [(1e9, 0.1), (1e5, 0.0), (-1.0, 0.1), (1e5, 50.0), (1.0, -1e-9)]
)
def test_outside_is_clamped_or_nan(host, road, pressure, velocity):
    for clamp, outside in ((True, "clamp"), (False, "nan")):
        host.clamp(clamp)
        np.testing.assert_array_equal(
            host.at(pressure, velocity), of_map(road, pressure, velocity, outside=outside)
        )
        assert host.inside() == 0


@on_linux
@pytest.mark.parametrize(("pressure", "velocity"), [(NAN, 0.1), (1e5, NAN), (1e5, float("inf"))])
def test_nan_in_nan_out(host, pressure, velocity):
    host.clamp(False)
    assert np.isnan(host.at(pressure, velocity)).all()
    assert host.inside() == 0
    assert host.at(1e5, 0.1)[0] > 0  # and it goes on


@on_linux
def test_status_outside_is_a_warning(host, capfd):
    fmi2 = host.version == "2.0"
    raw = host.unit.dll.fmi2DoStep if fmi2 else host.unit.dll.fmi3DoStep
    answers = () if fmi2 else (None,) * 4
    statuses = []
    for pressure in (1e5, 1e9, NAN, -1e5, 1e5):
        host.set([1], [pressure])
        step = map(ctypes.c_double, (0.0, 0.1))
        statuses.append(raw(host.unit.component, *step, False, *answers))
    assert statuses == [0, 1, 1, 1, 0]
    assert capfd.readouterr().out.count("a point lies outside of the map") == 1


@on_linux
def test_another_temperature(host, road):
    host.set([A_T], [3.0])
    assert host.at(1e5, 1e-2) == same(of_map(road, 1e5, 1e-2, a_T=3.0))


@on_linux
def test_certified_error_is_told(host, road):
    assert host.get([MAX_ERROR]) == [road.max_error]


@on_linux
def test_directional_derivatives(host, road):
    unit = host.unit
    h = 1e-5
    for pressure, velocity in zip(*points(20, seed=3), strict=True):
        pressure, velocity = float(pressure), float(velocity)
        host.set([1, 2], [pressure, velocity])
        for name, reference in OUTPUTS.items():
            for known, at in ((1, pressure), (2, velocity)):
                if host.version == "2.0":
                    slope = unit.getDirectionalDerivative([reference], [known], [2.0])[0]
                else:
                    slope = unit.getDirectionalDerivative([reference], [known], [2.0], 1)[0]
                look = getattr(
                    road, {"mu_hysteresis": "hysteresis", "mu_adhesion": "adhesion"}.get(name, name)
                )
                sides = [
                    look(
                        pressure * (np.exp(s * h) if known == 1 else 1),
                        velocity * (np.exp(s * h) if known == 2 else 1),
                        outside="clamp",
                    )
                    for s in (-1, 1)
                ]
                # second order in h; rounding of the differences is 1e-16 / 1e-5
                size = max(abs(side) for side in sides)
                assert slope * at == pytest.approx((sides[1] - sides[0]) / h, abs=1e-6 * size)
