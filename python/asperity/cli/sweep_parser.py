"""The options of the verb `sweep`."""

import argparse
from collections.abc import Callable

from asperity.cli.options import pairs, whole
from asperity.cli.sweep_command import sweep


def add_sweep(
    verb: Callable[..., argparse.ArgumentParser],
    pictures: Callable[[argparse.ArgumentParser], None],
    notes: Callable[[argparse.ArgumentParser], None],
) -> None:
    added = verb(
        "sweep",
        sweep,
        "friction of many scenes at once, on one machine or on many; pictures and ranks of them",
        "sweep.toml --output results.zarr --workers 4\n"
        "  asperity sweep results.zarr --plot results.png --at surface.hurst=0.8\n"
        "  asperity sweep results.zarr --rank correction.kind",
    )
    added.add_argument(
        "sweep",
        metavar="SWEEP.toml",
        help='scene = "scene.toml", and a table [over] of keys with lists; or a store of such a '
        "sweep, to look at",
    )
    added.add_argument("--output", metavar="STORE", help="results.zarr or results.nc")
    added.add_argument(
        "--workers", type=whole, metavar="N", help="processes of this machine (default: this one)"
    )
    added.add_argument(
        "--scheduler", metavar="ADDRESS", help="of Dask workers that run, tcp://host:8786"
    )
    added.add_argument(
        "--mpi", action="store_true", help="other ranks compute: start it by mpiexec -n 8"
    )
    added.add_argument(
        "--resume", action="store_true", help="go on with the store of an earlier run"
    )
    added.add_argument("--force", action="store_true", help="replace a sweep's store that is there")
    added.add_argument(
        "--variables",
        metavar="NAME,...",
        help="keep these alone (default: all of them); draw the first",
    )
    added.add_argument(
        "--dry-run", action="store_true", help="tell points, tasks, bytes and seconds"
    )
    added.add_argument(
        "--at",
        type=pairs,
        metavar="AXIS=VALUE,...",
        default={},
        help="look at these values of some axes",
    )
    added.add_argument(
        "--rank",
        metavar="AXIS",
        help="tell which value of an axis has most friction, where, and how certainly, as CSV",
    )
    pictures(added)
    notes(added)
