"""Where a method takes over from another inside, nothing may jump.

Each case goes through its switch in steps far below the tolerance; what a smooth function does in
them is bounded by how fast it may change, and what is left is rounding.
"""

import math

import numpy as np
import pytest

import asperity
from helpers.rubbers import prony

BAND = {"rms_height": 1e-4, "hurst": 0.8, "q0": 2e3, "q1": 1e5}
SERIES = {"equilibrium_modulus": 3e6, "moduli": [1e7, 1e8], "relaxation_times": [1e-2, 1e-5]}
W = np.geomspace(1e-1, 1e7, 17)
CURVE = {
    "angular_frequency": W,
    "storage_modulus": 1e6 * (1 + W**0.4),
    "loss_modulus": 3e5 * W**0.4,
}
ROAD, RUBBER = asperity.SelfAffineSpectrum(**BAND), asperity.PronySeries(**SERIES)
MEASURED = asperity.MasterCurve(extrapolation="power-law", **CURVE)
STEPS = 1e-9 * np.array([-2, -1, -1e-4, 0, 1e-4, 1, 2])


def mu(spectrum=ROAD, rubber=RUBBER, **options):
    options = {"pressure": 1e5, "velocity": 1e-2, "rtol": 1e-11, **options}
    return asperity.friction(spectrum, rubber, **options).mu


def area(spectrum=ROAD, rubber=RUBBER, **options):
    options = {"pressure": 1e5, "velocity": 1e-2, "rtol": 1e-11, **options}
    return asperity.contact_area(spectrum, rubber, **options)


def smooth(value, at, steepest=2.0, noise=1e-12):
    """That ln value follows ln x as a line through its ends does, within `noise`."""
    result = np.log([value(at * (1 + step)) for step in STEPS])
    assert abs(result[-1] - result[0]) <= steepest * (STEPS[-1] - STEPS[0]) + noise
    line = result[0] + (result[-1] - result[0]) * (STEPS - STEPS[0]) / (STEPS[-1] - STEPS[0])
    np.testing.assert_allclose(result, line, rtol=0, atol=noise)


def pressure_of(g, form="exact"):
    """Where G at q1 is `g`."""
    low, high = 1e-3, 1e14
    for _ in range(200):
        middle = math.sqrt(low * high)
        share = area(pressure=middle, form=form)
        there = math.erf(0.5 / math.sqrt(g))
        if form == "interpolated":
            there = (1 + (math.pi * g) ** 1.5) ** (-1 / 3)
        low, high = (middle, high) if share < there else (low, middle)
    return math.sqrt(low * high)


@pytest.mark.parametrize("value", [mu, area])
@pytest.mark.parametrize("correction", [None, asperity.SFactor(), asperity.NayakSFactor()])
@pytest.mark.parametrize(
    ("g", "form"), [(0.007, "exact"), (0.03, "exact"), (1.0, "exact"), (1e-8, "interpolated")]
)
def test_pressure_where_contact_is_whole_no_more(value, correction, g, form):
    at = pressure_of(g, form)
    smooth(lambda p: value(pressure=p, correction=correction, form=form), at)


@pytest.mark.parametrize("gamma", [0.0, 1.0])
@pytest.mark.parametrize("applies_to", ["friction", "area", "both"])
@pytest.mark.parametrize("value", [mu, area])
def test_gamma_at_its_ends(gamma, applies_to, value):
    def at(x):
        return value(correction=asperity.SFactor(gamma=x, applies_to=applies_to), pressure=1e4)

    inside = abs(gamma - 1e-10)
    # d ln / d gamma is of the order of 1 / S, S >= 1e-3 here
    assert at(inside) == pytest.approx(at(gamma), rel=1e-7)
    assert at(abs(gamma - 1e-16)) == pytest.approx(at(gamma), rel=2e-12, abs=0)


@pytest.mark.parametrize("value", [mu, area])
def test_gamma_of_one_is_no_correction(value):
    whole = asperity.SFactor(gamma=1.0, applies_to="both")
    assert value(correction=whole) == pytest.approx(value(), rel=1e-14, abs=0)
    assert value(correction=asperity.AffineShift(1.0)) == value()


@pytest.mark.parametrize("rubber", [RUBBER, MEASURED], ids=["Prony", "table"])
@pytest.mark.parametrize("pressure", [1e2, 1e5, 1e8])
def test_tolerances_at_which_the_nodes_change(rubber, pressure):
    best = mu(rubber=rubber, pressure=pressure, rtol=1e-10)
    for rtol in np.geomspace(1e-10, 0.1, 91):
        result = asperity.friction(ROAD, rubber, pressure=pressure, velocity=1e-2, rtol=rtol)
        assert abs(result.mu - best) <= result.error_estimate + 1e-10 * best
        assert result.error_estimate <= rtol * result.mu


def test_a_rubber_without_terms_and_with_a_trace_of_one():
    def rubber(modulus):
        return prony(3e6, [modulus], [1e-4])

    bare = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[], relaxation_times=[])
    assert mu(rubber=bare) == 0
    assert area(rubber=rubber(1e-100)) == pytest.approx(area(rubber=bare), rel=1e-15, abs=0)
    per_pascal = mu(rubber=rubber(1e-3)) / 1e-3
    for modulus in (1e-5, 1e-20, 1e-100, 1e-200):
        assert mu(rubber=rubber(modulus)) == pytest.approx(per_pascal * modulus, rel=1e-8, abs=0)


@pytest.mark.parametrize("at", [1.0, 1e150 / 1e-2])
def test_forms_of_a_relaxation_for_slow_and_fast(at):
    one = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-2])
    w = at * 100 if at == 1 else at
    smooth(lambda x: one.modulus(x).real, w)
    smooth(lambda x: one.modulus(x).imag, w)
    for i in (0, 1):
        smooth(lambda x, i=i: one.angular_integrals(x)[i], w)


def test_relaxation_times_from_which_on_terms_are_summed_one_by_one():
    slowest = 1e150 / (1e-2 * BAND["q1"])

    def at(tau):
        # the far term is elastic and leaves the loss to the other
        return mu(rubber=prony(3e6, [1e6, 1e8], [tau, 1e-4]))

    smooth(at, slowest)


@pytest.mark.parametrize("w", [W[0], W[-1], W[0] / 9.999, W[-1] * 9.999, *W[1:-1:5]])
def test_a_measured_modulus_across_its_rows_and_its_ends(w):
    smooth(lambda x: MEASURED.modulus(x).real, w)
    smooth(lambda x: MEASURED.modulus(x).imag, w)
    for i in (0, 1):
        smooth(lambda x, i=i: MEASURED.angular_integrals(x)[i], w)


def test_extrapolation_ends_at_a_decade():
    for w, beyond in ((W[0] / 10, 1 - 1e-9), (W[-1] * 10, 1 + 1e-9)):
        assert math.isfinite(MEASURED.angular_integrals(w)[0])
        with pytest.raises(asperity.OutOfRange):
            MEASURED.angular_integrals(w * beyond)


@pytest.mark.parametrize("end", ["q0", "q1"])
def test_velocities_at_which_the_band_leaves_the_measurement(end):
    w = W[0] if end == "q0" else W[-1]
    smooth(lambda v: mu(rubber=MEASURED, velocity=v), w / BAND[end], noise=4e-12)


@pytest.mark.parametrize("value", [mu, area])
def test_an_exponent_of_one(value):
    # (q1/q0)^(2 - 2H) - 1 over 2 - 2H becomes a logarithm: a change of H times ln(q1/q0)^2
    at_one = value(asperity.SelfAffineSpectrum(**{**BAND, "hurst": 1.0}))
    for below in (1e-16, 1e-14, 1e-12):
        near = value(asperity.SelfAffineSpectrum(**{**BAND, "hurst": 1 - below}))
        assert near == pytest.approx(at_one, rel=1e-12 + 16 * below, abs=0)


@pytest.mark.parametrize("value", [mu, area])
def test_a_roll_off_at_the_end(value):
    near = asperity.SelfAffineSpectrum(**BAND, rolloff=BAND["q0"] * (1 + 1e-13))
    assert value(near) == pytest.approx(value(), rel=2e-12, abs=0)


@pytest.mark.parametrize("value", [mu, area])
@pytest.mark.parametrize("length", [4, 8])
def test_bands_at_which_a_panel_is_added(value, length):
    def at(q1):
        return value(asperity.SelfAffineSpectrum(**{**BAND, "q1": q1}))

    smooth(at, BAND["q0"] * math.exp(length), steepest=4.0)


@pytest.mark.parametrize("t", [-100.0, -1.0, 0.0, 8.0])
@pytest.mark.parametrize("peaks", [None, [1e-4, 3e-5, 2e-5]])
def test_separations_where_the_moments_take_over(t, peaks):
    stiffness = 2e3 / (3 * math.pi**2 * math.sqrt(3 * math.sqrt(2) * 1e-4)) * 1e-6
    # of the order of the load at which d is t rms heights
    load = stiffness * (max(-t, 1) ** 1.5 if t < 0 else math.exp(-t * t / 2))

    def gap(x):
        result = asperity.separation(
            pressure=x, effective_modulus=1.0, rms_height=1e-4, q0=1e3, peaks=peaks
        )
        return 1e-3 - result.effective  # below a plane ten rms heights up

    smooth(gap, load, steepest=1.0, noise=1e-13)


def separation(pressure):
    modulus = abs(RUBBER.modulus(BAND["q0"] * 1e-2)) / 0.75
    result = asperity.separation(
        pressure=pressure, effective_modulus=modulus, rms_height=BAND["rms_height"], q0=BAND["q0"]
    )
    return result.effective


def shifted(pressure, z_max, z_min, rtol):
    correction = asperity.GreenwoodWilliamson(z_max=z_max, z_min=z_min)
    return mu(pressure=pressure, correction=correction, rtol=rtol)


def test_igw_into_full_contact():
    d, top = separation(3e6), 4 * BAND["rms_height"]
    assert d < 0
    partial, full = (shifted(3e6, top, d * (1 + step), 1e-9) for step in (1e-9, -1e-9))
    assert full == pytest.approx(mu(pressure=3e6), rel=1e-9)
    assert partial == pytest.approx(full, rel=1e-8)


def test_igw_out_of_contact():
    # p_T grows without end, and mu falls as 1 / p^2
    d = separation(10.0)
    assert d > 0
    result = [shifted(10.0, d * (1 + step), -1e-4, 1e-4) for step in (1e-3, 1e-5, 1e-7, -1e-7)]
    assert result[0] > result[1] > result[2] > result[3] == 0
    assert result[2] < 1e-6


def test_a_row_of_zeros_beside_rows_of_one_density():
    q = np.array([2e3, 1e4, 5e4, 1e5])
    even = asperity.TabulatedSpectrum(wavenumber=q, density=np.full(4, 1e-18))
    # a power law of exponent 1e-13 and a straight line between equal densities
    tilted = asperity.TabulatedSpectrum(wavenumber=q, density=1e-18 * (1 + 1e-13 * np.arange(4)))
    assert mu(even) == pytest.approx(mu(tilted), rel=1e-12)
    assert area(even) == pytest.approx(area(tilted), rel=1e-12, abs=0)
