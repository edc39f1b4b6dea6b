"""A scene over which tests sweep, and the plain loop that a sweep is held against."""

import copy
import itertools
import json
from pathlib import Path

import numpy as np

from asperity import PronySeries
from asperity.scene.scene import build_scene

RUBBER = {
    "equilibrium_modulus_pa": 3e6,
    "moduli_pa": [1e9, 1e8, 1e7],
    "relaxation_times_s": [1e-8, 1e-6, 1e-4],
}
SCENE = {
    "surface": {"rms_height_m": 2e-4, "hurst": 0.8, "q0_per_m": 2e3, "q1_per_m": 1e5},
    "rubber": RUBBER,
    "conditions": {"pressure_pa": 1e5, "velocity_m_s": {"from": 1e-6, "to": 1, "points": 7}},
}
COLUMNS = ("mu", "hysteresis", "adhesion", "contact_area", "shift_factor", "error_estimate")
HEATED = SCENE | {
    "rubber": {**RUBBER, "reference_temperature_c": 20, "wlf_c1": 8.86, "wlf_c2_k": 101.6},
    "heating": {
        "density_kg_m3": 1200,
        "heat_capacity_j_kg_k": 1650,
        "conductivity_w_m_k": 0.23,
        "contact_diameter_m": 1e-3,
    },
}


def measured(path, w, factor=1):
    """Write a master curve over these frequencies; return its name."""
    rubber = PronySeries(equilibrium_modulus=3e6, moduli=[1e8], relaxation_times=[1e-4])
    e = factor * rubber.modulus(w)
    lines = [f"{a},{b.real},{b.imag}" for a, b in zip(w, e, strict=True)]
    header = "angular_frequency_rad_s,storage_modulus_pa,loss_modulus_pa"
    path.write_text("\n".join([header, *lines]))
    return str(path)


def _column(result, name):
    if name == "mu_cold":
        return result.cold.mu
    return getattr(result, "temperature" if name == "hot_temperature" else name)


def plain_loop(scene, over, folder=Path(), columns=COLUMNS):
    """Friction of every combination, by a scene of its own each: arrays over `over` and the
    velocities of the scene."""
    axes = [list(zip(*one.values(), strict=True)) for one in over.values()]
    keys = [list(one) for one in over.values()]
    rows = []
    for values in itertools.product(*axes):
        tables = copy.deepcopy(scene)
        for names, entries in zip(keys, values, strict=True):
            for name, entry in zip(names, entries, strict=True):
                table, field = name.split(".")
                tables.setdefault(table, {})[field] = entry
        if tables.get("correction", {}).get("kind") == "none":
            del tables["correction"]
        made = build_scene(folder / "scene", tables, for_friction=True)
        curves = made.friction()
        rows.append([_column(curves, name)[0] for name in columns])
    shape = [len(one) for one in axes]
    found = np.moveaxis(np.array(rows), 1, 0)
    return dict(zip(columns, found.reshape(len(columns), *shape, -1), strict=True))


def toml(tables):
    """A scene as a file has it."""
    lines = []
    for name, table in tables.items():
        lines.append(f"[{name}]")
        for key, value in table.items():
            if isinstance(value, dict):
                inside = ", ".join(f"{k} = {json.dumps(v)}" for k, v in value.items())
                lines.append(f"{key} = {{{inside}}}")
            else:
                lines.append(f"{key} = {json.dumps(value)}")
    return "\n".join(lines)
