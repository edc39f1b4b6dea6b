"""The options of the verb `sweep`."""

import argparse
from collections.abc import Callable

from asperity.cli.options import whole
from asperity.cli.sweep_command import sweep


def add_sweep(
    verb: Callable[..., argparse.ArgumentParser],
) -> None:
    added = verb(
        "sweep",
        sweep,
        "friction of many scenes at once, on one machine or on many",
        "sweep.toml --output results.zarr --workers 4",
    )
    added.add_argument(
        "sweep",
        metavar="SWEEP.toml",
        help='scene = "scene.toml", and a table [over] of keys with lists',
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
        "--variables", metavar="NAME,...", help="keep these alone (default: all of them)"
    )
    added.add_argument(
        "--dry-run", action="store_true", help="tell points, tasks, bytes and seconds"
    )
