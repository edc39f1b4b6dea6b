"""Elastic contacts by tamaas, a program of others: what ours are held against."""

import math
from typing import NamedTuple

import numpy as np
import pytest

import asperity


class Elastic(NamedTuple):
    """A contact at E* = 1: shares of the points, mean gap and energy over A0 [m]."""

    area_raw: float
    area: float
    mean_gap: float
    energy: float


def pressed(surface: asperity.HeightMap, pressure: float, tolerance: float = 1e-8) -> Elastic:
    """Polonsky and Keer's conjugate gradients on a periodic map, the pressure in units of E*."""
    tamaas = pytest.importorskip("tamaas")
    tamaas.set_log_level(tamaas.LogLevel.error)
    (ny, nx), (dy, dx) = surface.heights.shape, surface.pixel_size
    model = tamaas.ModelFactory.createModel(
        tamaas.model_type.basic_2d, [ny * dy / dx, float(nx)], [ny, nx]
    )
    model.E, model.nu = 1.0, 0.0
    # lengths along the surface are in dx, and pressures and heights in units that make them near 1
    slope = surface.rms_slope
    scaled = surface.heights / (slope * dx)
    solver = tamaas.PolonskyKeerRey(model, scaled, tolerance)
    solver.max_iter = 20_000
    assert solver.solve(pressure / slope) <= tolerance
    traction, moved = np.asarray(model.traction), np.asarray(model.displacement)
    touching = traction > 0
    edges = sum(np.count_nonzero(touching != np.roll(touching, 1, axis)) for axis in range(2))
    excess = (math.pi - 1 + math.log(2)) / 24 * edges / touching.size
    gap = float(np.where(touching, 0.0, moved - scaled).mean()) * slope * dx
    energy = float((traction * (moved - moved.mean())).mean()) / 2 * slope**2 * dx
    raw = float(touching.mean())
    return Elastic(raw, raw - excess, gap, energy)
