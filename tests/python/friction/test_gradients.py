"""Slopes of mu: identities of the theory, differences of mu, and what is refused."""

import numpy as np
import pytest

import asperity
from helpers import table_rows

SPEEDS = np.geomspace(1e-4, 10, 4)
ROAD = asperity.SelfAffineSpectrum(rms_height=265e-6, hurst=0.87, q0=300, q1=2e5, rolloff=2000)
SERIES = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=np.geomspace(1e6, 3e8, 9),
    relaxation_times=np.geomspace(1e-2, 1e-9, 9),
)


def rings(seed=1, count=150):
    q = np.geomspace(300, 1.99e5, count)
    scatter = np.exp(0.15 * np.random.default_rng(seed).standard_normal(count))
    return asperity.TabulatedSpectrum(wavenumber=q, density=ROAD.at(q) * scatter)


def rows(count=60):
    w = np.geomspace(1e-3, 1e11, count)
    e = SERIES.modulus(w) * np.exp(0.02 * np.random.default_rng(2).standard_normal(count))
    return asperity.MasterCurve(angular_frequency=w, storage_modulus=e.real, loss_modulus=e.imag)


FEW = asperity.TabulatedSpectrum(
    wavenumber=[300, 900, 4e3, 4e4, 1e5, 2e5], density=[1e-13, 1e-14, 1e-16, 1e-20, 0, 0]
)
SURFACES = {"law": ROAD, "rings": rings(), "few rows": FEW}
RUBBERS = {"series": SERIES, "rows": rows()}
CORRECTIONS = {
    "none": None,
    "s": asperity.SFactor(),
    "partial": asperity.PartialContact(),
    "nayak": asperity.NayakSFactor(),
    "implicit": asperity.ImplicitSFactor(),
    "shift": asperity.AffineShift(1.5),
    "gw": asperity.GreenwoodWilliamson(z_max=9e-4, z_min=-9e-4),
}
IDENTITIES = ("none", "s", "partial", "nayak", "implicit", "shift")


def weights(x):
    steps = np.diff(np.log(x)) / 2
    return np.append(steps, 0) + np.append(0, steps)


def solved(spectrum, rubber, name, **more):
    points = {"pressure": 2e5, "velocity": SPEEDS, "rtol": 1e-9} | more
    return asperity.friction(spectrum, rubber, correction=CORRECTIONS[name], **points)


def slope(mu, step=1e-3):
    return (mu(np.exp(step)) - mu(np.exp(-step))) / (2 * step)


def modulus(rubber, w):
    """E' and E'' at the rows: of a master curve its own."""
    e = rubber.modulus(w)
    return e.real, e.imag


MODELS = {"partial-contact": asperity.PartialContact(), "none": None}
MODELS |= {"s-factor": asperity.SFactor(gamma=0.5)}
SHIFT = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)  # of the tables with heat
HEATING = ("density", "heat_capacity", "conductivity", "contact_diameter", "macro_wavenumber")
HEATING += ("residence",)


TABLES = ("gradients", "gradients_strain", "gradients_direction", "gradients_hot")


def scene_of(row):
    """Spectrum, rubber and conditions of a row."""
    law, series = row["rms_height"] is not None, row["equilibrium_modulus"] is not None
    spectrum = table_rows.self_affine(row) if law else table_rows.tabulated(row)
    rubber = table_rows.prony(row) if series else table_rows.master_curve(row)
    at = {name: row[name] for name in ("pressure", "velocity", "poisson_ratio")}
    if "direction_deg" in row:
        at["direction"] = np.radians(row["direction_deg"])
    if row.get("strain_per_slope") is not None:
        names = ("strain", "storage", "loss", "strain_per_slope")
        at["strain_factors"] = asperity.StrainFactors(**{name: row[name] for name in names})
    if "heat_capacity" in row:
        at |= {"temperature": row["temperature"], "shift": SHIFT}
        at["heating"] = asperity.Heating(**{name: row[name] for name in HEATING})
    return spectrum, rubber, at


@pytest.mark.parametrize("table", TABLES)
def test_slopes_by_definition(reference_table, table):
    """Differences of mu that another program computed, relative to mu."""
    made = {}
    for row in reference_table(table):
        *scene, slope_of = row["case"].split(", ")
        correction = MODELS[scene[1]] if len(scene) > 1 else asperity.PartialContact()
        if (key := tuple(scene)) not in made:
            spectrum, rubber, at = scene_of(row)
            made[key] = asperity.friction(
                spectrum, rubber, correction=correction, gradients=True, **at
            )
        name, _, index = slope_of.partition(" ")
        of = made[key].gradients
        found = getattr(of, name)
        if name in ("spectrum", "storage", "loss"):
            found = found * weights(of.wavenumber if name == "spectrum" else of.angular_frequency)
        found = found[int(index)] if index else found
        within = of.error_estimate + row["rtol"] * row["mu"]
        assert abs(found - row["slope"]) <= within, (row["case"], found, row["slope"])


@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("rubber", RUBBERS)
@pytest.mark.parametrize("name", IDENTITIES)
def test_identities_of_the_hysteresis(surface, rubber, name):
    """mu is a function of C / sigma0^2 and E / sigma0, I1 of E'' and I2 of both squares."""
    result = solved(SURFACES[surface], RUBBERS[rubber], name, gradients=True)
    of, mu = result.gradients, result.mu
    over_c = of.spectrum @ weights(of.wavenumber)
    over_e = (of.storage + of.loss) @ weights(of.angular_frequency)
    np.testing.assert_allclose(over_c, (mu - of.pressure) / 2, atol=3e-5 * mu.max())
    np.testing.assert_allclose(over_e, -of.pressure, atol=2e-4 * mu.max())
    # d mu / d ln v by the slopes of E' and E''
    w = of.angular_frequency
    h = 1e-4
    inside = np.clip(w, w[0] * np.exp(h), w[-1] * np.exp(-h))
    ends = [np.log(modulus(RUBBERS[rubber], inside * np.exp(side))) for side in (-h, h)]
    n1, n2 = (np.array(ends[1]) - np.array(ends[0])) / (2 * h)
    if rubber == "series":  # its rows are hats, on which E has no kinks
        over_v = (of.storage * n1 + of.loss * n2) @ weights(w)
        np.testing.assert_allclose(over_v, of.velocity, atol=0.01 * mu.max())


@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("rubber", RUBBERS)
@pytest.mark.parametrize("name", CORRECTIONS)
def test_slopes_are_differences(surface, rubber, name):
    spectrum, e = SURFACES[surface], RUBBERS[rubber]
    adhesion = asperity.Adhesion(shear_stress=1e5)
    result = solved(spectrum, e, name, adhesion=adhesion, gradients=True)
    of, most = result.gradients, result.mu.max()

    def mu(spectrum=spectrum, rubber=e, adhesion=adhesion, p=1.0, v=1.0):
        points = {"pressure": 2e5 * p, "velocity": SPEEDS * v, "adhesion": adhesion}
        return solved(spectrum, rubber, name, **points).mu

    def close(found, expected, within=2e-5):
        np.testing.assert_allclose(found, expected, atol=within * most)

    close(of.pressure, slope(lambda f: mu(p=f)))
    close(of.velocity, slope(lambda f: mu(v=f)))
    stress = slope(lambda f: mu(adhesion=asperity.Adhesion(shear_stress=1e5 * f)))
    close(of.shear_stress, stress)
    if surface == "law":
        close(of.rms_height, slope(lambda f: mu(with_argument(ROAD, "rms_height", f))))
        close(of.hurst, slope(lambda f: mu(with_argument(ROAD, "hurst", f))))
        close(of.q0, slope(lambda f: mu(with_argument(ROAD, "q0", f))))
        close(of.q1, slope(lambda f: mu(with_argument(ROAD, "q1", f))))
        close(of.rolloff, slope(lambda f: mu(with_argument(ROAD, "rolloff", f))))
    else:
        weight = weights(of.wavenumber)
        for k in np.linspace(0, weight.size - 1, 4).astype(int):
            row = slope(lambda f, k=k: mu(with_row(spectrum, k, f)), 0.02)
            close(of.spectrum[:, k] * weight[k], row, 5e-5)
    if rubber == "series":
        for k in (0, 4, 8):
            close(of.moduli[:, k], slope(lambda f, k=k: mu(rubber=with_term(k, modulus=f))))
            close(of.relaxation_times[:, k], slope(lambda f, k=k: mu(rubber=with_term(k, time=f))))
    else:
        weight = weights(of.angular_frequency)
        for k in (12, 25, 33):
            for name_of, density in (("storage_modulus", of.storage), ("loss_modulus", of.loss)):
                row = slope(lambda f, k=k, n=name_of: mu(rubber=with_modulus(k, n, f)))
                close(density[:, k] * weight[k], row, 2e-4)


def with_argument(law, name, factor):
    arguments = {n: getattr(law, n) for n in ("rms_height", "hurst", "q0", "q1", "rolloff")}
    return asperity.SelfAffineSpectrum(**arguments | {name: arguments[name] * factor})


def with_row(table, k, factor):
    density = np.array(table.density)
    density[k] *= factor
    return asperity.TabulatedSpectrum(wavenumber=table.wavenumber, density=density)


def with_term(k, modulus=1.0, time=1.0):
    moduli, times = np.array(SERIES.moduli), np.array(SERIES.relaxation_times)
    moduli[k] *= modulus
    times[k] *= time
    return asperity.PronySeries(
        equilibrium_modulus=SERIES.equilibrium_modulus, moduli=moduli, relaxation_times=times
    )


def with_modulus(k, name, factor):
    curve = RUBBERS["rows"]
    columns = {n: np.array(getattr(curve, n)) for n in ("storage_modulus", "loss_modulus")}
    columns[name][k] *= factor
    return asperity.MasterCurve(angular_frequency=curve.angular_frequency, **columns)


def test_temperature_is_the_frequency_shifted():
    shift = asperity.WLF(c1=17.4, c2=51.6, reference_temperature=293.0)
    at = {
        "pressure": 2e5,
        "velocity": 0.01,
        "shift": shift,
        "correction": asperity.PartialContact(),
    }
    of = asperity.friction(ROAD, SERIES, temperature=300.0, gradients=True, **at).gradients
    less, more = (
        asperity.friction(ROAD, SERIES, temperature=300 + h, **at).mu for h in (-0.1, 0.1)
    )
    assert of.temperature == pytest.approx((more - less) / 0.2, rel=1e-3)
    assert of.velocity == pytest.approx(of.temperature / slope_of_shift(shift, 300.0), rel=1e-9)


def slope_of_shift(shift, temperature):
    ends = [shift.log10_a_T(temperature + h) for h in (-1e-3, 1e-3)]
    return np.log(10) * (ends[1] - ends[0]) / 2e-3


def test_shapes_follow_mu_and_scalars_stay_scalars():
    at = {"pressure": [[1e5], [2e5]], "velocity": SPEEDS, "gradients": True}
    of = asperity.friction(ROAD, SERIES, **at).gradients
    assert of.pressure.shape == (2, 4)
    assert of.moduli.shape == (2, 4, 9)
    assert of.spectrum.shape == (2, 4, of.wavenumber.size)
    one = asperity.friction(ROAD, SERIES, pressure=1e5, velocity=SPEEDS[1], gradients=True)
    assert isinstance(one.gradients.velocity, float)
    np.testing.assert_allclose(one.gradients.moduli, of.moduli[0, 1], rtol=1e-12)
    assert asperity.friction(ROAD, SERIES, pressure=1e5, velocity=1.0).gradients is None
    assert of.to_xarray()["storage"].dims[-1] == "angular_frequency"


def test_elastic_rubber_and_complete_contact():
    elastic = asperity.PronySeries(equilibrium_modulus=1e7, moduli=[], relaxation_times=[])
    of = asperity.friction(
        ROAD,
        elastic,
        pressure=1e5,
        velocity=1.0,
        correction=asperity.PartialContact(),
        gradients=True,
    ).gradients
    assert of.pressure == of.velocity == 0
    assert not of.spectrum.any()
    pressed = solved(ROAD, SERIES, "none", pressure=1e12, gradients=True)
    np.testing.assert_allclose(pressed.gradients.pressure, -pressed.mu, rtol=1e-6)


def test_a_scan_has_the_slopes_of_what_it_interpolates_and_ratios_of_the_others():
    law = asperity.SelfAffineSpectrum(rms_height=2e-6, hurst=0.8, q0=1.2e5, q1=1.5e6)
    rough = asperity.synthesize(law, shape=(64, 64), pixel_size=1e-6, seed=1)
    worn = asperity.HeightMap(np.minimum(rough.heights, 1e-6), pixel_size=1e-6)
    spectrum = asperity.power_spectrum(worn).truncated(q1=1.5e6)
    exact = asperity.ScanContact(worn)

    def at(correction, p=1.0, v=1.0, **more):
        points = {"pressure": 2e6 * p, "velocity": np.array([1e-3, 0.1]) * v, "rtol": 1e-8}
        return asperity.friction(spectrum, SERIES, correction=correction, **points, **more)

    result = at(exact, gradients=True)
    of = result.gradients
    np.testing.assert_allclose(of.velocity, slope(lambda f: at(exact, v=f).mu), rtol=1e-4)
    np.testing.assert_allclose(of.pressure, slope(lambda f: at(exact, p=f).mu, 0.1), rtol=1e-6)
    over_c = of.spectrum @ weights(of.wavenumber)
    over_e = (of.storage + of.loss) @ weights(of.angular_frequency)
    np.testing.assert_allclose(over_c, (result.mu + over_e) / 2, rtol=1e-3)


@pytest.mark.parametrize(
    ("argument", "more"),
    [("method", {"method": "qag"}), ("gradients", {"gradients": 1.5})],
)
def test_refusals(argument, more):
    with pytest.raises(asperity.InvalidInput) as refused:
        asperity.friction(ROAD, SERIES, pressure=1e5, velocity=1.0, **{"gradients": True, **more})
    assert refused.value.argument == argument
