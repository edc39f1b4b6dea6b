"""What the contact of a scan carries into a band on mu."""

from typing import Any

import numpy as np

from asperity.base.arguments import Array
from asperity.results.friction import Friction
from asperity.scan_contact import ScanContact
from asperity.spectrum import Spectrum, TabulatedSpectrum
from asperity.uncertainty.draws import Drawn, Generator

_ROWS_PER_DECADE = 16  # of a spectrum that goes on beyond the scan


def beyond_scan(spectrum: Drawn[Spectrum], scan: ScanContact) -> Drawn[Spectrum]:
    """The spectrum, drawn beyond the waves that the scan knows alone: of the others the scan's
    quarters tell how mu scatters, spectrum and all."""
    ny, nx = scan.height_map.heights.shape
    dy, dx = scan.height_map.pixel_size
    low, high = 2 * np.pi / max(ny * dy, nx * dx), np.pi / max(dy, dx)
    plain, draw = spectrum.plain, spectrum.draw
    if draw is None or (plain.q0 >= low * (1 - 1e-9) and plain.q1 <= high * (1 + 1e-9)):
        return Drawn[Spectrum](plain, None, spectrum.whole)

    def drawn(rng: Generator) -> Spectrum:
        one = draw(rng)
        harmonics: dict[str, Any] = {}
        if isinstance(plain, TabulatedSpectrum):
            q = plain.wavenumber
            harmonics = {"cosine": plain.cosine, "sine": plain.sine}
        else:
            rows = 2 + int(_ROWS_PER_DECADE * np.log10(plain.q1 / plain.q0))
            q = np.geomspace(plain.q0, plain.q1, rows)
        known = (q >= low) & (q <= high)
        density = np.where(known, plain.at(q), one.at(q))
        return TabulatedSpectrum(wavenumber=q, density=density, q1=plain.q1, **harmonics)

    return Drawn[Spectrum](plain, drawn, spectrum.whole)


class HeldScan:
    """mu of draws with a ScanContact: PartialContact's, times the ratio of exact contact to it of
    the inputs as they are, and times what another scan of the surface may have."""

    def __init__(self, exact: Friction, rule: Friction, samples: int, rng: Generator) -> None:
        self._ratio = tuple(
            np.divide(of_scan, of_rule, out=np.ones_like(of_scan), where=of_rule > 0)
            for of_scan, of_rule in (
                (exact.hysteresis, rule.hysteresis),
                (exact.contact_area, rule.contact_area),
            )
        )
        self._error = exact.model_error
        self._scatter = iter(rng.permutation(_scatter(samples)))

    def draw(self) -> float:
        """How another scan differs, in its standard errors."""
        return float(next(self._scatter))

    def mu(self, rule: Friction, scatter: float) -> Array:
        of_hysteresis, of_area = self._ratio
        mu: Array = of_hysteresis * rule.hysteresis + of_area * rule.adhesion
        mu *= np.exp(scatter * self._error)
        return mu


def _scatter(samples: int) -> Array:
    """Quantiles of Student's t of three degrees of freedom: four quarters tell the error."""
    t = np.sinh(np.linspace(-8, 8, 4001))
    share = 0.5 + (t / np.sqrt(3) / (1 + t**2 / 3) + np.arctan(t / np.sqrt(3))) / np.pi
    result: Array = np.interp((np.arange(samples) + 0.5) / samples, share, t)
    return result
