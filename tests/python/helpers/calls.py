"""Every function, class and method that the package offers, with arguments that work."""

import inspect
from collections.abc import Callable, Iterator
from typing import Any

from helpers.examples import ALL, AT, CALLS, FMAP, FUNCTIONS, SLOW, SWEEPS

# What functions return holds what they computed, and nothing is checked again.
RESULTS = {"Friction", "FrictionBand", "FrictionSlopes", "Gradients", "SceneFit", "Separation"}
METHODS: dict[str, dict[str, Any]] = {  # by name: classes that have the method take the same
    "adhesion": AT,
    "affine_shift": {"p": 2.0},
    "angular_harmonics": {"angular_frequency": 10.0, "count": 2},
    "angular_integrals": {"angular_frequency": 10.0},
    "at": {"wavenumber": 5e3},
    "at_strain": {"strain": 5e-3, "sweeps": SWEEPS, "shift_factors": SLOW.shift_factors},
    "autocorrelation": {"distance": 1e-4},
    "contact_area": AT,
    "cutoff_for_contamination": {"size": 1e-3},
    "cutoff_for_slope": {"slope": 1.0},
    "derivatives": AT,
    "sliding_length": {"velocity": AT["velocity"]},
    "detrend": {"order": "plane"},
    "extended": {},
    "extrapolated_shares": {"angular_frequency": 10.0},
    "fill_dropouts": {"max_fraction": 0.9},
    "fit_arrhenius": {},
    "fit_wlf": {},
    "from_article": {"h0": 1e-4, "hurst": 0.8, "q0": 1e3, "q1": 1e5},
    "from_bytes": {"content": FMAP.to_bytes()},
    "height_histogram": {"bins": 4},
    "hysteresis": AT,
    "isotropic": {},
    "lateral": AT,
    "line_density": {"wavenumber": 5e3},
    "local_peaks": {"min_distance": 1e-3},
    "log10_a_T": {"temperature": 293.0},
    "log10_a_T_slope": {"temperature": 293.0},
    "log_binned": {},
    "modulus": {"angular_frequency": 10.0},
    "mu": AT,
    "mu_at": {"distance": 1e-3},
    "plot": {},
    "progress": {"tell": print},
    "scaled": {"factor": 2.0},
    "shift_factor": {"temperature": 293.0},
    "shifted": {"a_T": 0.5},
    "to_bytes": {},
    "to_dataframe": {},
    "to_xarray": {},
    "toward": {"wavenumber": 5e3, "direction": 0.3},
    "traction": AT,
    "truncated": {},
}
Call = tuple[Callable[..., Any], dict[str, Any] | None]


def public_methods(value: object) -> Iterator[tuple[str, Callable[..., Any]]]:
    """Methods of an object by name, those of its class too."""
    for name, _ in inspect.getmembers(type(value), callable):
        if not name.startswith("_"):
            yield name, getattr(value, name)


def every_call() -> Iterator[tuple[str, Call]]:
    """Names, and what is called with which arguments; None for those that need files."""
    for name, function in FUNCTIONS.items():
        yield name, (function, CALLS.get(name))
    for value in {type(one): one for one in ALL.values()}.values():
        cls = type(value)
        if cls.__name__ not in RESULTS:
            yield cls.__name__, (cls, value._arguments())
        for name, method in public_methods(value):
            files = name in ("load", "save")
            yield f"{cls.__name__}.{name}", (method, None if files else METHODS[name])


EVERY_CALL = dict(every_call())
