"""The verb `sweep`: many scenes at once, on one machine or on many."""

import importlib.util
import json
import logging
import math
import sys
from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from asperity._core import Error, InvalidInput
from asperity.base.arguments import FilePath
from asperity.base.table import imported
from asperity.cli.friction_commands import refuse_overwrite
from asperity.cli.streams import print_stderr, print_stdout, tell_notes
from asperity.io.fields import nearest
from asperity.scene.scene import read_toml
from asperity.sweep import run
from asperity.sweep.executors import Executor
from asperity.sweep.plan import cut_of
from asperity.sweep.store import remove_store
from asperity.sweep.timing import estimated, timed

_KEYS = dict.fromkeys(("scene", "over", "variables"))
_TOLD = 20  # notes that go to the terminal: each of a hundred scans may have its own
_PATIENCE = 10  # seconds that a scheduler has to answer


def sweep(args: Namespace) -> None:
    """Compute a sweep, or tell what it would take."""
    try:
        _sweep(args)
    except ImportError as error:
        raise Error(str(error)) from error


def _sweep(args: Namespace) -> None:
    if args.output is None and not args.dry_run:
        raise InvalidInput("--output: is missing: results.zarr or results.nc")
    with _executor(args) as (executor, first):
        if first:
            _compute(args, executor)


def _compute(args: Namespace, executor: Any) -> None:
    path = FilePath(args.sweep)
    scene, over, variables = _read(path)
    if args.variables is not None:
        variables = args.variables.split(",")
    plan = run.planned(scene, over, variables)
    if args.output is not None:
        output = run.store_path(args.output)
        refuse_overwrite([output], [path, scene, *map(Path, plan.task.digests)])
    if args.dry_run:
        _tell(plan, Executor(executor))
        return
    if args.force and not args.resume:
        for old in (output, output.with_name(output.name + ".part")):
            remove_store(old)
    found = run.sweep(
        scene,
        over,
        executor=executor,
        store=output,
        resume=args.resume,
        progress=_bar(path),
        variables=variables,
    )
    with found:
        notes = str(found.attrs["notes"]).splitlines()
        tell_notes(notes[:_TOLD])
        if len(notes) > _TOLD:
            print_stderr(
                f"note: {len(notes) - _TOLD} more are in the attribute notes of {output}\n"
            )
        points, failed = plan.points, int(found.attrs["failed"])
        messages = found["failure_message"].values.tolist()
    if failed:
        more = f" and {len(messages) - 1} other messages" if len(messages) > 1 else ""
        raise Error(f"{output}: {failed} of {points} points failed: {messages[0]}{more}")
    print_stderr(f"{output}: {points} points, none failed\n")


def _read(path: Path) -> tuple[Path, Any, Any]:
    """The scene of a sweep's file, its axes and the variables that it wants."""
    given = read_toml(path)
    for key in given:
        if key not in _KEYS:
            raise InvalidInput(f"{path}: {key}: unknown key, {nearest(key, _KEYS)}")
    scene, over = given.get("scene"), given.get("over")
    if not isinstance(scene, str):
        raise InvalidInput(f'{path}: scene: must be the name of a file, as in scene = "scene.toml"')
    if not isinstance(over, dict):
        raise InvalidInput(f"{path}: [over]: must be a table of keys with lists")
    return FilePath(path.parent / scene), over, given.get("variables")


def _tell(plan: Any, executor: Executor) -> None:
    """Say what a sweep would take, by tasks that were timed."""
    cost = timed(plan, executor)
    cut = cut_of(plan, cost)
    tasks = math.prod(math.ceil(n / c) for n, c in zip(plan.shape, cut, strict=True))
    size = plan.points * (8 * len(plan.variables) + 4)
    seconds = estimated(plan, cost)
    told = {
        "points": plan.points,
        "shape": dict(zip((axis.name for axis in plan.axes), plan.shape, strict=True)),
        "tasks": tasks,
        "bytes": size,
        "seconds_of_one_worker": float(f"{seconds:.2g}"),
    }
    print_stdout("".join(f"{name} = {json.dumps(one)}\n" for name, one in told.items()))


def _bar(path: Path) -> Any:
    on_terminal = sys.stderr is not None and sys.stderr.isatty()
    if not on_terminal or importlib.util.find_spec("tqdm") is None:
        return None
    return run.bar(f"{path}")


@contextmanager
def _executor(args: Namespace) -> Iterator[tuple[Any, bool]]:
    """The executor that is asked for, and whether this process is the one that sends tasks."""
    asked = [args.workers is not None, args.scheduler is not None, args.mpi]
    if sum(asked) > 1:
        raise InvalidInput("--workers, --scheduler, --mpi: must be one of them")
    if args.mpi:
        futures = imported("mpi4py.futures", "mpi")
        with futures.MPICommExecutor() as executor:
            yield executor, executor is not None
    elif args.scheduler is not None:
        with _client(args.scheduler) as client:
            yield client, True
    elif args.workers is not None:
        if not 1 <= args.workers <= 10_000:
            raise InvalidInput(f"--workers {args.workers}: must be from 1 to 10000")
        distributed = imported("distributed", "sweep")
        with (
            distributed.LocalCluster(
                n_workers=args.workers,
                threads_per_worker=1,
                dashboard_address=None,
                silence_logs=logging.CRITICAL,
            ) as cluster,
            distributed.Client(cluster) as client,
        ):
            yield client, True
    else:
        yield None, True


def _client(address: str) -> Any:
    distributed = imported("distributed", "sweep")
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    try:
        client = distributed.Client(address, timeout=_PATIENCE)
    except (OSError, TimeoutError):
        problem = f"does not answer within {_PATIENCE} s"
        raise Error(f"--scheduler {address}: {problem}: is it running?") from None
    except (ValueError, TypeError) as error:
        raise InvalidInput(f"--scheduler {address}: {error}") from None
    if not client.ncores():
        print_stderr(f"note: {address} has no workers yet: waiting for them\n")
    return client
