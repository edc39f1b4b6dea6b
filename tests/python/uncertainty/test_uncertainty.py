"""A band on mu from the standard errors of what was measured."""

import csv
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity import (
    InvalidInput,
    Isotherm,
    OutOfRange,
    PronySeries,
    SelfAffineSpectrum,
    TabulatedSpectrum,
    build_master_curve,
    fit_prony,
    fit_self_affine,
    friction,
    friction_band,
)
from asperity.cli.main import main
from asperity.scene.scene import load_scene
from asperity.uncertainty.band import relative_band, swept_band
from asperity.uncertainty.draws import (
    Drawn,
    Inputs,
    ShiftedRubber,
    drawn_rubber,
    drawn_spectrum,
)
from helpers.heat import HEATING, LAW
from helpers.rubbers import curve_of, prony

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
from band_coverage import KINDS
from coverage_isotherms import trial

ROAD = SelfAffineSpectrum(rms_height=2e-4, hurst=0.8, q0=2e3, q1=2e5)
RUBBER = prony(3e6, np.geomspace(2e8, 2e6, 9), np.geomspace(1e-8, 1e0, 9))
SCENE = {"pressure": 2e5, "velocity": [1e-4, 1e-3, 1e-2]}
TEMPERATURES = np.arange(263.0, 324.0, 10.0)
T_REF = 293.0


def measured_spectrum(seed, rows=30):
    """The road's densities as a scan's rings would scatter about them."""
    q = np.geomspace(2e3, 2e5, rows)
    count = np.round(20 * (q / q[0]) ** 1.5)
    rng = np.random.default_rng(seed)
    density = ROAD.at(q) * rng.gamma(count / 2) / (count / 2)
    return TabulatedSpectrum(
        wavenumber=q, density=density, count=count, standard_error=density * np.sqrt(2 / count)
    )


def measured_isotherms(seed, noise=0.01):
    """Sweeps of the rubber, a_T after WLF, every modulus off by 1 %."""
    rng = np.random.default_rng(seed)
    w = np.geomspace(0.1, 100, 13)
    sweeps = []
    for t in TEMPERATURES:
        a_t = 10 ** (-8.86 * (t - T_REF) / (101.6 + t - T_REF))
        e = RUBBER.modulus(a_t * w)
        scatter = np.exp(noise * rng.normal(size=(2, w.size)))
        sweeps.append(
            Isotherm(
                temperature=t,
                angular_frequency=w,
                storage_modulus=e.real * scatter[0],
                loss_modulus=e.imag * scatter[1],
            )
        )
    return sweeps


def built(seed, noise=0.01):
    isotherms = measured_isotherms(seed, noise)
    return build_master_curve(isotherms, reference_temperature=T_REF, smooth=True)


@pytest.mark.parametrize("temperature", [None, 298.0])
@pytest.mark.parametrize("extrapolation", ["power-law", "clamp"])
def test_a_draw_answers_wherever_the_plain_curve_does(extrapolation, temperature):
    """Drawn shifts move the ends of what was measured."""
    build = build_master_curve(
        measured_isotherms(1), reference_temperature=T_REF, extrapolation=extrapolation
    )
    a_t = 1 if temperature is None else build.shift_factor(temperature)
    low, high = build.master_curve.angular_frequency[[0, -1]] * [0.1, 10] / a_t
    scene = {"pressure": 2e5, "velocity": [low / ROAD.q0, high / ROAD.q1]}
    if temperature is not None:
        scene["temperature"] = temperature
    band = friction_band(ROAD, build, samples=30, seed=1, **scene)
    assert not any("draws that failed" in note for note in band.notes)
    assert (band.lower > 0).all()
    assert (band.lower < band.upper).all()


def test_draws_lie_about_the_curve_that_they_are_drawn_for():
    """A curve of noisy points is off the spline whose errors are drawn, to either side."""
    band = SelfAffineSpectrum(rms_height=2e-4, hurst=0.8, q0=2e3, q1=2e4)
    scene = {"pressure": 2e5, "velocity": np.geomspace(1e-5, 1e-2, 4)}
    off = []
    for seed in range(8):
        build = build_master_curve(measured_isotherms(seed, 0.05), reference_temperature=T_REF)
        solid, rng = drawn_rubber(build), np.random.default_rng(seed)
        drawn = [np.log(friction(band, solid(rng).rubber, **scene).mu) for _ in range(60)]
        centre = np.log(friction(band, build.master_curve, **scene).mu)
        off.append((np.median(drawn, axis=0) - centre) / np.std(drawn, axis=0))
    assert np.abs(off).max() < 1  # the median of 60 draws scatters by 0.16 deviations


def test_a_band_of_a_scan_that_is_too_small_says_so():
    for points, small in ((64, True), (256, False)):
        whole = asperity.synthesize(
            SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=1.5e5),
            shape=(2 * points, 2 * points),
            pixel_size=2e-5,
            seed=1,
        )
        crop = asperity.HeightMap(whole.heights[:points, :points].copy(), pixel_size=2e-5)
        band = friction_band(asperity.power_spectrum(crop), RUBBER, **SCENE, samples=20)
        assert any("the scan is too small" in note for note in band.notes) == small
        assert any("holds too few periods" in note for note in band.notes)


def test_bands_of_random_rubbers_hold_the_truth_and_stand_still():
    """tests/stability/band_coverage.py runs 200 trials of 100 draws."""
    held, _, moved = (
        np.array(x) for x in zip(*[trial(9, k, samples=60) for k in range(25)], strict=True)
    )
    assert 0.86 < held.mean() < 0.995  # 25 trials at velocities that are not independent
    assert np.median(moved) < 0.2  # of the width, between two seeds


@pytest.mark.parametrize("kind", ["rings-hann", "fit-hann"])
def test_bands_of_random_scans_hold_the_truth_and_stand_still(kind):
    """tests/stability/band_coverage.py runs 200 trials of 100 draws."""
    held, _, moved = (
        np.array(x) for x in zip(*[KINDS[kind](9, k, 60) for k in range(30)], strict=True)
    )
    assert held.mean() > 0.9  # 30 trials at velocities that are not independent
    assert np.median(moved) < 0.2  # of the width, between two seeds


def test_independent_errors_add_as_squares():
    table, build = measured_spectrum(1).truncated(q1=2e4), built(1, noise=0.05)
    scene = {"pressure": 2e5, "velocity": 1e-4}
    plain = TabulatedSpectrum(wavenumber=table.wavenumber, density=table.density)
    bands = [
        friction_band(spectrum, rubber, **scene, samples=200)
        for spectrum, rubber in ((plain, build), (table, build.master_curve), (table, build))
    ]
    first, second, both = (float(band.upper - band.lower) for band in bands)
    assert min(first, second) > 0.3 * max(first, second)  # else one would hide the other
    assert both == pytest.approx(np.hypot(first, second), rel=0.2)  # 200 draws scatter by 7 %


def test_halving_the_errors_halves_the_band():
    scene = {"pressure": 2e5, "velocity": 1e-3}
    table = measured_spectrum(4)
    sharper = TabulatedSpectrum(
        wavenumber=table.wavenumber,
        density=table.density,
        count=4 * table.count,
        standard_error=table.standard_error / 2,
    )
    wide, narrow = (friction_band(t, RUBBER, **scene, samples=200) for t in (table, sharper))
    ratio = float((wide.upper - wide.lower) / (narrow.upper - narrow.lower))
    assert ratio == pytest.approx(2, rel=0.15)  # 200 draws: a quantile's scatter


def test_the_same_seed_gives_the_same_band_and_another_seed_another():
    fit = fit_self_affine(measured_spectrum(2))
    bands = [friction_band(fit, RUBBER, **SCENE, seed=seed) for seed in (3, 3, 4)]
    np.testing.assert_array_equal(bands[0].lower, bands[1].lower)
    np.testing.assert_array_equal(bands[0].upper, bands[1].upper)
    assert (bands[0].lower != bands[2].lower).all()


def test_shape_level_and_samples():
    fit = fit_self_affine(measured_spectrum(2))
    points = {"pressure": [[1e5], [2e5]], "velocity": [1e-4, 1e-3, 1e-2]}
    wide = friction_band(fit, RUBBER, **points)
    half = friction_band(fit, RUBBER, **points, level=0.5)
    mu = friction(fit.spectrum, RUBBER, **points).mu
    assert wide.lower.shape == wide.upper.shape == (2, 3)
    assert (wide.lower < half.lower).all()
    assert (half.lower < mu).all()
    assert (mu < half.upper).all()
    assert (half.upper < wide.upper).all()
    assert (wide.level, half.level, wide.samples) == (0.95, 0.5, 100)


def test_a_fitted_adhesion_brings_its_own_errors():
    velocity = np.geomspace(1e-6, 1, 40)
    truth = asperity.Adhesion(shear_stress=5e6)
    mu = friction(ROAD, RUBBER, pressure=2e5, velocity=velocity, adhesion=truth).mu
    inside = []
    for seed in range(40):
        noisy = mu * np.exp(0.05 * np.random.default_rng(seed).normal(size=mu.size))
        fit = asperity.fit_adhesion(
            ROAD, RUBBER, velocity=velocity, mu=noisy, pressure=2e5, fixed={"width": 0.1}
        )
        points = {"pressure": 2e5, "velocity": velocity[::8]}
        band = friction_band(ROAD, RUBBER, **points, adhesion=fit, seed=seed)
        inside.append((band.lower <= mu[::8]) & (mu[::8] <= band.upper))
    # 95 % of 40, at each velocity: below 33 once in 700 draws of a binomial
    assert (np.mean(inside, axis=0) >= 33 / 40).all()


def failing(every, kind):
    """A rubber each n-th draw of which fails, or is not known where it is asked."""
    count = 0
    w = np.array([1e9, 1e10])
    unknown = curve_of(w, RUBBER.modulus(w))

    def draw(rng):
        nonlocal count
        count += 1
        if kind == "draw" and count % every == 0:
            raise OutOfRange("velocity = 1: not measured")
        return ShiftedRubber(RUBBER if count % every else unknown)

    return Drawn(ShiftedRubber(RUBBER), draw)


@pytest.mark.parametrize("kind", ["draw", "curve"])
def test_a_band_says_how_many_draws_it_left_out(kind):
    at = {"pressure": 2e5, "velocity": 1e-3}

    def inputs(every):
        return Inputs(drawn_spectrum(measured_spectrum(3)), failing(every, kind), None, at)

    how = {"samples": 40, "seed": 1, "level": 0.9}
    alone, shared = (relative_band(inputs(15), **how, threads=n) for n in (1, 3))
    np.testing.assert_array_equal([alone.lower, alone.upper], [shared.lower, shared.upper])
    (note,) = alone.notes
    assert shared.notes == (note,)
    assert note.startswith("the band leaves out 2 of 40 draws that failed, the last with: velocity")
    assert relative_band(inputs(41), **how).notes == ()
    with pytest.raises(OutOfRange, match=r"^velocity = "):
        relative_band(inputs(5), **how)


def test_without_friction_the_band_has_no_width():
    elastic = PronySeries(equilibrium_modulus=1e6, moduli=[], relaxation_times=[])
    band = friction_band(fit_self_affine(measured_spectrum(2)), elastic, **SCENE)
    np.testing.assert_array_equal(band.lower, 0)
    np.testing.assert_array_equal(band.upper, 0)


@pytest.mark.parametrize(
    ("argument", "given"),
    [
        ("", {"spectrum": ROAD}),  # no argument has errors
        ("rubber", {}),  # a PronyFit, which does not know its errors
        ("samples", {"samples": 19}),
        ("seed", {"seed": -1}),
        ("level", {"level": 1}),
        ("pressure", {"pressure": -1}),
        ("temperature", {"temperature": 293.0}),
        ("shift", {"shift": LAW}),
        ("heating", {"heating": HEATING}),
        ("branch", {"branch": "hot"}),
    ],
)
def test_bad_input(argument, given):
    if argument == "rubber":
        given = {"rubber": fit_prony(built(1))}
    fit = fit_self_affine(measured_spectrum(2))
    with pytest.raises(InvalidInput) as caught:
        friction_band(**{"spectrum": fit, "rubber": RUBBER, **SCENE} | given)
    assert caught.value.argument == argument


TOML = """
[surface]
file = "scan.npy"
pixel_size_m = 1e-5
unit = "m"
{fit}
[rubber]
equilibrium_modulus_pa = 3e6
moduli_pa = [1e8, 1e7]
relaxation_times_s = [1e-6, 1e-4]
[conditions]
pressure_pa = 2e5
velocity_m_s = {{from = 1e-4, to = 1e-2, points = {points}}}
{more}
"""


@pytest.fixture
def scene(tmp_path):
    surface = SelfAffineSpectrum(rms_height=2e-5, hurst=0.8, q0=2e4, q1=3e5)
    heights = asperity.synthesize(surface, shape=(200, 240), pixel_size=1e-5, seed=4).heights
    np.save(tmp_path / "scan.npy", heights)
    path = tmp_path / "scene.toml"

    def write(fit="", more="", points=5):
        path.write_text(TOML.format(fit=fit, more=more, points=points))
        return path

    return write


def rows(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def test_a_scene_that_asks_for_a_band_has_two_more_columns(scene, tmp_path):
    out = tmp_path / "mu.csv"
    assert main(["friction", str(scene()), "--output", str(out)]) == 0
    assert "mu_low" not in rows(out)[0]
    path = scene(more="[uncertainty]\nsamples = 30\nlevel = 0.9", points=20)
    assert main(["friction", str(path), "--output", str(out)]) == 0
    assert len(rows(out)) == 20
    for row in rows(out):
        low, mu, high = (float(row[name]) for name in ("mu_low", "mu", "mu_high"))
        assert 0.5 * mu < low < mu < high < 2 * mu
    assert "# uncertainty.level = 0.9" in out.read_text()


def test_between_its_velocities_a_band_runs_straight_over_ln_v():
    velocity = np.geomspace(1e-6, 1e2, 25)  # every other one of the 13 that are computed
    inputs = Inputs(drawn_spectrum(measured_spectrum(3)), drawn_rubber(RUBBER), None, {})
    how = {"samples": 20, "seed": 1, "level": 0.9}
    points = {"pressure": np.full(25, 2e5), "velocity": velocity}
    direct = relative_band(inputs.with_options(**points), **how)
    swept = swept_band(inputs, np.array([2e5]), velocity, **how)
    for exact, (result,) in zip(direct[:2], swept[:2], strict=True):
        np.testing.assert_allclose(result[::2], exact[::2], rtol=1e-9)
        np.testing.assert_allclose(result[1::2], (result[:-1:2] + result[2::2]) / 2, rtol=1e-12)


def test_a_scene_takes_the_fitted_law_beyond_what_the_scan_resolves(scene, tmp_path, capsys):
    out = tmp_path / "mu.csv"
    path = scene(fit='fit = "self-affine"\nq1_per_m = 1e6')
    assert main(["friction", str(path), "--output", str(out)]) == 0
    assert "is the fitted law gone on with, beyond" in capsys.readouterr().err
    loaded = load_scene(path)
    assert isinstance(loaded.spectrum, SelfAffineSpectrum)
    assert loaded.spectrum.q1 == 1e6
    assert loaded.spectrum.hurst == pytest.approx(0.8, abs=0.05)
    mu = loaded.friction().mu
    lower, upper, notes = loaded.band(mu)
    assert notes == ()
    assert ((lower < mu) & (mu < upper)).all()  # the drawn laws go on as far
