"""FMUs of maps that know directions: the direction as input, and the force across."""

import numpy as np
import pytest

from asperity import (
    WLF,
    Heating,
    PronySeries,
    SelfAffineSpectrum,
    TabulatedSpectrum,
    export_fmu,
    friction_map,
)
from helpers.fmus import Host, on_linux

PRESSURE, VELOCITY, DIRECTION, MU, TRACTION, LATERAL, ACROSS = 1, 2, 5, 8, 12, 17, 18


@pytest.fixture(scope="module")
def road():
    surface = SelfAffineSpectrum(
        rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e4, axis_ratio=2.0, lay=0.5
    )
    rubber = PronySeries(equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6])
    box = {"pressure": (8e4, 4e5), "velocity": (1e-2, 1.0)}
    return friction_map(surface, rubber, **box, rtol=1e-2, checked=0)


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_forces_along_and_across_are_those_of_the_map(road, tmp_path, fmi):
    export_fmu(road, tmp_path / "road.fmu", fmi=fmi)
    host = Host(tmp_path / "road.fmu", tmp_path)
    for direction in (0.0, 0.7, 4.0):
        for velocity in (0.1, -0.1):
            host.set([PRESSURE, VELOCITY, DIRECTION], [1e5, velocity, direction])
            mu, traction, lateral, across = host.get([MU, TRACTION, LATERAL, ACROSS])
            assert mu == road.mu(1e5, velocity, direction=direction)
            assert lateral == road.lateral(1e5, velocity, direction=direction)
            assert traction == np.sign(velocity) * mu * 1e5
            assert across == np.sign(velocity) * lateral * 1e5
    h = 1e-5
    host.set([PRESSURE, VELOCITY, DIRECTION], [1e5, 0.1, 0.7])
    more = () if fmi == "2.0" else (1,)
    [slope] = host.unit.getDirectionalDerivative([LATERAL], [DIRECTION], [2.0], *more)
    sides = [road.lateral(1e5, 0.1, direction=0.7 + s) for s in (-h, h)]
    assert slope == pytest.approx((sides[1] - sides[0]) / h, rel=1e-6)
    host.end()


@on_linux
def test_a_map_with_heat_has_the_force_across_of_the_distance_slid(tmp_path):
    q = np.geomspace(2e3, 2e4, 8)
    mean = SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e4)
    lay = np.full((8, 1), 0.2)
    surface = TabulatedSpectrum(wavenumber=q, density=mean.at(q), cosine=lay, sine=lay)
    rubber = PronySeries(equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6])
    warm = friction_map(
        surface,
        rubber,
        pressure=(1e5, 1.2e5),
        velocity=(0.5, 1.0),
        temperature=293.15,
        shift=WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
        heating=Heating(density=1200, heat_capacity=1650, conductivity=0.2, contact_diameter=1e-3),
        direction=0.7,
        rtol=2e-2,
        checked=0,
    )
    export_fmu(warm, tmp_path / "warm.fmu", fmi="3.0")
    host = Host(tmp_path / "warm.fmu", tmp_path)
    host.set([PRESSURE, VELOCITY], [1.1e5, -0.6])
    found = []
    for i in range(4):
        lateral, across = host.get([LATERAL, ACROSS])
        assert lateral == warm.lateral(1.1e5, 0.6, distance=i * 6e-4)
        assert across == -lateral * 1.1e5
        found.append(lateral)
        host.step(i * 1e-3, 1e-3)
    assert np.all(np.diff(np.abs(found)) < 0)
    host.end()
