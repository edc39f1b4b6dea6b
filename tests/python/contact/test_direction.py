"""Friction by direction: plane sums of the definition, and the limits that are known."""

import inspect

import numpy as np
import pytest

import asperity
from asperity import (
    InvalidInput,
    MasterCurve,
    NayakSFactor,
    PartialContact,
    PronySeries,
    SelfAffineSpectrum,
    SFactor,
    StrainFactors,
    TabulatedSpectrum,
)
from helpers import table_rows
from helpers.cases import case

RUBBER = PronySeries(
    equilibrium_modulus=3e6,
    moduli=[1e9, 3e8, 1e8, 1e7],
    relaxation_times=[1e-8, 1e-6, 1e-4, 1e-2],
)
VISCOUS = PronySeries(equilibrium_modulus=1e6, moduli=[1e6], relaxation_times=[1e-13])
Q = np.geomspace(2e3, 2e5, 60)
C = 1e-16 * (Q / 2e3) ** -3.6


def ridges(axis_ratio=2.5, lay=0.2):
    return SelfAffineSpectrum(
        rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5, axis_ratio=axis_ratio, lay=lay
    )


def rows(a=0.0, b=0.0, *more):
    """A table whose rows have these harmonics a_1, b_1, a_2, b_2 and so on."""
    columns = np.array([a, b, *more])
    return TabulatedSpectrum(
        wavenumber=Q,
        density=C,
        cosine=np.tile(columns[::2], (Q.size, 1)),
        sine=np.tile(columns[1::2], (Q.size, 1)),
    )


@pytest.mark.parametrize("rtol", [1e-3, 1e-6])
def test_reference(reference_table, rtol):
    rubbers = {}  # harmonics of a curve are made once
    for row in reference_table("direction"):
        with case(case=row["case"], rtol=rtol):
            spectrum = SelfAffineSpectrum(
                **{name: row[name] for name in ("rms_height", "hurst", "q0", "q1", "axis_ratio")},
                lay=np.radians(row["lay_deg"]),
            )
            series = row["table_frequency"].size == 0
            rubber = rubbers.setdefault(
                series, (table_rows.prony if series else table_rows.master_curve)(row)
            )
            for correction, names in (
                (None, ("area", "mu", "lateral")),
                (PartialContact(), ("partial_area", "partial_mu", "partial_lateral")),
            ):
                found = asperity.friction(
                    spectrum,
                    rubber,
                    **{name: row[name] for name in ("pressure", "velocity", "poisson_ratio")},
                    correction=correction,
                    direction=np.radians(row["direction_deg"]),
                    rtol=rtol,
                )
                area, mu, lateral = (row[name] for name in names)
                least = row["rtol"] * mu
                assert abs(found.mu - mu) <= found.error_estimate + least
                assert abs(found.lateral - lateral) <= found.error_estimate + least
                assert found.contact_area == pytest.approx(area, rel=rtol)
                assert found.error_estimate <= rtol * found.mu


@pytest.mark.parametrize("correction", [None, SFactor(), NayakSFactor(), PartialContact()])
def test_no_harmonics_is_the_isotropic_result(correction):
    kwargs = {"pressure": 2e5, "velocity": [1e-4, 1e-1], "correction": correction}
    mean = TabulatedSpectrum(wavenumber=Q, density=C)
    isotropic = asperity.friction(mean, RUBBER, **kwargs, direction=0.7)
    np.testing.assert_array_equal(isotropic.mu, asperity.friction(mean, RUBBER, **kwargs).mu)
    np.testing.assert_array_equal(isotropic.lateral, 0)
    found = asperity.friction(rows(), RUBBER, **kwargs, direction=0.7)
    np.testing.assert_allclose(found.mu, isotropic.mu, rtol=1e-6)
    np.testing.assert_array_equal(found.lateral, 0)


@pytest.mark.parametrize("theta", np.radians([0, 20, 45, 77]))
def test_a_viscous_loss_has_one_harmonic(theta):
    """Im E ~ w in complete contact: 1 + a cos 2 theta along, a sin 2 theta across."""
    a, at = 0.6, {"pressure": 1e9, "velocity": 1e-6}
    mean = asperity.friction(rows(), VISCOUS, **at).mu
    found = asperity.friction(rows(a, 0, 0.2, 0.1), VISCOUS, **at, direction=theta)
    # the angle of C's ellipse is that of its long axis, from which sliding is -theta away
    assert found.mu / mean == pytest.approx(1 + a * np.cos(2 * theta), rel=1e-6)
    assert found.lateral / mean == pytest.approx(-a * np.sin(2 * theta), abs=1e-6)


@pytest.mark.parametrize("theta", np.radians([10, 50]))
def test_a_constant_loss_modulus_has_two_thirds_along_and_four_across(theta):
    w = np.geomspace(1e-8, 1e12, 30)
    flat = MasterCurve(
        angular_frequency=w, storage_modulus=np.full(30, 1e7), loss_modulus=np.full(30, 1e6)
    )
    a, at = 0.3, {"pressure": 1e11, "velocity": 1.0}
    mean = asperity.friction(rows(), flat, **at).mu
    found = asperity.friction(rows(a), flat, **at, direction=theta)
    assert found.mu / mean == pytest.approx(1 + 2 * a / 3 * np.cos(2 * theta), rel=1e-6)
    assert found.lateral / mean == pytest.approx(-4 * a / 3 * np.sin(2 * theta), abs=2e-6)


@pytest.mark.parametrize("correction", [None, PartialContact()])
def test_half_a_turn_changes_nothing_and_a_mirror_turns_the_lateral_force(correction):
    at = {"pressure": 2e5, "velocity": 1e-2, "correction": correction}
    spectrum = SelfAffineSpectrum(
        rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5, rolloff=6e3, axis_ratio=2.5, lay=0.4
    )

    def found(direction, lay=0.4):
        turned = SelfAffineSpectrum(
            rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5, rolloff=6e3, axis_ratio=2.5, lay=lay
        )
        result = asperity.friction(turned, RUBBER, **at, direction=direction)
        return np.array([result.mu, result.lateral, result.contact_area])

    assert spectrum.is_directional
    np.testing.assert_allclose(found(1.1 + np.pi), found(1.1), rtol=1e-9)
    np.testing.assert_allclose(found(-1.1, lay=-0.4), [1, -1, 1] * found(1.1), rtol=1e-9)
    np.testing.assert_allclose(found(1.6, lay=0.9), found(1.1), rtol=1e-9)
    assert found(0.4)[0] < found(0.4 + np.pi / 2)[0]  # along the ridges, and across


def test_grooves_along_the_sliding_have_no_friction():
    """C on the line q_x = 0: cos 2 m phi = (-1)^m."""
    m = 24
    harmonics = [x for k in range(1, m + 1) for x in ((-1.0) ** k * (1 - k / (m + 1)), 0)]
    grooves = rows(*harmonics)
    at = {"pressure": 2e6, "velocity": 1e-5}
    along = asperity.friction(grooves, RUBBER, **at, rtol=1e-4)
    across = asperity.friction(grooves, RUBBER, **at, direction=np.pi / 2, rtol=1e-4)
    assert along.mu < 0.1 * across.mu
    assert abs(along.lateral) < 1e-10


def test_what_directions_do_not_know_is_refused():
    spectrum = rows(0.3)
    at = {"pressure": 2e5, "velocity": 1e-2}
    with pytest.raises(InvalidInput, match="method"):
        asperity.friction(spectrum, RUBBER, **at, method="qag")
    with pytest.raises(InvalidInput, match="rtol"):
        asperity.friction(spectrum, RUBBER, **at, rtol=1e-9)
    for direction in (np.nan, None, [[1.0], [1.0, 2.0]]):
        for function in (asperity.friction, asperity.contact_area):
            with pytest.raises(InvalidInput, match="direction"):
                function(spectrum, RUBBER, **at, direction=direction)


def test_degrees_given_as_radians_are_noted():
    mean = TabulatedSpectrum(wavenumber=Q, density=C)
    notes = asperity.friction(mean, RUBBER, pressure=2e5, velocity=1e-2, direction=45.0).notes
    assert [note.code for note in notes if note.argument == "direction"] == ["large-angle"]


@pytest.mark.parametrize(
    ("ratio", "direction", "noted"),
    [(2.5, {}, True), (2.5, {"direction": [0, 1]}, False), (1.2, {}, False)],
)
@pytest.mark.parametrize("notes_of", ["friction", "contact_notes"])
def test_sliding_along_x_without_being_asked_to_is_noted(ratio, direction, noted, notes_of):
    spectrum = ridges(ratio, np.radians(115))
    found = getattr(asperity, notes_of)(spectrum, RUBBER, pressure=2e5, velocity=1e-2, **direction)
    found = [note for note in getattr(found, "notes", found) if note.code == "along-x"]
    assert bool(found) is noted
    for note in found:
        assert note.value == pytest.approx(65, abs=1)  # degrees to the ridges
        assert note.severity == "note"


def test_the_direction_is_x_by_default():
    for function in (asperity.friction, asperity.contact_area, asperity.validation.slide):
        assert inspect.signature(function).parameters["direction"].default == 0.0


def test_the_area_is_that_of_the_friction():
    at = {"pressure": [[1e5], [2e5]], "velocity": 1e-2, "direction": [0.6, 0, 1.2]}
    at["correction"] = PartialContact()
    spectrum = rows(0.4, 0.1)
    area = asperity.contact_area(spectrum, RUBBER, **at)
    np.testing.assert_array_equal(area, asperity.friction(spectrum, RUBBER, **at).contact_area)
    one = at | {"pressure": 2e5, "direction": 1.2}
    assert asperity.contact_area(spectrum, RUBBER, **one) == area[1, 2]
    by_scale = asperity.contact_area(spectrum, RUBBER, **at, wavenumber=[1e4, 2e5])
    np.testing.assert_allclose(by_scale[..., 1], area, rtol=2e-6)
    stress = np.array([[1e5], [1e6]])
    del at["pressure"], at["correction"]
    parts = asperity.pressure_distribution(stress, spectrum, RUBBER, **at, pressure=1e5)
    alone = asperity.pressure_distribution(
        1e6, spectrum, RUBBER, **one | {"pressure": 1e5, "correction": None}
    )
    assert parts[1, 2] == alone


PAYNE = StrainFactors(strain=[0.01, 0.1, 0.5], storage=[0.8, 0.5, 0.3], loss=[1.2, 0.8, 0.4])
HEAT = {
    "heating": asperity.Heating(
        density=1200, heat_capacity=1650, conductivity=0.23, contact_diameter=1e-3
    ),
    "shift": asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
    "temperature": 293.15,
}
EXTRAS = {"plain": {}, "strain": {"strain_factors": PAYNE}, "hot": {**HEAT, "rtol": 1e-5}}
W = np.geomspace(1e-3, 1e12, 90)
CURVE = MasterCurve(
    angular_frequency=W, storage_modulus=RUBBER.modulus(W).real, loss_modulus=RUBBER.modulus(W).imag
)
AT = {"pressure": 2e5, "velocity": 0.3, "direction": 0.6}


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_strain_and_heat_by_definition(reference_table, rtol):
    for row in reference_table("direction_hot"):
        with case(case=row["case"], rtol=rtol):
            given = {name: row[name] for name in ("pressure", "velocity", "poisson_ratio")}
            if row["heated"]:
                heating = asperity.Heating(
                    density=1200,
                    heat_capacity=row["heat_capacity"],
                    conductivity=0.23,
                    contact_diameter=1e-3,
                )
                given |= {**HEAT, "heating": heating, "temperature": row["temperature"]}
            law = ("rms_height", "hurst", "q0", "q1", "axis_ratio")
            found = asperity.friction(
                SelfAffineSpectrum(
                    **{name: row[name] for name in law}, lay=np.radians(row["lay_deg"])
                ),
                table_rows.prony(row),
                **given,
                strain_factors=StrainFactors(
                    **{k: row[k] for k in ("strain", "storage", "loss", "strain_per_slope")}
                ),
                direction=np.radians(row["direction_deg"]),
                correction=PartialContact(),
                rtol=rtol,
            )
            off = found.error_estimate + row["rtol"] * row["mu"]
            assert abs(found.mu - row["mu"]) <= off
            assert abs(found.lateral - row["lateral"]) <= off
            assert found.contact_area == pytest.approx(row["contact_area"], rel=rtol)
            if row["heated"]:
                rise = found.temperature - row["temperature"]
                assert rise == pytest.approx(row["rise"], rel=10 * rtol)


@pytest.mark.parametrize("correction", [None, SFactor(), PartialContact()])
@pytest.mark.parametrize("extra", EXTRAS.values(), ids=EXTRAS)
@pytest.mark.parametrize("rubber", [RUBBER, CURVE], ids=["series", "curve"])
def test_few_rows_and_many_are_one_law(correction, extra, rubber):
    """Panels end at rows, pieces take them together."""
    law = ridges(axis_ratio=2, lay=0.3)
    q, phi = np.geomspace(2e3, 2e5, 60), 2 * np.pi * np.arange(512) / 512
    means = np.fft.fft(law.toward(q[:1], phi)) / law.toward(q[:1], phi).sum()
    many = TabulatedSpectrum(
        wavenumber=q,
        density=law.at(q),
        cosine=np.tile(means.real[2:66:2], (60, 1)),
        sine=np.tile(-means.imag[2:66:2], (60, 1)),
    )
    one, two = (
        asperity.friction(spectrum, rubber, **AT, correction=correction, **extra)
        for spectrum in (law, many)
    )
    allowed = one.error_estimate + two.error_estimate
    assert abs(one.mu - two.mu) <= allowed
    assert abs(one.lateral - two.lateral) <= allowed
    assert one.contact_area == pytest.approx(two.contact_area, rel=2 * allowed / one.mu)


@pytest.mark.parametrize("correction", [None, PartialContact()])
@pytest.mark.parametrize("extra", EXTRAS.values(), ids=EXTRAS)
def test_no_harmonics_turns_and_mirrors_with_all_that_friction_takes(correction, extra):
    how = {"correction": correction, **extra}

    def found(spectrum, **turned):
        result = asperity.friction(spectrum, RUBBER, **{**AT, **turned}, **how)
        return np.array([result.mu, result.lateral, result.contact_area])

    mean = TabulatedSpectrum(wavenumber=Q, density=C)
    np.testing.assert_allclose(found(rows()), found(mean), rtol=2 * extra.get("rtol", 1e-6))
    along, across = found(ridges(lay=0.2)), found(ridges(lay=-0.2), direction=-0.6)
    np.testing.assert_allclose(across, [1, -1, 1] * along, rtol=1e-7)
    turned = found(ridges(lay=0.5), direction=0.9 + np.pi)
    np.testing.assert_allclose(turned, along, rtol=1e-7)


SOFT = PronySeries(
    equilibrium_modulus=1.5e6,
    moduli=[5e8, 1.5e8, 5e7, 5e6],
    relaxation_times=[1e-8, 1e-6, 1e-4, 1e-2],
)
SOFT_CURVE = MasterCurve(
    angular_frequency=W,
    storage_modulus=0.4 * RUBBER.modulus(W).real,
    loss_modulus=0.7 * RUBBER.modulus(W).imag,
)


@pytest.mark.parametrize(
    ("rubber", "soft", "f", "g"), [(RUBBER, SOFT, 0.5, 0.5), (CURVE, SOFT_CURVE, 0.4, 0.7)]
)
@pytest.mark.parametrize("correction", [None, PartialContact()])
def test_constant_factors_of_strain_are_another_rubber(rubber, soft, f, g, correction):
    how = {**AT, "correction": correction}
    factors = StrainFactors(strain=[0], storage=[f], loss=[g])
    one = asperity.friction(ridges(), rubber, **how, strain_factors=factors)
    two = asperity.friction(ridges(), soft, **how)
    for name in ("mu", "lateral", "contact_area"):
        assert getattr(one, name) == pytest.approx(getattr(two, name), rel=2e-6)


@pytest.mark.parametrize("extra", EXTRAS.values(), ids=EXTRAS)
@pytest.mark.parametrize("correction", [None, PartialContact()])
def test_parts_sum_to_the_whole(correction, extra):
    found = asperity.friction(
        ridges(), RUBBER, **AT, correction=correction, **extra, contributions=True
    )
    assert found.decade_share.sum() == pytest.approx(1, rel=1e-5)
    whole = np.trapezoid(found.dmu_dlnq, np.log(found.wavenumber))
    assert whole == pytest.approx(found.hysteresis, rel=5e-3)  # of the trapezoids
    plain = asperity.friction(ridges(), RUBBER, **AT, correction=correction, **extra)
    assert found.mu == pytest.approx(plain.mu, abs=2 * plain.error_estimate)
    assert found.lateral == pytest.approx(plain.lateral, abs=2 * plain.error_estimate)


def test_areas_of_magnifications_and_the_pressure_there():
    q = np.array([3e3, 2e4, 2e5])
    at = {"pressure": 2e5, "velocity": 0.3, "direction": 0.6}
    area = asperity.contact_area(ridges(), RUBBER, **at, wavenumber=q)
    cut = [asperity.contact_area(ridges().truncated(q1=one), RUBBER, **at) for one in q]
    np.testing.assert_allclose(area, cut, rtol=2e-6)
    np.testing.assert_allclose(
        asperity.correction_factor(ridges(), RUBBER, **at, wavenumber=q), area, rtol=2e-6
    )
    np.testing.assert_allclose(
        asperity.mean_pressure(ridges(), RUBBER, **at, wavenumber=q), 2e5 / area, rtol=2e-6
    )
    sigma = np.linspace(0, 4e7, 20001)
    density = asperity.pressure_distribution(sigma, ridges(), RUBBER, **at, wavenumber=2e4)
    assert np.trapezoid(density, sigma) == pytest.approx(area[1], rel=1e-4)
    by_rule = asperity.contact_area(
        ridges(), RUBBER, **at, wavenumber=q, correction=PartialContact()
    )
    assert (np.diff(by_rule) < 0).all()


def test_complete_contact_has_no_edges_to_cross():
    complete = {"pressure": 1e10, "velocity": 1e-2, "rtol": 1e-4}
    plain = asperity.friction(ridges(), RUBBER, **complete).mu
    found = asperity.friction(ridges(), RUBBER, **complete, correction=PartialContact()).mu
    assert found == pytest.approx(plain, rel=1e-3)


def test_stronger_ridges_than_any_contact_had_are_told():
    at = {"pressure": 2e5, "velocity": 1e-2, "correction": PartialContact()}
    law = {"rms_height": 1e-4, "hurst": 0.8, "q0": 2e3, "q1": 2e4}
    known, beyond = (
        asperity.friction(SelfAffineSpectrum(**law, axis_ratio=r), RUBBER, **at) for r in (4, 9)
    )
    assert known.model_error > 0
    assert np.isnan(beyond.model_error)
    assert "unknown-model-error" in [note.code for note in beyond.notes]


def test_directions_broadcast_like_pressures():
    spectrum = rows(0.4, 0.1)
    pressure, angles = np.array([[1e5], [2e5]]), np.array([0.3, 1.1, 0.3, -0.5])
    found = asperity.friction(spectrum, RUBBER, pressure=pressure, velocity=0.1, direction=angles)
    assert found.mu.shape == (2, 4)
    np.testing.assert_array_equal(found.direction, np.broadcast_to(angles, (2, 4)))
    for i, p in enumerate(pressure[:, 0]):
        for j, angle in enumerate(angles):
            one = asperity.friction(spectrum, RUBBER, pressure=p, velocity=0.1, direction=angle)
            assert (found.mu[i, j], found.lateral[i, j]) == (one.mu, one.lateral)
            assert one.direction == angle
    table = found.to_xarray()
    assert table.mu.dims == ("pressure", "direction")
    codes = [note.code for note in found.notes]
    assert len(codes) == len(set(codes))
    for more in ({"contributions": True}, {"gradients": True}):
        with pytest.raises(InvalidInput, match="one number"):
            asperity.friction(
                spectrum, RUBBER, pressure=1e5, velocity=0.1, direction=angles, **more
            )
    with pytest.raises(InvalidInput, match="direction"):
        asperity.friction(spectrum, RUBBER, pressure=1e5, velocity=0.1, direction=[0, np.nan])


def test_the_picture_over_directions_is_polar():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    angles = np.linspace(0, 2 * np.pi, 9)
    found = asperity.friction(
        rows(0.4), RUBBER, pressure=1e5, velocity=[[0.1], [0.2]], direction=angles
    )
    axes = found.plot()
    assert axes.name == "polar"
    mu, across = axes.lines[:2]
    np.testing.assert_allclose(mu.get_xdata(), angles)
    np.testing.assert_array_equal(mu.get_ydata(), found.mu[0])
    np.testing.assert_array_equal(across.get_ydata(), np.abs(found.lateral[0]))
    ticks, angle = axes.get_yticks()[1:], np.radians(axes.get_rlabel_position())
    drawn = [np.interp(angle, *line.get_data(), period=2 * np.pi) for line in axes.lines[:4]]
    apart = np.abs(np.subtract.outer(ticks, drawn)).min()
    assert apart > 0.03 * axes.get_rmax()  # the names of radii are on no curve
    plain = pyplot.figure().add_subplot()
    found.plot(plain)
    np.testing.assert_allclose(plain.lines[0].get_xdata(), np.degrees(angles))
    np.testing.assert_array_equal(plain.lines[1].get_ydata(), found.lateral[0])
    over_velocity = asperity.friction(
        rows(0.4), RUBBER, pressure=1e5, velocity=[0.1, 0.2, 0.3], direction=[[0.0], [1.0]]
    )
    assert [text.get_text() for text in over_velocity.plot().get_legend().get_texts()][:2] == [
        "100 kPa, 0°",
        "100 kPa, 57.3°",
    ]
    pyplot.close("all")


@pytest.mark.parametrize("finer", [4, 8])
def test_noise_beyond_the_roughness_hides_no_harmonics(finer):
    n, u = 64, 2 * np.pi / 1e-3
    law = SelfAffineSpectrum(rms_height=1e-6, hurst=0.8, q0=4 * u, q1=28 * u, axis_ratio=4, lay=0.4)
    rough = asperity.synthesize(law, shape=(n, n), pixel_size=1e-3 / n, seed=3).heights
    modes, points = np.fft.fftshift(np.fft.fft2(rough)), n * finer
    padded = np.pad(modes, (points - n) // 2)
    heights = np.fft.ifft2(np.fft.ifftshift(padded)).real * finer**2
    heights += 1e-10 * np.random.default_rng(0).normal(size=heights.shape)
    fine = asperity.HeightMap(heights, pixel_size=1e-3 / points)
    plain = asperity.HeightMap(rough, pixel_size=1e-3 / n)
    how = {"window": "none", "detrend": "offset", "directional": True}
    spectra = [asperity.power_spectrum(one, **how) for one in (plain, fine)]
    coarse_mu, fine_mu = (
        asperity.friction(
            one.truncated(q0=5 * u, q1=27 * u), RUBBER, pressure=2e5, velocity=0.1, direction=0.4
        ).mu
        for one in spectra
    )
    assert fine_mu == pytest.approx(coarse_mu, rel=5e-3)


def test_no_directions_are_refused():
    for function in (asperity.friction, asperity.contact_area):
        with pytest.raises(InvalidInput) as caught:
            function(rows(0.4), RUBBER, pressure=1e5, velocity=0.1, direction=[])
        assert caught.value.argument == "direction"


def test_a_table_is_heated_after_it_was_cold():
    # what cold results keep with the rows must outlive the copy of the table that made it
    def scan():
        a = 0.2 + 0.1 * np.sin(np.log(Q))
        return TabulatedSpectrum(wavenumber=Q, density=C, cosine=a[:, None], sine=0 * a[:, None])

    used = scan()
    for _ in range(3):
        asperity.friction(used, RUBBER, **AT)
    again = asperity.friction(used, RUBBER, **AT, **HEAT)
    fresh = asperity.friction(scan(), RUBBER, **AT, **HEAT)
    assert (again.mu, again.lateral) == (fresh.mu, fresh.lateral)
