"""Messages and notes as the page says them: no names of Python, few digits."""

import re

_LONG = re.compile(r"(?<![\w.])\d+\.\d{5,}(?:e[+-]?\d+)?")
_SAID = (
    (r"[:,] see (?:its flag|the flag)", ": grey in the picture of the spectrum"),
    (r"[:,;] see (?:extrapolated_share|model_error)", ""),
    (r" is not known where model_error is NaN", " is not known at some points"),
    (r"\bslope_cutoff = (\S+) is not reached", r"the wanted rms slope of \1 is not reached"),
    (r": give macro_wavenumber(_per_m)? or macro_area", ""),
)
_ALLOWED = re.compile(r"velocities from (\S+) to (\S+) m/s are allowed")


def in_words(text: str) -> str:
    """The same for a reader who does not program."""
    for pattern, said in _SAID:
        text = re.sub(pattern, said, text)
    return _LONG.sub(lambda found: f"{float(found[0]):.4g}", text)


def allowed_velocities(problem: str) -> tuple[float, float] | None:
    """Velocities [m/s] that a message offers, both within what it allows."""
    found = _ALLOWED.search(problem)
    if found is None:
        return None
    low, high = (float(one) for one in found.groups())
    return float(f"{1.01 * low:.3g}"), float(f"{0.99 * high:.3g}")
