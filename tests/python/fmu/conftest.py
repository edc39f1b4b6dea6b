"""Maps as FMUs of both standards, and instances of them."""

import pytest

from asperity import (
    Adhesion,
    FrictionMap,
    PronySeries,
    SelfAffineSpectrum,
    export_fmu,
    friction_map,
)
from helpers.fmus import BOX, Host, hot_map


@pytest.fixture(scope="session")
def road() -> FrictionMap:
    surface = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=2e4)
    rubber = PronySeries(
        equilibrium_modulus=3e6,
        moduli=[1e9, 3e8, 1e8, 1e7],
        relaxation_times=[1e-8, 1e-6, 1e-4, 1e-2],
    )
    return friction_map(surface, rubber, adhesion=Adhesion(shear_stress=8.3e6), **BOX, checked=0)


@pytest.fixture(scope="session")
def files(road, tmp_path_factory):
    """{(standard, points): path} of four FMUs."""
    folder = tmp_path_factory.mktemp("fmu")
    made = {}
    for fmi in ("2.0", "3.0"):
        for points in (None, 3):
            made[fmi, points] = folder / f"{fmi}-{points}.fmu"
            export_fmu(road, made[fmi, points], fmi=fmi, points=points)
    return made


@pytest.fixture(params=["2.0", "3.0"])
def host(request, files, tmp_path):
    made = Host(files[request.param, None], tmp_path)
    yield made
    made.end()


@pytest.fixture(scope="session")
def hot_road() -> FrictionMap:
    return hot_map((289.15, 291.15))
