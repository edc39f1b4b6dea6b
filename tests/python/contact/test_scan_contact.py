"""The contact of a scan itself: exact where it is solved, near to it between."""

import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import asperity
from asperity.validation import slide
from helpers.rubbers import prony, tread

LENGTH = 0.01
RUBBER = prony(1e6, np.geomspace(3e5, 3e8, 8), np.geomspace(1e-1, 1e-7, 8))
ROAD = asperity.SelfAffineSpectrum(
    rms_height=1e-4, hurst=0.8, q0=4 * np.pi / LENGTH, q1=32 * np.pi / LENGTH
)


def filtered(heights, lowest, highest):
    n = len(heights)
    k = 2 * np.pi * np.fft.fftfreq(n, LENGTH / n)
    q = np.hypot(k, k[:, None])
    modes = np.where(
        (q > lowest * (1 - 1e-9)) & (q < highest * (1 + 1e-9)), np.fft.fft2(heights), 0
    )
    return np.fft.ifft2(modes).real


def worn(n=128, seed=1):
    """A periodic map with flattened tops, of the band of ROAD."""
    z = asperity.synthesize(ROAD, shape=(n, n), pixel_size=LENGTH / n, seed=seed).heights / 1e-4
    h = filtered(-np.logaddexp(0, -1.2 * z - 0.5), ROAD.q0, ROAD.q1)
    return asperity.HeightMap(h * 1e-4 / h.std(), pixel_size=LENGTH / n)


def rings(scan):
    spectrum = asperity.power_spectrum(scan, window="none", detrend=None)
    return spectrum.truncated(q0=ROAD.q0, q1=ROAD.q1)


SCAN = worn()
SPECTRUM = rings(SCAN)
EXACT = asperity.ScanContact(SCAN, periodic=True)


def friction(velocity, pressure=2e5, correction=EXACT, **more):
    scene = {"correction": correction, "pressure": pressure, "velocity": velocity} | more
    return asperity.friction(SPECTRUM, RUBBER, **scene)


def truth(velocity, pressure=2e5):
    return slide(SCAN, RUBBER, pressure=pressure, velocity=velocity, periodic=True, rtol=1e-5)


def test_it_is_exact_where_it_is_solved_and_near_to_it_between():
    assert SCAN.skewness < -0.7
    velocity = 1.37 * np.geomspace(1e-6, 1, 16)
    result = friction(velocity)
    exact = [truth(v) for v in velocity]
    mu = np.array([c.hysteresis for c in exact])
    area = np.array([c.contact_area for c in exact])
    assert result.mu == pytest.approx(mu, rel=0.02)
    assert result.contact_area == pytest.approx(area, rel=0.02)
    assert np.sqrt(np.mean((result.mu / mu - 1) ** 2)) < 0.006
    theory = friction(velocity, correction=asperity.PartialContact())
    assert np.abs(theory.mu / mu - 1).max() > 0.5
    assert (result.model_error > np.abs(result.mu / mu - 1) / 2).all()

    assert (friction(velocity, rtol=1e-4).error_estimate <= 1e-4 * result.mu).all()

    table = EXACT.contacts.to_dataframe()
    here = table[(table.part == -1) & (table.coarse == 0) & (table.pressure == 2e5)]
    row = here.iloc[len(here) // 2]
    at_node = friction(row.velocity)
    assert at_node.mu == pytest.approx(row.hysteresis, rel=1e-5)
    assert at_node.contact_area == pytest.approx(row.contact_area, rel=1e-5)
    assert row.hysteresis == pytest.approx(truth(row.velocity).hysteresis, rel=1e-3)


def test_each_error_stands_apart_in_its_contacts():
    anew = asperity.ScanContact(SCAN, periodic=True)
    result = friction(0.013, correction=anew)
    table = anew.contacts.to_dataframe()
    parts = {name: table[name].dropna() for name in ("interpolation", "pixels", "scan", "joining")}
    assert {name: len(one) for name, one in parts.items()} == dict.fromkeys(parts, 1)
    [at] = parts["scan"].index
    together = np.hypot.reduce([*(one.iloc[0] for one in parts.values()), table.error[at]])
    assert result.model_error == pytest.approx(together, rel=1e-12)

    # of one scan: half of the scatter of mu of its quarters
    quarters = table[(table.part >= 0) & (table.velocity == table.velocity[at])]
    assert len(quarters) == 4
    scatter = np.log(quarters.hysteresis).std() / 2
    assert parts["scan"].iloc[0] == pytest.approx(scatter, rel=1e-9)
    [half] = np.flatnonzero(table.coarse)
    ratio = np.log(table.hysteresis / table.rule_hysteresis)
    assert parts["pixels"].iloc[0] == pytest.approx(abs(ratio[half] - ratio[at]) / 3, rel=1e-9)
    assert table.points_x[half] < 0.6 * table.points_x[at]


def test_a_steep_modulus_is_solved_at_every_node():
    # E0 / E_inf = 300 in one term: a loss tangent of 8.6
    steep = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[299e6], relaxation_times=[1e-3])
    anew = asperity.ScanContact(SCAN, periodic=True)
    velocity = 1.3 * np.geomspace(3e-3, 0.03, 2)
    result = asperity.friction(SPECTRUM, steep, pressure=5e5, velocity=velocity, correction=anew)
    assert anew.contacts.to_dataframe().error.max() <= 1e-4
    exact = [slide(SCAN, steep, pressure=5e5, velocity=v, periodic=True) for v in velocity]
    assert result.mu == pytest.approx([c.hysteresis for c in exact], rel=0.02)


def test_digits_do_not_depend_on_order_threads_or_what_was_solved():
    velocity = np.geomspace(1e-4, 1, 5)
    whole = friction(velocity)
    anew = asperity.ScanContact(SCAN, periodic=True)
    backward = [friction(v, correction=anew).mu for v in velocity[::-1]]
    assert backward[::-1] == whole.mu.tolist()
    threaded = asperity.ScanContact(SCAN, periodic=True)
    assert friction(velocity, correction=threaded, threads=2).mu.tolist() == whole.mu.tolist()
    shared = asperity.ScanContact(SCAN, periodic=True)
    with ThreadPoolExecutor(2) as pool:
        result = [*pool.map(lambda v: friction(v, correction=shared).mu, velocity)]
    assert result == whole.mu.tolist()


def test_what_was_solved_is_kept_and_carried(tmp_path):
    first = friction(0.01)
    count = len(EXACT.contacts)
    assert friction(0.01).mu == first.mu
    assert len(EXACT.contacts) == count
    EXACT.save(tmp_path / "scan.npz")
    for again in (
        pickle.loads(pickle.dumps(EXACT)),
        asperity.ScanContact.load(tmp_path / "scan.npz"),
    ):
        assert again == EXACT
        assert friction(0.01, correction=again).mu == first.mu
        assert len(again.contacts) == count
    (tmp_path / "other.npz").write_bytes(b"PK nothing")
    with pytest.raises(asperity.InvalidInput, match=r"other\.npz: is no saved ScanContact"):
        asperity.ScanContact.load(tmp_path / "other.npz")


def test_one_lattice_serves_all_temperatures():
    law = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
    anew = asperity.ScanContact(SCAN, periodic=True)
    first = friction(0.01, correction=anew)
    count = len(anew.contacts)
    a_T = 10 ** law.log10_a_T(283.15)  # noqa: N806
    cool = friction(0.01 / a_T, correction=anew, temperature=283.15, shift=law)
    assert cool.mu == pytest.approx(first.mu, rel=1e-9)
    assert len(anew.contacts) == count


def test_a_rubber_without_loss_has_no_friction_and_the_exact_area():
    elastic = asperity.PronySeries(equilibrium_modulus=2e6, moduli=[], relaxation_times=[])
    result = asperity.friction(SPECTRUM, elastic, pressure=2e5, velocity=1.0, correction=EXACT)
    exact = slide(SCAN, elastic, pressure=2e5, velocity=0.0, periodic=True, rtol=1e-5)
    assert result.mu == 0
    assert result.contact_area == pytest.approx(exact.contact_area, rel=1e-3)


def test_area_and_contributions():
    area = asperity.contact_area(SPECTRUM, RUBBER, pressure=2e5, velocity=0.1, correction=EXACT)
    assert area == friction(0.1).contact_area
    q = ROAD.q1 / 2
    half = asperity.HeightMap(filtered(SCAN.heights, ROAD.q0, q), pixel_size=SCAN.pixel_size)
    exact = slide(half, RUBBER, pressure=2e5, velocity=0.1, periodic=True, rtol=1e-5)
    scene = {"pressure": 2e5, "velocity": 0.1, "correction": EXACT}
    result = asperity.contact_area(SPECTRUM, RUBBER, wavenumber=[ROAD.q0, q, ROAD.q1], **scene)
    assert result[0] == 1
    assert result[1] == pytest.approx(exact.contact_area, rel=0.03)
    assert result[2] == area

    parts = friction(0.1, contributions=True)
    density = np.trapezoid(parts.dmu_dlnq, np.log(parts.wavenumber))
    assert density == pytest.approx(parts.hysteresis, rel=0.02)
    with pytest.raises(asperity.InvalidInput, match="knows no distribution of pressure"):
        asperity.pressure_distribution(1e6, SPECTRUM, RUBBER, **scene)


def test_a_map_that_is_no_sample_of_the_spectrum_is_refused():
    lost = np.random.default_rng(1).random(SCAN.heights.shape) < 1 / 3
    holed = asperity.HeightMap(np.where(lost, np.nan, SCAN.heights), pixel_size=SCAN.pixel_size)
    with pytest.raises(asperity.InvalidInput):
        friction(0.01, correction=asperity.ScanContact(holed))
    with pytest.raises(asperity.InvalidInput, match=r"mean square slope .* factor of 2"):
        asperity.friction(SPECTRUM.scaled(3), RUBBER, pressure=2e5, velocity=0.1, correction=EXACT)
    far = asperity.SelfAffineSpectrum(rms_height=1e-6, hurst=0.8, q0=1e6, q1=1e7)
    with pytest.raises(asperity.InvalidInput, match="height_map knows waves from"):
        asperity.friction(far, RUBBER, pressure=2e5, velocity=0.1, correction=EXACT)


def test_beyond_the_map_the_theory_goes_on():
    longer = asperity.SelfAffineSpectrum(
        rms_height=SPECTRUM.rms_height, hurst=0.8, q0=ROAD.q0, q1=ROAD.q1 * 20
    )
    scene = {"pressure": 2e5, "velocity": 1e-3, "correction": EXACT}
    # the scan knows waves of two pixels and longer
    result = asperity.friction(longer, RUBBER, **scene)
    inside = asperity.friction(longer.truncated(q1=np.pi / SCAN.pixel_size[0]), RUBBER, **scene)
    assert result.contact_area < inside.contact_area


def test_a_scan_with_edges_drop_outs_and_a_tilt():
    whole = worn(512, seed=3)
    spectrum = rings(whole)
    cut = whole.heights[40:424, 100:484].copy()
    cut += 2e-6 * np.arange(384)[:, None]
    cut[5, 7:9] = np.nan
    part = asperity.HeightMap(cut, pixel_size=whole.pixel_size)
    scene = {"pressure": 2e5, "velocity": np.geomspace(1e-4, 0.1, 4)}
    result = asperity.friction(spectrum, RUBBER, correction=asperity.ScanContact(part), **scene)
    exact = asperity.friction(
        spectrum, RUBBER, correction=asperity.ScanContact(whole, periodic=True), **scene
    )
    assert result.mu == pytest.approx(exact.mu, rel=0.1)
    assert (np.abs(result.mu / exact.mu - 1) < 3 * result.model_error).all()


def large(n=1280):
    """A periodic worn map that one grid does not hold, and its rings."""
    end = np.pi * n / 4 / LENGTH
    band = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=ROAD.q0, q1=end)
    z = asperity.synthesize(band, shape=(n, n), pixel_size=LENGTH / n, seed=4).heights / 1e-4
    h = filtered(-np.logaddexp(0, -1.2 * z - 0.5), ROAD.q0, end)
    scan = asperity.HeightMap(h * 1e-4 / h.std(), pixel_size=LENGTH / n)
    rings = asperity.power_spectrum(scan, window="none", detrend=None)
    return scan, rings.truncated(q0=ROAD.q0, q1=end)


def test_a_scan_that_one_grid_does_not_hold_has_its_short_waves_from_pieces():
    scan, spectrum = large()
    elastic = asperity.PronySeries(equilibrium_modulus=2e6, moduli=[], relaxation_times=[])
    scene = {"pressure": 2e5, "velocity": 1.0}
    exact = slide(scan, elastic, pressure=2e5, velocity=0.0, periodic=True, rtol=1e-4)
    split = asperity.ScanContact(scan, periodic=True)
    result = asperity.friction(spectrum, elastic, correction=split, **scene)
    assert result.contact_area == pytest.approx(exact.contact_area, rel=0.05)
    rule = asperity.friction(spectrum, elastic, correction=asperity.PartialContact(), **scene)
    assert rule.contact_area < 0.8 * exact.contact_area
    assert any("solved on four pieces" in str(note) for note in result.notes)
    rows = split.contacts.to_dataframe()
    assert set(rows.part) == {-1, *range(12)}
    assert (rows.points_x * rows.points_y).max() <= 520**2

    # pieces that hold the longest waves need no whole scan
    short = spectrum.truncated(q0=spectrum.q1 / 3)
    alone = asperity.ScanContact(scan, periodic=True)
    result = asperity.friction(short, elastic, correction=alone, **scene)
    assert set(alone.contacts.to_dataframe().part) == {4, 5, 6, 7}
    assert result.contact_area > 0.1


def test_many_pressures_are_asked_on_a_lattice():
    anew = asperity.ScanContact(SCAN, periodic=True)
    pressure = np.geomspace(1e5, 4e5, 20)
    result = friction(0.01, pressure=pressure, correction=anew)
    loads = np.unique(anew.contacts.to_dataframe().pressure)
    assert len(loads) <= 8
    for i in (3, 12):
        exact = truth(0.01, pressure[i])
        assert result.mu[i] == pytest.approx(exact.hysteresis, rel=0.02)


LAW = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)


def heated(conductivity, velocity):
    heating = tread(conductivity=conductivity, contact_diameter=2e-3)
    return friction(velocity, temperature=293.15, shift=LAW, heating=heating)


def test_with_heat_each_wave_has_its_temperature():
    velocity = np.array([0.1, 10.0])
    exact = [truth(v) for v in velocity]
    faint = heated(100.0, velocity[:1])  # whose heat flows away: the cold contact
    assert faint.temperature == pytest.approx(293.15, abs=0.2)
    assert faint.mu == pytest.approx(exact[0].hysteresis, rel=1e-2)
    assert faint.contact_area == pytest.approx(exact[0].contact_area, rel=1e-2)
    hot = heated(0.01, velocity)
    assert (hot.temperature > [293.2, 293.5]).all()
    # all waves are between the cold rubber and that of the hottest
    ends = [
        truth(v * 10 ** LAW.log10_a_T(t)).contact_area
        for v, t in zip(velocity, hot.temperature, strict=True)
    ]
    cold = np.array([c.contact_area for c in exact])
    assert (cold < hot.contact_area).all()
    assert (hot.contact_area < ends).all()
    assert hot.cold.mu == pytest.approx(friction(velocity).mu, rel=1e-9)
    with pytest.raises(asperity.InvalidInput, match="a map with heat"):
        asperity.friction_map(
            SPECTRUM,
            RUBBER,
            pressure=(1e5, 2e5),
            velocity=(1e-3, 1e-1),
            correction=EXACT,
            temperature=293.15,
            shift=LAW,
            heating=tread(conductivity=0.2, contact_diameter=2e-3),
        )


def test_a_map_of_it_is_certified_against_friction():
    scene = {"pressure": (1e5, 4e5), "velocity": (1e-2, 0.1), "correction": EXACT}
    fmap = asperity.friction_map(SPECTRUM, RUBBER, rtol=1e-2, checked=200, **scene)
    rng = np.random.default_rng(5)
    p, v = 1e5 * 4 ** rng.random(50), 1e-2 * 10 ** rng.random(50)
    result = friction(v, pressure=p)
    assert (np.abs(fmap.mu(p, v) / result.mu - 1) <= fmap.max_error).all()


def test_a_scene_takes_its_own_scan(tmp_path):
    from asperity.cli import main

    np.save(tmp_path / "scan.npy", SCAN.heights)
    (tmp_path / "scene.toml").write_text(
        f"""
[surface]
file = "scan.npy"
pixel_size_m = {SCAN.pixel_size[0]}
unit = "m"
window = "none"
detrend = "none"
q0_per_m = {ROAD.q0}
q1_per_m = {ROAD.q1}
[rubber]
equilibrium_modulus_pa = 1e6
moduli_pa = {RUBBER.moduli.tolist()}
relaxation_times_s = {RUBBER.relaxation_times.tolist()}
[conditions]
pressure_pa = 2e5
velocity_m_s = [1e-3, 0.1]
[correction]
kind = "scan-contact"
periodic = true
tolerance = 0.02
"""
    )
    out = tmp_path / "mu.csv"
    assert main(["friction", str(tmp_path / "scene.toml"), "--output", str(out)]) == 0
    lines = [line for line in out.read_text().splitlines() if not line.startswith("#")]
    mu = [float(line.split(",")[lines[0].split(",").index("mu")]) for line in lines[1:]]
    assert mu == pytest.approx(friction(np.array([1e-3, 0.1])).mu, rel=0.01)
