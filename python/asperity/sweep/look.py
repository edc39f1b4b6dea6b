"""What a store says: parts of it that are chosen, and ranks with the certainty that they have."""

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.base.diagnostics import Argument, InvalidInput, Note, must_have, refusal, valued
from asperity.base.table import imported
from asperity.io.fields import nearest

_ERRORS = ("error_estimate", "mu_low", "mu_high", "model_error", "hysteresis")
_SCENE = "_scene"
_AGREE = 1e-6  # relative, of a number that was typed and a coordinate


def choose(dataset: Any, at: Mapping[str, str]) -> Any:
    """The dataset where coordinates have the values that were typed."""
    for name, text in at.items():
        if name not in dataset.sizes:
            known = dict.fromkeys(map(str, dataset["failure"].dims))
            raise InvalidInput(Argument(f"--at {name}"), f": is no axis, {nearest(name, known)}")
        dataset = dataset.isel({name: _index(dataset[name].values, name, text)})
    return dataset


def _index(values: NDArray[Any], name: str, text: str) -> int:
    if values.dtype.kind in "fiu":
        try:
            wanted = float(text)
        except ValueError:
            raise refusal(f"--at {name}", text, "a number", text=text) from None
        index = int(np.abs(values - wanted).argmin())
        if abs(values[index] - wanted) <= _AGREE * abs(wanted):
            return index
        known = {f"{one:g}": None for one in values}
    else:
        known = {str(one): None for one in values}
        if text in known:
            return list(known).index(text)
    shown = list(known)
    allowed = ", ".join(shown if len(shown) <= 12 else [*shown[:6], "...", *shown[-5:]])
    about = Argument(f"--at {name}"), " = ", valued(text, text)
    raise InvalidInput(*about, f": is not on the axis, which has {allowed}")


def with_scenes(dataset: Any) -> Any:
    """The dataset with the number of the scene of each point, by which notes know theirs."""
    names = json.loads(dataset.attrs["scene_axes"])
    sizes = [dataset.sizes[name] for name in names]
    return dataset.assign({_SCENE: (names, np.arange(math.prod(sizes)).reshape(sizes))})


def notes_of(dataset: Any) -> list[Note]:
    """The notes of a sweep, or of what was chosen of one `with_scenes`."""
    columns = (str(dataset.attrs[f"note{name}"]) for name in ("_scenes", "_labels", "s", "_steps"))
    rows = zip(*(column.split("\n") for column in columns), strict=True)
    here = np.unique(dataset[_SCENE]) if _SCENE in dataset else None
    return [Note.of_label(*row) for runs, *row in rows if row[0] and _in_runs(runs, here)]


def _in_runs(runs: str, scenes: NDArray[np.int64] | None) -> bool:
    """Whether one of the rising numbers is in a run; -1 stands for all of them."""
    if scenes is None or runs.startswith("-1"):
        return True
    ends = np.array([[int(end) for end in run.split(":")] for run in runs.split()])
    return bool((np.diff(np.searchsorted(scenes, ends + np.array([0, 1]))) > 0).any())


def ranks(dataset: Any, axis: str) -> dict[str, list[Any]]:
    """The values of an axis by their mean friction, as columns of a table.

    Only points at which every value has a result are compared. `best_share` is how often a value
    has the highest mu, `certain_share` how often its lead over the next exceeds the sum of the
    errors of the two: of each the numerical error, the model error of the hysteresis, and half of
    the band where the store has one. `best_at` tells where along each other axis it is best more
    often than not.
    """
    if axis not in dataset.sizes:
        axes = dict.fromkeys(map(str, dataset["failure"].dims))
        raise InvalidInput(Argument(f"--rank {axis}"), f": is no axis, {nearest(axis, axes)}")
    for name in ("mu", "error_estimate"):
        if name not in dataset:
            raise InvalidInput(
                Argument(f"--rank {axis}"), f": the store has no {name}: it was not kept"
            )
    count = dataset.sizes[axis]
    if count < 2:
        raise must_have(f"--rank {axis}", "two or more", ": has one value")
    result = _counts(dataset, axis)
    points, known = int(result["points"]), int(result["known"])
    if points == 0:
        problem = ": there is no point at which every value has a result"
        raise InvalidInput(Argument(f"--rank {axis}"), problem)
    best, certain = result["best"].values, result["certain"].values
    mean = result["total"].values / points
    by_mean = np.argsort(-mean, kind="stable")
    labels = [str(one) for one in dataset[axis].values]
    next_one = [*(mean[by_mean[:-1]] - mean[by_mean[1:]]), math.nan]
    return {
        "rank": [*range(1, count + 1)],
        axis: [labels[i] for i in by_mean],
        "mean_mu": [float(mean[i]) for i in by_mean],
        "lead": [float(one) for one in next_one],
        "best_share": [float(best[i] / points) for i in by_mean],
        "certain_share": [float(certain[i] / known) if known else math.nan for i in by_mean],
        "best_at": [_places(dataset, result, {axis: i}) for i in by_mean],
    }


def _counts(dataset: Any, axis: str) -> Any:
    """Sums over the points at which every value of an axis has a result, by name; over all of the
    other axes, and over all but one.

    The store is read chunk by chunk, as it need not fit in memory.
    """
    names = [name for name in ("mu", *_ERRORS) if name in dataset]
    chunks = dataset[names].reset_coords(drop=True).chunk("auto")
    places = imported("xarray", "sweep").DataArray(np.arange(dataset.sizes[axis]), dims=axis)
    mu = chunks["mu"]
    sound = mu.notnull().all(axis)
    mu = mu.where(sound, 0.0)
    first = sound & (mu.argmax(axis) == places)
    rest = mu.where(~first, -np.inf)
    leading = first | sound & (rest.argmax(axis) == places)
    both = _error(chunks).where(leading, 0.0).sum(axis, skipna=False)
    sure = first & (mu.max(axis) - rest.max(axis) > both)  # else they overlap, or are not known

    def over(of: Any, *kept: str) -> Any:
        return of.sum([name for name in of.dims if name not in kept])

    sums = {"points": over(sound), "known": over(sound & both.notnull())}
    sums |= {"total": over(mu, axis), "best": over(first, axis), "certain": over(sure, axis)}
    sums["best at"] = {name: over(first, axis, name) for name in sound.dims}
    sums["points at"] = {name: over(sound, name) for name in sound.dims}
    (result,) = imported("dask", "sweep").compute(sums)
    return result


def _error(chunks: Any) -> Any:
    """How far mu may be from what it stands for, all errors added; NaN where one is unknown."""
    error = chunks["error_estimate"]
    if "mu_low" in chunks and "mu_high" in chunks:
        error = error + (chunks["mu_high"] - chunks["mu_low"]) / 2
    if "model_error" not in chunks or "hysteresis" not in chunks:
        return error * np.nan
    return error + chunks["model_error"] * chunks["hysteresis"]


def _places(dataset: Any, counts: Any, value: Mapping[str, int]) -> str:
    """Where along other axes a value is best more often than not, of those where that is not
    everywhere."""
    parts = []
    for name, points in counts["points at"].items():
        often = (2 * counts["best at"][name].isel(value) > points).values
        if often.any() and not often[points > 0].all():
            parts.append(_named(name, dataset[name].values, often))
    return "; ".join(parts)


def _named(name: str, values: NDArray[Any], often: NDArray[np.bool_]) -> str:
    short = name.rpartition(".")[2]
    if values.dtype.kind not in "fiu":
        return f"{short} {' '.join(str(one) for one in values[often])}"
    edges = np.flatnonzero(np.diff(np.concatenate([[0], often.astype(int), [0]])))
    runs = zip(edges[::2], edges[1::2], strict=True)
    return f"{short} " + ", ".join(
        f"{values[a]:.3g}" if b - a == 1 else f"{values[a]:.3g} to {values[b - 1]:.3g}"
        for a, b in runs
    )
