"""Spectra of a build without FFTW beside those of the usual one: their digits and their times.

    python tests/stability/permissive.py FOLDER

FOLDER has an asperity built with ASPERITY_PERMISSIVE=ON, the interpreter that runs this has the
other. They take turns, on white noise. Ends with an error where a row of a spectrum of doubles
differs by 1e-13 or more of itself or of the mean, if that is more, one of floats by 1e-5: by chance
a single mode of a line is a millionth of the mean.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

import numpy as np

WORK = """
import importlib.metadata, json, sys, time
import numpy as np
import asperity

print(json.dumps(importlib.metadata.metadata("asperity")["License-Expression"]))
for kind, shape in json.load(sys.stdin):
    heights = np.random.default_rng(1).normal(scale=1e-6, size=shape).astype(kind)
    if len(shape) == 2:
        surface, spectrum_of = asperity.HeightMap(heights, pixel_size=1e-6), asperity.power_spectrum
    else:
        surface, spectrum_of = asperity.LineScan(heights, spacing=1e-6), asperity.line_spectrum
    times = []
    for _ in range(5):
        begin = time.process_time()
        spectrum = spectrum_of(surface)
        times.append(time.process_time() - begin)
    print(json.dumps([min(times), spectrum.density.tolist()]))
"""

ASKS = [
    ("f8", (1024, 1024)), ("f8", (2000, 2000)), ("f8", (1500, 3000)), ("f8", (4096, 1021)),
    ("f8", (1009, 1013)), ("f4", (1024, 1024)), ("f4", (2000, 2000)), ("f4", (4096, 4096)),
    ("f4", (997, 1536)), ("f8", (65536,)), ("f8", (1000003,)),
]  # fmt: skip


def spectra(folder: str | None = None) -> list[tuple[float, list[float]]]:
    """Times and densities of the asperity in a folder, or of the installed one."""
    environment = dict(os.environ)
    environment.pop("PYTHONPATH", None)
    if folder is not None:
        environment["PYTHONPATH"] = os.path.abspath(folder)
    run = subprocess.run(
        [sys.executable, "-c", WORK],
        input=json.dumps(ASKS),
        env=environment,
        cwd=tempfile.gettempdir(),
        capture_output=True,
        text=True,
        check=False,
    )
    if run.returncode:
        sys.exit(run.stderr)
    results = [json.loads(line) for line in run.stdout.splitlines()]
    licence = results.pop(0)
    if licence != ("GPL-3.0-or-later" if folder is None else "BSD-3-Clause"):
        sys.exit(f"{folder or sys.executable}: its asperity is under {licence}")
    return [tuple(one) for one in results]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--turns", type=int, default=3)
    chosen = parser.parse_args()
    usual, permissive = [], []
    for _ in range(chosen.turns):
        usual.append(spectra())
        permissive.append(spectra(chosen.folder))
    exceeded, ratios = 0, []
    for i, (kind, shape) in enumerate(ASKS):
        a, b = np.array(usual[0][i][1]), np.array(permissive[0][i][1])
        apart = np.max(np.abs(b - a) / np.maximum(a, a.mean()))
        ratio = statistics.median(b[i][0] / a[i][0] for a, b in zip(usual, permissive, strict=True))
        ratios.append(ratio)
        allowed = 1e-13 if kind == "f8" else 1e-5
        exceeded += apart >= allowed
        print(
            f"{kind} {'x'.join(map(str, shape)):>10}: {apart:.1e} apart, {ratio:.2f} times FFTW's "
            f"{1e3 * min(a[i][0] for a in usual):.1f} ms"
        )
    print(f"{exceeded} exceeded; {max(ratios):.2f} times as slow at most")
    sys.exit(1 if exceeded else 0)


if __name__ == "__main__":
    main()
