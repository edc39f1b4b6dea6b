"""Maps as FMUs of both standards, and instances of them."""

import pytest

from asperity import Adhesion, FrictionMap, export_fmu, friction_map
from helpers.fmus import BOX, Host, hot_map
from helpers.mapped import ROAD
from helpers.ridges import RUBBER


@pytest.fixture(scope="session")
def road() -> FrictionMap:
    return friction_map(ROAD, RUBBER, adhesion=Adhesion(shear_stress=8.3e6), **BOX, checked=0)


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
