"""Numbers of a scene from measured friction, and the scene beside it."""

import json
import math

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, fit_scene, read_scene
from asperity.cli.main import main
from asperity.scene.at_points import AtPoints, Slopes
from asperity.scene.unknowns import unknowns_of, with_numbers

pytest.importorskip("scipy")
SCENE = """
[surface]
rms_height_m = 265e-6
hurst = 0.87
q0_per_m = 300
q1_per_m = {q1}
[rubber]
equilibrium_modulus_pa = {modulus}
moduli_pa = [1e7, 1e8, 5e8]
relaxation_times_s = [1e-3, 1e-5, 1e-7]
wlf_c1 = 9.645
wlf_c2_k = 93.3
reference_temperature_c = 20
temperature_c = 30
[conditions]
pressure_pa = 2e5
velocity_m_s = 0.1
[correction]
kind = "partial-contact"
[adhesion]
shear_stress_pa = {stress}
"""
TRUTH = {"q1": 2e5, "modulus": 3e6, "stress": 1e6}
AWAY = {"q1": 3e5, "modulus": 4.5e6, "stress": 5e5}
KEYS = {
    "surface.q1_per_m": "q1",
    "rubber.equilibrium_modulus_pa": "modulus",
    "adhesion.shear_stress_pa": "stress",
}
VELOCITY = np.tile(np.geomspace(1e-5, 1, 10), 2)
PRESSURE = np.repeat([1e5, 4e5], 10)


@pytest.fixture
def scene(tmp_path):
    def write(name="scene.toml", **numbers):
        path = tmp_path / name
        path.write_text(SCENE.format(**{**AWAY, **numbers}))
        return path

    return write


def points(scene, noise=0.0, seed=1, **more):
    """What a tester would measure of the true scene."""
    mu = read_scene(scene("truth.toml", **TRUTH)).friction_at(PRESSURE, VELOCITY).mu
    scatter = noise * np.random.default_rng(seed).normal(size=mu.size)
    return {"mu": mu * np.exp(scatter), "velocity": VELOCITY, "pressure": PRESSURE, **more}


def test_three_numbers_come_back(scene):
    fit = fit_scene(scene(), points(scene), free=[*KEYS])
    for key, name in KEYS.items():
        assert fit.value[key] == pytest.approx(TRUTH[name], rel=1e-5)
    assert {*fit.slopes.values()} == {"gradients"}
    assert fit.rms < 1e-6
    assert read_scene_of(fit, scene).friction_at(PRESSURE, VELOCITY).mu == pytest.approx(fit.mu)


def read_scene_of(fit, scene):
    path = scene("fitted.toml")
    path.write_text(fit.toml)
    return read_scene(path)


def test_intervals_hold_the_truth(scene):
    """docs/howto/calibrate.md has 200 draws; 10 of three numbers scatter by 4 % about 95 %."""
    held = []
    for seed in range(10):
        fit = fit_scene(scene(**TRUTH), points(scene, 0.05, seed), free=[*KEYS])
        held += [fit.lower[k] < TRUTH[n] < fit.upper[k] for k, n in KEYS.items()]
    assert np.mean(held) > 0.83


def test_slopes_are_those_of_differences(scene):
    path = scene()
    unknown = [*KEYS, "rubber.relaxation_times_s[1]", "rubber.temperature_c", "adhesion.width"]
    model = model_of(path, points(scene))
    free = unknowns_of(path, model.tables, [*unknown, "surface.hurst"], {}, hot=False)
    start = np.array([one.inside(one.start) for one in free])
    slopes = Slopes(model, free, start)
    assert {*slopes.how.values()} == {"gradients"}
    by_gradients = slopes.jacobian(start)
    for k, one in enumerate(free):
        step = np.zeros(start.size)
        step[k] = 1e-3 * one.step
        ends = [
            model.log_mu(with_numbers(model.tables, free, x)) for x in (start - step, start + step)
        ]
        result = (ends[1] - ends[0]) / (2 * step[k])
        assert by_gradients[:, k] == pytest.approx(result, abs=2e-3 * np.abs(result).max())


def model_of(path, measured):
    from asperity.io.read_friction import measured_friction

    return AtPoints(path, read_scene(path).tables, *measured_friction(measured))


def test_a_number_without_slopes_takes_differences(scene):
    fit = fit_scene(
        scene(**{**TRUTH, "stress": 5e5}),
        points(scene),
        free=["adhesion.shear_stress_pa", "rubber.wlf_c1"],
    )
    assert fit.slopes["rubber.wlf_c1"] == "differences"
    assert fit.value["rubber.wlf_c1"] == pytest.approx(9.645, rel=1e-4)
    assert fit.value["adhesion.shear_stress_pa"] == pytest.approx(1e6, rel=1e-4)


def test_points_have_temperatures_of_their_own(scene):
    kelvin = np.where(PRESSURE > 2e5, 323.15, 293.15)
    table = read_scene(scene("truth.toml", **TRUTH)).tables
    mu = np.empty(20)
    for t in (293.15, 323.15):
        hot = {**table, "rubber": {**table["rubber"], "temperature_c": t - 273.15}}
        path = scene("hot.toml")
        path.write_text(asperity.scene.scene.scene_text(hot))
        here = kelvin == t
        mu[here] = read_scene(path).friction_at(PRESSURE[here], VELOCITY[here]).mu
    measured = {"mu": mu, "velocity": VELOCITY, "pressure": PRESSURE, "temperature": kelvin}
    assert fit_scene(scene(**TRUTH), measured).rms < 1e-9
    fit = fit_scene(
        scene(**{**TRUTH, "modulus": 4e6}),
        measured,
        free=["rubber.equilibrium_modulus_pa", "rubber.wlf_c2_k"],
    )
    assert fit.value["rubber.wlf_c2_k"] == pytest.approx(93.3, rel=1e-4)
    with pytest.raises(InvalidInput, match=r"rubber\.temperature_c: must be left out"):
        fit_scene(scene(), measured, free=["rubber.temperature_c"])


def test_leaving_out_is_fitting_without(scene):
    measured = points(scene, 0.05)
    fit = fit_scene(scene(), measured, free=[*KEYS])
    for i in (0, 7, 19):
        others = {name: np.delete(column, i) for name, column in measured.items()}
        path = scene("without.toml")
        path.write_text(fit_scene(scene(), others, free=[*KEYS]).toml)
        mu = read_scene(path).friction_at(PRESSURE[[i]], VELOCITY[[i]]).mu[0]
        assert fit.left_out[i] == pytest.approx(mu, rel=1e-4)
    log_mu = np.log(measured["mu"])
    others = [log_mu[i] - np.delete(log_mu, i).mean() for i in range(20)]
    assert fit.rms_same_mu == pytest.approx(np.sqrt(np.mean(np.square(others))))


@pytest.mark.parametrize("prior", [(2e5, 2e4), (2e5, 0.1, "ln")])
def test_a_prior_counts_by_its_deviation(scene, prior):
    """Beside points of a small scatter alone it moves nothing, beside a great one all."""
    key, measured = "surface.q1_per_m", points(scene, 0.02)
    for scatter, value, error in ((1e-3, None, None), (30.0, 2e5, 0.1)):
        given = {"free": [key], "scatter": scatter}
        fit = fit_scene(scene(**{**TRUTH, "q1": 3e5}), measured, priors={key: prior}, **given)
        if value is None:
            value = fit_scene(scene(**TRUTH), measured, **given).value[key]
        assert fit.value[key] == pytest.approx(value, rel=1e-2)
        if error is not None:
            assert np.sqrt(fit.covariance[0, 0]) == pytest.approx(error, rel=0.05)
            assert "prior-stays" in {note.code for note in fit.notes}


@pytest.mark.parametrize(
    ("free", "of", "why"),
    [
        (
            ["rubber.moduli_pa[0]", *KEYS, "rubber.moduli_pa[1]", "surface.hurst"],
            slice(20),
            "error",
        ),
        (["surface.q1_per_m", "adhesion.shear_stress_pa"], slice(3), "combination alone"),
    ],
)
def test_what_the_points_do_not_settle_is_refused_by_name(scene, free, of, why):
    measured = {name: column[of] for name, column in points(scene, 0.05).items()}
    with pytest.raises(InvalidInput, match=rf"do not settle .*{why}") as refused:
        fit_scene(scene(**{**TRUTH, "stress": 1e5}), measured, free=free)
    assert refused.value.code == "undetermined"
    assert {*refused.value.argument.split(", ")} <= {*free}


@pytest.mark.parametrize(
    ("key", "end"), [("surface.hurst", "1"), ("conditions.poisson_ratio", "0.5")]
)
def test_a_number_drawn_beyond_its_end_is_refused(scene, key, end):
    measured = points(scene)
    measured["mu"] = measured["mu"] * (1.5 if key == "surface.hurst" else 0.7)
    with pytest.raises(InvalidInput, match=rf"{key}: is drawn to {end} and beyond") as refused:
        fit_scene(scene(**TRUTH), measured, free=[key])
    assert refused.value.code == "undetermined"


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"free": ["surface.q1"]}, r"did you mean surface\.q1_per_m"),
        ({"free": ["solver.rtol"]}, "no number of a scene"),
        ({"free": ["rubber.moduli_pa"]}, r"one of them, rubber\.moduli_pa\[0\]"),
        ({"free": ["rubber.moduli_pa[7]"]}, "one of the 3"),
        ({"free": ["surface.hurst[0]"]}, "is no list"),
        ({"free": ["conditions.velocity_m_s"]}, "the points have their own"),
        (
            {"free": ["surface.rolloff_per_m"]},
            r"has surface\.rms_height_m, .*rubber\.moduli_pa\[0\], .*adhesion\.shear_stress_pa$",
        ),
        ({"free": "surface.hurst"}, "a list of keys"),
        ({"free": ["surface.hurst"] * 2}, "without repeats"),
        ({"free": ["surface.hurst"], "priors": {"surface.q1_per_m": (1, 1)}}, "one of free"),
        ({"free": ["surface.hurst"], "priors": {"surface.hurst": (0.8,)}}, "standard deviation"),
        ({"free": ["surface.hurst"], "priors": {"surface.hurst": (0.8, 0)}}, "positive"),
        ({"scatter": -1.0}, "scatter = -1"),
    ],
)
def test_bad_input_is_named(scene, given, text):
    with pytest.raises(InvalidInput, match=text):
        fit_scene(scene(), points(scene), **given)


@pytest.mark.parametrize(
    ("change", "text"),
    [({"mu": None}, "has mu"), ({"velocity": [1.0]}, "has shape"), ({"speed": 1.0}, "speed")],
)
def test_bad_points_are_named(scene, change, text):
    measured = {name: x for name, x in {**points(scene), **change}.items() if x is not None}
    with pytest.raises(InvalidInput, match=text):
        fit_scene(scene(), measured)


def test_a_scene_without_adhesion_says_so(scene):
    path = scene(**TRUTH)
    assert "hysteresis alone" not in fit_scene(path, points(scene)).sentence
    path.write_text(path.read_text().partition("[adhesion]")[0])
    assert "hysteresis alone" in fit_scene(path, points(scene)).sentence
    with pytest.raises(InvalidInput, match=r"adhesion\.shear_stress_pa can be added"):
        fit_scene(path, points(scene), free=["adhesion.shear_stress_pa"])


def test_a_comparison_has_three_errors(scene):
    """Numbers, inputs, which a law does not know, and the model; and the scatter of the points."""
    path = scene(**TRUTH)
    plain = read_scene(path).friction_at(PRESSURE, VELOCITY)
    result = fit_scene(path, points(scene, 0.05), scatter=0.05)
    assert result.model_error == pytest.approx(
        plain.model_error * plain.hysteresis / plain.mu, nan_ok=True
    )
    assert result.numbers_error == pytest.approx(plain.error_estimate / plain.mu)
    assert np.isnan(result.inputs_error).all()
    known = np.nan_to_num(result.model_error) ** 2 + 0.05**2
    assert np.log(result.band_upper / result.mu) == pytest.approx(1.96 * np.sqrt(known), rel=1e-3)
    assert result.inside == np.mean(
        (result.measured > result.band_lower) & (result.measured < result.band_upper)
    )
    assert result.rms == pytest.approx(result.rms_left_out)
    for part in (
        "20 measured",
        f"{100 * result.rms:.2g} % rms",
        "nothing was fitted",
        "inputs not known",
    ):
        assert part in result.sentence
    same = {**points(scene), "mu": np.full(20, 0.5)}
    assert "no-better-than-mean" in {note.code for note in fit_scene(path, same).notes}


def test_the_verb_has_the_digits_of_the_function(scene, tmp_path, capsys):
    measured, path, out = points(scene, 0.05), scene(), tmp_path / "fit.json"
    file = tmp_path / "measured.csv"
    rows = np.column_stack([measured["pressure"], measured["velocity"], measured["mu"]])
    np.savetxt(file, rows, delimiter=",", header="pressure_pa,velocity_m_s,mu", comments="")
    free = ",".join(KEYS)
    each = [word for key in KEYS for word in ("--free", key)]  # or parted by commas
    assert main(["fit", str(path), str(file), *each, "--json", "--output", str(out)]) == 0
    said, made = json.loads(out.read_text()), fit_scene(path, file, free=[*KEYS])
    [inputs] = said["inputs"]
    assert [x[1] for x in inputs["found"].values()] == [*made.value.values()]
    assert said["columns"]["left_out"] == made.left_out.tolist()
    assert made.sentence in capsys.readouterr().err
    command = ["fit", str(path), str(file), "--compare", "--scatter", "0.05"]
    assert main([*command, "--output", str(tmp_path / "c.csv")]) == 0
    assert fit_scene(path, file, scatter=0.05).sentence in capsys.readouterr().err
    for more, text in (
        (["--free", "surface.q1"], "--free surface.q1: is no number"),
        (["--free", free, "--prior", "surface.hurst=1,1"], "--prior"),
        (["--compare", "--hold", "width=0.1"], "--hold"),
        (["--prior", "surface.hurst=1,1"], "--prior: goes with --free or --compare"),
    ):
        assert main(["fit", str(path), str(file), *more]) == 2
        assert text in capsys.readouterr().err


def test_the_adhesion_is_fitted_at_one_temperature(scene, tmp_path, capsys):
    file = tmp_path / "measured.csv"
    file.write_text("velocity_m_s,mu,temperature_c\n1e-3,0.5,-20\n1e-2,0.6,20\n")
    assert main(["fit", str(scene()), str(file)]) == 2
    assert "has temperatures from 253.15 to 293.15 K" in capsys.readouterr().err
    assert math.isclose(asperity.io.read_friction.read_friction(file).temperature[0], 253.15)
