"""Exact sliding contact against closed forms, other solvers, and its own symmetries."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asperity
from asperity.validation import SlidingContact, SlidingStep, slide
from asperity.validation.sliding import continued
from helpers import boundary_elements
from helpers.cases import case

sys.path.insert(0, str(Path(__file__).parents[2] / "reference"))
import contact_tables

LENGTH = 0.01
SOLID = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[9e6], relaxation_times=[1e-3])
BAND = {"hurst": 0.8, "q0": 8 * np.pi / LENGTH, "rms_height": 1e-4}


def rough(n: int, last: int, seed: int = 1) -> asperity.HeightMap:
    """n^2 points, 4 to `last` waves to a side."""
    spectrum = asperity.SelfAffineSpectrum(q1=last * 2 * np.pi / LENGTH, **BAND)
    return asperity.synthesize(spectrum, shape=(n, n), pixel_size=LENGTH / n, seed=seed)


def pressed(surface: asperity.HeightMap, **changed: Any) -> SlidingContact:
    given = {"pressure": 2e5, "velocity": 0.3, "periodic": True}
    return slide(surface, SOLID, **(given | changed))


def with_heights(surface: asperity.HeightMap, heights: Any) -> asperity.HeightMap:
    return asperity.HeightMap(np.ascontiguousarray(heights), pixel_size=surface.pixel_size)


def test_reference_table(reference_table: Callable[[str], list[dict[str, Any]]]) -> None:
    for row in reference_table("sliding"):
        with case(case=row["case"]):
            n = int(row["points"])
            y, x = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
            waves = zip(*(row[name] for name in ("kx", "ky", "amplitude", "phase")), strict=True)
            h = sum(a * np.cos(2 * np.pi * (i * x + j * y) / n + f) for i, j, a, f in waves)
            rubber = asperity.PronySeries(
                equilibrium_modulus=row["equilibrium_modulus"],
                moduli=row["moduli"],
                relaxation_times=row["relaxation_times"],
            )
            given = {name: row[name] for name in ("pressure", "velocity", "poisson_ratio")}
            surface = asperity.HeightMap(h, pixel_size=row["length"] / n)
            # the error that is promised, and what is left of it where it is small
            for rtol, bound in ((1e-6, 1e-5), (1e-11, row["rtol"])):
                result = slide(surface, rubber, **given, periodic=True, rtol=rtol)
                assert result.error <= rtol
                assert result.contact_area_raw == pytest.approx(row["contact_area"], rel=1e-14)
                for name in ("hysteresis", "work_of_slopes", "elastic_energy"):
                    assert getattr(result, name) == pytest.approx(row[name], rel=bound)


@pytest.mark.parametrize("skew", [0, 1, 3])
def test_complete_contact_of_one_wave(skew: int) -> None:
    # p_q = h_q |q| conj E / (2 (1 - nu^2)), so mu = q_x a^2 |q| E'' / (4 (1 - nu^2) sigma0)
    n, k, a, nu, load, v = 64, 3, 2e-5, 0.4, 5e5, 0.7
    y, x = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    surface = asperity.HeightMap(
        a * np.cos(2 * np.pi * (k * x + skew * y) / n + 0.4), pixel_size=LENGTH / n
    )
    qx, q = 2 * np.pi * k / LENGTH, 2 * np.pi * np.hypot(k, skew) / LENGTH
    modulus = SOLID.modulus(v * qx)
    result = slide(surface, SOLID, pressure=load, velocity=v, poisson_ratio=nu, periodic=True)
    expected = qx * a**2 * q * modulus.imag / (4 * (1 - nu**2) * load)
    assert result.hysteresis == pytest.approx(expected, rel=1e-12)
    assert result.work_of_slopes == pytest.approx(expected, rel=1e-12)
    assert result.contact_area == result.contact_area_raw == 1
    amplitude = a * q * abs(modulus) / (2 * (1 - nu**2))
    assert result.pressure.max() == pytest.approx(load + amplitude, rel=3e-3)  # between points
    assert result.elastic_energy == pytest.approx(
        q * a**2 * modulus.real / (8 * (1 - nu**2)), rel=1e-12
    )
    assert not result.gap.any()


@pytest.mark.parametrize(("velocity", "modulus"), [(0.0, 1e6), (1e-12, 1e6), (1e14, 1e7)])
def test_both_limits_are_elastic(velocity: float, modulus: float) -> None:
    surface = rough(128, 16)
    effective = modulus / 0.75
    for load in (0.02, 0.1, 0.4):
        elastic = boundary_elements.pressed(surface, load * surface.rms_slope, 1e-10)
        pressure = load * effective * surface.rms_slope
        result = pressed(surface, pressure=pressure, velocity=velocity, rtol=1e-9)
        assert result.contact_area_raw == elastic.area_raw
        assert result.contact_area == pytest.approx(elastic.area, rel=1e-12)
        assert result.elastic_energy == pytest.approx(elastic.energy * effective, rel=1e-6)
        assert result.gap.mean() == pytest.approx(elastic.mean_gap, rel=1e-6)
        assert abs(result.hysteresis) < 1e-8


def shipped(kind: Callable[[dict[str, str]], bool]) -> list[tuple[float, float]]:
    """Relative errors of mu and A against rows of the table."""
    rows = [row for row in contact_tables.rows(contact_tables.ANOTHER_PROGRAM) if kind(row)]
    assert len(rows) > 2
    errors = []
    for row in rows:
        surface = contact_tables.map_of_another_program(row, int(row["N"]))
        _, rubber, at = contact_tables.scene_of_another_program(row)
        with case(**row):
            result = slide(surface, rubber, **at, periodic=True, rtol=1e-5)
        mu, area = (
            result.hysteresis / float(row["mu"]) - 1,
            result.contact_area / float(row["A"]) - 1,
        )
        with case(**row, mu_error=mu, area_error=area):
            # four times the scatter of maps
            assert abs(mu) < 0.10
            assert abs(area) < 0.072
        errors.append((mu, area))
    return errors


def test_rows_of_another_program() -> None:
    def few(row: dict[str, str]) -> bool:
        name = (row["material"], row["pressure"][:4], row["log10_v_q0"])
        return (row["k1"], row["N"]) == ("64", "512") and name in {
            ("sls10", "0.66", "-1.5000"),
            ("sls10", "0.66", "0.0000"),
            ("sls100", "1.33", "-0.8333"),
            ("sbr", "0.66", "0.0000"),
        }

    mu, area = np.array(shipped(few)).T
    assert np.sqrt(np.mean(mu**2)) < 0.05
    assert np.sqrt(np.mean(area**2)) < 0.036


@pytest.mark.long
def test_all_rows_of_another_program() -> None:
    mu, area = np.array(shipped(lambda r: r["N"] == "512" and float(r["A"]) > 0.03)).T
    assert np.sqrt(np.mean(mu**2)) < 0.025
    assert np.sqrt(np.mean(area**2)) < 0.018


def test_dissipation_is_the_work_of_the_slopes_on_fine_meshes() -> None:
    fine = rough(256, 16)
    result = []
    for step in (4, 2, 1):  # 4, 8, 16 points a shortest wave
        heights = np.ascontiguousarray(fine.heights[::step, ::step])
        thinned = asperity.HeightMap(heights, pixel_size=step * LENGTH / 256)
        result.append(pressed(thinned, velocity=0.03))
    missing = [abs(c.work_of_slopes / c.hysteresis - 1) for c in result]
    assert missing[0] > missing[1] > missing[2]
    assert missing[2] < 0.004
    assert result[1].hysteresis == pytest.approx(result[2].hysteresis, rel=0.01)
    assert result[1].contact_area == pytest.approx(result[2].contact_area, rel=0.015)


def test_mirrored_and_shifted_maps() -> None:
    surface = rough(100, 12)  # no power of two; no coarser grid falls on the same points
    first = pressed(surface, rtol=1e-9)
    across = pressed(with_heights(surface, surface.heights[::-1]), rtol=1e-9)
    moved = pressed(with_heights(surface, np.roll(surface.heights, (17, 31), (0, 1))), rtol=1e-9)
    for other, back in (
        (across, across.pressure[::-1]),
        (moved, np.roll(moved.pressure, (-17, -31), (0, 1))),
    ):
        assert other.hysteresis == pytest.approx(first.hysteresis, rel=1e-7)
        assert np.abs(back - first.pressure).max() < 1e-5 * first.pressure.max()
    backwards = pressed(with_heights(surface, surface.heights[:, ::-1]), rtol=1e-9)
    assert abs(backwards.hysteresis / first.hysteresis - 1) > 1e-4  # another way, other slopes


@pytest.mark.parametrize("scale", [1e-6, 1e5])
def test_units(scale: float) -> None:
    surface, first = rough(48, 8), pressed(rough(48, 8), rtol=1e-9)
    assert first.pressure.min() == first.gap.min() == 0
    assert first.pressure.mean() == pytest.approx(2e5, rel=1e-12)
    assert (first.pressure * first.gap).mean() <= 1e-9 * first.pressure.mean() * surface.rms_height
    long = asperity.HeightMap(surface.heights * scale, pixel_size=surface.pixel_size[0] * scale)
    result = pressed(long, velocity=0.3 * scale, rtol=1e-9)
    assert result.hysteresis == pytest.approx(first.hysteresis, rel=1e-8)
    assert result.contact_area == pytest.approx(first.contact_area, rel=1e-12)
    assert result.gap.mean() == pytest.approx(first.gap.mean() * scale, rel=1e-8)


def test_pixels_need_not_be_square() -> None:
    fine = rough(128, 8)
    wide = asperity.HeightMap(fine.heights[:, ::2], pixel_size=(LENGTH / 128, LENGTH / 64))
    tall = asperity.HeightMap(fine.heights[::2], pixel_size=(LENGTH / 64, LENGTH / 128))
    first = pressed(fine)
    for result in (pressed(wide), pressed(tall)):
        assert result.hysteresis == pytest.approx(first.hysteresis, rel=0.02)
        assert result.contact_area == pytest.approx(first.contact_area, rel=0.03)


def test_ways_to_make_a_map_periodic() -> None:
    scan = with_heights(rough(128, 16), rough(128, 16).heights[:80, :64])
    by_images = pressed(scan, periodic="mirror")
    images = np.pad(scan.heights, ((0, 80), (0, 64)), mode="symmetric")
    as_given = pressed(with_heights(scan, images))
    assert by_images.hysteresis == pytest.approx(as_given.hysteresis, rel=1e-9)
    assert by_images.pressure == pytest.approx(as_given.pressure, abs=1e-3)
    assert "mirror" in by_images.notes[0]
    assert as_given.notes == ()

    faded = pressed(scan, periodic="fade")
    h = scan.heights - scan.heights.mean()
    for axis, margin in ((1, 8), (0, 10)):
        h = np.moveaxis(h, axis, 0)
        kept = len(h) - margin
        angle = np.pi / 2 * (np.arange(margin)[:, None] + 0.5) / margin
        edge = np.sin(angle) * h[:margin] + np.cos(angle) * h[kept:]
        h = np.moveaxis(np.concatenate([edge, h[margin:kept]]), 0, axis)
    same = pressed(with_heights(scan, h))
    assert faded.pressure.shape == (70, 56)
    assert faded.hysteresis == pytest.approx(same.hysteresis, rel=1e-6)
    assert "fading" in faded.notes[0]
    solved = continued(scan, "fade").heights
    assert solved == pytest.approx(h - h.mean(), abs=1e-18)

    blended = slide(scan, SOLID, pressure=2e5, velocity=0.3)
    assert "blending" in blended.notes[0]
    same = pressed(continued(scan, "blend"))
    assert blended.hysteresis == pytest.approx(same.hysteresis, rel=1e-6)


DIRECTIONS = (0.0, 0.3, np.pi / 4, 1.2, np.pi / 2, 2.5, -2.0)


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_a_wave_in_complete_contact_knows_its_direction(direction: float) -> None:
    n, waves, nu, load = 64, np.array([3, 2]), 0.4, 5e6  # along x and y
    q = 2 * np.pi / LENGTH * waves
    x = np.arange(n) * LENGTH / n
    amplitude = 1e-5
    heights = amplitude * np.cos(q[0] * x + q[1] * x[:, None])
    surface = asperity.HeightMap(heights, pixel_size=LENGTH / n)
    v = 2.0
    s = np.array([np.cos(direction), np.sin(direction)])
    result = slide(
        surface,
        SOLID,
        pressure=load,
        velocity=v,
        poisson_ratio=nu,
        direction=direction,
        periodic=True,
    )
    assert result.contact_area == 1
    # p = |q| conj E h / (2 (1 - nu^2)) of the wave, and its work
    loss = SOLID.modulus(v * abs(q @ s)).imag * np.sign(q @ s)
    work = amplitude**2 * np.hypot(*q) * loss / (4 * (1 - nu**2) * load)
    assert result.hysteresis == pytest.approx(work * (q @ s), rel=1e-9)
    assert result.work_of_slopes == pytest.approx(result.hysteresis, rel=1e-9)
    assert result.lateral == pytest.approx(work * (q @ [-s[1], s[0]]), rel=1e-9)


def test_a_turned_map_is_a_turned_direction() -> None:
    scan = rough(64, 8)
    ridged = with_heights(scan, scan.heights + 2 * np.roll(scan.heights, 3, axis=1))
    first = pressed(ridged, direction=0.4)
    transposed = pressed(with_heights(scan, ridged.heights.T.copy()), direction=np.pi / 2 - 0.4)
    # waves of two points have no direction of their own
    assert transposed.hysteresis == pytest.approx(first.hysteresis, rel=1e-4)
    assert transposed.lateral == pytest.approx(-first.lateral, rel=1e-3)
    back = np.roll(ridged.heights[::-1, ::-1], 1, axis=(0, 1))
    turned = pressed(with_heights(scan, back), direction=0.4 + np.pi)
    assert turned.hysteresis == pytest.approx(first.hysteresis, rel=1e-5)
    assert turned.lateral == pytest.approx(first.lateral, rel=1e-4)
    assert abs(first.lateral) > 1e-3


def test_friction_is_smooth_in_the_direction() -> None:
    # waves across the way have the mean of their cell: without it mu dips where they meet the grid
    scan = rough(64, 8)
    angles = np.linspace(-0.2, 0.2, 9)
    mu = [pressed(scan, velocity=1e3, direction=angle).hysteresis for angle in angles]
    assert np.abs(np.diff(mu, 2)).max() < 0.02 * np.mean(mu)


def test_band_of_waves_across_the_way() -> None:
    # ridges along the way: the band alone dissipates, v -> inf is glassy and not relaxed
    n = 64
    ridges = 1e-4 * np.cos(2 * np.pi * np.arange(n) / n)[:, None] * np.ones(n)
    surface = asperity.HeightMap(ridges, pixel_size=LENGTH / n)
    relaxed = pressed(surface, velocity=0.0)
    fast = pressed(surface, velocity=1e9)
    assert fast.contact_area < 0.6 * relaxed.contact_area
    slow = pressed(surface, velocity=1.0)
    assert slow.hysteresis > 0
    assert abs(slow.work_of_slopes) < 1e-9


def test_master_curve_must_reach_all_waves() -> None:
    w = np.geomspace(1, 1e5, 60)
    e = SOLID.modulus(w)
    curve = asperity.MasterCurve(angular_frequency=w, storage_modulus=e.real, loss_modulus=e.imag)
    surface = rough(32, 8)
    result = slide(surface, curve, pressure=2e5, velocity=0.3, periodic=True)
    series = pressed(surface)
    assert result.hysteresis == pytest.approx(series.hysteresis, rel=2e-3)
    with pytest.raises(asperity.OutOfRange, match=r"velocities from 0\.00159.* to 9\.94"):
        slide(surface, curve, pressure=2e5, velocity=50.0, periodic=True)
    with pytest.raises(asperity.OutOfRange, match="velocity = 0 m/s"):
        slide(surface, curve, pressure=2e5, velocity=0.0, periodic=True)


SMALL = rough(32, 8)
HOLED = np.where(np.arange(256).reshape(16, 16) == 7, np.nan, np.arange(256).reshape(16, 16) % 7)


REFUSED: list[tuple[str, Any, dict[str, Any]]] = [
    ("pressure", SMALL, {"pressure": 0.0}),
    *(("velocity", SMALL, {"velocity": wrong}) for wrong in (-1.0, np.nan)),
    ("poisson_ratio", SMALL, {"poisson_ratio": 0.7}),
    *(("periodic", SMALL, {"periodic": wrong}) for wrong in ("window", False, 1)),
    ("rtol", SMALL, {"rtol": 0.5}),
    ("time_limit", SMALL, {"time_limit": -1.0}),
    ("direction", SMALL, {"direction": np.nan}),
    *(
        ("height_map", asperity.HeightMap(heights, pixel_size=1e-4), {})
        for heights in (np.ones((16, 16)), np.arange(64.0).reshape(8, 8), HOLED)
    ),
    ("height_map", np.ones((16, 16)), {}),
]


@pytest.mark.parametrize(("argument", "surface", "changed"), REFUSED)
def test_what_cannot_slide_is_refused_by_its_argument(
    argument: str, surface: Any, changed: dict[str, Any]
) -> None:
    with pytest.raises(asperity.InvalidInput) as caught:
        pressed(surface, **changed)
    assert caught.value.argument == argument


def test_a_direction_in_degrees_is_noted() -> None:
    assert pressed(rough(64, 8), direction=90.0).notes[0].code == "large-angle"


def test_time_limit_says_what_was_reached() -> None:
    with pytest.raises(asperity.NotConverged, match=r"error of .* its contact area was .*time_lim"):
        pressed(rough(256, 32), rtol=1e-12, time_limit=1e-3)


def test_progress_is_told_every_step_coarse_grids_first() -> None:
    told: list[SlidingStep] = []
    result = pressed(rough(256, 32), rtol=1e-6, progress=told.append)
    first = [at.shape for at in told if at.step == 1]
    assert first == [(64, 64), (128, 128), (256, 256)]
    assert told[-1].shape == (256, 256)
    assert told[-1].error == pytest.approx(result.error, rel=1e-3)
    assert result == pressed(rough(256, 32), rtol=1e-6)


def test_steepest_moduli_take_few_steps() -> None:
    # where beta falls though GMRES did not come to its end, it takes 388 steps and twice the time
    waves = {"hurst": 0.3, "q0": 4 * np.pi / LENGTH, "q1": 170 * np.pi / LENGTH}
    spectrum = asperity.SelfAffineSpectrum(rms_height=1e-4, **waves)
    surface = asperity.synthesize(spectrum, shape=(256, 256), pixel_size=LENGTH / 256, seed=1)
    steep = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[999e6], relaxation_times=[1e-3])
    told: list[SlidingStep] = []
    slide(
        surface,
        steep,
        pressure=8e6,
        velocity=1e-3,
        periodic=True,
        rtol=1e-4,
        progress=told.append,
    )
    assert len(told) < 300


def test_what_progress_raises_ends_the_contact() -> None:
    def stop(_: SlidingStep) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        pressed(rough(128, 16), progress=stop)
    with pytest.raises(asperity.InvalidInput, match="progress = 3: must be callable, or None"):
        pressed(rough(128, 16), progress=3)
