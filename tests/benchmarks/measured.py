"""Measured inputs, from the folder that ASPERITY_DATA names: none without it."""

import os
from pathlib import Path

import asperity

SCANS = ("opd-1.opd", "al3d-1.al3d")
RUBBERS = ("epdm_70", "material_a")
COLUMNS = {
    "frequency": "freq_hz",
    "temperature": "temperature_C",
    "storage": "G_storage_pa",
    "loss": "G_loss_pa",
}
UNITS = {"frequency": "Hz", "temperature": "C", "modulus": "Pa"}


def folder() -> Path | None:
    result = os.environ.get("ASPERITY_DATA")
    return Path(result) if result else None


def spectra() -> dict[str, asperity.TabulatedSpectrum]:
    """Reliable rings of each scan, drop-outs filled."""
    data = folder()
    return {} if data is None else {name: _rings(data / "topography" / name) for name in SCANS}


def _rings(path: Path) -> asperity.TabulatedSpectrum:
    rings = asperity.power_spectrum(asperity.read_surface(path).fill_dropouts())
    known = rings.wavenumber[rings.reliable]
    return rings.truncated(q0=known[0], q1=known[-1])


def rubbers() -> dict[str, asperity.MasterCurveBuild]:
    data = folder()
    return {} if data is None else {name: _build(data / "dma" / name) for name in RUBBERS}


def _build(path: Path) -> asperity.MasterCurveBuild:
    sweeps = asperity.read_isotherms(
        path / "tf_015p.csv", columns=COLUMNS, units=UNITS, modulus="G"
    )
    return asperity.build_master_curve(sweeps, reference_temperature=293.15)


def velocities(
    spectrum: asperity.TabulatedSpectrum, curve: asperity.MasterCurve
) -> tuple[float, float]:
    """The slowest and the fastest at which all of the modulus was measured."""
    lowest, highest = curve.angular_frequency[[0, -1]]
    return 1.01 * lowest / spectrum.q0, 0.99 * highest / spectrum.q1
