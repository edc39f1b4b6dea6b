"""The page on the heat of sliding says what is computed."""

from pathlib import Path

import numpy as np
import pytest

import asperity
from helpers.cases import case
from helpers.examples import TREAD
from helpers.heat import hot

DOCS = Path(__file__).parents[3] / "docs"
PAGE = (DOCS / "explanation/heat.md").read_text(encoding="utf-8")
NOTES = (DOCS / "notes/heat.md").read_text(encoding="utf-8")
CHANGES = {
    "nothing": {},
    "$2R$ = 0.5 mm, and": {"contact_diameter": 0.5e-3},
    "$2R$ = 2 mm, and": {"contact_diameter": 2e-3},
    "$2R$ = 0.5 mm, $q_m$ held": {"contact_diameter": 0.5e-3, "macro_wavenumber": 6283.185},
    "$2R$ = 2 mm, $q_m$ held": {"contact_diameter": 2e-3, "macro_wavenumber": 6283.185},
    "$q_m$ = 3000": {"macro_wavenumber": 3000},
    "$q_m$ = 10000": {"macro_wavenumber": 10000},
    "`macro_area` = 0.1": {"macro_area": 0.1},
    "`macro_area` = 0.3": {"macro_area": 0.3},
    "heat capacity or density 20 % higher": {"density": 1440},
    "heat capacity or density 20 % lower": {"heat_capacity": 1320},
    '`residence="box"`': {"residence": "box"},
}


def cells(start, page=PAGE):
    (line,) = [line for line in page.splitlines() if line.startswith(f"| {start}")]
    return [cell.strip() for cell in line.strip("| ").split("|")][1:]


def test_the_table_of_what_matters():
    for start, change in CHANGES.items():
        found = hot(velocity=1.0, rtol=1e-6, heating=asperity.Heating(**TREAD | change))
        mu, rise, area = cells(start)
        with case(start=start):
            assert mu == f"{found.mu:.3f}"
            assert rise == f"{found.temperature - 293.15:.1f}"
            assert area in (f"{found.macro_area:.3f}", f"{found.macro_area:g}")
    for celsius in (10, 30):
        found = hot(velocity=1.0, temperature=273.15 + celsius)
        start = f"$T_0$ = {celsius} °C ({found.cold.mu:.3f} without heat)"
        expected = [f"{found.mu:.3f}", f"{found.temperature - 273.15 - celsius:.1f}"]
        assert cells(start) == [*expected, f"{found.macro_area:.3f}"]
    for conductivity, mu, rise in ((0.15, "0.942", "11.8"), (0.30, "0.944", "11.6")):
        found = hot(
            velocity=1.0, heating=asperity.Heating(**TREAD | {"conductivity": conductivity})
        )
        assert (mu, rise) == (f"{found.mu:.3f}", f"{found.temperature - 293.15:.1f}")
        assert mu in cells("conductivity")[0]
        assert rise in cells("conductivity")[1]


def test_the_limit_of_one_dimension_is_that_of_the_exact_disc():
    """Mean over a uniform disc, insulated, J R / lambda = 1, against c_h sqrt(2 / (pi Pe))."""
    scipy = pytest.importorskip("scipy.special")
    phi = np.linspace(0, 2 * np.pi, 2001)[:-1]
    for peclet, percent in ((3.0, "16 % at 3"), (10.0, "4.6 % at 10"), (100.0, "0.5 % at 100")):
        x = np.geomspace(1e-6, 3e3, 40001)
        weight = np.gradient(np.log(x)) * x
        inner = np.array(
            [np.mean(((1 + 1j * peclet * np.cos(phi) / one) ** -0.5).real) for one in x[::40]]
        )
        inner = np.interp(np.log(x), np.log(x[::40]), inner)
        exact = 2 * np.sum(weight * (scipy.j1(x) / x) ** 2 * inner)
        off = 1.2204156216 * np.sqrt(2 / (np.pi * peclet)) / exact - 1
        assert percent in " ".join(PAGE.split())
        assert 100 * off == pytest.approx(float(percent.split()[0]), abs=0.3)
