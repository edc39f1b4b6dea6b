"""The verb `sweep`: many scenes at once, on one machine or on many."""

import json
import logging
import math
from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from asperity.base.arguments import FilePath
from asperity.base.codes import FATAL
from asperity.base.diagnostics import Argument, Error, InvalidInput, Note, must_be
from asperity.base.table import imported
from asperity.cli.friction_commands import shows_bars
from asperity.cli.options import exclusive, goes_with, list_used
from asperity.cli.streams import print_stderr, print_stdout, tell_notes
from asperity.draw.figure import check_plot
from asperity.draw.style import drawn_in
from asperity.io.fields import nearest
from asperity.io.files import check_output, refuse_overwrite, write_whole
from asperity.io.table import Table
from asperity.plot.sweep import sweep_figure
from asperity.scene.scene import read_toml
from asperity.sweep import run
from asperity.sweep.executors import Executor, local_cluster
from asperity.sweep.existing import open_store
from asperity.sweep.look import choose, notes_of, ranks, with_scenes
from asperity.sweep.plan import cut_of
from asperity.sweep.timing import estimated, timed

_KEYS = dict.fromkeys(("scene", "over", "variables"))
_RANK_NOTES = [
    "points at which every value has a result are compared; lead is that of the mean over the next",
    "certain_share: the lead at a point exceeds the sum of the errors of the two: numerical "
    "error, model error, and half the band where there is one; nan where a model error is unknown",
]
_PATIENCE = 10  # seconds that a scheduler has to answer


def sweep(args: Namespace) -> None:
    """Compute a sweep, tell what it would take, or look at what it computed."""
    try:
        _sweep(args)
    except ImportError as error:
        raise Error(str(error)) from error


def _sweep(args: Namespace) -> None:
    looks = bool(args.plot or args.rank)
    goes_with(args, "style", "plot")
    goes_with(args, "at", "plot rank")
    if args.plot is not None:
        check_plot(FilePath(args.plot))
        check_output(FilePath(args.plot))
    path = FilePath(args.sweep)
    if path.suffix in (".zarr", ".nc"):
        _look_at_store(args, path, looks)
        return
    exclusive(args, "dry-run force resume")
    exclusive(args, "workers scheduler mpi")
    if args.dry_run and looks:
        problem = ": computes nothing that --plot or --rank could show"
        raise InvalidInput(Argument("--dry-run"), problem)
    if args.output is None and not args.dry_run:
        raise InvalidInput(Argument("--output"), ": is missing: results.zarr or results.nc")
    with _executor(args) as (executor, first):
        if first:
            _compute(args, executor)


def _compute(args: Namespace, executor: Any) -> None:
    path = FilePath(args.sweep)
    scene, over, variables = _read(path)
    if args.variables is not None:
        variables = args.variables.split(",")
    plan = run.planned(scene, over, variables, path)
    if args.output is not None:
        output = run.store_path(args.output)
        outputs = [output] if args.plot is None else [output, FilePath(args.plot)]
        refuse_overwrite(outputs, [path, scene, *map(Path, plan.task.digests)])
    if args.dry_run:
        _tell(plan, Executor(executor))
        return
    bar = run.bar(f"{path}") if shows_bars() else None
    how = {"resume": args.resume, "force": args.force, "progress": bar}
    with run.computed(plan, executor, output, **how) as dataset:
        _look(args, dataset)
        tell_notes(notes_of(dataset), args.notes)
        points, failed = plan.points, int(dataset.attrs["failed"])
        messages = dataset["failure_message"].values.tolist()
    if failed:
        rest = len(messages) - 1
        more = f"; failure_message has {rest} more" if rest else ""
        raise Error(f"{output}: {failed} of {points} points failed: {messages[0]}{more}")
    print_stderr(f"{output}: {points} points, none failed\n")


def _look_at_store(args: Namespace, path: Path, looks: bool) -> None:
    """Draw or rank what an earlier sweep computed."""
    for flag in list_used(args, "output workers scheduler mpi resume force dry-run"):
        problem = f": {path} is a store: give a SWEEP.toml to compute"
        raise InvalidInput(Argument(flag), problem)
    if not looks:
        raise InvalidInput("is a store: look at it by --plot or --rank", where=path)
    if args.variables is not None and args.plot is None:
        raise InvalidInput(Argument("--variables"), ": goes with --plot, a rank is of mu")
    if args.variables is not None and "," in args.variables:
        raise must_be("--variables", "one, the one to draw", f" {args.variables}")
    if not path.exists():
        raise InvalidInput("cannot be read: No such file or directory", where=path)
    with open_store(path) as dataset:
        if "failure" not in dataset or "sweep" not in dataset.attrs:
            raise InvalidInput("is no store of a sweep", where=path)
        if not dataset.attrs["complete"]:
            print_stderr(f"note: {path} is not whole: points that are missing are left out\n")
        _look(args, dataset)


def _look(args: Namespace, dataset: Any) -> None:
    """Draw and rank what is asked for, where --at says."""
    part = choose(with_scenes(dataset), args.at)
    if args.plot is not None:
        picture = FilePath(args.plot)
        name = (args.variables or "mu").split(",")[0]
        with drawn_in(args.style, notes_of(part)):
            write_whole(picture, sweep_figure(part, picture, name))
    if args.rank is not None:
        columns = ranks(part, args.rank)
        fatal = [note for note in notes_of(part) if note.severity == FATAL]
        at = {f"at {name}": one for name, one in args.at.items()}
        inputs = [{"axis": args.rank, **at, "fatal_notes": len(fatal)}]
        notes = [*fatal, *map(Note, _RANK_NOTES)]
        print_stdout(Table("sweep --rank", inputs, notes, columns).csv())


def _read(path: Path) -> tuple[Path, Any, Any]:
    """The scene of a sweep's file, its axes and the variables that it wants."""
    tables = read_toml(path)
    for key in tables:
        if key not in _KEYS:
            raise InvalidInput(Argument(key), f": unknown key, {nearest(key, _KEYS)}", where=path)
    scene, over = tables.get("scene"), tables.get("over")
    if not isinstance(scene, str):
        raise must_be("scene", 'the name of a file, as in scene = "scene.toml"', where=path)
    if not isinstance(over, dict):
        raise must_be("", "a table of keys with lists", "[over]", where=path)
    return FilePath(path.parent / scene), over, tables.get("variables")


def _tell(plan: Any, executor: Executor) -> None:
    """Say what a sweep would take, by tasks that were timed."""
    cost = timed(plan, executor)
    cut = cut_of(plan, cost)
    tasks = math.prod(math.ceil(n / c) for n, c in zip(plan.shape, cut, strict=True))
    size = plan.points * 8 * (len(plan.task.variables) + 1)
    seconds = estimated(plan, cost)
    facts = {
        "points": plan.points,
        "shape": dict(zip((axis.name for axis in plan.axes), plan.shape, strict=True)),
        "tasks": tasks,
        "bytes": size,
        "seconds_of_one_worker": float(f"{seconds:.2g}"),
    }
    print_stdout("".join(f"{name} = {json.dumps(one)}\n" for name, one in facts.items()))


@contextmanager
def _executor(args: Namespace) -> Iterator[tuple[Any, bool]]:
    """The executor that is asked for, and whether this process is the one that sends tasks."""
    if args.mpi:
        futures = imported("mpi4py.futures", "mpi")
        with futures.MPICommExecutor() as executor:
            yield executor, executor is not None
    elif args.scheduler is not None:
        with _client(args.scheduler) as client:
            yield client, True
    elif args.workers is not None:
        if not 1 <= args.workers <= 10_000:
            raise must_be("", "from 1 to 10000", f"--workers {args.workers}")
        with local_cluster(args.workers) as client:
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
