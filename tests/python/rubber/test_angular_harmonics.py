"""Harmonics of the rubber on a circle of wavevectors against their definition."""

import numpy as np
import pytest

from asperity import InvalidInput, MasterCurve, OutOfRange, PronySeries
from helpers.awkward_moduli import TABLES
from helpers.by_definition import NODES, WEIGHTS, Definition, z_of
from helpers.rubbers import prony

SERIES = prony(1e6, [1e6, 1e7, 3e8, 5e8], [1e-1, 1e-4, 1e-7, 1e-9])

EVEN = TABLES["30 decades"]


def of_series(w, count):
    z, step = np.linspace(0, 45, 4501, retstep=True)
    weight = 4 * step * np.where((z == 0) | (z == 45), 0.5, 1) / np.cosh(z)
    return sums(SERIES.modulus(np.maximum(w / np.cosh(z), 1e-300)), weight, z, count)


def sums(modulus, weight, z, count):
    cosine, m, phi = 1 / np.cosh(z), np.arange(count + 1)[:, None], np.arctan(np.sinh(z))
    square = (np.cos(2 * m * phi) * np.abs(modulus) ** 2) @ weight
    along = (np.cos(2 * m * phi) * cosine * modulus.imag) @ weight
    across = (np.sin(2 * m * phi) * np.tanh(z) * modulus.imag) @ weight
    return along, across, square


def of_table(definition, w, count):
    """As `Definition` of I1 and I2, on panels short enough for cos(2 count phi)."""
    below = definition.edges[:-1] < w
    far = z_of(w, definition.edges[:-1][below])[:, None]
    near = z_of(w, np.minimum(definition.edges[1:][below], w))[:, None]
    parts = np.arange(24) / 24
    low = (near + (far - near) * parts)[..., None]
    half = ((far - near) / 48)[..., None]
    z = low + half * (1 + NODES)
    interval = definition.interval[below][:, None, None]
    storage, loss = np.exp(definition.logarithms(interval, w / np.cosh(z)))
    weight = 4 * half * WEIGHTS / np.cosh(z)
    return sums((storage + 1j * loss).ravel(), weight.ravel(), z.ravel(), count) + of_tail(
        definition, w, count
    )


def of_tail(definition, w, count):
    lowest = definition.edges[0]
    storage, loss = np.exp(definition.logarithms(0, lowest))
    half = np.arctan2(lowest, np.sqrt((w - lowest) * (w + lowest))) / 48
    psi = (half * (2 * np.arange(24)[:, None] + 1 + NODES)).ravel()
    weight = 4 * half * np.tile(WEIGHTS, 24)
    modulus = storage + 1j * loss * w * np.sin(psi) / lowest
    m = np.arange(count + 1)[:, None]
    phi = np.pi / 2 - psi
    return np.array(
        [
            (np.cos(2 * m * phi) * np.sin(psi) * modulus.imag) @ weight,
            (np.sin(2 * m * phi) * np.cos(psi) * modulus.imag) @ weight,
            (np.cos(2 * m * phi) * np.abs(modulus) ** 2) @ weight,
        ]
    )


@pytest.mark.parametrize("w", [1e-3, 0.3, 10.0, 1e4, 3e7, 1e11])
def test_harmonics_of_a_series_are_those_of_the_definition(w):
    compare(SERIES.angular_harmonics(w, 40), of_series(w, 40), 1e-13)


def compare(result, expected, tolerance):
    """Relative to I1, I1 and I2."""
    for values, truth, scale in zip(
        result, expected, np.array(expected)[[0, 0, 2], 0], strict=True
    ):
        np.testing.assert_allclose(values, truth, rtol=0, atol=tolerance * scale)


@pytest.mark.parametrize("name", ["two rows, 30 decades", "50 rows", "kinks", "step"])
def test_harmonics_of_a_table_are_those_of_the_definition(name):
    w, storage, loss = TABLES[name]
    curve = MasterCurve(angular_frequency=w, storage_modulus=storage, loss_modulus=loss)
    definition = Definition(w, storage, loss)
    at = np.exp(np.random.default_rng(7).uniform(np.log(w[0]), np.log(w[-1]), 2))
    at = np.concatenate([at, w[:2], w[:1] * (1 + 1e-6), w[-1:]])
    result = curve.angular_harmonics(at, 30)
    for n, one in enumerate(at):
        # measured: 3e-9 where rows nearly meet, 5e-10 elsewhere
        compare([values[n] for values in result], of_table(definition, one, 30), 5e-9)


def test_zeroth_harmonics_are_the_angular_integrals_and_more_change_none():
    w = np.geomspace(1e-2, 1e9, 37).reshape(37, 1)
    table = dict(zip(("angular_frequency", "storage_modulus", "loss_modulus"), EVEN, strict=True))
    for rubber in (SERIES, MasterCurve(**table)):
        along, across, square = rubber.angular_harmonics(w, 3)
        assert along.shape == (37, 1, 4)
        i1, i2 = rubber.angular_integrals(w)
        np.testing.assert_array_equal(along[..., 0], i1)
        np.testing.assert_array_equal(square[..., 0], i2)
        assert np.all(across[..., 0] == 0)
        for few, many in zip((along, across, square), rubber.angular_harmonics(w, 20), strict=True):
            np.testing.assert_array_equal(few, many[..., :4])


def test_a_loss_that_is_proportional_to_frequency_has_one_harmonic():
    rubber = PronySeries(equilibrium_modulus=1e6, moduli=[1e6], relaxation_times=[1e-9])
    along, across, _ = rubber.angular_harmonics(1e-2, 4)
    i1 = rubber.angular_integrals(1e-2)[0]
    np.testing.assert_allclose(along / i1, [1, 0.5, 0, 0, 0], atol=1e-15)
    np.testing.assert_allclose(across / i1, [0, 0.5, 0, 0, 0], atol=1e-15)


def test_frequencies_and_counts_out_of_range_are_refused():
    curve = MasterCurve(
        angular_frequency=[1, 10], storage_modulus=[1e6, 2e6], loss_modulus=[1e5, 2e5]
    )
    with pytest.raises(OutOfRange, match="angular_frequency"):
        curve.angular_harmonics(11, 1)
    with pytest.raises(InvalidInput, match="count"):
        SERIES.angular_harmonics(1.0, -1)
