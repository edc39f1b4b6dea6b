"""Small files as instruments write them, made here, so that no test waits for measured ones."""

import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import asperity

Heights = NDArray[np.float64]
SHAPES = {"opd": (96, 128), "al3d": (80, 60), "holes": (60, 40), "line": (1200,)}
PIXEL = 2e-7  # m


def rough(shape: tuple[int, ...], seed: int) -> Heights:
    """Heights [m] of a rough map, tilted, or of a row of one."""
    side = max(shape)
    q0 = 2 * np.pi / (side * PIXEL / 8)
    spectrum = asperity.SelfAffineSpectrum(rms_height=5e-8, hurst=0.8, q0=q0, q1=side / 4 * q0 / 8)
    rows = shape[0] if len(shape) == 2 else 8
    made = asperity.synthesize(spectrum, shape=(rows, shape[-1]), pixel_size=PIXEL, seed=seed)
    heights = made.heights + 1e-6 * np.linspace(0, 1, shape[-1])
    return heights if len(shape) == 2 else heights[0]


def opd(heights: Heights) -> bytes:
    """Wyko's blocks behind a directory: heights in wavelengths, x before y, and two numbers."""
    raster = np.where(np.isnan(heights), np.inf, heights * 1e9 / 500.0).astype("<f4")
    ny, nx = heights.shape
    data = struct.pack("<3H", nx, ny, 4) + np.ascontiguousarray(raster.T[:, ::-1]).tobytes()
    blocks = [
        (b"RAW_DATA", 3, data),
        (b"Wavelength", 7, struct.pack("<f", 500.0)),
        (b"Pixel_size", 7, struct.pack("<f", PIXEL * 1e3)),
    ]
    entries = [(b"Directory", 1, 24 * (len(blocks) + 1)), *((n, t, len(d)) for n, t, d in blocks)]
    heads = b"".join(struct.pack("<16shlH", name, kind, size, 0) for name, kind, size in entries)
    return b"\x01\x00" + heads + b"".join(content for _, _, content in blocks)


def al3d(heights: Heights) -> bytes:
    """Alicona's tags, and rows of floats padded to eight bytes."""
    ny, nx = heights.shape
    tags = {
        "Cols": nx,
        "Rows": ny,
        "PixelSizeXMeter": repr(PIXEL),
        "PixelSizeYMeter": repr(PIXEL),
        "InvalidPixelValue": "1e10",
        "DepthImageOffset": 1024,
    }

    def tag(key: str, value: object) -> bytes:
        return struct.pack("20s30s2s", key.encode(), str(value).encode(), b"\r\n")

    text = b"AliconaImaging\x00\r\n" + tag("Version", 1) + tag("TagCount", len(tags))
    text += b"".join(tag(key, value) for key, value in tags.items()) + bytes(254) + b"\r\n"
    padded = np.zeros((ny, -(-nx // 2) * 2), "<f4")
    padded[:, :nx] = np.where(np.isnan(heights), 1e10, heights)
    return text.ljust(1024, b"\x00") + padded.tobytes()


def stylus(heights: Heights) -> bytes:
    """A profile as a stylus instrument exports it: a header, positions and heights in um."""
    lines = ["Scan Parameters", "Scan Type,Standard Scan", "Stylus,Radius: 2.5 um", ""]
    lines += ["Scan Data", "", "Lateral um,Raw Micrometer,"]
    lines += [f"{0.2 * i:.1f},{1e6 * z:.5f},," for i, z in enumerate(heights)]
    return "\r\n".join([*lines, ""]).encode()


FILES = {"opd-1.opd": "opd", "al3d-1.al3d": "al3d", "holes.al3d": "holes", "line-1.csv": "line"}
_WRITERS = {".opd": opd, ".al3d": al3d, ".csv": stylus}


def heights_of(name: str) -> Heights:
    """What is in a file [m]; of `holes` three tenths of the points are missing."""
    kind = FILES[name]
    heights = rough(SHAPES[kind], seed=len(kind))
    order = np.random.default_rng(4).permutation(heights.size)
    missing = {"opd": heights.size // 200, "holes": heights.size * 3 // 10}.get(kind, 0)
    heights.ravel()[order[:missing]] = np.nan
    return heights


def write_scans(folder: Path) -> None:
    """All FILES, in topography."""
    (folder / "topography").mkdir()
    for name in FILES:
        (folder / "topography" / name).write_bytes(_WRITERS[Path(name).suffix](heights_of(name)))
