"""A band on mu from slopes and covariances, beside the one of draws."""

import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, SelfAffineSpectrum, friction, friction_band
from asperity.dma import draw_master_curve, master_curve_modes
from helpers.heat import HEATING

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
from band_coverage import road_of, scanned
from coverage_isotherms import ROAD, SCENE, T_REF, measured, rubber_of

RNG = np.random.default_rng(3)
RUBBER = rubber_of(RNG)
PIXEL = 2e-5
RINGS = scanned(road_of(RNG, 400 * PIXEL, PIXEL), 200, PIXEL, "hann", RNG)
FIT = asperity.fit_self_affine(RINGS)
POINTS = {"pressure": 3e5, "velocity": np.geomspace(1e-5, 1e-1, 4)}
STICKING = asperity.AdhesionFit(
    shear_stress=2e6,
    reference_velocity=6e-3,
    width=0.1,
    covariance=[[1e11, 20.0, 0.0], [20.0, 1e-6, 0.0], [0.0, 0.0, 1e-4]],
    residual=0.05,
    outliers=[False],
)


def built(smooth):
    noise = np.random.default_rng(1)
    how = {"reference_temperature": T_REF, "extrapolation": "power-law"}
    return asperity.build_master_curve(measured(RUBBER, 0.02, noise), smooth=smooth, **how)


def width(band):
    return np.log(band.upper / band.lower)


@pytest.mark.parametrize(
    ("spectrum", "rubber", "more"),
    [
        (RINGS.truncated(q1=1e5), RUBBER, {"correction": asperity.PartialContact()}),
        (FIT, RUBBER, {"correction": asperity.NayakSFactor()}),
        (ROAD, built(True), {}),
        (ROAD, built(False), {"temperature": 300.0, "correction": asperity.PartialContact()}),
        (ROAD, RUBBER, {"adhesion": STICKING}),
        (FIT, built(True), {"adhesion": STICKING, "temperature": [[290.0], [305.0]]}),
    ],
)
def test_a_linear_band_is_as_wide_as_that_of_draws(spectrum, rubber, more):
    """400 draws tell a width to some 5 %."""
    drawn = friction_band(spectrum, rubber, **POINTS, **more, samples=400)
    linear = friction_band(spectrum, rubber, **POINTS, **more, method="linear")
    assert (linear.lower < linear.mu).all()
    np.testing.assert_allclose(width(linear), width(drawn), rtol=0.2)
    np.testing.assert_array_equal(linear.mu, drawn.mu)
    assert linear.samples == 0
    assert "linear-band-off" not in {note.code for note in linear.notes}


def test_a_band_of_the_shear_stress_is_its_share_of_mu():
    """mu is linear in tau_f0: a band of it alone is known."""
    alone = asperity.AdhesionFit(
        **{**STICKING._arguments(), "covariance": np.diag([1e10, 0.0, 0.0])}
    )
    result = friction(ROAD, RUBBER, **POINTS, adhesion=alone)
    band = friction_band(ROAD, RUBBER, **POINTS, adhesion=alone, method="linear", level=0.6827)
    assert width(band) / 2 == pytest.approx(result.adhesion / result.mu * 0.05, rel=1e-3)


def test_modes_of_a_smooth_build_are_as_large_as_draws():
    build = built(True)
    w = build.master_curve.angular_frequency[::6]
    storage, loss, decades = master_curve_modes(build, w)
    drawn = [draw_master_curve(build, seed) for seed in range(300)]
    moduli = np.array([one.master_curve.modulus(w) for one in drawn])
    for modes, draws in (
        (storage, np.log(moduli.real)),
        (loss, np.log(moduli.imag)),
        (decades, np.array([one.log10_a_T for one in drawn])),
    ):
        deviation = np.std(draws, axis=0)
        off = np.sqrt((modes**2).sum(axis=0)) - deviation
        assert np.abs(off).max() < 0.3 * deviation.max()
        assert np.sqrt(np.mean(off**2)) < 0.12 * np.sqrt(np.mean(deviation**2))


def test_it_says_where_mu_is_not_linear_in_the_inputs():
    """At its maximum an adhesion has no slope over its velocity, however uncertain that is."""
    unsure = np.diag([0.0, (1.5 * np.log(10) * 6e-3) ** 2, 0.0])
    wide = asperity.AdhesionFit(**{**STICKING._arguments(), "covariance": unsure})
    at_maximum = {**POINTS, "velocity": 6e-3, "adhesion": wide}
    linear = friction_band(ROAD, RUBBER, **at_maximum, method="linear")
    drawn = friction_band(ROAD, RUBBER, **at_maximum)
    assert width(linear) < width(drawn) / 10
    [note] = [note for note in linear.notes if note.code == "linear-band-off"]
    assert "draws" in note.next_step


@pytest.mark.parametrize(
    ("more", "named"),
    [
        ({"heating": HEATING, "temperature": 300.0}, "heating"),
        (
            {"strain_factors": asperity.StrainFactors(strain=[0.1], storage=[0.8], loss=[1.1])},
            "strain_factors",
        ),
        ({"method": "slopes"}, "method"),
        ({"level": 1.0}, "level"),
    ],
)
def test_what_has_no_linear_band_is_refused(more, named):
    with pytest.raises(InvalidInput, match=named) as refused:
        friction_band(ROAD, built(True), **POINTS, **{"method": "linear", **more})
    assert refused.value.argument == named


def test_a_scan_has_no_linear_band():
    road = SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1.5e5)
    scan = asperity.synthesize(road, shape=(32, 32), pixel_size=2e-5, seed=1)
    with pytest.raises(InvalidInput, match="correction: ScanContact has no linear band"):
        friction_band(
            asperity.power_spectrum(scan),
            RUBBER,
            **SCENE,
            correction=asperity.ScanContact(scan, periodic=True),
            method="linear",
        )
