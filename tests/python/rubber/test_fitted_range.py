"""A fitted Prony series is known where it was fitted, and goes on beyond when asked by name."""

import pickle
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

import asperity
from asperity import OutOfRange, SelfAffineSpectrum
from helpers.rubbers import curve_of, prony

ROAD = SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5)
TRUE = prony(1e6, [3e6, 1e7, 4e7, 2e8, 5e8], [1e-1, 1e-2, 1e-3, 1e-4, 1e-5])
SHARE = "the Prony series is asked beyond the frequencies that it was fitted on"


def fitted(low=10.0, high=1e4, extrapolation=None):
    w = np.geomspace(low, high, 40)
    modulus = TRUE.modulus(w)
    curve = curve_of(w, modulus)
    return asperity.fit_prony(curve, extrapolation=extrapolation)


SERIES = fitted()
BEYOND = fitted(extrapolation="prony")


def parts_outside(series, w):
    """Shares of I1 and I2 from |w cos(phi)| beyond the fitted range, by quadrature over phi."""
    plain = prony(series.equilibrium_modulus, series.moduli, series.relaxation_times)

    def part(weigh, low, high):  # w cos(phi) from `low` to `high`
        ends = [np.arccos(min(1.0, end / w)) for end in (high, low)]
        cuts = np.linspace(*ends, 60)
        return sum(quad(weigh, *piece, epsabs=0, epsrel=1e-12)[0] for piece in pairwise(cuts))

    def hysteresis(phi):
        return np.cos(phi) * plain.modulus(w * np.cos(phi)).imag

    def stiffness(phi):
        return abs(plain.modulus(w * np.cos(phi))) ** 2

    low, high = series.lowest_frequency, series.highest_frequency
    for weigh in (hysteresis, stiffness):
        inside = part(weigh, low, high) if w > low else 0.0
        yield 1 - inside / part(weigh, 0.0, w)


@pytest.mark.parametrize(
    "w", [1e-3, 1.0, 9.99, 10.0, 10.001, 12.0, 49.0, 51.0, 300.0, 1e4, 1.0001e4, 3e4, 1e7]
)
def test_the_shares_from_beyond_the_fit_are_those_of_the_definition(w):
    result = BEYOND.extrapolated_shares(w)
    np.testing.assert_allclose(result, [*parts_outside(BEYOND, w)], rtol=0, atol=1e-10)


def test_a_fit_is_known_on_the_measured_frequencies_only():
    assert (SERIES.lowest_frequency, SERIES.highest_frequency) == pytest.approx((10.0, 1e4))
    inside = np.array([10.0, 300.0, 1e4])
    np.testing.assert_array_equal(SERIES.modulus(inside), BEYOND.modulus(inside))
    np.testing.assert_array_equal(
        SERIES.angular_integrals(inside), BEYOND.angular_integrals(inside)
    )
    for call in (SERIES.modulus, SERIES.angular_integrals, SERIES.extrapolated_shares):
        for w in (0.0, 9.9, [100.0, 1.01e4]):
            with pytest.raises(OutOfRange, match=r'fitted on \[10, 10000\] rad/s; .*"prony"'):
                call(w)


def test_a_shift_moves_the_range():
    for series in (SERIES, BEYOND):
        cold = series.shifted(100.0)
        assert isinstance(cold, asperity.PronyFit)
        assert (cold.lowest_frequency, cold.highest_frequency) == pytest.approx((0.1, 100.0))
        assert cold.extrapolation == series.extrapolation
        assert cold.modulus(1.0) == pytest.approx(series.modulus(100.0))
        assert pickle.loads(pickle.dumps(cold)) == cold
    with pytest.raises(OutOfRange):
        pickle.loads(pickle.dumps(SERIES.shifted(100.0))).modulus(101.0)


@pytest.mark.parametrize("velocity", [1e-3, 0.1])
def test_friction_and_area_stay_on_the_fitted_frequencies(velocity):
    inside = asperity.friction(ROAD.truncated(q1=1e5), SERIES, pressure=1e5, velocity=0.05)
    assert 0 < inside.extrapolated_share < 0.02  # where cos(phi) ends
    assert not any(SHARE in note for note in inside.notes)
    known = r"known in \[10, 10000\] rad/s; extrapolation=\"prony\""
    for ask in (asperity.friction, asperity.contact_area):
        with pytest.raises(OutOfRange, match=rf"^velocity = {velocity}: q0 = .*{known}"):
            ask(ROAD, SERIES, pressure=1e5, velocity=velocity)
        ask(ROAD, BEYOND, pressure=1e5, velocity=velocity)


@pytest.mark.parametrize("velocity", [1e-3, 0.1, 10.0])
def test_friction_beyond_the_fit_tells_its_share(velocity):
    result = asperity.friction(ROAD, BEYOND, pressure=1e6, velocity=velocity, contributions=True)
    outside = BEYOND.extrapolated_shares(velocity * result.wavenumber)[0]
    part = np.trapezoid(result.dmu_dlnq * outside, np.log(result.wavenumber))
    assert result.extrapolated_share == pytest.approx(part / result.hysteresis, rel=0.02)
    assert result.extrapolated_share > 0.1
    assert sum(SHARE in note for note in result.notes) == 1
    if velocity == 10:  # 200 times beyond the measured frequencies
        assert result.extrapolated_share > 0.9
    by_definition = asperity.friction(ROAD, BEYOND, pressure=1e6, velocity=velocity, method="qag")
    assert result.extrapolated_share == pytest.approx(by_definition.extrapolated_share, rel=1e-3)


def test_the_macro_asperities_of_a_correction_are_asked_on_the_fitted_frequencies():
    correction = asperity.GreenwoodWilliamson(z_max=3e-4, z_min=-3e-4, q0=100.0)
    ask = {"pressure": 1e5, "velocity": 0.04, "correction": correction}
    with pytest.raises(
        OutOfRange, match=r'q0 = 100 1/m of the correction .* extrapolation="prony"'
    ):
        asperity.friction(ROAD, SERIES, **ask)
    asperity.friction(ROAD, BEYOND, **ask)


def test_a_series_given_by_hand_has_no_range():
    by_hand = prony(SERIES.equilibrium_modulus, SERIES.moduli, SERIES.relaxation_times)
    w = np.array([0.0, 1.0, 1e9])
    np.testing.assert_array_equal(by_hand.modulus(w), BEYOND.modulus(w))
    np.testing.assert_array_equal(by_hand.extrapolated_shares(w[1:]), 0)
    result = asperity.friction(ROAD, by_hand, pressure=1e6, velocity=10.0)
    assert result.extrapolated_share == 0
    assert result.mu == asperity.friction(ROAD, BEYOND, pressure=1e6, velocity=10.0).mu


@pytest.mark.parametrize("extrapolation", ["power-law", "clamp", "Prony", 1])
def test_no_other_extrapolation(extrapolation):
    with pytest.raises(asperity.InvalidInput, match=r"^extrapolation = "):
        fitted(extrapolation=extrapolation)
