"""The scene that ships with the package: rubber on a synthetic asphalt scan."""

import io
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray

from asperity.self_affine_fit import synthesize
from asperity.spectrum import SelfAffineSpectrum

FILES = ("scan.npy", "scene.toml", "hot.toml", "friction.csv", "friction.png")
PIXEL_SIZE = (110e-6, 90e-6)  # dy, dx [m]
SHAPE = (480, 640)


def scan() -> NDArray[np.float32]:
    """Heights [m] of a synthetic asphalt as a profilometer would give them.

    Table 1's asphalt (H 0.87, rms height 265.7 um, q0 2000 1/m), 17 longest waves long and wide,
    tilted, curved, and with 2 % of the points dropped out (NaN). Seeded: always the same.
    """
    asphalt = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000.0, q1=1e6)
    heights = synthesize(asphalt, shape=SHAPE, pixel_size=PIXEL_SIZE, seed=2024).heights
    y, x = (np.arange(n) * d for n, d in zip(SHAPE, PIXEL_SIZE, strict=True))
    trend = 0.01 * x + 0.03 * y[:, None] + (x - x.mean()) ** 2 / 2.0  # radius 1 m
    dropouts = np.random.default_rng(2024).random(SHAPE) < 0.02
    return np.where(dropouts, np.nan, heights + trend).astype(np.float32)


def scene_text() -> str:
    return _shipped("scene.toml")


def hot_scene_text() -> str:
    return f"{scene_text()}\n{_shipped('heating.toml')}"


def _shipped(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def input_files() -> dict[str, bytes]:
    out = io.BytesIO()
    np.save(out, scan())
    scenes = {"scene.toml": scene_text(), "hot.toml": hot_scene_text()}
    return {"scan.npy": out.getvalue(), **{name: one.encode() for name, one in scenes.items()}}
