"""`sweep`: tasks go out to an executor, a few at a time, and results into a store as they come."""

import os
import pickle
import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path
from queue import SimpleQueue
from typing import Any

from asperity.base.arguments import FilePath, flag, path_of
from asperity.base.diagnostics import Error, InvalidInput, refusal, unfit
from asperity.base.table import imported
from asperity.io import plausible
from asperity.scene.scene import read_tables
from asperity.sweep.describe import Described, write_netcdf
from asperity.sweep.executors import Executor, Lost, result_of
from asperity.sweep.existing import (
    open_store,
    refuse_another,
    refuse_foreign,
    refuse_taken,
    remove_store,
)
from asperity.sweep.plan import Plan, cut_of, plan_of
from asperity.sweep.store import Memory, ZarrStore
from asperity.sweep.task import work
from asperity.sweep.timing import timed

Progress = Callable[[int, int], object]


def sweep(
    scene: Any,
    over: Mapping[str, Any],
    *,
    executor: Any = None,
    store: Any = None,
    resume: bool = False,
    progress: Progress | bool | None = None,
    variables: Any = None,
) -> Any:
    """Return the friction of a scene over any of its keys, for every combination of values.

    Results are the same bit by bit for any executor, any number of workers and any order. A point
    that cannot be computed (OutOfRange, NotConverged, or values that make no scene) leaves NaN and
    a message. Needs asperity[sweep].

    Parameters
    ----------
    scene : path or dict
        A scene file, or its tables; files of a dict are looked for in the working directory.
    over : dict
        Keys of a scene, table and key with a dot between them, with a list of values each:
        numbers, names of kinds or files. Every entry is a dimension. Several keys that move
        together are an entry with a name of its own: `{"road": {"surface.file": [...],
        "surface.pixel_size_m": [...]}}`. The kind "none" of `correction.kind` is plain Persson, and
        a kind takes those of the scene's keys of [correction] that it knows. None leaves a key out.
        Lists of the scene itself (pressure, velocity, temperature) are dimensions after those.
    executor : optional
        Anything with the `submit` of `concurrent.futures`: a process pool, a Dask `Client`,
        `mpi4py.futures.MPIPoolExecutor`. By default this process computes. It stays open.
    store : path, optional
        .zarr, or .nc, where results go as they come (NetCDF is made of a Zarr store `.nc.part` at
        the end). The memory that this process takes does then not grow with the points.
    resume : bool
        Go on with a store that an earlier run of the same sweep left; without one, begin.
    progress : callable or bool, optional
        Called with points done and points altogether after every task; True shows a bar of tqdm.
    variables : list of str, optional
        Those that are wanted, by default all.

    Returns
    -------
    xarray.Dataset
        Variables named as the attributes of `Friction`, `mu_low` and `mu_high` where the scene asks
        for a band, and `failure`, whose codes other than 0 are those of `failure_message`. Of a
        store numbers are read when they are asked for.

    Raises
    ------
    InvalidInput
        Before anything is computed, but for what only a scene can tell; also for a store that
        exists, or is of another sweep. The message names the key.
    Error
        A store that cannot be written, an executor that ends. What was written can be resumed.

    Examples
    --------
    >>> scene = {
    ...     "surface": {"rms_height_m": 2e-4, "hurst": 0.8, "q0_per_m": 2e3, "q1_per_m": 1e5},
    ...     "rubber": {
    ...         "equilibrium_modulus_pa": 3e6,
    ...         "moduli_pa": [1e9],
    ...         "relaxation_times_s": [1e-6],
    ...     },
    ...     "conditions": {"pressure_pa": 1e5, "velocity_m_s": [1e-3, 1e-2]},
    ... }
    >>> found = asperity.sweep(scene, {"surface.hurst": [0.7, 0.8, 0.9]})  # doctest: +SKIP
    >>> found.mu.sizes  # doctest: +SKIP
    Frozen({'surface.hurst': 3, 'conditions.velocity_m_s': 2})
    """
    resumes = flag(resume, "resume")
    report = _progress(progress)
    if resumes and store is None:
        raise unfit("resume", "True", "needs store=, the store of the earlier run", "True")
    plan = planned(scene, over, variables)
    return computed(plan, executor, store, resume=resumes, progress=report)


def computed(
    plan: Plan,
    executor: Any = None,
    store: Any = None,
    *,
    resume: bool = False,
    force: bool = False,
    progress: Progress | None = None,
) -> Any:
    """The results of a plan. `force` replaces the store of a sweep that is there already."""
    workers = Executor(executor)
    described = Described(plan)
    if store is None:
        memory = Memory(described)
        _fill(memory, plan, cut_of(plan, timed(plan, workers)), workers, progress)
        return memory.finish()
    path = store_path(store)
    if path.suffix == ".nc" and os.path.lexists(path) and not force:
        if not resume:
            refuse_taken(path)
        dataset = open_store(path)
        refuse_another(path, dataset.attrs, described.inputs)
        return dataset
    part = path if path.suffix == ".zarr" else path.with_name(path.name + ".part")
    if resume and os.path.lexists(part):
        opened = ZarrStore.resumed(part, described)
    else:
        there = (path, part) if force else ()
        for old in there:
            refuse_foreign(old)
        if not force:
            refuse_taken(part)
        cut = cut_of(plan, timed(plan, workers))
        for old in there:  # only now is the new sweep known to work
            remove_store(old)
        opened = ZarrStore(part, described, cut)
    with opened as zarr:
        _fill(zarr, plan, zarr.cut, workers, progress)
        dataset = zarr.finish()
        if part == path:
            return dataset
        dataset.close()
        write_netcdf(path, part)
    shutil.rmtree(part)
    return open_store(path)


def planned(scene: Any, over: Any, variables: Any = None, where: Path | None = None) -> Plan:
    """A sweep, checked; `where` is the file that has its axes, where they are in one."""
    with plausible.collected() as notes:
        if isinstance(scene, Mapping):
            path: Path = FilePath("scene")
            tables = scene
        else:
            path = path_of(scene, "scene")
            tables = read_tables(path)
        plan = plan_of(path, tables, over, variables, where or path)
    plan = replace(plan, notes=tuple(notes))
    try:
        pickle.dumps(plan.task)
    except Exception as error:
        raise InvalidInput(f"cannot be sent to workers: {error}", where=plan.path) from error
    return plan


def store_path(store: Any) -> Path:
    path = path_of(store, "store")
    if path.suffix not in (".zarr", ".nc"):
        raise unfit("store", store, "must end in .zarr or .nc")
    if not path.parent.is_dir():
        raise InvalidInput(f"the directory {FilePath(path.parent)} does not exist", where=path)
    return path


def _fill(
    sink: Memory | ZarrStore,
    plan: Plan,
    cut: Sequence[int],
    workers: Executor,
    progress: Progress | None,
) -> None:
    tasks = (plan.box(at, cut) for at in plan.boxes(cut) if not sink.has(at))
    arrived: SimpleQueue[Any] = SimpleQueue()
    pending: set[Any] = set()
    lost: list[str] = []

    def send() -> None:
        for task in islice(tasks, max(0, workers.room - len(pending))):
            future = workers.submit(work, replace(task, store=sink.place))
            pending.add(future)
            future.add_done_callback(arrived.put)

    try:
        send()
        while pending:
            future = arrived.get()
            pending.discard(future)
            try:
                sink.write(result_of(future))
            except Lost as error:
                lost.append(str(error))
            del future  # and with it the numbers
            if progress is not None:
                progress(sink.tally.points, plan.points)
            send()
    finally:
        for future in pending:
            future.cancel()
    if lost:
        raise Error(
            f"{len(lost)} tasks were lost with their workers, resume computes them: {lost[-1]}"
        )


def _progress(progress: Any) -> Progress | None:
    if progress is None or progress is False:
        return None
    if progress is True:
        return bar("sweep")
    if callable(progress):
        function: Progress = progress
        return function
    raise refusal("progress", progress, "a function, True, False or None")


def bar(title: str) -> Progress:
    """A bar with points a second and the time that is left."""
    made = imported("tqdm", "all").tqdm(desc=title, unit=" points", unit_scale=True, delay=1)

    def show(done: int, points: int) -> None:
        made.total = points
        made.update(done - made.n)
        if done == points:
            made.close()

    return show
