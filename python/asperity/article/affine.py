"""Section 3 checked: the affine transformation (Eqs 9 to 12)."""

import numpy as np

from asperity.article.inputs import Inputs
from asperity.article.statement import Statement, by_construction, judged
from asperity.article.surfaces import slope_fit
from asperity.measured_spectrum import power_spectrum
from asperity.spectrum import SelfAffineSpectrum


def statements(inputs: Inputs) -> list[Statement]:
    """What Section 3 says of Eqs 9 to 12, on the first sandpaper scan."""
    p, scan = 2.0, inputs.scans[0]
    moved = scan.affine_shift(p)
    mean = float(moved.heights.mean() - scan.heights.mean())
    wanted = scan.z_max * (1 - 1 / p)
    top = float(moved.heights.max() - scan.heights.max())
    before, after = (slope_fit(power_spectrum(s)).hurst for s in (scan, moved))
    variance = (moved.rms_height / scan.rms_height) ** 2
    ratio = power_spectrum(moved).density / power_spectrum(scan).density
    h0 = inputs.asphalt.rms_height
    skewness, kurtosis = moved.skewness - scan.skewness, moved.kurtosis - scan.kurtosis
    printed = printed_eq12(inputs.asphalt)
    return [
        Statement(
            "A1",
            "Eq. 9, Fig. 2",
            "the transformation keeps the highest point and moves the mean to z_max (1 - 1/p_T)",
            "both within 1e-9 of z_max, p_T = 2",
            f"highest point moves by {top * 1e6:.1e} um; mean {mean * 1e6:.3f} um against "
            f"{wanted * 1e6:.3f} um",
            by_construction([abs(top) < 1e-9 * scan.z_max, abs(mean - wanted) < 1e-9 * scan.z_max]),
            "Eq. 9, applied to a synthetic scan",
        ),
        Statement(
            "A2",
            "Sec. 3",
            "fractal dimension and shape of the height distribution do not change",
            "H, skewness and kurtosis within 1e-6",
            f"H {before:.4f} and {after:.4f}; skewness differs by {skewness:.0e}, kurtosis by "
            f"{kurtosis:.0e}",
            by_construction(
                [abs(after - before) < 1e-6, abs(skewness) < 1e-6, abs(kurtosis) < 1e-6]
            ),
            "all heights are scaled alike, small asperities as well as large ones",
        ),
        Statement(
            "A3",
            "Eqs 10-11",
            "mean square height and spectrum are divided by p_T^2",
            "both within 1e-9, p_T = 2",
            f"mean square x {variance:.6g}; spectrum x {ratio.min():.6g} to {ratio.max():.6g}",
            by_construction(
                [abs(variance * p**2 - 1) < 1e-9, bool(np.all(np.abs(ratio * p**2 - 1) < 1e-9))]
            ),
            "the same factor on h",
        ),
        Statement(
            "A4",
            "Eq. 12",
            "Eq. 12 is the spectrum of a surface with the rms height h0",
            "2 pi int q C dq = h0^2 within 1 %",
            f"rms height {printed.rms_height * 1e6:.4g} um for h0 = {h0 * 1e6:g} um: "
            f"{printed.rms_height / h0:.4f} h0",
            judged(abs(printed.rms_height / h0 - 1) < 0.01),
            "printed with H / (2 pi) in place of H / pi; figures here have h_rms as published",
        ),
    ]


def printed_eq12(surface: SelfAffineSpectrum) -> SelfAffineSpectrum:
    """Eq. 12 as printed, with the parameters of a surface."""
    return SelfAffineSpectrum.from_article(
        h0=surface.rms_height, hurst=surface.hurst, q0=surface.q0, q1=surface.q1
    )
