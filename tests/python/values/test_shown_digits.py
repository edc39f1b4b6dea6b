"""Messages on a number out of its range have the fewest digits that tell, six at least."""

import re

import numpy as np
import pytest

import asperity


def message(lowest: float, highest: float, q: float) -> tuple[str, str, str]:
    table = asperity.TabulatedSpectrum(wavenumber=[lowest, highest], density=[1e-20, 1e-24])
    with pytest.raises(asperity.OutOfRange) as error:
        table.at(q)
    found = re.fullmatch(
        r"wavenumber = (\S+): the spectrum is known in \[(\S+), (\S+)\] 1/m", str(error.value)
    )
    assert found is not None, error.value
    return found[1], found[2], found[3]


def digits(text: str) -> int:
    return len(text.partition("e")[0].replace(".", "").strip("0"))


def test_typed_numbers_come_back_as_they_were_typed() -> None:
    assert message(1000, 28000, 28000.5) == ("28000.5", "1000", "28000")
    assert message(1e-3, 1.5, 2) == ("2", "0.001", "1.5")


@pytest.mark.parametrize("seed", range(8))
def test_what_is_outside_looks_outside_and_the_ends_are_inside(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(100):
        lowest = 10 ** rng.uniform(-8, 8)
        highest = lowest * 10 ** rng.choice([rng.uniform(1e-7, 1e-3), rng.uniform(0.1, 9)])
        off = 10 ** rng.uniform(-14, 2)
        below = bool(rng.integers(2))
        q = lowest / (1 + off) if below else highest * (1 + off)
        if lowest <= q <= highest:
            continue
        shown, low, high = message(lowest, highest, q)
        assert lowest <= float(low) <= float(high) <= highest
        assert float(low) == pytest.approx(lowest, rel=2e-5)
        assert float(high) == pytest.approx(highest, rel=2e-5)
        assert (float(shown) < lowest) if below else (float(shown) > highest)
        if digits(shown) > 6:  # none could be left out
            fewer = float(f"{q:.{digits(shown) - 1}g}")
            assert lowest <= fewer <= highest


def test_velocities_that_are_said_to_be_allowed_are() -> None:
    curve = asperity.MasterCurve(
        angular_frequency=[1.23456789, 1e3, 3.3333333e7],
        storage_modulus=[1e6, 1e7, 1e8],
        loss_modulus=[1e5, 2e6, 1e7],
    )
    road = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=1900, q1=28571.4286)
    for v in (1e-5, 1e5):
        with pytest.raises(asperity.OutOfRange) as error:
            asperity.friction(road, curve, pressure=1e5, velocity=v)
        found = re.search(r"velocities from (\S+) to (\S+) m/s are allowed", str(error.value))
        assert found is not None
        for end in found.groups():
            assert asperity.friction(road, curve, pressure=1e5, velocity=float(end)).mu > 0
        assert max(map(digits, re.findall(r"\d[\d.e+]*", str(error.value)))) <= 6
    long = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=1, q1=1e9)
    with pytest.raises(asperity.OutOfRange, match="no velocity asks for less than is known"):
        asperity.friction(long, curve, pressure=1e5, velocity=1)


@pytest.mark.parametrize("off", [1e-7, 3e-12])
def test_a_velocity_just_beyond_what_is_known_looks_beyond_it(off: float) -> None:
    omega = np.geomspace(1e-2, 1e5, 60)
    rubber = asperity.MasterCurve(
        angular_frequency=omega, storage_modulus=1e6 * omega**0.1, loss_modulus=2e5 * omega**0.1
    )
    road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1e5)
    with pytest.raises(asperity.OutOfRange) as error:
        asperity.friction(road, rubber, pressure=1e5, velocity=1 + off)
    said = re.match(r"velocity = (\S+): .* velocities from (\S+) to (\S+) m/s", str(error.value))
    assert said is not None, error.value
    assert float(said[2]) <= float(said[3]) <= 1 < float(said[1])
