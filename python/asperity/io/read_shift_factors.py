"""Shift factors from files."""

import os

import numpy as np

from asperity._core import InvalidInput
from asperity.base import quantities
from asperity.base.arguments import path_of
from asperity.io import plausible
from asperity.io.columns import read_columns
from asperity.shift_factors import ShiftFactors


def read_shift_factors(
    path: str | os.PathLike[str], *, reference_temperature: float
) -> ShiftFactors:
    """Shift factors over temperature [K] from a CSV file with columns temperature_k, log10_a_t.

    Parameters
    ----------
    path : path-like
    reference_temperature : float
        T_ref [K], where a_T = 1.

    Returns
    -------
    ShiftFactors

    Raises
    ------
    InvalidInput
        Naming file and line.
    """
    file = path_of(path, "path")
    names = {"temperature": "temperature_k", "log10_a_T": "log10_a_t"}
    table = read_columns(file, names, {}).values
    plausible.check("temperature_k", table["temperature"], quantities.TEMPERATURE, path=file)
    order = np.argsort(table["temperature"], kind="stable")
    try:
        return ShiftFactors(
            reference_temperature=reference_temperature,
            temperature=table["temperature"][order],
            log10_a_T=table["log10_a_T"][order],
        )
    except InvalidInput as error:
        raise error.within(file) from error
