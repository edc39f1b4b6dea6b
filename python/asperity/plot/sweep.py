"""Small multiples of a sweep: panels over two axes, curves of a third (matplotlib)."""

from pathlib import Path
from typing import Any

import numpy as np

from asperity.base.diagnostics import Argument, InvalidInput, must_be
from asperity.base.parameters import without_unit
from asperity.draw.figure import (
    COLUMN,
    MOST_ENTRIES,
    PRESSURE,
    VELOCITY,
    legend_outside,
    picture,
    pressure_text,
    shaded,
    tell_fatal_notes,
)
from asperity.draw.style import Axes, Figure, colours, grey, narrow

_MOST_PANELS = 8  # along either axis
_TITLES = {"conditions.velocity_m_s": VELOCITY, "conditions.pressure_pa": PRESSURE}
_OF_TABLE = ("kind", "file")  # what there is one of in a table
_WIDE, _LONG = 3.0, 2.5  # inches of a panel


def sweep_figure(dataset: Any, path: Path, name: str = "mu") -> bytes:
    """A variable over velocity, or over the last axis of numbers. Of the axes that are left the
    last has a colour a value, that before it panels in a row, the first rows under one another."""
    dataset, fixed = _squeezed(dataset, name)
    x, lines, columns, rows = _roles(dataset, name)
    across, down = (1 if axis is None else dataset.sizes[axis] for axis in (columns, rows))
    figure, panels = _grid(across, down)
    count = 1 if lines is None else dataset.sizes[lines]
    tints: Any = colours(count)
    if count > MOST_ENTRIES:
        values, title = dataset[lines].values, _title(dataset, lines)
        tints = shaded(panels, values, title, linear=not _over_decades(values))
    elif lines is not None:
        _tell_colours(figure, dataset[lines], tints, _title(dataset, lines))
    with_band = name == "mu" and {"mu_low", "mu_high"} <= {*dataset} and count <= MOST_ENTRIES
    if with_band and np.isfinite(dataset["mu_low"]).any():
        fixed.append("shaded: the errors of the inputs")
    for row in range(down):
        for column in range(across):
            axes = panels[row * across + column]
            places = {rows: row, columns: column}
            at = {axis: i for axis, i in places.items() if axis is not None}
            for i in range(count):
                curve = dataset.isel({**at, **({} if lines is None else {lines: i})})
                axes.plot(curve[x], curve[name], color=tints[i], linewidth=1.3)
                if with_band:
                    how = {"color": tints[i], "alpha": 0.2, "linewidth": 0}
                    axes.fill_between(curve[x], curve["mu_low"], curve["mu_high"], **how)
            _dress(axes, dataset, x, [(axis, at[axis]) for axis in (rows, columns) if axis in at])
            if not np.isfinite(dataset.isel(at)[name]).any():
                axes.text(0.5, 0.5, "no result", transform=axes.transAxes, ha="center")
    meaning = dataset[name].attrs.get("long_name", name)
    label = f"{meaning[0].upper()}{meaning[1:]} [{_unit(dataset[name].attrs)}]"
    figure.supylabel(label, fontsize="medium")
    if np.nanmin(dataset[name].values, initial=np.inf) >= 0:
        panels[0].set_ylim(bottom=0)  # which all share
    for axes in panels[-1 if narrow() else -across :]:
        axes.set_xlabel(_title(dataset, x))
    if fixed:
        figure.suptitle(", ".join(fixed), fontsize="medium")
    return picture(figure, path)


def _squeezed(dataset: Any, name: str) -> tuple[Any, list[str]]:
    """The dataset without axes of one value, and what these were."""
    if name not in dataset:
        raise InvalidInput(Argument(name), ": the store does not have it: it was not kept")
    left = set(dataset[name].dims)
    for axis in list(left):
        if dataset.sizes[axis] == 1:
            dataset = dataset.isel({axis: 0})
    scalars = [one for one in dataset.coords if not dataset[one].dims]
    return dataset, [_value(dataset[one]) for one in scalars]


def _roles(dataset: Any, name: str) -> list[Any]:
    """The axes of x, colours, columns and rows; None where there are not so many."""
    left = [str(axis) for axis in dataset[name].dims]
    numbers = [axis for axis in left if dataset[axis].dtype.kind in "fiu"]
    if not numbers:
        problem = ": there is no axis of numbers with two values or more to draw over"
        raise InvalidInput(Argument("--plot"), problem)
    x = "conditions.velocity_m_s" if "conditions.velocity_m_s" in numbers else numbers[-1]
    left.remove(x)
    if len(left) > 3:
        names = ", ".join(left)
        raise must_be("--plot", f"at most 3 beside {x}: fix the others by --at", f": {names}")
    lines = left.pop() if left else None
    panels = left[::-1]
    for axis in panels:
        if dataset.sizes[axis] > _MOST_PANELS:
            problem = f"has {dataset.sizes[axis]} values: must be at most {_MOST_PANELS} for panels"
            raise InvalidInput(Argument("--plot"), f": {axis} {problem}: fix it by --at")
    if lines is not None and dataset.sizes[lines] > MOST_ENTRIES and lines not in numbers:
        problem = f"has {dataset.sizes[lines]} values: must be at most {MOST_ENTRIES} for colours"
        raise InvalidInput(Argument("--plot"), f": {lines} {problem}: fix it by --at")
    return [x, lines, *panels, None, None][:4]


def _grid(across: int, down: int) -> tuple[Figure, list[Axes]]:
    from matplotlib.figure import Figure

    if narrow():
        across, down = 1, across * down
        size = (COLUMN, 0.6 * COLUMN * down + 0.6)
    else:
        size = (max(_WIDE * across, 5.0) + 1.2, max(_LONG * down, 3.4) + 0.5)
    figure = Figure(figsize=size, layout="constrained")
    tell_fatal_notes(figure)
    grid = figure.subplots(down, across, sharex=True, sharey=True, squeeze=False)
    return figure, list(grid.ravel())


def _over_decades(values: Any) -> bool:
    """Whether values are told apart on a logarithmic scale alone."""
    return bool(values.min() > 0 and values.max() / values.min() > 20)


def _dress(axes: Axes, dataset: Any, x: str, panel: list[tuple[str, int]]) -> None:
    if _over_decades(dataset[x].values):
        axes.set_xscale("log")
    axes.set_title(", ".join(_value(dataset[axis][i]) for axis, i in panel), fontsize="small")
    axes.tick_params(labelsize="small")
    axes.grid(color=grey(0.9), linewidth=0.5)


def _tell_colours(figure: Figure, lines: Any, tints: Any, title: str) -> None:
    from matplotlib.lines import Line2D

    handles = [Line2D([], [], color=tint) for tint in tints]
    pascal = _in_pascal(lines)
    names = [pressure_text(float(one)) if pascal else _text(one) for one in lines.values]
    title = _short(lines.name) if pascal else title
    legend_outside(figure, handles, names, title=title, title_fontsize="small")


def _title(dataset: Any, axis: str) -> str:
    if axis in _TITLES:
        return _TITLES[axis]
    unit = _unit(dataset[axis].attrs) if dataset[axis].dtype.kind in "fiu" else ""
    return _short(axis) + (f" [{unit}]" if unit else "")


def _unit(attributes: Any) -> str:
    unit = attributes.get("units", "")
    return {"1": "-", "degC": "\N{DEGREE SIGN}C"}.get(unit, str(unit))


def _short(axis: object) -> str:
    """The name of an axis as a picture has room for it: the key without table and unit, or the
    table where the key tells nothing."""
    table, _, key = str(axis).rpartition(".")
    return table if key in _OF_TABLE else without_unit(key)[0].replace("_", " ")


def _value(coordinate: Any) -> str:
    """One value of an axis, with its name and unit."""
    if _in_pascal(coordinate):
        return f"{_short(coordinate.name)} {pressure_text(float(coordinate.values))}"
    unit = _unit(coordinate.attrs) if coordinate.dtype.kind in "fiu" else "-"
    return f"{_short(coordinate.name)} {_text(coordinate.values)}" + f" {unit}" * (unit != "-")


def _in_pascal(coordinate: Any) -> bool:
    return coordinate.dtype.kind in "fiu" and _unit(coordinate.attrs) == "Pa"


def _text(value: Any) -> str:
    """A coordinate as a picture has room for it; of files their names."""
    if np.asarray(value).dtype.kind in "fiu":
        return f"{float(value):.4g}"
    return "+".join(one.rpartition("/")[2] for one in str(value).split("+"))
