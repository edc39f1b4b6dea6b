"""Calls that solve contacts of a scan: how far they are, ended on the way, refused, or noted."""

import signal
from typing import Any

import numpy as np
import pytest

import asperity
from helpers.rubbers import curve_of, prony, tread

LENGTH = 0.01
ROAD = asperity.SelfAffineSpectrum(
    rms_height=1e-4, hurst=0.8, q0=8 * np.pi / LENGTH, q1=32 * np.pi / LENGTH
)
SCAN = asperity.synthesize(ROAD, shape=(64, 64), pixel_size=LENGTH / 64, seed=1)
RUBBER = prony(1e6, [2e6, 9e6], [1e-1, 1e-4])
_OF_CONTACT = 19  # columns up to its points, with the seconds that it took; errors come later
VELOCITY = np.geomspace(1e-3, 1, 7)


def scan():
    return asperity.ScanContact(SCAN, periodic=True)


def friction(correction, **more):
    scene: dict[str, Any] = {"pressure": 2e5, "velocity": VELOCITY} | more
    return asperity.friction(ROAD, RUBBER, correction=correction, **scene)


@pytest.mark.parametrize("threads", [1, 2])
def test_progress_is_told_after_each_contact(threads):
    exact, seen = scan(), []
    with exact.progress(lambda solved, needed: seen.append((solved, needed))):
        friction(exact, threads=threads)
    solved, needed = np.array(seen).T
    assert (np.diff(solved) >= 0).all()
    assert (np.diff(needed) >= 0).all()
    assert (solved <= needed).all()
    assert solved[-1] == needed[-1] == len(exact.contacts) > 10
    assert threads > 1 or np.diff(solved).max() == 1
    count = len(seen)
    with exact.progress(lambda solved, needed: seen.append((solved, needed))):
        friction(exact)  # all is there
        friction(scan())  # another scan
    friction(exact, pressure=1e5)  # behind the block
    assert len(seen) == count


def test_progress_of_hot_points_and_of_areas():
    law = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
    heating = tread(conductivity=0.2, contact_diameter=2e-3)
    exact, seen = scan(), []
    with exact.progress(lambda *both: seen.append(both)):
        asperity.contact_area(ROAD, RUBBER, pressure=2e5, velocity=0.1, correction=exact)
        cold = len(exact.contacts)
        friction(exact, velocity=[0.1, 0.2], temperature=293.15, shift=law, heating=heating)
    assert seen[-1] == (len(exact.contacts),) * 2
    assert len(exact.contacts) >= cold + 2


class Enough(Exception):
    pass


@pytest.fixture
def interruptible():
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # nohup starts without one
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("how", ["Ctrl-C", "an exception"])
def test_what_was_solved_is_kept_where_a_call_ends(how):
    exact = scan()

    def tell(solved, needed):
        if solved >= 5 and how == "Ctrl-C":
            signal.raise_signal(signal.SIGINT)
        elif solved >= 5:
            raise Enough

    with pytest.raises(KeyboardInterrupt if how == "Ctrl-C" else Enough), exact.progress(tell):
        friction(exact)
    kept = exact.contacts.rows.copy()
    assert 5 <= len(kept) < len(wholly_solved().contacts)
    again = friction(exact).mu
    assert again.tolist() == friction(wholly_solved()).mu.tolist()
    rows = {row[:_OF_CONTACT].tobytes() for row in exact.contacts.rows}
    assert all(row[:_OF_CONTACT].tobytes() in rows for row in kept)  # and not solved anew


_whole: list[asperity.ScanContact] = []


def wholly_solved():
    if not _whole:
        _whole.append(scan())
        friction(_whole[0])
    return _whole[0]


def test_a_scan_that_is_short_for_its_longest_wave_says_how_many_it_holds():
    half = asperity.HeightMap(SCAN.heights[:, :32].copy(), pixel_size=SCAN.pixel_size)
    result = asperity.friction(
        ROAD, RUBBER, pressure=2e5, velocity=0.1, correction=asperity.ScanContact(half)
    )
    (note,) = (str(one) for one in result.notes if "longest waves" in str(one))
    assert note.startswith("the scan holds 2 of its longest waves to a side, where 4 or more")
    tiny = asperity.HeightMap(SCAN.heights[:9, :9].copy(), pixel_size=SCAN.pixel_size)
    with pytest.raises(asperity.InvalidInput) as caught:
        asperity.friction(
            ROAD, RUBBER, pressure=2e5, velocity=0.1, correction=asperity.ScanContact(tiny)
        )
    assert "\n" not in str(caught.value)


def test_a_rubber_that_ends_within_the_band_is_refused_in_one_line():
    known = np.geomspace(1e3, 2e3, 12)  # a third of a decade: the band has 0.6
    modulus = RUBBER.modulus(known)
    curve = curve_of(known, modulus)
    exact = scan()
    for velocity in (0.1, 1.0, 1e3):
        with pytest.raises(asperity.OutOfRange) as caught:
            asperity.friction(ROAD, curve, pressure=2e5, velocity=velocity, correction=exact)
        assert "\n" not in str(caught.value)
        assert "1000" in str(caught.value)
    assert len(exact.contacts) == 0
