"""The kernel of the heat flow: values from its definition, limits, and what it refuses."""

import numpy as np
import pytest

import asperity
from helpers.cases import case
from helpers.examples import TREAD
from helpers.refusals import refused
from helpers.rubbers import tread
from helpers.table_rows import close

HEATING = tread()
D = TREAD["conductivity"] / (TREAD["density"] * TREAD["heat_capacity"])
RHO_C = TREAD["density"] * TREAD["heat_capacity"]


def heated(row):
    """The constants of a row, whose diffusivity is that of this density and capacity."""
    return tread(
        conductivity=row["diffusivity"] * RHO_C,
        contact_diameter=row["contact_diameter"],
        residence=row["residence"],
    )


@pytest.mark.reference("heat_kernel")
def test_kernel_of_its_definition(row):
    result = asperity.heat_kernel(
        row["q"], row["q_prime"], velocity=row["velocity"], heating=heated(row)
    )
    close(row, ["g"], [result])


@pytest.mark.reference("heat_universal")
def test_universal_functions_of_their_definition(row):
    # far apart g has N alone, and on the diagonal Q alone
    q = 1e4
    time = (row["x"] / (2 * q)) ** 2 / D
    diameter = 1e-3
    box = row["residence"] == "box"
    velocity = diameter / time / (2 if box else 1)
    heating = tread(residence=row["residence"])
    on_diagonal = asperity.heat_kernel(q, q, velocity=velocity, heating=heating)
    close(row, ["q"], [2 * on_diagonal / time])


NODE, WEIGHT = np.polynomial.legendre.leggauss(120)


def over_k(q, q_prime, time, residence):
    """g by the integral over k, with the mean of exp(-D k^2 tau) over the residence."""
    k = np.exp(np.arange(-40, 40, 0.05))
    z = D * k * k * time
    if residence == "box":
        mean = -np.expm1(-z) / z
    else:  # by the trapezoid in time, an angle that the square roots at both ends ask for
        phi = np.pi / 4 * (1 + NODE)
        w = np.sin(phi) ** 4  # many nodes near w = 0
        h = 1 - 2 / np.pi * (w * np.sqrt(1 - w * w) + np.arcsin(w))
        dw = 4 * np.sin(phi) ** 3 * np.cos(phi) * np.pi / 4 * WEIGHT
        mean = (np.exp(-z[:, None] * w) * h * dw).sum(axis=1)
    lorentz = 4 * q**2 / (k**2 + 4 * q**2) * 4 * q_prime / (k**2 + 4 * q_prime**2)
    return time * 0.05 / np.pi * (lorentz * mean * k).sum()


@pytest.mark.parametrize("residence", ["disc", "box"])
def test_closed_form_is_the_integral_over_k(residence):
    rng = np.random.default_rng(3)
    heating = tread(residence=residence)
    for _ in range(40):
        q, q_prime, v = np.exp(rng.uniform(np.log([1e3, 1e3, 1e-4]), np.log([1e6, 1e6, 10])))
        if rng.random() < 0.3:
            q_prime = q * (1 + 10 ** rng.uniform(-8, -1))
        time = TREAD["contact_diameter"] / v / (2 if residence == "box" else 1)
        with case(q=q, q_prime=q_prime, v=v):
            g = asperity.heat_kernel(q, q_prime, velocity=v, heating=heating)
            assert g == pytest.approx(over_k(q, q_prime, time, residence), rel=1e-7)


def test_kernel_has_no_seam_where_its_formula_changes():
    q = 1e4
    for residence in ("disc", "box"):
        heating = tread(residence=residence)
        for v in (1e-4, 1.0, 1e3):
            for apart in (0.02, 1e-3, 1e-9):
                near = q * (1 + apart * np.array([1 - 1e-6, 1, 1 + 1e-6]))
                g = asperity.heat_kernel(q, near, velocity=v, heating=heating)
                with case(residence=residence, v=v, apart=apart):
                    assert abs(g[0] - 2 * g[1] + g[2]) < 1e-12 * g[1]


def test_kernel_without_diffusion_stays_where_the_heat_is():
    thin = tread(conductivity=0.01, contact_diameter=1e-12)
    q, q_prime, v = 2e3, 1e5, 1e3
    residence = 4 / (3 * np.pi) * 1e-12 / v  # 8 R / (3 pi v)
    g = asperity.heat_kernel(q, q_prime, velocity=v, heating=thin)
    assert g == pytest.approx(residence * q / (q + q_prime), rel=1e-4)


def test_kernel_where_diffusion_wins_is_the_same_for_all_wavenumbers():
    q, v = np.array([1e3, 1e5, 1e7]), 1e-15
    g = asperity.heat_kernel(q[:, None], q, velocity=v, heating=HEATING)
    surface = 1.2204156216 * np.sqrt(1e-3 / v / np.pi / D) / 2  # c_h sqrt(t / (pi D)) / 2
    np.testing.assert_allclose(g * q, surface, rtol=1e-4)


def test_kernel_is_positive_over_all_scales():
    q = np.geomspace(1e-3, 1e12, 60)
    for residence in ("disc", "box"):
        heating = tread(residence=residence)
        for v in (1e-9, 1e-3, 10.0, 1e5):
            assert asperity.heat_kernel(q[:, None], q, velocity=v, heating=heating).min() > 0


def test_velocities_broadcast_with_wavenumbers():
    q, v = np.array([1e3, 1e4, 1e6]), np.array([1e-3, 1.0])
    g = asperity.heat_kernel(q[:, None, None], q[:, None], velocity=v, heating=HEATING)
    assert g.shape == (3, 3, 2)
    for j, one in enumerate(v):
        alone = asperity.heat_kernel(q[:, None], q, velocity=one, heating=HEATING)
        np.testing.assert_array_equal(g[..., j], alone)


def test_calls_without_a_kernel_are_refused():
    with refused("macro_area"):
        tread(macro_area=0.2, macro_wavenumber=5e3)
    for wavenumber in (-1.0, np.nan):
        with refused("macro_wavenumber"):
            tread(macro_wavenumber=wavenumber)
    for velocity in (0.0, [1.0, np.nan], [1.0, -1.0]):
        with refused("velocity"):
            asperity.heat_kernel(1e3, 1e3, velocity=velocity, heating=HEATING)
    with refused("", "invalid-input"):  # of two arguments
        asperity.heat_kernel([1e3] * 3, 1e3, velocity=[1.0, 2.0], heating=HEATING)
