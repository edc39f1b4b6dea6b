"""Adhesion from measured friction: truth, noise, outliers, pressures, what is held and refused."""

import pickle

import numpy as np
import pytest

import asperity
from asperity import Adhesion, AffineShift, InvalidInput, fit_adhesion, friction
from helpers.refusals import refused
from helpers.rubbers import prony

ROAD = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
ROAD = ROAD.truncated(q1=ROAD.cutoff_for_slope(1.3))
RUBBER = prony(3e6, [1e7, 1e8, 1e9], [1e-2, 1e-4, 1e-6])
TRUTH = Adhesion(shear_stress=8.3e6)
MODEL = {"correction": AffineShift(2.0)}
NAMES = ("shear_stress", "reference_velocity", "width")


def measured(velocity=None, pressure=81e3, noise=0.0, seed=1, truth=TRUTH):
    """Keywords of fit_adhesion for friction with noise in proportion to mu."""
    velocity = np.geomspace(1e-6, 1, 24) if velocity is None else np.asarray(velocity)
    mu = friction(
        ROAD, RUBBER, pressure=pressure, velocity=velocity, adhesion=truth, rtol=1e-9, **MODEL
    ).mu
    mu = mu * (1 + noise * np.random.default_rng(seed).standard_normal(np.shape(mu)))
    return {"velocity": velocity, "pressure": pressure, "mu": mu, **MODEL}


def parameters(fit):
    return np.array([getattr(fit, name) for name in NAMES])


@pytest.mark.reference("adhesion_fit")
def test_reference_fits(row):
    surface = asperity.SelfAffineSpectrum(
        rms_height=row["rms_height"], hurst=row["hurst"], q0=row["q0"], q1=row["q1"]
    )
    names = ("equilibrium_modulus", "moduli", "relaxation_times")
    held = {name: row[f"fixed_{name}"] for name in NAMES if row[f"fixed_{name}"] is not None}
    fit = fit_adhesion(
        surface,
        asperity.PronySeries(**{name: row[name] for name in names}),
        velocity=row["velocities"],
        mu=row["measured"],
        pressure=row["pressures"],
        fixed=held,
        correction=AffineShift(row["shift_factor"]),
    )
    assert parameters(fit) == pytest.approx([row[name] for name in NAMES], rel=row["rtol"])
    np.testing.assert_array_equal(np.flatnonzero(fit.outliers), row["outliers"])
    if row["residual"] is None:
        assert fit.residual < 1.01e-6  # the tolerance of mu
        assert max(fit.standard_errors.values()) < 1
    else:
        assert fit.residual == pytest.approx(row["residual"], rel=row["rtol"])
        for name in NAMES:
            expected = row[f"{name}_error"]
            assert fit.standard_errors[name] == pytest.approx(expected, rel=10 * row["rtol"])


@pytest.mark.parametrize(
    "truth",
    [
        Adhesion(shear_stress=5.3e6),
        Adhesion(shear_stress=8.3e6, reference_velocity=1e-3, width=0.3),
        Adhesion(shear_stress=1e5, reference_velocity=0.5, width=0.02),
        Adhesion(shear_stress=3e7, reference_velocity=1e-5, width=2.0),
    ],
)
@pytest.mark.parametrize("correction", [None, asperity.SFactor(applies_to="both")])
def test_exact_friction_gives_its_adhesion_back(truth, correction):
    scene = {"velocity": np.geomspace(1e-6, 1, 20), "pressure": 2e5, "correction": correction}
    mu = friction(ROAD, RUBBER, adhesion=truth, rtol=1e-9, **scene).mu
    fit = fit_adhesion(ROAD, RUBBER, mu=mu, rtol=1e-9, **scene)
    # mu is known to 1e-9, the adhesion is down to 1e-3 of it
    assert parameters(fit) == pytest.approx(parameters(truth), rel=1e-6)
    assert not fit.outliers.any()


@pytest.mark.parametrize("outliers", [0, 8])
def test_errors_are_the_scatter_of_fits_to_noise_and_outliers(outliers):
    """5 % of noise on 40 points; 60 fits tell the scatter to 9 %."""
    clean = measured(np.geomspace(1e-6, 1, 40)) | {"rtol": 1e-3}
    off, stated = [], []
    for seed in range(60):
        rng = np.random.default_rng(seed)
        mu = clean["mu"] * (1 + 0.05 * rng.normal(size=40))
        wrong = rng.permutation(40)[:outliers]
        mu[wrong] *= np.where(np.arange(outliers) % 2, 0.3, 3)
        fit = fit_adhesion(ROAD, RUBBER, **{**clean, "mu": mu})
        assert fit.outliers[wrong].all()
        scale = np.array([fit.shear_stress, fit.reference_velocity, 1])
        ratio = parameters(fit) / parameters(TRUTH)
        off.append([*np.log(ratio[:2]), fit.width - TRUTH.width])
        stated.append(np.diag(fit.covariance) / scale**2)
    ratio = np.sqrt(np.mean(np.square(off), axis=0) / np.mean(stated, axis=0))
    assert ratio == pytest.approx(np.ones(3), abs=0.27)
    # the least that an unbiased estimate of these points can scatter is 1.3 % and 0.061 decades
    near = np.abs(np.array(off)[:, :2]) < [0.05, 0.1 * np.log(10)]
    assert (near.mean(axis=0) >= [0.97, 0.75]).all()


@pytest.mark.parametrize(("modulus", "time"), [(3.7, 1.0), (1.0, 3.7)])
def test_units_of_pressure_and_of_velocity(modulus, time):
    points = measured(np.geomspace(1e-5, 1e-1, 16), noise=0.05)
    first = fit_adhesion(ROAD, RUBBER, **points)
    other = prony(
        modulus * RUBBER.equilibrium_modulus,
        modulus * RUBBER.moduli,
        time * RUBBER.relaxation_times,
    )
    points |= {"pressure": modulus * 81e3, "velocity": points["velocity"] / time}
    fit = fit_adhesion(ROAD, other, **points)
    # minima are found to about 1e-8 of a standard error, which is 0.1 of the values
    expected = parameters(first) * [modulus, 1 / time, 1]
    assert parameters(fit) == pytest.approx(expected, rel=1e-7)


def test_a_fit_is_an_adhesion():
    points = measured(noise=0.05)
    fit = fit_adhesion(ROAD, RUBBER, **points)
    assert isinstance(fit, Adhesion)
    assert type(fit.adhesion) is Adhesion
    scene = {"pressure": 81e3, "velocity": [1e-4, 1e-2]}
    by_fit, by_values = (friction(ROAD, RUBBER, adhesion=a, **scene) for a in (fit, fit.adhesion))
    np.testing.assert_array_equal(by_fit.mu, by_values.mu)
    assert pickle.loads(pickle.dumps(fit)) == fit
    assert fit.outliers.shape == points["mu"].shape
    covariance = fit.covariance
    np.testing.assert_array_equal(covariance, covariance.T)
    errors = [fit.standard_errors[name] for name in NAMES]
    np.testing.assert_array_equal(np.sqrt(np.diag(covariance)), errors)
    expected = errors[1] / fit.reference_velocity / np.log(10)
    assert fit.log10_reference_velocity_error == pytest.approx(expected, rel=1e-14, abs=0)


def test_points_count_by_their_relative_error():
    # 40 % of the smallest mu is less than 5 % of the largest: an outlier all the same
    narrow = Adhesion(shear_stress=8.3e6, width=0.3)
    points = measured(pressure=np.array([[81e3], [8e5]]), noise=0.05, truth=narrow)
    mu = points["mu"]
    least = np.unravel_index(np.argmin(mu), mu.shape)
    assert 0.4 * mu[least] < 0.05 * mu.max()
    mu[least] *= 0.6
    fit = fit_adhesion(ROAD, RUBBER, **points)
    assert fit.outliers[least]
    assert fit.outliers.sum() == 1
    assert fit.residual == pytest.approx(0.05, rel=0.3)  # 48 points: a scale to 15 %


@pytest.mark.parametrize("factor", [4.0, 0.25])
@pytest.mark.parametrize("first", [0, 5, 10, 15, 20])
def test_a_row_of_outliers_moves_nothing(factor, first):
    points = measured(noise=0.03)
    rows = slice(first, first + 4)  # of 24
    without = {key: np.delete(points[key], rows) for key in ("mu", "velocity")}
    alone = fit_adhesion(ROAD, RUBBER, **{**points, **without})
    points["mu"][rows] *= factor
    fit = fit_adhesion(ROAD, RUBBER, **points)
    assert fit.outliers[rows].all()
    assert fit.outliers.sum() == 4
    assert "points-aside" in {note.code for note in fit.notes}
    # the points that are left weigh a little differently where the scale is larger
    assert fit.shear_stress == pytest.approx(alone.shear_stress, rel=0.01)
    shift = np.log10(fit.reference_velocity / alone.reference_velocity)
    assert abs(shift) < 0.5 * alone.log10_reference_velocity_error


def test_outliers_up_and_down_by_any_factor_are_the_same_outliers():
    fits = []
    for factor in (0.01, 0.3, 3.0, 1e4):
        points = measured(noise=0.05)
        points["mu"][[3, 11, 17]] *= factor
        fits.append(parameters(fit_adhesion(ROAD, RUBBER, **points)))
    np.testing.assert_allclose(fits, fits[:1] * 4, rtol=1e-8)


def test_order_and_shape_of_the_points_do_not_matter():
    points = measured(pressure=np.array([[81e3], [2e5]]), noise=0.05)
    fit = fit_adhesion(ROAD, RUBBER, **points)
    assert fit.outliers.shape == (2, 24)
    order = np.random.default_rng(3).permutation(48)
    columns = np.broadcast_arrays(points["velocity"], points["pressure"], points["mu"])
    velocity, pressure, mu = (column.ravel()[order] for column in columns)
    shuffled = fit_adhesion(ROAD, RUBBER, velocity=velocity, pressure=pressure, mu=mu, **MODEL)
    # sums in another order: the minimum is found to about 1e-8 of a standard error
    assert parameters(shuffled) == pytest.approx(parameters(fit), rel=1e-8)
    np.testing.assert_array_equal(shuffled.outliers, fit.outliers.ravel()[order])
    assert shuffled.notes == fit.notes


def test_every_point_four_times_halves_the_errors():
    once = measured(noise=0.05)
    four = {**once, "velocity": np.repeat(once["velocity"], 4), "mu": np.repeat(once["mu"], 4)}
    fit, narrow = fit_adhesion(ROAD, RUBBER, **once), fit_adhesion(ROAD, RUBBER, **four)
    # the scale, of residuals over n - p, changes a little, and with it the weights;
    # so does the correction of the errors for few points
    assert parameters(narrow) == pytest.approx(parameters(fit), rel=0.05)
    for name in NAMES:
        ratio = narrow.standard_errors[name] / fit.standard_errors[name]
        assert ratio == pytest.approx(np.sqrt((24 - 3) / (96 - 3)), rel=0.08)


@pytest.mark.parametrize("name", NAMES)
def test_held_ones_stay_and_the_others_are_known_better(name):
    points = measured(noise=0.05)
    free = fit_adhesion(ROAD, RUBBER, **points)
    fit = fit_adhesion(ROAD, RUBBER, fixed={name: getattr(TRUTH, name)}, **points)
    assert getattr(fit, name) == getattr(TRUTH, name)
    at = NAMES.index(name)
    assert not fit.covariance[at].any()
    assert not fit.covariance[:, at].any()
    for other in set(NAMES) - {name}:
        assert 0 < fit.standard_errors[other] < 1.1 * free.standard_errors[other]


def test_friction_without_a_maximum_is_width_zero_about_a_held_velocity():
    points = measured(noise=0.05, truth=Adhesion(shear_stress=8.3e6, width=0.0), seed=3)
    fit = fit_adhesion(ROAD, RUBBER, fixed={"reference_velocity": 6e-3}, **points)
    assert fit.width <= 2 * fit.standard_errors["width"] < 0.01
    assert fit.shear_stress == pytest.approx(8.3e6, rel=0.05)
    with refused("velocity", "undetermined"):
        fit_adhesion(ROAD, RUBBER, **points)


@pytest.mark.parametrize("upper", [1e-5, 3e-5])
def test_a_flank_alone_does_not_settle_the_maximum(upper):
    points = measured(np.geomspace(1e-6, upper, 24), noise=0.05, seed=2)
    with refused("velocity", "undetermined"):
        fit_adhesion(ROAD, RUBBER, **points)
    fit = fit_adhesion(ROAD, RUBBER, fixed={"width": 0.1, "reference_velocity": 6e-3}, **points)
    assert fit.shear_stress == pytest.approx(8.3e6, rel=0.05)


def test_a_maximum_beyond_the_points_is_said_to_be_extrapolated():
    fit = fit_adhesion(ROAD, RUBBER, **measured(np.geomspace(1e-6, 1e-3, 24), noise=0.005))
    assert "maximum-extrapolated" in {note.code for note in fit.notes}
    inside = fit_adhesion(ROAD, RUBBER, **measured(np.geomspace(1e-6, 1e-2, 24), noise=0.005))
    assert "maximum-extrapolated" not in {note.code for note in inside.notes}


def test_hysteresis_that_is_wrong_is_noticed_where_scatter_allows():
    points = measured(np.geomspace(1e-6, 1, 60), noise=0.03)
    right = fit_adhesion(ROAD, RUBBER, **points)
    assert "systematic-misfit" not in {note.code for note in right.notes}
    wrong = fit_adhesion(ROAD, RUBBER, **{**points, "correction": AffineShift(1.5)})
    assert "systematic-misfit" in {note.code for note in wrong.notes}


@pytest.mark.parametrize("correction", [None, AffineShift(2.0)])
def test_friction_below_the_hysteresis(correction):
    scene = {"velocity": np.geomspace(1e-6, 1, 24), "pressure": 81e3, "correction": correction}
    mu = friction(ROAD, RUBBER, **scene).mu / 1.5
    with refused("mu", "no-adhesion-left"):
        fit_adhesion(ROAD, RUBBER, mu=mu, **scene)


def test_friction_of_the_hysteresis_alone():
    points = measured(truth=None, noise=0.02)
    with refused("velocity", "undetermined"):
        fit_adhesion(ROAD, RUBBER, **points)


V = [1e-4, 1e-3, 1e-2, 1e-1]
MU = [0.8, 0.9, 1.0, 0.9]
HELD = {"width": 0.1, "reference_velocity": 6e-3}
REFUSED = [
    ("velocity", {"velocity": V[:3], "mu": MU[:3]}),  # fewer than parameters
    ("velocity", {"velocity": [1e-3] * 9, "mu": [1.0] * 9}),
    ("velocity", {"velocity": 1e-3, "mu": 1.0, "fixed": HELD}),
    *(("mu", {"mu": [0.8, wrong, 1.0, 0.9]}) for wrong in (-1.0, 0.0, np.nan, np.inf)),
    *(("mu", {"mu": wrong}) for wrong in (MU[:3], 1.0, ["a"] * 4)),
    ("mu", {"pressure": [[1e5], [2e5]]}),
    ("", {"pressure": [1e5, 2e5]}),  # shapes of two arguments
    ("velocity", {"velocity": [1e-4, 1e-3, 0.0, 1.0]}),
    ("pressure", {"pressure": -1.0}),
    ("fixed", {"fixed": {"tau": 1.0}}),
    ("fixed", {"fixed": ["width"]}),
    ("fixed", {"fixed": dict.fromkeys(NAMES, 1.0)}),  # leaves nothing to fit
    *(("fixed: width", {"fixed": {"width": wrong}}) for wrong in (-0.1, np.nan, [0.1], None, 0.0)),
    ("fixed: shear_stress", {"fixed": {"shear_stress": 0.0}}),
    ("fixed: reference_velocity", {"fixed": {"reference_velocity": 0}}),
    ("rtol", {"rtol": 1.0}),
]


@pytest.mark.parametrize(("argument", "changed"), REFUSED)
def test_bad_arguments(argument, changed):
    arguments = {"velocity": V, "mu": MU, "pressure": 81e3} | changed
    with pytest.raises(InvalidInput) as caught:
        fit_adhesion(ROAD, RUBBER, **arguments)
    assert caught.value.argument == argument


def test_a_point_without_contact():
    lost = asperity.GreenwoodWilliamson(z_max=3e-4, z_min=-1e-3)
    scene = {"pressure": 1.0, "velocity": V, "correction": lost}
    assert np.isinf(friction(ROAD, RUBBER, **scene).shift_factor).all()
    with refused("mu", "no-contact"):
        fit_adhesion(ROAD, RUBBER, mu=MU, **scene)
