"""Numbers and names as a page shows them."""

from pathlib import Path

import numpy as np


def number_text(value: float) -> str:
    """Four digits, without an exponent where a reader does not need one."""
    if np.isnan(value):
        return "not known"
    if 1e4 <= abs(value) < 1e6:
        return np.format_float_positional(value, 4, fractional=False, trim="-")
    return f"{value:.4g}"


def percent_text(percent: float, sign: str = "") -> str:
    """Two digits, or whole percents where those are more; `sign` "+" shows one."""
    digits = f"{sign}.0f" if abs(percent) >= 99.5 else f"{sign}.2g"
    return f"{percent:{digits}} %"


def printable(path: Path) -> str:
    """A file's name as text: what is none is written out."""
    return f"{path}".encode(errors="backslashreplace").decode()
