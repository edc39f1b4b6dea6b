"""What a store says: parts of it that are chosen, and ranks with the certainty that they have."""

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.base.diagnostics import Argument, Note, must_have, refusal, valued
from asperity.io.fields import nearest

_BLOCK = 1_000_000  # numbers of a variable that are looked at together
_SCENE = "_scene"
_AGREE = 1e-6  # relative, of a number that was typed and a coordinate


def choose(dataset: Any, at: Mapping[str, str], option: str = "--at") -> Any:
    """The dataset where coordinates have the values that were typed."""
    for name, text in at.items():
        if name not in dataset.sizes:
            known = dict.fromkeys(map(str, dataset["failure"].dims))
            raise InvalidInput(
                Argument(f"{option} {name}"), f": is no axis, {nearest(name, known)}"
            )
        dataset = dataset.isel({name: _index(dataset[name].values, name, text, option)})
    return dataset


def _index(values: NDArray[Any], name: str, text: str, option: str) -> int:
    if values.dtype.kind in "fiu":
        try:
            wanted = float(text)
        except ValueError:
            raise refusal(f"{option} {name}", text, "a number", text=text) from None
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
    about = Argument(f"{option} {name}"), " = ", valued(text, text)
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
    others = [str(name) for name in dataset["mu"].dims if name != axis]
    total, known, points = np.zeros(count), 0, 0
    best, certain = np.zeros(count, int), np.zeros(count, int)
    places = {name: np.zeros((count, dataset.sizes[name]), int) for name in others}
    compared = {name: np.zeros(dataset.sizes[name], int) for name in others}
    for block, offset in _blocks(dataset, axis, others):
        mu = _stacked(block, "mu", axis, others)
        error = _errors(block, axis, others)
        sound = np.isfinite(mu).all(axis=0)
        order = np.argsort(-np.where(np.isfinite(mu), mu, -np.inf), axis=0, kind="stable")
        first = order[0]
        best_mu, next_mu = np.take_along_axis(mu, order[:2], axis=0)
        both = np.take_along_axis(error, order[:2], axis=0).sum(axis=0)
        sure = sound & np.isfinite(both) & (best_mu - next_mu > both)  # else they overlap
        points += int(sound.sum())
        known += int((sound & np.isfinite(both)).sum())
        total += np.where(sound, mu, 0.0).reshape(count, -1).sum(axis=1)
        for i in range(count):
            mine = sound & (first == i)
            best[i] += int(mine.sum())
            certain[i] += int((mine & sure).sum())
            for k, name in enumerate(others):
                rest = tuple(j for j in range(len(others)) if j != k)
                where = slice(offset.get(name, 0), offset.get(name, 0) + mine.shape[k])
                places[name][i, where] += mine.sum(axis=rest)
                if i == 0:
                    compared[name][where] += sound.sum(axis=rest)
    if points == 0:
        problem = ": there is no point at which every value has a result"
        raise InvalidInput(Argument(f"--rank {axis}"), problem)
    mean = total / points
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
        "best_at": [
            "; ".join(filter(None, (_where(dataset, n, places[n][i], compared[n]) for n in others)))
            for i in by_mean
        ],
    }


def _blocks(dataset: Any, axis: str, others: list[str]) -> Iterator[tuple[Any, dict[str, int]]]:
    """Parts of a store that fit into memory, and where they begin along the longest axis."""
    if not others:
        yield dataset, {}
        return
    longest = max(others, key=lambda name: int(dataset.sizes[name]))
    size = dataset.sizes[longest]
    across = math.prod(dataset.sizes[name] for name in dataset["mu"].dims) // size
    step = max(1, _BLOCK // max(across, 1))
    for start in range(0, size, step):
        yield dataset.isel({longest: slice(start, start + step)}), {longest: start}


def _stacked(block: Any, name: str, axis: str, others: list[str]) -> NDArray[np.float64]:
    values: NDArray[np.float64] = block[name].transpose(axis, *others).values
    return values


def _errors(block: Any, axis: str, others: list[str]) -> NDArray[np.float64]:
    """How far mu may be from what it stands for, all errors added; NaN where one is unknown."""
    error = _stacked(block, "error_estimate", axis, others)
    if "mu_low" in block and "mu_high" in block:
        high, low = (_stacked(block, name, axis, others) for name in ("mu_high", "mu_low"))
        error = error + (high - low) / 2
    if "model_error" not in block or "hysteresis" not in block:
        return np.full(error.shape, np.nan)
    model, mu = (_stacked(block, name, axis, others) for name in ("model_error", "hysteresis"))
    return np.asarray(error + model * mu)


def _where(dataset: Any, name: str, mine: NDArray[np.int64], all_: NDArray[np.int64]) -> str:
    """Where along an axis a value is best more often than not: nothing where that is everywhere."""
    often = 2 * mine > all_
    if not often.any() or often[all_ > 0].all():
        return ""
    values = dataset[name].values
    short = name.rpartition(".")[2]
    if values.dtype.kind not in "fiu":
        return f"{short} {' '.join(str(one) for one in values[often])}"
    edges = np.flatnonzero(np.diff(np.concatenate([[0], often.astype(int), [0]])))
    runs = zip(edges[::2], edges[1::2], strict=True)
    return f"{short} " + ", ".join(
        f"{values[a]:.3g}" if b - a == 1 else f"{values[a]:.3g} to {values[b - 1]:.3g}"
        for a, b in runs
    )
