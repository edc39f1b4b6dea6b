"""What may stand as a spectrum, as a rubber and as a correction."""

from asperity._core import (
    AffineShift,
    GreenwoodWilliamson,
    LocalPeaks,
    MasterCurve,
    NayakSFactor,
    PeaksThenGreenwoodWilliamson,
    PronySeries,
    SelfAffineSpectrum,
    SFactor,
    TabulatedSpectrum,
)

Spectrum = SelfAffineSpectrum | TabulatedSpectrum
Rubber = PronySeries | MasterCurve
Correction = (
    SFactor
    | NayakSFactor
    | AffineShift
    | LocalPeaks
    | GreenwoodWilliamson
    | PeaksThenGreenwoodWilliamson
)
