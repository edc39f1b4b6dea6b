"""Rubber contact area and friction on rough surfaces, after Persson. SI units throughout."""

from asperity.base import begin  # noqa: F401  # isort: skip  # before what takes long
from asperity import correction, validation
from asperity._core import Error, InvalidInput, NotConverged, OutOfRange, __version__
from asperity.adhesion import Adhesion, AdhesionFit, fit_adhesion
from asperity.asperities import Separation, hertz_penetration, separation
from asperity.contact import (
    contact_area,
    contact_notes,
    correction_factor,
    mean_pressure,
    pressure_distribution,
)
from asperity.correction import *  # noqa: F403
from asperity.dma import MasterCurveBuild, MasterPoints, build_master_curve
from asperity.fmu import export_fmu
from asperity.friction import Friction, Gradients, friction
from asperity.friction_map.build import friction_map
from asperity.friction_map.look_up import FrictionMap, FrictionSlopes
from asperity.heating import Heating, heat_kernel
from asperity.io.prony_input import prony_input
from asperity.io.read_dma import read_isotherms, read_strain_sweep
from asperity.io.read_master_curve import read_master_curve
from asperity.io.read_shift_factors import read_shift_factors
from asperity.io.read_surface import read_surface
from asperity.measured_spectrum import line_spectrum, merge_spectra, power_spectrum
from asperity.plane_spectrum import Anisotropy, SpectralDensity, anisotropy, spectral_density
from asperity.prony_fit import PronyFit, fit_prony
from asperity.report.report import report
from asperity.rubber import MasterCurve, PronySeries, effective_modulus
from asperity.scene.fit import fit_scene
from asperity.scene.scene import read_scene
from asperity.scene.scene_fit import SceneFit
from asperity.self_affine_fit import SelfAffineFit, fit_self_affine, synthesize
from asperity.shift_factors import WLF, ArrheniusFit, ShiftFactors, WlfFit
from asperity.spectrum import LineSpectrum, SelfAffineSpectrum, TabulatedSpectrum
from asperity.surface import HeightMap, LineScan
from asperity.sweep.run import sweep
from asperity.sweeps import Isotherm, StrainFactors, StrainSweep, strain_factors
from asperity.tiles.statistics import HeightStatistics, height_statistics
from asperity.uncertainty.band import FrictionBand, friction_band

__all__ = [
    "WLF",
    "Adhesion",
    "AdhesionFit",
    "Anisotropy",
    "ArrheniusFit",
    "Error",
    "Friction",
    "FrictionBand",
    "FrictionMap",
    "FrictionSlopes",
    "Gradients",
    "Heating",
    "HeightMap",
    "HeightStatistics",
    "InvalidInput",
    "Isotherm",
    "LineScan",
    "LineSpectrum",
    "MasterCurve",
    "MasterCurveBuild",
    "MasterPoints",
    "NotConverged",
    "OutOfRange",
    "PronyFit",
    "PronySeries",
    "SceneFit",
    "SelfAffineFit",
    "SelfAffineSpectrum",
    "Separation",
    "ShiftFactors",
    "SpectralDensity",
    "StrainFactors",
    "StrainSweep",
    "TabulatedSpectrum",
    "WlfFit",
    "__version__",
    "anisotropy",
    "build_master_curve",
    "contact_area",
    "contact_notes",
    "correction_factor",
    "effective_modulus",
    "export_fmu",
    "fit_adhesion",
    "fit_prony",
    "fit_scene",
    "fit_self_affine",
    "friction",
    "friction_band",
    "friction_map",
    "heat_kernel",
    "height_statistics",
    "hertz_penetration",
    "line_spectrum",
    "mean_pressure",
    "merge_spectra",
    "power_spectrum",
    "pressure_distribution",
    "prony_input",
    "read_isotherms",
    "read_master_curve",
    "read_scene",
    "read_shift_factors",
    "read_strain_sweep",
    "read_surface",
    "report",
    "separation",
    "spectral_density",
    "strain_factors",
    "sweep",
    "synthesize",
    "validation",
]
__all__ += correction.__all__
