"""Slopes of mu through strain factors, directions and heat: differences of mu."""

import inspect

import numpy as np
import pytest

import asperity
from helpers.rubbers import curve_of, prony, tread


def with_changes(made, **more):
    """The object made anew with other numbers."""
    kept = {name: getattr(made, name) for name in inspect.signature(type(made)).parameters}
    return type(made)(**{**kept, **more})


ROAD = asperity.SelfAffineSpectrum(rms_height=265e-6, hurst=0.87, q0=300, q1=2e5, rolloff=2000)
Q = np.geomspace(300, 1.99e5, 150)
SCATTER = np.exp(0.15 * np.random.default_rng(1).standard_normal(Q.size))
RINGS = asperity.TabulatedSpectrum(wavenumber=Q, density=ROAD.at(Q) * SCATTER)
RIDGES = asperity.SelfAffineSpectrum(
    rms_height=265e-6, hurst=0.8, q0=300, q1=2e5, axis_ratio=3.0, lay=0.3
)
ROLLED = with_changes(RIDGES, rolloff=2000.0)
ANGLES = np.random.default_rng(5).uniform(-0.3, 0.3, (Q.size, 3)) * [1, 0.5, 0.2]
GROUND = asperity.TabulatedSpectrum(
    wavenumber=Q, density=ROAD.at(Q) * SCATTER, cosine=0.2 + ANGLES, sine=ANGLES[::-1]
)
SERIES = prony(3e6, np.geomspace(1e6, 3e8, 9), np.geomspace(1e-2, 1e-9, 9))
W = np.geomspace(1e-5, 1e11, 60)
MEASURED = curve_of(W, SERIES.modulus(W))
PARTS = {"storage": "real", "loss": "imag"}
STRAIN = asperity.StrainFactors(
    strain=[0.001, 0.01, 0.1, 0.3, 0.6],
    storage=[0.95, 0.75, 0.45, 0.34, 0.3],
    loss=[1.1, 1.25, 0.8, 0.5, 0.41],
)
UNSOFTENED = asperity.StrainFactors(strain=[0.001, 0.01, 50], storage=[1, 1, 1], loss=[1, 1, 1])
HEATING = tread()
AREA = with_changes(HEATING, macro_area=0.1, residence="box", interface_share=0.9)
SMALL = with_changes(HEATING, contact_diameter=1e-5)  # as long as the shortest waves
OWN = with_changes(HEATING, macro_wavenumber=5e3, interface_share=0.4)
STICKY = asperity.Adhesion(shear_stress=1e6)
PARTIAL = asperity.PartialContact()
TOPS = asperity.GreenwoodWilliamson(z_max=9e-4, z_min=-9e-4)
HEAT = {
    "temperature": 290.0,
    "shift": asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
}
SCENES = {
    "strain": (ROAD, SERIES, {"strain_factors": STRAIN}),
    "strain on rings": (RINGS, SERIES, {"strain_factors": STRAIN, "correction": PARTIAL}),
    "strain of rows": (ROAD, MEASURED, {"strain_factors": STRAIN, "correction": PARTIAL}),
    "heat": (ROAD, SERIES, {"heating": HEATING}),
    "heat by the rule": (ROAD, SERIES, {"heating": HEATING, "correction": PARTIAL}),
    "heat on rings": (RINGS, SERIES, {"heating": OWN, "correction": PARTIAL, "adhesion": STICKY}),
    "heat of adhesion": (RINGS, SERIES, {"heating": AREA, "adhesion": STICKY}),
    "heat of asperities": (ROAD, SERIES, {"heating": OWN, "correction": TOPS, "adhesion": STICKY}),
    "heat of rows": (ROAD, MEASURED, {"heating": HEATING, "correction": PARTIAL}),
    "ridges": (RIDGES, SERIES, {"direction": 0.9}),
    "ridges by the rule": (RIDGES, MEASURED, {"direction": 1.4, "correction": PARTIAL}),
    "rolled ridges": (ROLLED, SERIES, {"direction": 0.1, "correction": PARTIAL}),
    "ridges on rings": (GROUND, SERIES, {"direction": 2.0, "correction": PARTIAL}),
    "ridges of S": (GROUND, MEASURED, {"correction": asperity.NayakSFactor(), "adhesion": STICKY}),
    "strain on ridges": (GROUND, SERIES, {"strain_factors": STRAIN, "correction": PARTIAL}),
    "heat of ridges": (GROUND, MEASURED, {"heating": HEATING, "correction": PARTIAL}),
    "heat of rolled ridges": (ROLLED, SERIES, {"heating": HEATING, "correction": PARTIAL}),
    "heat of all ridges": (ROLLED, SERIES, {"heating": SMALL, "correction": TOPS}),
    "heat and strain": (ROAD, SERIES, {"heating": HEATING, "strain_factors": STRAIN}),
    "heat and factors of 1": (ROAD, SERIES, {"heating": HEATING, "strain_factors": UNSOFTENED}),
}
NAMES = {
    "strain_factors": ("strain_per_slope",),
    "adhesion": ("shear_stress", "reference_velocity"),
    "heating": (
        "density",
        "heat_capacity",
        "conductivity",
        "contact_diameter",
        "macro_wavenumber",
        "macro_area",
        "interface_share",
    ),
}
FACTOR_ROWS = ("storage", "loss")


def weights(x):
    steps = np.diff(np.log(x)) / 2
    return np.append(steps, 0) + np.append(0, steps)


def changed(made, name, factor, row=None):
    """The object with one number, or one of several, times a factor."""
    old = getattr(made, name)
    if row is None:
        return with_changes(made, **{name: old * factor})
    several = np.array(old)
    several[row] *= factor
    return with_changes(made, **{name: several})


def slopes(spectrum, rubber, at, of):
    """Each slope with what changes the scene by a logarithm."""
    for name in ("pressure", "velocity"):
        yield name, getattr(of, name), lambda f, n=name: (spectrum, rubber, {n: at[n] * f})
    if "heating" in at:
        by_ten = 10 * of.temperature
        yield (
            "temperature",
            by_ten,
            lambda f: (
                spectrum,
                rubber,
                {"temperature": 290.0 + 10 * np.log(f)},
            ),
        )
    if isinstance(spectrum, asperity.SelfAffineSpectrum):
        for name in ("rms_height", "hurst", "q0", "q1", "rolloff", "axis_ratio"):
            if (slope := getattr(of, name)) is not None:
                yield name, slope, lambda f, n=name: (changed(spectrum, n, f), rubber, {})
    else:
        rows = of.spectrum * weights(of.wavenumber)
        for k in (20, 110):
            yield k, rows[k], lambda f, k=k: (changed(spectrum, "density", f, k), rubber, {})
    if spectrum.is_directional:
        angle = at.get("direction", 0.0)
        yield (
            "direction",
            of.direction,
            lambda f: (spectrum, rubber, {"direction": angle + np.log(f)}),
        )
    if rubber is SERIES:
        for name in ("moduli", "relaxation_times"):
            slope = getattr(of, name)[2]
            yield name, slope, lambda f, n=name: (spectrum, changed(SERIES, n, f, 2), {})
    else:
        loss = of.loss * weights(of.angular_frequency)
        k = int(np.argmax(loss))
        yield "loss", loss[k], lambda f: (spectrum, changed(rubber, "loss_modulus", f, k), {})
    for part, names in NAMES.items():
        for name in names:
            if (made := at.get(part)) and getattr(made, name) and getattr(of, name) is not None:
                yield (
                    name,
                    getattr(of, name),
                    lambda f, p=part, n=name: (spectrum, rubber, {p: changed(at[p], n, f)}),
                )
    if factors := at.get("strain_factors"):
        for name in FACTOR_ROWS:
            yield (
                name,
                getattr(of, f"{name}_factors")[2],
                lambda f, n=name: (spectrum, rubber, {"strain_factors": changed(factors, n, f, 2)}),
            )


@pytest.mark.parametrize("scene", SCENES)
def test_slopes_are_differences(scene):
    spectrum, rubber, more = SCENES[scene]
    at = {"pressure": 2e5, "velocity": 0.3, **(HEAT if "heating" in more else {}), **more}
    result = asperity.friction(spectrum, rubber, gradients=True, **at)
    rtol = 1e-7 if spectrum is RINGS or spectrum.is_directional else 1e-9
    for name, slope, change in slopes(spectrum, rubber, at, result.gradients):

        def mu(x, change=change):
            road, e, moved = change(np.exp(x))
            return asperity.friction(road, e, **{**at, **moved}, rtol=rtol).mu

        h = 1e-3 if rtol < 1e-7 else 5e-3
        two, four = (mu(h) - mu(-h)) / (2 * h), (mu(2 * h) - mu(-2 * h)) / (4 * h)
        within = result.gradients.error_estimate + 2e-5 * result.mu
        assert abs(slope - (4 * two - four) / 3) <= within, name


@pytest.mark.parametrize("branch", ["cold", "hot"])
def test_each_of_several_states_has_its_own_slopes(branch):
    """Of a rubber that runs away: T(q) on either side of the state that is not stable."""
    rubber = asperity.PronySeries(equilibrium_modulus=2e6, moduli=[1e9], relaxation_times=[1e-4])
    road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2e4)
    at = {"pressure": 2e5, "heating": HEATING, "shift": HEAT["shift"], "branch": branch}
    at |= {"temperature": 243.15, "velocity": 1.0, "rtol": 1e-9}
    result = asperity.friction(road, rubber, gradients=True, **at)
    less, more = (
        asperity.friction(road, rubber, **at | {"velocity": np.exp(x)}).mu for x in (-1e-3, 1e-3)
    )
    assert result.branches == 3
    assert result.gradients.velocity == pytest.approx((more - less) / 2e-3, rel=1e-4)


@pytest.mark.parametrize("name", ["storage", "loss"])
def test_rows_of_the_modulus_on_narrow_ridges(name):
    """Whose harmonics are so many that they turn often between two rows that stand far apart."""
    few = np.geomspace(1e-4, 1e13, 35)
    modulus = SERIES.modulus(few)
    at = {"pressure": 2e5, "velocity": 0.1, "direction": 0.8}
    narrow = with_changes(RIDGES, axis_ratio=10.0, lay=0.0)
    several = slice(13, 17)

    def solved(log_factor, **more):
        kept = {one: np.array(getattr(modulus, part)) for one, part in PARTS.items()}
        kept[name][several] *= np.exp(log_factor)
        rubber = curve_of(few, kept["storage"] + 1j * kept["loss"])
        return asperity.friction(narrow, rubber, **at, **more)

    of = solved(0, gradients=True).gradients
    slope = np.sum(getattr(of, name)[several]) * np.log(few[1] / few[0])
    step = 1e-3
    two, four = (
        (solved(h, rtol=1e-7).mu - solved(-h, rtol=1e-7).mu) / (2 * h) for h in (step, 2 * step)
    )
    assert abs(slope - (4 * two - four) / 3) <= of.error_estimate


def test_lay_and_direction_turn_the_same():
    of = asperity.friction(
        RIDGES, SERIES, pressure=2e5, velocity=0.3, direction=0.9, gradients=True
    ).gradients
    assert of.lay == -of.direction
    assert of.to_xarray()["lay"].attrs["units"] == "1/rad"


def test_a_hot_scan_has_the_slopes_of_its_contacts_and_holds_the_ratio_of_the_others():
    law = asperity.SelfAffineSpectrum(rms_height=2e-6, hurst=0.8, q0=1.2e5, q1=1.5e6)
    rough = asperity.synthesize(law, shape=(32, 32), pixel_size=2e-6, seed=1)
    rings = asperity.power_spectrum(rough, window="none", detrend="offset")
    spectrum = rings.truncated(q1=1.5e6)
    at = {"pressure": 2e6, "velocity": 0.3, "heating": HEATING, **HEAT}
    exact = asperity.ScanContact(rough, periodic=True)

    def solved(correction, **more):
        return asperity.friction(spectrum, SERIES, correction=correction, **{**at, **more})

    scan, rule = (solved(one, gradients=True) for one in (exact, PARTIAL))
    ratio = scan.mu / rule.mu
    off = np.abs(scan.gradients.moduli - ratio * rule.gradients.moduli)
    assert off.max() <= 0.1 * scan.gradients.error_estimate
    assert "held-ratio" in [note.code for note in scan.notes]
    for name, step in (("velocity", 0.1), ("pressure", 0.1)):
        less, more = (solved(exact, **{name: at[name] * np.exp(x)}).mu for x in (-step, step))
        found = getattr(scan.gradients, name)
        assert found == pytest.approx((more - less) / (2 * step), rel=1e-6)
