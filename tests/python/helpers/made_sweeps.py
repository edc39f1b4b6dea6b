"""DMA files as instruments write them, of rubbers whose moduli and shifts are known."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
# log10 a_T = -B1 (T - T_r) / ((B2 + T_r) (B2 + T)), T in C: RepTate (jorge-ramirez-upm/RepTate),
# polyisoprene of RepTate/tools/CreateMaterialsDatabaseFile.py, the law in theories/TheoryWLF.py;
# b_T has the density, proportional to 1 / (1 + alpha T)
B1, B2, ALPHA = 691.6245, 114.3, 10**-3.2147
CELSIUS = {
    "material_a": np.linspace(-10, 46, 9),
    "epdm_70": np.linspace(-10, 53, 10),
    "reptate_pi1000k": np.array([-40, -30, -20, -10, 0, 10, 20, 30, 30, 50.0]),
}


def modulus(w: Array, plateau: float, step: float, centre: float, width: float) -> Array:
    """G' + i G'' [Pa] of relaxations spread over 16 decades about `centre` (log10 of seconds)."""
    times = np.linspace(centre - 8, centre + 8, 65)
    weights = np.exp(-0.5 * ((times - centre) / width) ** 2)
    x = 1j * np.multiply.outer(w, 10**times)
    return np.asarray(plateau + step * (x / (1 + x) * weights).sum(axis=-1) / weights.sum())


def of_tread(w: Array) -> Array:
    return modulus(w, 9e5, 6e8, -7.5, 1.8)


def of_melt(w: Array) -> Array:
    """A chain that flows: Rouse's times below the longest."""
    x = 1j * np.multiply.outer(w, 0.5 / np.arange(1, 60) ** 2)
    return np.asarray(4e4 * (x / (1 + x)).sum(axis=-1))


def wlf(celsius: Array | float, c1: float = 6.5, c2: float = 130.0) -> Array | float:
    """log10 a_T about 20 C."""
    return -c1 * (celsius - 20) / (c2 + celsius - 20)


def shifts_of_epdm(celsius: Array) -> tuple[Array, Array]:
    """log10 a_T of E' and of E'': off WLF, and 0.4 apart at the coldest."""
    storage = wlf(celsius) + 0.15 * np.sin(1.3 * np.arange(celsius.size))
    apart = np.zeros(celsius.size)
    apart[0] = 0.4
    return storage, storage - apart


def write_sweeps(folder: Path) -> None:
    """dma/material_a and dma/epdm_70 with sweeps of strain, and dma/reptate_pi1000k."""
    for number, name in enumerate(("material_a", "epdm_70")):
        there = folder / "dma" / name
        there.mkdir(parents=True)
        (there / "tf_015p.csv").write_text(_frequencies(name, np.random.default_rng(number)))
        for hertz in (10, 100):
            (there / f"sd_{hertz}hz.csv").write_text(_strains(hertz))
    there = folder / "dma" / "reptate_pi1000k"
    there.mkdir()
    random = np.random.default_rng(7)
    for run, celsius in enumerate(CELSIUS["reptate_pi1000k"]):
        (there / f"melt_{run}.osc").write_text(_melt(float(celsius), random), encoding="latin-1")


_HEAD = "run,freq_hz,temperature_C,G_storage_pa,G_loss_pa,G_abs_pa,tan_delta,force_dyn_N,"


def _row(run: str, hertz: float, celsius: float, g: complex, strain: float) -> str:
    numbers = (hertz, celsius, g.real, g.imag, abs(g), g.imag / g.real, 1.0, strain)
    return ",".join([run, *(f"{x:.9g}" for x in numbers)])


def _frequencies(name: str, random: np.random.Generator) -> str:
    """Of epdm_70 E'' asks for shifts of its own, and neither follows WLF."""
    lines = [_HEAD + "strain_dyn_pct"]
    hertz = np.geomspace(0.1, 300, 19)
    shifts = (wlf(CELSIUS[name]),) * 2 if name == "material_a" else shifts_of_epdm(CELSIUS[name])
    for celsius, storage, loss in zip(CELSIUS[name], *(10**one for one in shifts), strict=True):
        w = 2 * np.pi * hertz
        noise = 1 + 0.01 * random.standard_normal((2, hertz.size))
        g = of_tread(w * storage).real * noise[0] + 1j * of_tread(w * loss).imag * noise[1]
        lines += [_row("made", h, celsius, one, 0.15) for h, one in zip(hertz, g, strict=True)]
    return "\n".join([*lines, ""])


def _strains(hertz: int) -> str:
    """Softer by strain, as filled rubber is."""
    lines = [_HEAD + "strain_dyn_pct"]
    g = complex(of_tread(np.array([2 * np.pi * hertz * 10 ** wlf(22.5)]))[0])
    for percent in np.geomspace(0.01, 1.5, 15):
        soft = g.real / (1 + 0.15 * percent) + 1j * g.imag * (1 + 0.1 * percent)
        lines.append(_row("made", hertz, 22.5, soft, percent))
    return "\n".join([*lines, ""])


def _melt(celsius: float, random: np.random.Generator) -> str:
    log_a = -B1 * celsius / (B2 * (B2 + celsius))
    b = (celsius + 273.15) / 273.15 / (1 + ALPHA * celsius)
    w = np.geomspace(0.1, 100, 19)
    g = b * of_melt(w * 10**log_a)
    noise = 1 + 0.005 * random.standard_normal((2, w.size))
    g = g.real * noise[0] + 1j * g.imag * noise[1]
    head = f"T={celsius:g};Mw=1131;chem=PI;"
    names = "Freq\tG'\tG\"\tTemp\tStrain"
    rows = [
        f"{x:.6g}\t{y.real:.7g}\t{y.imag:.7g}\t{celsius:g}\t5" for x, y in zip(w, g, strict=True)
    ]
    return "\n".join([head, names, "rad/s\tPa\tPa\t\xb0C\t%", *rows, ""])
