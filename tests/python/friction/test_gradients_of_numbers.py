"""Slopes of mu over numbers of corrections and Poisson's ratio, and at the ends of ranges."""

import inspect

import numpy as np
import pytest

import asperity
from helpers.rubbers import prony, tread

ROAD = asperity.SelfAffineSpectrum(rms_height=2e-5, hurst=0.8, q0=2000, q1=1e6)
SERIES = prony(3e6, np.geomspace(1e6, 3e8, 9), np.geomspace(1e-2, 1e-9, 9))
ELASTIC = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[], relaxation_times=[])
STICKY = asperity.Adhesion(shear_stress=1e7)
HOT = {
    "heating": tread(conductivity=0.2),
    "shift": asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
    "temperature": 300.0,
}
PEAKS = [1e-5, 3e-5, 4e-5]
NUMBERS = {
    "s of both": (asperity.SFactor(gamma=0.3, applies_to="both"), ("gamma",)),
    "s of the area": (asperity.SFactor(gamma=0.5, applies_to="area"), ("gamma",)),
    "nayak": (asperity.NayakSFactor(friction_gamma=0.4), ("friction_gamma",)),
    "implicit": (asperity.ImplicitSFactor(gamma=0.45), ("gamma",)),
    "shift": (asperity.AffineShift(1.5), ("p",)),
    "peaks": (asperity.LocalPeaks(PEAKS, z_max=6e-5), ("z_max",)),
    "both": (
        asperity.PeaksThenGreenwoodWilliamson(PEAKS, z_max=8e-5, z_min=-6e-5, reading="added"),
        ("z_max", "z_min"),
    ),
    "own numbers": (
        asperity.GreenwoodWilliamson(
            z_max=7e-5, z_min=-6e-5, reading="added", rms_height=2.2e-5, q0=3000
        ),
        ("z_max", "z_min", "correction_rms_height", "correction_q0"),
    ),
}


def mu(road=ROAD, rubber=SERIES, **at):
    points = {"pressure": 2e5, "velocity": 1.0, "adhesion": STICKY, "rtol": 1e-10} | at
    return asperity.friction(road, rubber, **points).mu


def of(road=ROAD, rubber=SERIES, **at):
    points = {"pressure": 2e5, "velocity": 1.0, "adhesion": STICKY} | at
    return asperity.friction(road, rubber, **points, gradients=True).gradients


def changed(made, name, factor):
    arguments = {one: getattr(made, one) for one in inspect.signature(type(made)).parameters}
    return type(made)(**arguments | {name: arguments[name] * factor})


def slope(at, step=1e-3):
    return (at(np.exp(step)) - at(np.exp(-step))) / (2 * step)


@pytest.mark.parametrize("hot", [{}, HOT], ids=["cold", "hot"])
@pytest.mark.parametrize("name", NUMBERS)
def test_numbers_of_corrections(name, hot):
    correction, numbers = NUMBERS[name]
    result = of(correction=correction, **hot)
    for number in numbers:
        argument = number.removeprefix("correction_")
        expected = slope(lambda f, n=argument: mu(correction=changed(correction, n, f), **hot))
        assert getattr(result, number) == pytest.approx(expected, rel=1e-4, abs=1e-9), number
    assert result.q0 == pytest.approx(
        slope(lambda f: mu(changed(ROAD, "q0", f), correction=correction, **hot)), rel=1e-4
    )


@pytest.mark.parametrize("correction", [None, asperity.PartialContact(), NUMBERS["both"][0]])
@pytest.mark.parametrize("ratio", [0.45, 0.2, 0.0])
def test_poisson_ratio(correction, ratio):
    result = of(correction=correction, poisson_ratio=ratio).poisson_ratio
    expected = slope(lambda f: mu(correction=correction, poisson_ratio=ratio * f))
    assert result == pytest.approx(expected, rel=1e-5, abs=1e-12)


@pytest.mark.parametrize("correction", [None, asperity.PartialContact()])
@pytest.mark.parametrize("more", [{}, {"rolloff": 5000.0}, HOT])
def test_hurst_at_its_end(correction, more):
    """One-sided differences of second order, as hurst goes no further than 1."""
    law = {"rms_height": 2e-5, "q0": 2000, "q1": 1e6}
    law |= {"rolloff": more.get("rolloff")}
    at = {"correction": correction} | {k: v for k, v in more.items() if k != "rolloff"}
    roads = [asperity.SelfAffineSpectrum(hurst=np.exp(-h), **law) for h in (0, 1e-3, 2e-3)]
    here, near, far = (mu(road, **at) for road in roads)
    assert of(roads[0], **at).hurst == pytest.approx((3 * here - 4 * near + far) / 2e-3, rel=1e-4)


@pytest.mark.parametrize(
    ("argument", "law"),
    [
        ("rolloff", {"rolloff": 2000 * (1 + 1e-7)}),
        ("rolloff", {"rolloff": 1e6 * (1 - 1e-7)}),
        ("q1", {"q1": 2000 * 1.01}),
        ("q0", {"q1": 2000 * 1.01}),
    ],
)
@pytest.mark.parametrize("correction", [None, asperity.PartialContact()])
def test_narrow_bands(argument, law, correction):
    road = asperity.SelfAffineSpectrum(
        **{"rms_height": 2e-5, "hurst": 0.8, "q0": 2000, "q1": 1e6} | law
    )
    result = of(road, correction=correction)
    step = 1e-8 if argument == "rolloff" else 1e-4
    expected = slope(lambda f: mu(changed(road, argument, f), correction=correction), step)
    assert abs(getattr(result, argument) - expected) <= 2 * result.error_estimate


@pytest.mark.parametrize("correction", [None, asperity.PartialContact()])
def test_no_roughness_and_no_loss(correction):
    flat = asperity.TabulatedSpectrum(wavenumber=[2e3, 1e5, 1e6], density=[0, 0, 0])
    for result in (of(flat, correction=correction), of(flat, ELASTIC, correction=correction)):
        # the adhesion in complete contact alone
        assert result.pressure == pytest.approx(-result.shear_stress)
        assert not result.loss.any()
        assert not result.spectrum.any()
    dry = of(ROAD, ELASTIC, correction=correction, adhesion=None)
    for name in ("pressure", "velocity", "hurst", "q0", "q1", "equilibrium_modulus"):
        assert getattr(dry, name) == 0


def test_many_rings_without_roughness():
    flat = asperity.TabulatedSpectrum(wavenumber=np.geomspace(2e3, 1e6, 30), density=np.zeros(30))
    result = of(flat, correction=asperity.PartialContact())
    assert result.pressure == pytest.approx(-result.shear_stress)
