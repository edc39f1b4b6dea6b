"""The verb `rubber`: DMA sweeps to a master curve, shift factors and a Prony series."""

from argparse import Namespace
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base import quantities
from asperity.base.arguments import FilePath
from asperity.base.diagnostics import InvalidInput, NotConverged, Note, fatal_first, refusal
from asperity.base.parameters import parameters
from asperity.cli.friction_commands import check_outputs, write_outputs
from asperity.cli.options import flags, typed_options
from asperity.dma import MasterCurveBuild, build_master_curve
from asperity.io import plausible
from asperity.io.fields import rename_in_errors
from asperity.io.files import refuse_overwrite, write_files
from asperity.io.prony_input import prony_input
from asperity.io.read_dma import read_isotherms
from asperity.io.read_shift_factors import read_shift_factors
from asperity.io.table import Table, columns_of
from asperity.plot import rubber as plot_rubber
from asperity.prony_fit import PronyFit
from asperity.rubber import PronySeries
from asperity.scene.celsius import all_in_celsius
from asperity.scene.rubber import quiet_prony
from asperity.shift_factors import WlfFit

_PRONY: dict[str, Any] = {".csv": None, ".inp": "abaqus", ".mac": "ansys"}
_FOLLOWS = 0.05  # decades: of a_T, about what 4 % of mu stand for

_READ = ("columns", "units", "modulus", "poisson_ratio", "temperatures")
_FLAGS = flags(*_READ, "reference_temperature", "vertical_shift")


def rubber(args: Namespace) -> None:
    """Master curve of the isotherms in files; its table can be a scene's master_curve."""
    files = [FilePath(name) for name in args.file]
    shift_file = [] if args.shift is None else [FilePath(args.shift)]
    wanted = {name: getattr(args, name) for name in ("write_shift", "write_prony")}
    if args.write_prony is not None and FilePath(args.write_prony).suffix not in _PRONY:
        allowed = "a name in .csv, .inp (Abaqus) or .mac (Ansys)"
        raise refusal("--write-prony", args.write_prony, allowed)
    refuse_overwrite(check_outputs(args, **wanted), [*files, *shift_file])
    with plausible.collected(typed_options(args)) as unusual, rename_in_errors(None, _FLAGS):
        if args.reference_temperature is not None:
            flag, temperature = "--reference-temperature", args.reference_temperature
            plausible.check(flag, temperature, quantities.TEMPERATURE)
        isotherms = read_isotherms(files, **{name: getattr(args, name) for name in _READ})
        middle = isotherms[len(isotherms) // 2].temperature
        reference = middle if args.reference_temperature is None else args.reference_temperature
        shifts = None
        if args.shift is not None:
            shifts = read_shift_factors(args.shift, reference_temperature=reference)
        build = build_master_curve(
            isotherms,
            reference_temperature=reference,
            vertical_shift=args.vertical_shift,
            shift_factors=shifts,
        )
    wlf, prony, of_fits = _fits(build)
    notes = fatal_first([*unusual, *build.notes, *of_fits])
    facts = _facts(build, wlf, prony)
    inputs: dict[str, Any] = {
        "files": [str(file) for file in files],
        **{name: getattr(args, name) for name in (*_READ, "vertical_shift", "shift")},
        "isotherms": _isotherms(build),
        "found": facts,
    }
    if prony is not None:
        of_series = parameters(PronySeries)
        inputs["prony"] = {p.key: np.asarray(getattr(prony, p.name)).tolist() for p in of_series}
    celsius = (args.units or {}).get("temperature") == "C"
    notes = [note.said(all_in_celsius) for note in notes] if celsius else notes
    inputs["note_lines"] = [note.line for note in notes]  # for a scene that reads the curve
    table = Table("rubber", [inputs], notes, columns_of(build.master_curve))
    beside: dict[Path, bytes | str] = {}
    if args.write_shift is not None:
        of_build = {"reference_temperature_k": build.reference_temperature}
        its_table = Table("rubber", [of_build], build.notes, _isotherms(build))
        beside[FilePath(args.write_shift)] = its_table.csv()
    if args.write_prony is not None:
        path = FilePath(args.write_prony)
        beside[path] = _prony_text(args, path, build, prony)
    write_files(beside)

    def draw(path: Path) -> bytes:
        return plot_rubber.rubber_figure(isotherms, build, wlf, prony, path, celsius=celsius)

    write_outputs(args, table, draw, facts)


def _prony_text(
    args: Namespace, path: Path, build: MasterCurveBuild, prony: PronyFit | None
) -> str:
    if prony is None:
        raise InvalidInput("there is no Prony fit to write; --output tells why", where=path)
    if program := _PRONY[path.suffix]:
        with rename_in_errors(path, _FLAGS):
            return f"{prony_input(prony, program, poisson_ratio=args.poisson_ratio)}\n"
    facts = {
        "reference_temperature_k": build.reference_temperature,
        "equilibrium_modulus_pa": prony.equilibrium_modulus,
    }
    return Table("rubber", [facts], prony.notes, columns_of(prony)).csv()


def _fits(build: MasterCurveBuild) -> tuple[WlfFit | None, PronyFit | None, list[Note]]:
    """WLF and Prony fits where there are any, and what to say of them."""
    notes: list[Note] = []
    wlf = prony = None
    try:
        wlf = build.fit_wlf()
        follow = "follow" if wlf.residual < _FOLLOWS else "do not follow"
        text = f"the shift factors {follow} WLF: residual {wlf.residual:.2g} decades"
        notes.append(Note(text, code="wlf-fit"))
    except (InvalidInput, NotConverged) as error:
        notes.append(Note(f"no WLF fit: {error}", code="no-wlf-fit"))
    try:
        prony = quiet_prony(build)
        notes += prony.notes
    except (InvalidInput, NotConverged) as error:
        notes.append(Note(f"no Prony fit: {error}", code="no-prony-fit"))
    return wlf, prony, notes


def _facts(build: MasterCurveBuild, wlf: WlfFit | None, prony: PronyFit | None) -> dict[str, float]:
    arrhenius = build.fit_arrhenius()
    facts = {
        "reference_temperature_k": build.reference_temperature,
        "lowest_frequency_rad_s": float(build.master_curve.angular_frequency[0]),
        "highest_frequency_rad_s": float(build.master_curve.angular_frequency[-1]),
        "residual": build.residual,
    }
    if wlf is not None:
        facts |= {
            "wlf_c1": wlf.c1,
            "wlf_c1_standard_error": wlf.standard_errors["c1"],
            "wlf_c2_k": wlf.c2,
            "wlf_c2_standard_error_k": wlf.standard_errors["c2"],
            "wlf_residual_decades": wlf.residual,
        }
    facts["activation_energy_j_per_mol"] = arrhenius.activation_energy
    facts["arrhenius_residual_decades"] = arrhenius.residual
    if prony is not None:
        facts |= {
            "prony_modes": float(prony.moduli.size),
            "prony_storage_residual": prony.storage_residual,
            "prony_loss_residual": prony.loss_residual,
            **_of_points(build, prony),
        }
    return facts


def _of_points(build: MasterCurveBuild, prony: PronyFit) -> dict[str, float]:
    """What the series leaves of the measured points, which scatter about the master curve that it
    was fitted to; `residual` is what that curve leaves of them."""
    points = build.points
    fitted = prony.modulus(points.angular_frequency)
    off = points.storage_modulus / fitted.real - 1, points.loss_modulus / fitted.imag - 1
    names = "prony_points_storage_residual", "prony_points_loss_residual"
    return {name: float(np.sqrt(np.mean(one**2))) for name, one in zip(names, off, strict=True)}


def _isotherms(build: MasterCurveBuild) -> dict[str, list[float]]:
    columns = columns_of(build) | {"log10_a_t": np.round(build.log10_a_T, 6)}
    return {name: column.tolist() for name, column in columns.items()}
