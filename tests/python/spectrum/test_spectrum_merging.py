"""Logarithmic bins and spectra of several scans made into one."""

import numpy as np
import pytest

from asperity import (
    HeightMap,
    InvalidInput,
    LineSpectrum,
    SelfAffineSpectrum,
    TabulatedSpectrum,
    merge_spectra,
    power_spectrum,
    synthesize,
)


def power_law(hurst, rows, counted, kind=TabulatedSpectrum):
    k = np.arange(1, rows + 1)
    count = {"count": np.round(2 * np.pi * k)} if counted else {}
    return kind(wavenumber=1e3 * k, density=(1e3 * k) ** (-2 * hurst - 2), **count)


@pytest.mark.parametrize("per_decade", [3, 10, 30])
@pytest.mark.parametrize("counted", [False, True])
@pytest.mark.parametrize("hurst", [0.1, 0.5, 1.0])
def test_bins_of_a_power_law_lie_on_it(hurst, counted, per_decade):
    for kind in (TabulatedSpectrum, LineSpectrum):
        spectrum = power_law(hurst, 1000, counted, kind)
        binned = spectrum.log_binned(per_decade=per_decade)
        expected = binned.wavenumber ** (-2 * hurst - 2)
        np.testing.assert_allclose(binned.density, expected, rtol=1e-6)


@pytest.mark.parametrize("per_decade", [1, 3, 10, 30, 100])
def test_every_row_is_in_the_bin_of_its_own_decade(per_decade):
    spectrum = power_law(0.8, 700, True)
    binned = spectrum.log_binned(per_decade=per_decade)
    place = np.floor(np.log10(spectrum.wavenumber / 1e3) * per_decade + 1e-9).astype(int)
    count = np.bincount(place, spectrum.count)
    kept = count > 0
    np.testing.assert_array_equal(binned.count, count[kept])
    q = np.bincount(place, spectrum.count * spectrum.wavenumber)[kept] / count[kept]
    np.testing.assert_allclose(binned.wavenumber, q, rtol=1e-13)
    assert np.sum(binned.count) == np.sum(spectrum.count)
    # bins that hold one row leave it alone
    alone = np.bincount(place)[kept] == 1
    np.testing.assert_allclose(
        binned.density[alone], spectrum.density[np.isin(spectrum.wavenumber, q[alone])], rtol=1e-14
    )


def test_flagged_rows_are_left_out_of_bins_that_have_others():
    q = np.array([1.0, 1.1, 1.2, 2.0, 2.1, 4.0, 4.2, 8.0, 8.1])
    density = np.where(np.arange(9) % 2 == 1, 7e-20, 1e-20)
    for flag in (1, 2, 3):
        bad = {"count": np.full(9, 100.0), "standard_error": density / 50}
        flags = [0, flag, 0, 0, flag, flag, flag, 4, 4]
        binned = TabulatedSpectrum(wavenumber=q, density=density, flag=flags, **bad)
        binned = binned.log_binned(per_decade=5)
        np.testing.assert_allclose(binned.wavenumber[:2], [1.1, 2.0], rtol=1e-14)
        np.testing.assert_array_equal(binned.count, [200, 100, 200, 200])
        np.testing.assert_array_equal(binned.flag, [0, 0, flag, 0])  # 4 is cured by averaging
        # rows 1.0 and 1.2 of 1e-20 each, brought to their mean along the slope to the next bin
        slope = np.log(binned.density[1] / binned.density[0]) / np.log(2.0 / 1.1)
        expected = 1e-20 / np.mean((q[[0, 2]] / 1.1) ** slope)
        assert binned.density[0] == pytest.approx(expected, rel=1e-9, abs=0)


def test_the_error_of_a_bin_is_pooled():
    spectrum = TabulatedSpectrum(
        wavenumber=[1.0, 1.02, 3.0, 3.03],
        density=[2e-20, 2e-20, 1e-20, 1e-20],
        count=[10, 30, 5, 5],
        standard_error=[4e-21, 2e-21, 1e-21, 3e-21],
    )
    binned = spectrum.log_binned(per_decade=10)
    expected = [np.hypot(10 * 4e-21, 30 * 2e-21) / 40, np.hypot(1e-21, 3e-21) / 2]
    np.testing.assert_allclose(binned.standard_error, expected, rtol=1e-3)
    # 1e-3: rows are brought along the power law by 1 % of wavenumber first, which nearly cancels


def table(density, count, error, flag=0):
    n = len(density)
    return TabulatedSpectrum(
        wavenumber=1e3 * np.arange(1, n + 1),
        density=density,
        count=np.broadcast_to(count, n),
        standard_error=np.broadcast_to(error, n),
        flag=np.broadcast_to(flag, n),
    )


def test_scans_on_one_grid_are_averaged_row_by_row():
    rng = np.random.default_rng(4)
    density, error = rng.gamma(5, 1e-20, size=(3, 8)), rng.gamma(5, 1e-22, size=(3, 8))
    count = rng.integers(5, 50, size=(3, 8))
    merged = merge_spectra([table(*rows) for rows in zip(density, count, error, strict=True)])
    total = count.sum(axis=0)
    np.testing.assert_array_equal(merged.wavenumber, 1e3 * np.arange(1, 9))
    np.testing.assert_array_equal(merged.count, total)
    np.testing.assert_allclose(merged.density, (count * density).sum(axis=0) / total, rtol=1e-13)
    pooled = np.sqrt(((count * error) ** 2).sum(axis=0)) / total
    np.testing.assert_allclose(merged.standard_error, pooled, rtol=1e-13)


def test_one_spectrum_merged_is_itself():
    spectrum = table([3e-20, 2e-20, 1e-20], 60, 1e-22)
    merged = merge_spectra([spectrum])
    for name in ("wavenumber", "density", "count", "standard_error", "flag"):
        np.testing.assert_allclose(getattr(merged, name), getattr(spectrum, name), rtol=1e-14)


def test_spectra_that_do_not_go_together_are_refused():
    first, longer = table([3e-20, 2e-20], 9, 1e-22), table([3e-20, 2e-20, 1e-20], 9, 1e-22)
    with pytest.raises(InvalidInput, match=r"^spectra: have different wavenumbers"):
        merge_spectra([first, longer])
    assert merge_spectra([first, longer], per_decade=10).wavenumber.size == 3
    bare = TabulatedSpectrum(wavenumber=[1e3, 2e3], density=[1e-20, 1e-20])
    with pytest.raises(InvalidInput, match=r"^spectra: some have counts and some have none"):
        merge_spectra([first, bare])
    assert merge_spectra([bare, bare]).count is None


def test_two_magnifications_of_one_surface_make_one_spectrum():
    pixel, n = 1e-6, 4096
    truth = SelfAffineSpectrum(
        rms_height=1e-5, hurst=0.8, q0=2 * np.pi / (n * pixel), q1=np.pi / pixel
    )
    surface = synthesize(truth, shape=(n, n), pixel_size=pixel, seed=6).heights
    coarse = power_spectrum(HeightMap(surface[::4, ::4], pixel_size=4 * pixel))
    fine = power_spectrum(HeightMap(surface[1000:2024, 700:1724], pixel_size=pixel))
    merged = merge_spectra([coarse, fine], per_decade=10)
    good = merged.reliable
    q, c = merged.wavenumber[good], merged.density[good]
    np.testing.assert_allclose(c, truth.at(q), rtol=0.1)
    # joined: from the coarse scan's window to the fine one's half Nyquist, without a gap
    assert q[0] < 17 * 2 * np.pi / (n * pixel) * 10**0.1
    assert q[-1] > 0.9 * np.pi / pixel / 2 / 10**0.1
    assert np.diff(np.log10(q)).max() < 0.2
    # each alone is worse where it is flagged: the fine one by its window, the coarse one folded
    low, high = fine.wavenumber[2], coarse.wavenumber[coarse.wavenumber < np.pi / 4e-6][-1]
    assert fine.density[2] > 1.3 * truth.at(low)
    assert coarse.density[coarse.wavenumber == high][0] > 1.3 * truth.at(high)
    nearest = np.abs(np.log(merged.wavenumber / high)).argmin()
    assert merged.density[nearest] == pytest.approx(
        truth.at(merged.wavenumber[nearest]), rel=0.1, abs=0
    )


def test_repeated_scans_have_smaller_errors():
    truth = SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=3e4, q1=3e6)
    spectra = [
        power_spectrum(synthesize(truth, shape=(256, 256), pixel_size=1e-6, seed=seed))
        for seed in range(9)
    ]
    merged = merge_spectra(spectra)
    ok = merged.reliable
    single = np.mean([s.standard_error for s in spectra], axis=0)[ok]
    np.testing.assert_allclose(merged.standard_error[ok], single / 3, rtol=0.05)
    np.testing.assert_array_equal(merged.count, 9 * spectra[0].count)
