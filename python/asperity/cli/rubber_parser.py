"""The options of the verb `rubber`."""

import argparse
from collections.abc import Callable

from asperity.cli.options import number, numbers, pairs
from asperity.cli.rubber_command import rubber


def add_rubber(verb: Callable[..., argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the verb and its options, but for those that verbs share."""
    added = verb(
        "rubber",
        rubber,
        "master curve, shift factors and Prony series of DMA isotherms",
        "dma.csv --columns frequency=f,temperature=T,storage=G1,loss=G2 "
        "--units frequency=Hz,temperature=C,modulus=MPa --modulus G --plot rubber.png",
    )
    added.add_argument("file", metavar="FILE", nargs="+")
    added.add_argument(
        "--columns",
        type=pairs,
        required=True,
        metavar="NAME=COLUMN,...",
        help="names in the files of frequency, temperature, storage, loss",
    )
    added.add_argument(
        "--units",
        type=pairs,
        required=True,
        metavar="NAME=UNIT,...",
        help="frequency=Hz or rad/s, temperature=K or C, modulus=Pa, kPa, MPa or GPa",
    )
    added.add_argument(
        "--modulus", choices=("E", "G"), required=True, help="Young's or shear moduli"
    )
    added.add_argument(
        "--poisson-ratio",
        type=number,
        default=0.5,
        metavar="NU",
        help="for E = 2 (1 + nu) G (default: %(default)s)",
    )
    added.add_argument(
        "--temperatures",
        type=numbers,
        metavar="T,T,...",
        help="one for each file, where the files have no column of them",
    )
    added.add_argument(
        "--reference-temperature",
        type=number,
        metavar="T",
        help="[K] (default: that of the middle isotherm)",
    )
    added.add_argument(
        "--vertical-shift", choices=("T/T_ref",), help="divide moduli by b_T (default: none)"
    )
    added.add_argument(
        "--shift",
        metavar="FILE",
        help="take a_T from a table (temperature_k,log10_a_t or T,log_aT) or a file of this verb",
    )
    added.add_argument(
        "--write-shift", metavar="FILE", help="write the shift factors, a row an isotherm (.csv)"
    )
    added.add_argument(
        "--write-prony",
        metavar="FILE",
        help="write the Prony terms: .csv, .inp for Abaqus, .mac for Ansys",
    )
    return added
