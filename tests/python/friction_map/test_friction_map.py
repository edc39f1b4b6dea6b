"""Friction maps: the certified error, smoothness, other temperatures, what is outside."""

import re
from itertools import product

import numpy as np
import pytest

import asperity
from asperity import (
    Adhesion,
    AffineShift,
    GreenwoodWilliamson,
    InvalidInput,
    LocalPeaks,
    MasterCurve,
    NayakSFactor,
    NotConverged,
    OutOfRange,
    PartialContact,
    PeaksThenGreenwoodWilliamson,
    PronySeries,
    SFactor,
    friction,
    friction_map,
)
from helpers.cases import long
from helpers.mapped import ROAD, drawn, measured
from helpers.ridges import RUBBER

MEASURED = measured(RUBBER, 1e7, 200)
ADHESION = Adhesion(shear_stress=8.3e6)
BOX = {"pressure": (5e4, 1e6), "velocity": (1e-5, 3.0)}
PEAKS = [1.1e-4, 2.9e-4, 4.2e-4, 0.3e-4, 2.2e-4]


def made(correction=None, rubber=RUBBER, adhesion=ADHESION, road=ROAD, box=BOX, **options):
    options = {"checked": 0, **options}
    return friction_map(road, rubber, correction=correction, adhesion=adhesion, **box, **options)


@pytest.fixture(scope="module")
def road_map():
    return made(SFactor())


def noisy_master_curve():
    """5 % and 10 % of scatter, row by row: kinks at every one of them."""
    draws = np.random.default_rng(4)
    w = np.geomspace(1e-3, 1e7, 80)
    e = RUBBER.modulus(w)
    return asperity.MasterCurve(
        angular_frequency=w,
        storage_modulus=e.real * np.exp(0.05 * draws.standard_normal(w.size)),
        loss_modulus=e.imag * np.exp(0.1 * draws.standard_normal(w.size)),
    )


def rings_with_jumps():
    """The road at equal steps of q, every other ten of them a thousand times as rough."""
    q = 2e3 * np.arange(1, 61)
    density = 1e-16 * (q / 2e3) ** -3.7 * np.where(np.arange(60) // 10 % 2, 1e3, 1.0)
    density[[7, 30, 31]] = 0
    return asperity.TabulatedSpectrum(wavenumber=q, density=density)


SCENES = {
    "none": {},
    "s-factor": {"correction": SFactor(applies_to="both")},
    "nayak": {"correction": NayakSFactor()},
    "partial": {"correction": PartialContact()},
    "shift": {"correction": AffineShift(2.0)},
    "peaks": {"correction": LocalPeaks(PEAKS)},
    "gw": {"correction": GreenwoodWilliamson(z_max=9e-4, z_min=-8e-4)},
    "gw added": {"correction": GreenwoodWilliamson(z_max=9e-4, z_min=-8e-4, reading="added")},
    "gw peaks": {"correction": GreenwoodWilliamson(z_max=9e-4, z_min=-8e-4, peaks=PEAKS)},
    "combined": {"correction": PeaksThenGreenwoodWilliamson(PEAKS, z_max=9e-4, z_min=-8e-4)},
    "interpolated": {"form": "interpolated"},
    "master curve": {"rubber": MEASURED},
    "noise": {"rubber": noisy_master_curve()},
    "jumps": {"road": rings_with_jumps(), "correction": NayakSFactor()},
    "many peaks": {
        "correction": GreenwoodWilliamson(
            z_max=9e-4, z_min=-8e-4, peaks=np.geomspace(1e-5, 8e-4, 100)
        )
    },
    "elastic": {"rubber": PronySeries(equilibrium_modulus=1e7, moduli=[], relaxation_times=[])},
}


SLOW = "many peaks"
FINE = [(name, 1e-6) for name in SCENES if name != SLOW]


@pytest.mark.parametrize(
    ("name", "rtol"),
    [*product(SCENES, [1e-2, 1e-4]), *FINE, long(SLOW, 1e-6)],
)
def test_a_map_is_as_good_as_it_says(name, rtol):
    plain = {"road": ROAD, "rubber": RUBBER, "correction": None, "form": "exact"}
    scene = {**plain, **SCENES[name]}
    result = made(**scene, rtol=rtol)
    assert 0 < result.max_error <= rtol
    p, v = drawn(3000, BOX)
    parts = scene.pop("road"), scene.pop("rubber")
    truth = friction(*parts, pressure=p, velocity=v, adhesion=ADHESION, rtol=1e-10, **scene)
    for quantity in ("mu", "hysteresis", "adhesion", "contact_area"):
        exact = getattr(truth, quantity)
        error = np.abs(getattr(result, quantity)(p, v) - exact)
        assert (error <= result.max_error * exact).all(), quantity


def test_the_check_counts_what_is_beyond_the_certified_error():
    result = made(checked=20_000)
    assert result.checked == 20_000
    assert result.exceeded == 0
    # twice the largest error on unseen points: what 20,000 others show is near half of it
    assert 0.3 * result.max_error < result.largest_checked_error <= result.max_error


def test_the_check_adds_the_error_of_the_solver():
    # in so narrow a box the map is as good as the solver, and all of the error is the solver's
    q = 2e3 + 40 * np.arange(400.0)
    road = asperity.TabulatedSpectrum(wavenumber=q, density=ROAD.at(q))
    box = {"pressure": (1e5, 1.0001e5), "velocity": (0.1, 0.10001)}
    scene = {"correction": NayakSFactor(), "rubber": MEASURED, "adhesion": None}
    result = made(road=road, box=box, checked=200, **scene)
    solved = friction(road, **scene, pressure=1e5, velocity=0.1, rtol=1e-6)
    assert result.largest_checked_error > 0.9 * solved.error_estimate / solved.mu
    assert result.exceeded == 0


def test_cells_are_as_many_as_the_tolerance_needs():
    # bicubic cells: the error falls as the fourth power of a side, the square of an area
    cells = [made(rtol=rtol).cells for rtol in (1e-3, 1e-4, 1e-5, 1e-6)]
    growth = np.array(cells[1:]) / cells[:-1]
    assert (growth > 2).all()
    assert (growth < 5).all()  # sqrt(10), and what single halvings add
    assert cells[1] < 250


def test_a_fine_map_of_many_decades_is_made_from_few_points():
    # a cell asks for a hundred points, of which there are tens of thousands; polynomials for 160
    result = made(box={"pressure": (5e4, 1e6), "velocity": (1e-12, 1e6)}, rtol=1e-8, checked=20_000)
    assert result.cells > 10_000
    assert result.max_error <= 1e-8
    assert result.exceeded == 0
    assert 0.3 * result.max_error < result.largest_checked_error


def test_kinks_beside_the_edge_of_a_patch_are_seen():
    # of the modulus at q0 v, and so of p_T: between the last of Chebyshev's zeros and the edge
    # one of this box had left neighbours apart, so that no number of cells was enough
    box = {**BOX, "velocity": (1e-5 * 1.05**3, 3.0)}
    correction = GreenwoodWilliamson(z_max=9e-4, z_min=-8e-4)
    result = made(correction, rubber=noisy_master_curve(), box=box, checked=20_000)
    assert result.max_error <= 1e-4
    assert result.exceeded == 0


@pytest.mark.parametrize("name", ["none", "s-factor", "master curve"])
def test_values_and_slopes_have_no_steps(name):
    result = made(**SCENES[name])
    p, v = drawn(40_000, BOX, seed=2)
    step = 1e-7  # so many of them cross a side of a cell
    for dp, dv in ((step, 0.0), (0.0, step)):
        there = p * np.exp(dp), v * np.exp(dv)
        inside = (there[0] < BOX["pressure"][1]) & (there[1] < BOX["velocity"][1])
        here = p[inside], v[inside]
        there = there[0][inside], there[1][inside]
        a, b = result.derivatives(*here), result.derivatives(*there)
        mu_a, mu_b = result.mu(*here), result.mu(*there)
        slope = a.dmu_dlnp if dp else a.dmu_dlnv
        other = b.dmu_dlnp if dp else b.dmu_dlnv
        # second derivatives are of the order of mu: over a step they change mu by step^2
        assert np.abs(mu_b - mu_a - step * (slope + other) / 2).max() < 1e-14 + 10 * step**2
        assert np.abs(b.dmu_dlnp - a.dmu_dlnp).max() < 10 * step
        assert np.abs(b.dmu_dlnv - a.dmu_dlnv).max() < 10 * step


def test_slopes_are_those_of_the_solver(road_map):
    p, v = drawn(200, {"pressure": (6e4, 9e5), "velocity": (1.2e-5, 2.5)})
    options = {"correction": SFactor(), "adhesion": ADHESION, "rtol": 1e-11}
    step = 1e-3
    slopes = road_map.derivatives(p, v)
    for name, dp, dv in (("dmu_dlnp", step, 0), ("dmu_dlnv", 0, step)):
        up, down = (
            friction(
                ROAD, RUBBER, pressure=p * np.exp(s * dp), velocity=v * np.exp(s * dv), **options
            )
            for s in (1, -1)
        )
        exact = (up.mu - down.mu) / (2 * step)
        # of a cubic that is off by 5e-5 over a cell about 1 wide in ln
        assert np.abs(getattr(slopes, name) - exact).max() < 1e-3 * road_map.mu(p, v).max()


def test_another_temperature_shifts_the_velocity(road_map):
    p, a_t = 2e5, 30.0
    v = np.array([1e-5, 1e-3, 0.09])
    other = friction(
        ROAD, RUBBER.shifted(a_t), pressure=p, velocity=v, correction=SFactor(), adhesion=ADHESION
    )
    for quantity in ("mu", "hysteresis", "adhesion", "contact_area"):
        result = getattr(road_map, quantity)(p, v, a_T=a_t)
        np.testing.assert_allclose(result, getattr(other, quantity), rtol=1e-4)
    # on request as if v0 were v0 / a_T
    moved = Adhesion(shear_stress=8.3e6, reference_velocity=6e-3 / a_t)
    other = friction(
        ROAD, RUBBER.shifted(a_t), pressure=p, velocity=v, correction=SFactor(), adhesion=moved
    )
    result = road_map.mu(p, v, a_T=a_t, shift_adhesion=True)
    np.testing.assert_allclose(result, other.mu, rtol=1e-4)
    # a temperature for each point
    several = road_map.mu(p, 1e-3, a_T=[1.0, 10.0])
    np.testing.assert_array_equal(several, [road_map.mu(p, 1e-3), road_map.mu(p, 1e-3, a_T=10.0)])


def test_traction_is_odd_and_nought_at_rest_and_without_load(road_map):
    p, v = drawn(20, BOX)
    np.testing.assert_allclose(road_map.traction(p, v), road_map.mu(p, v) * p, rtol=1e-14)
    np.testing.assert_array_equal(road_map.traction(p, -v), -road_map.traction(p, v))
    np.testing.assert_array_equal(road_map.mu(p, -v), road_map.mu(p, v))  # which is even
    slopes, mirrored = (road_map.derivatives(p, sign * v).dmu_dlnv for sign in (1, -1))
    np.testing.assert_array_equal(mirrored, slopes)
    for outside in ("error", "nan", "clamp"):
        still = road_map.traction([2e5, 0.0, -1e5], [0.0, 0.1, 0.1], outside=outside)
        np.testing.assert_array_equal(still, 0)


OUTSIDE = [(4.9e4, 0.1), (1.1e6, 0.1), (0.0, 0.1), (-1e5, 0.1), (2e5, 0.0), (2e5, 9e-6), (2e5, 3.1)]
OUTSIDE += [(2e5, -3.1), (2e5, np.inf), (np.inf, 0.1), (0.0, 0.0), (1e9, 1e9)]


@pytest.mark.parametrize("point", OUTSIDE)
def test_outside_of_the_box_the_caller_chooses(road_map, point):
    nearest = np.clip(point[0], *BOX["pressure"]), np.clip(abs(point[1]), *BOX["velocity"])
    for look_up in (road_map.mu, road_map.hysteresis, road_map.adhesion, road_map.contact_area):
        with pytest.raises(OutOfRange):
            look_up(*point)
        assert np.isnan(look_up(*point, outside="nan"))
        assert look_up(*point, outside="clamp") == pytest.approx(
            look_up(*nearest), rel=1e-14, abs=0
        )
    slopes = road_map.derivatives(*point, outside="clamp")
    if point[0] != nearest[0]:
        assert slopes.dmu_dlnp == 0
    if abs(point[1]) != nearest[1]:
        assert slopes.dmu_dlnv == 0


FULL = {"correction": GreenwoodWilliamson(z_max=9e-4, z_min=-4e-4)}


def test_the_map_is_split_where_contact_becomes_full():
    result = made(**FULL, rtol=1e-5)
    v = np.geomspace(1.1e-5, 2.9, 23)
    fine = np.geomspace(*BOX["pressure"], 20_001)
    crossed = 0
    for velocity in v:
        scene = {"velocity": velocity, **FULL, "adhesion": ADHESION, "rtol": 1e-11}
        shift = friction(ROAD, RUBBER, pressure=fine[::50], **scene).shift_factor
        if shift[0] == 1 or shift[-1] > 1:
            continue
        crossed += 1
        low, high = fine[::50][shift > 1][-1], fine[::50][shift == 1][0]
        for _ in range(60):
            middle = np.sqrt(low * high)
            full = friction(ROAD, RUBBER, pressure=middle, **scene).shift_factor == 1
            low, high = (low, middle) if full else (middle, high)
        # no step at the kink, and the slope of either side right up to it
        assert result.mu(low, velocity) == pytest.approx(result.mu(high, velocity), rel=1e-9)
        for edge, sign in ((low * (1 - 1e-4), -1), (high * (1 + 1e-4), 1)):
            h = 1e-3
            values = friction(
                ROAD, RUBBER, pressure=edge * np.exp([0, sign * h, sign * 2 * h]), **scene
            ).mu
            exact = sign * (-3 * values[0] + 4 * values[1] - values[2]) / (2 * h)
            slope = result.derivatives(edge, velocity).dmu_dlnp
            assert slope == pytest.approx(exact, abs=2e-3 * values[0])
    assert crossed > 5


@pytest.mark.parametrize("width", [0.02, 0.01, 0.002])
def test_steps_of_the_modulus_are_seen_by_greenwood_williamson(width):
    """E* of the macro-asperities is the modulus at a single frequency, as steep as it is there."""
    steps = np.log([0.3, 7.0, 2e3])  # at q0 v
    beside = np.exp(np.add.outer(steps, width * np.linspace(-10, 10, 41))).ravel()
    w = np.unique(np.r_[np.geomspace(1e-3, 1e8, 300), beside])
    x = np.log(w)
    storage = 1e6 * np.exp(sum((1 + np.tanh((x - at) / (2 * width))) / 2 for at in steps))
    rubber = MasterCurve(angular_frequency=w, storage_modulus=storage, loss_modulus=0.1 * storage)
    correction = GreenwoodWilliamson(z_max=1.5e-3, z_min=-3e-4)
    made = friction_map(
        ROAD,
        rubber,
        pressure=(5e4, 5e6),
        velocity=(1e-5, 10.0),
        rtol=1e-3,
        correction=correction,
        checked=0,
    )
    draws = np.random.default_rng(4)
    p = np.exp(draws.uniform(*np.log(made.pressure), 3000))
    v = np.exp(draws.choice(steps, 3000) + width * draws.uniform(-10, 10, 3000)) / ROAD.q0
    exact = friction(ROAD, rubber, pressure=p, velocity=v, rtol=1e-6, correction=correction)
    for result, truth in (
        (made.hysteresis(p, v), exact.hysteresis),
        (made.contact_area(p, v), exact.contact_area),
    ):
        assert np.abs(result / truth - 1).max() <= made.max_error <= 1e-3


@pytest.mark.parametrize("reading", ["implicit", "added"])
def test_a_box_with_a_part_without_contact_is_refused(reading):
    lifted = GreenwoodWilliamson(z_max=4e-4, z_min=-8e-4, reading=reading)
    pressure = (10.0, 1e6) if reading == "implicit" else (3e5, 1e9)
    with pytest.raises(InvalidInput, match="finds no contact") as refused:
        made(lifted, box={"pressure": pressure, "velocity": (1e-5, 3.0)})
    p, v = (float(x) for x in re.findall(r"at (\S+) Pa and (\S+) m/s", str(refused.value))[0])
    area = asperity.contact_area(ROAD, RUBBER, pressure=p, velocity=v, correction=lifted)
    assert area == 0  # it is there indeed


@pytest.mark.parametrize("ratio", [1 + 1e-5, 1.1])
@pytest.mark.parametrize("name", ["gw added", "combined", "none"])
def test_narrow_boxes_are_no_worse(name, ratio):
    box = {"pressure": (3e5, 3e5 * ratio), "velocity": (1e-5, 3.0)}
    result = made(**SCENES[name], box=box, checked=5000)
    assert 0 < result.max_error <= 1e-4
    assert result.exceeded == 0


def test_a_box_near_the_onset_of_contact_is_mapped():
    lifted = GreenwoodWilliamson(z_max=4e-4, z_min=-8e-4)
    box = {"pressure": (10.0, 1e6), "velocity": (1e-5, 3.0)}
    lowest, highest = 10.0, 1e6
    for _ in range(60):
        middle = np.sqrt(lowest * highest)
        area = asperity.contact_area(ROAD, RUBBER, pressure=middle, velocity=3.0, correction=lifted)
        lowest, highest = (lowest, middle) if area > 0 else (middle, highest)
    for above in (1.01, 1.1):
        box["pressure"] = (highest * above, 1e6)
        result = made(lifted, box=box, rtol=1e-2, checked=5000)
        assert result.exceeded == 0


def box(**sides):
    return {"box": BOX | sides}


def stuck(**law):
    return {"adhesion": Adhesion(**{"shear_stress": 1e6, **law})}


@pytest.mark.parametrize(
    ("argument", "given"),
    [
        ("pressure", box(pressure=(2e5, 1e5))),
        ("pressure", box(pressure=(1e5, np.inf))),
        ("pressure", box(pressure=1e5)),
        ("pressure", box(pressure=(1e5, 2e5, 3e5))),
        ("pressure", box(pressure=(1e-310, 1e5))),  # which a file cannot hold
        ("velocity", box(velocity=(0.1, 0.1))),
        ("velocity", box(velocity=(0.0, 0.1))),
        ("velocity", box(velocity=(1e-5, 1e4)) | {"rubber": MEASURED}),  # not measured
        ("rtol", {"rtol": 0.0}),
        ("rtol", {"rtol": 0.2}),
        ("rtol", {"rtol": np.nan}),
        ("rtol", {"rtol": 1e-12}),  # not reached
        ("checked", {"checked": -1}),
        ("progress", {"progress": True}),
        ("shear_stress", stuck(shear_stress=1e-310)),
        ("reference_velocity", stuck(reference_velocity=1e301)),
        ("width", stuck(width=1e301)),
    ],
)
def test_what_no_map_is_made_of_is_refused(argument, given):
    with pytest.raises((InvalidInput, OutOfRange, NotConverged)) as refused:
        made(**given)
    assert refused.value.argument == argument


def test_an_elastic_rubber_has_area_and_adhesion_alone():
    result = made(**SCENES["elastic"])
    p, v = drawn(10, BOX)
    np.testing.assert_array_equal(result.hysteresis(p, v), 0)
    np.testing.assert_allclose(result.mu(p, v), result.adhesion(p, v), rtol=1e-14)
    bare = made(**SCENES["elastic"], adhesion=None)
    np.testing.assert_array_equal(bare.mu(p, v), 0)
    assert bare.adhesion_law is None
    assert result.adhesion_law == ADHESION
