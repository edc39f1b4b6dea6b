"""A sweep's results as xarray, Zarr and NetCDF know them: names, units, coordinates, attributes."""

import hashlib
import json
import os
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import Error, __version__
from asperity.base.parameters import without_unit
from asperity.base.table import imported
from asperity.io.aside import folder_beside
from asperity.sweep.axes import Axis
from asperity.sweep.chunks import BLOSC, FAILURE
from asperity.sweep.outcome import Tally
from asperity.sweep.plan import MEANINGS, Plan

_FAILURE = {
    "long_name": "why a point has no result: 0, or a code of failure_message",
}
_MESSAGE = {
    "long_name": "what went wrong; where texts differ in their numbers alone, one of them",
}
Coordinate = tuple[str, Any, dict[str, str]]  # dimension, values, attributes


class Described:
    """Names, units and coordinates of a plan's results."""

    def __init__(self, plan: Plan) -> None:
        self.shape = plan.shape
        self.variables = plan.task.variables
        self.inputs = plan.inputs
        self.notes = plan.notes
        self.dimensions = tuple(axis.name for axis in plan.axes)
        self._scene_axes = [self.dimensions[i] for i in plan.task.fixed]
        self.coordinates: dict[str, Coordinate] = {}
        for axis in plan.axes:
            self.coordinates |= _coordinates(axis)
        self._inputs = json.dumps(self.inputs)
        self._sha = hashlib.sha256(self._inputs.encode())

    def tally(self) -> Tally:
        """What the sweep has before anything is computed."""
        return Tally(notes={note: [-1] for note in self.notes})

    def digest_of(self, start: Sequence[int]) -> str:
        """What a box's numbers come from: all inputs, files among them, and where it begins."""
        sha = self._sha.copy()
        sha.update(repr(tuple(start)).encode())
        return sha.hexdigest()

    def attributes(self) -> dict[str, Any]:
        versions = {"numpy": np.__version__, "xarray": imported("xarray", "sweep").__version__}
        return {
            "title": "rubber friction over " + ", ".join(self.dimensions),
            "source": f"asperity {__version__}",
            "versions": json.dumps({"asperity": __version__, **versions}),
            "sweep": self._inputs,
            "scene_axes": json.dumps(self._scene_axes),
        }

    def dataset(self, values: Mapping[str, Any], failure: Any, tally: Tally) -> Any:
        xarray = imported("xarray", "sweep")
        variables = {name: (self.dimensions, one, _said(name)) for name, one in values.items()}
        codes, texts = _messages(tally.messages)
        variables["failure"] = self.dimensions, failure, _FAILURE
        variables["failure_message"] = ("failure_code",), texts, _MESSAGE
        attributes = {**self.attributes(), **tally.attributes(), "complete": 1}
        coordinates = {**self.coordinates, "failure_code": (("failure_code",), codes)}
        return xarray.Dataset(variables, coordinates, attributes)

    def create(self, zarr: Any, path: Path, cut: Sequence[int]) -> None:
        beside = [name for name in self.coordinates if name not in self.dimensions]
        attributes = {**self.attributes(), "cut": list(cut), "complete": 0}
        if beside:
            attributes["coordinates"] = " ".join(beside)
        group = zarr.create_group(str(path), zarr_format=3, attributes=attributes)
        along = {"shape": self.shape, "chunks": tuple(cut), "dimension_names": self.dimensions}
        blosc = imported("zarr.codecs", "sweep").BloscCodec(shuffle="shuffle", **BLOSC)
        kinds: dict[str, Any] = {"dtype": "f8", "fill_value": np.nan}
        for name in self.variables:
            group.create_array(name, attributes=_said(name), compressors=blosc, **kinds, **along)
        kinds = {"dtype": "i8", "fill_value": 0, "attributes": _FAILURE}
        group.create_array(FAILURE, compressors=blosc, **kinds, **along)
        for name, (dimension, values, said) in self.coordinates.items():
            _add(group, name, dimension, values, said)
        group.create_group("_sweep")
        self.add_messages(group, {})
        consolidate(path)

    def add_messages(self, group: Any, messages: Mapping[int, str]) -> None:
        codes, texts = _messages(messages)
        _add(group, "failure_code", "failure_code", codes, {})
        _add(group, "failure_message", "failure_code", texts, _MESSAGE)


def consolidate(path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # on what the format's third version does not have yet
        imported("zarr", "sweep").consolidate_metadata(str(path))


def _add(group: Any, name: str, dimension: str, values: Any, said: Mapping[str, str]) -> None:
    kind = str if values.dtype.kind in "UTO" else values.dtype
    array = group.create_array(
        name,
        shape=values.shape,
        chunks=(max(1, values.size),),
        dtype=kind,
        dimension_names=(dimension,),
        attributes=dict(said),
        overwrite=True,
    )
    if values.size:
        array[:] = values.astype(object) if kind is str else values


def _messages(messages: Mapping[int, str]) -> tuple[Any, Any]:
    codes = sorted(messages)
    return np.array(codes, np.int64), np.array([messages[code] for code in codes], dtype=str)


def _said(name: str) -> dict[str, str]:
    unit, meaning = MEANINGS[name]
    return {"units": unit, "long_name": meaning}


def _coordinates(axis: Axis) -> dict[str, Coordinate]:
    """Coordinates of an axis; one of several keys has the first of them as its index."""
    coordinates = {
        key: _coordinate(axis.name, key, entries) for key, entries in axis.values.items()
    }
    if axis.name in coordinates:
        return coordinates
    first = next(iter(coordinates.values()))
    if len(set(first[1].tolist())) < axis.size:
        first = (axis.name, np.arange(axis.size), {})
    return {axis.name: first, **coordinates}


def _coordinate(dimension: str, key: str, entries: Sequence[Any]) -> Coordinate:
    # a number of a file may be one that knows how it was typed
    if all(isinstance(one, int | float) and not isinstance(one, bool) for one in entries):
        _, unit = without_unit(key)
        return dimension, np.array(entries, float), {"units": unit or "1"}
    return dimension, np.array([label(entry) for entry in entries], dtype=str), {}


def label(entry: Any) -> str:
    """A value of an axis that is no number, as text; files with a plus between them."""
    if isinstance(entry, str):
        return entry
    if isinstance(entry, list) and entry and all(isinstance(one, str) for one in entry):
        return "+".join(entry)
    return "none" if entry is None else json.dumps(entry)


def write_netcdf(path: Path, store: Path) -> None:
    """Write a Zarr store as NetCDF, chunk by chunk, and put it in its place when it is whole."""
    imported("netCDF4", "sweep")
    here = imported("dask", "sweep").config.set(scheduler="synchronous")  # whatever computed
    try:
        with folder_beside(path) as folder, here:
            part = folder / "store.nc"
            part.touch()  # with the permissions that a file has here
            with imported("xarray", "sweep").open_dataset(store, engine="zarr", chunks={}) as whole:
                for name, one in whole.variables.items():
                    missing = np.nan if name in whole.data_vars and one.dtype.kind == "f" else None
                    one.encoding = {"chunksizes": one.encoding["chunks"], "_FillValue": missing}
                whole.to_netcdf(part, engine="netcdf4")
            os.replace(part, path)
    except (OSError, RuntimeError) as error:  # the latter is NetCDF's, which knows no reasons
        reason = getattr(error, "strerror", None) or f"{error}: is the disk full?"
        raise Error(f"{path}: cannot be written: {reason}; --resume goes on") from error
