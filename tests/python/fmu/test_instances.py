"""An instance of an FMU: begun, misused, kept, forked and freed."""

import os
import resource
import struct
from pathlib import Path

import fmpy
import pytest

from helpers.fmus import CLAMP, INSIDE, NAN, Host, on_linux, same


@on_linux
def test_misuse_is_refused(host):
    for act in (
        lambda: host.set([8], [1.0]),  # an output
        lambda: host.set([999], [1.0]),
        lambda: host.get([31]),
        lambda: host.get([INSIDE]),  # of another type
        lambda: host.step(0.0, -0.1),
        lambda: host.step(NAN, 0.1),
    ):
        with pytest.raises(Exception, match=r"(?i)status 3|error"):
            act()
    assert host.at(1e5, 1e-2)[0] > 0


@on_linux
def test_state_is_kept_and_written(host, road):
    unit = host.unit
    host.set([1, 2], [1e5, 0.1])
    kept = unit.getFMUstate() if host.version == "2.0" else unit.getFMUState()
    as_bytes = (
        unit.serializeFMUstate(kept) if host.version == "2.0" else unit.serializeFMUState(kept)
    )
    host.set([1, 2], [9e5, 1e-4])
    host.clamp(False)
    (unit.setFMUstate if host.version == "2.0" else unit.setFMUState)(kept)
    assert host.get([1, 2, 8]) == same([1e5, 0.1, road.mu(1e5, 0.1)])
    host.set([1, 2], [9e5, 1e-4])
    again = (
        unit.deSerializeFMUstate(as_bytes, kept)
        if host.version == "2.0"
        else unit.deserializeFMUState(as_bytes)
    )
    (unit.setFMUstate if host.version == "2.0" else unit.setFMUState)(
        kept if again is None else again
    )
    assert host.get([1, 2, 8]) == same([1e5, 0.1, road.mu(1e5, 0.1)])


@on_linux
def test_two_instances_do_not_share(files, road, tmp_path):
    one, other = (Host(files["2.0", None], tmp_path / name, name) for name in ("a", "b"))
    one.set([1, 2], [1e5, 0.1])
    other.set([1, 2], [5e5, 0.01])
    assert one.get([8]) == same([road.mu(1e5, 0.1)])
    assert other.get([8]) == same([road.mu(5e5, 0.01)])
    one.end()
    assert other.get([8]) == same([road.mu(5e5, 0.01)])
    other.end()


@on_linux
def test_ten_thousand_instances_leave_no_memory(files, tmp_path):
    host = Host(files["3.0", None], tmp_path)

    def some(count):
        for _ in range(count):
            host.start()
            host.unit.fmi3FreeInstance(host.unit.component)
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = some(1000)
    assert some(9000) - before < 4096  # KiB, of 74 a map


@on_linux
def test_a_forked_child_goes_on(files, road, tmp_path):
    host = Host(files["2.0", None], tmp_path)
    host.set([1, 2], [1e5, 0.1])
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        os.write(write, repr(host.get([8])[0]).encode())
        os._exit(0)
    os.waitpid(child, 0)
    assert float(os.read(read, 100)) == host.get([8])[0] == same(road.mu(1e5, 0.1))
    host.end()


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_an_instance_of_another_fmu_is_refused(files, tmp_path, capfd, fmi):
    host = Host(files[fmi, None], tmp_path / fmi)
    own, other = (fmpy.read_model_description(str(files[fmi, n])).guid for n in (None, 3))
    assert own == (tmp_path / fmi / "resources" / "token.txt").read_text().strip()
    name = {"2.0": "GUID", "3.0": "instantiation token"}[fmi]
    for given in (other, own[:-1], own + " ", own.upper(), "", "{50%d}"):
        host.unit.guid = given
        with pytest.raises(Exception, match="Failed to instantiate"):
            host.unit.instantiate()
        told = f'the {name} "{given}" is that of another FMU: must be "{own}"'
        assert told in capfd.readouterr().out
    host.unit.guid = own
    host.start()
    host.end()


def version(number):
    """The change of a map's content to another version of the layout."""
    return lambda content: content[:12] + struct.pack("<I", number) + content[16:]


@on_linux
@pytest.mark.parametrize(
    ("file", "change", "message"),
    [
        ("token.txt", None, "must hold the GUID or instantiation token"),
        ("token.txt", lambda _: b"\n", "must hold the GUID or instantiation token"),
        ("points.txt", None, "must hold a number of points"),
        ("points.txt", lambda _: b"0", "must hold a number of points"),
        ("points.txt", lambda _: b"2", "has 2 points: must have the 1 of"),
        ("friction.fmap", None, "cannot be read"),
        ("friction.fmap", lambda _: b"ASPERMAP", "is truncated: 8 bytes"),
        ("friction.fmap", version(5), "has layout version 5: must be 4"),
        ("friction.fmap", version(1 << 24), "has layout version 16777216: must be 4"),
    ],
)
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_damaged_resources_give_no_instance(files, tmp_path, capfd, fmi, file, change, message):
    host = Host(files[fmi, None], tmp_path)
    damaged = Path(host.folder, "resources", file)
    if change is None:
        damaged.unlink()
    else:
        damaged.write_bytes(change(damaged.read_bytes()))
    with pytest.raises(Exception, match="Failed to instantiate"):
        host.unit.instantiate(loggingOn=True)
    said = capfd.readouterr()
    assert f"{file} {message}" in said.out + said.err


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_no_step_goes_past_the_stop_time(files, tmp_path, capfd, fmi):
    host = Host(files[fmi, None], tmp_path / fmi, stop=1.0)
    time = 0.0
    for _ in range(1000):  # their sum ends 1e-14 beyond 1
        host.step(time, 0.001)
        time += 0.001
    assert time > 1.0
    for start, size in ((1.0, 0.001), (0.5, 0.6), (2.0, 0.0)):
        with pytest.raises(Exception, match=r"(?i)status 3|error"):
            host.step(start, size)
        assert "ends after the stop time, 1.000000 s" in capfd.readouterr().out
    host.unit.reset()
    if fmi == "2.0":
        host.unit.setupExperiment(startTime=0.0)
    host.unit.enterInitializationMode()
    host.unit.exitInitializationMode()
    host.step(5.0, 0.1)  # no stop time is told now
    host.end()


@on_linux
@pytest.mark.parametrize(("start", "stop"), [(NAN, 1.0), (0.0, NAN), (2.0, 1.0)])
def test_a_simulation_that_ends_before_it_begins_is_refused(files, tmp_path, start, stop):
    for fmi in ("2.0", "3.0"):
        host = Host(files[fmi, None], tmp_path / f"{fmi} {start} {stop}")
        host.unit.reset()
        begin = host.unit.setupExperiment if fmi == "2.0" else host.unit.enterInitializationMode
        with pytest.raises(Exception, match=r"(?i)status 3|error"):
            begin(startTime=start, stopTime=stop)
        host.unit.freeInstance()


@on_linux
@pytest.mark.parametrize("asked", [{"eventModeUsed": True}, {"requiredIntermediateVariables": [8]}])
def test_event_mode_is_refused(files, tmp_path, capfd, asked):
    host = Host(files["3.0", None], tmp_path / next(iter(asked)))
    with pytest.raises(Exception, match="Failed to instantiate"):
        host.unit.instantiate(**asked)
    assert "neither an event mode nor intermediate updates" in capfd.readouterr().out
    described = host.description.coSimulation
    assert not described.hasEventMode
    assert not described.providesIntermediateUpdate


NOT_NOW = r"(?i)status 3|error"


def _phases(host, unit):
    """What there is to do with an instance, by name, and where the standards allow it."""
    two = host.version == "2.0"
    setup = (lambda: unit.setupExperiment(startTime=0.0)) if two else None
    acts = {
        "set": (lambda: host.set([1], [1e5]), "before during after"),
        "get": (lambda: host.get([8]), "during after ended"),
        "flag": (lambda: unit.getBoolean([CLAMP]), "during after ended"),
        "inside": (host.inside, "during after ended"),
        "switch": (lambda: host.clamp(True), "before during after"),
        "step": (lambda: host.step(0.0, 0.1), "after"),
        "exit": (unit.exitInitializationMode, "during"),
        "enter": (unit.enterInitializationMode, "before"),
        "terminate": (unit.terminate, "after"),
    }
    return acts | ({"setup": (setup, "before")} if two else {})


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_calls_are_allowed_in_the_phases_of_the_standard(files, tmp_path, fmi):
    """Each act in each phase: allowed, or refused and the instance goes on."""
    host = Host(files[fmi, None], tmp_path / fmi)
    unit = host.unit
    ways = {
        "before": [],
        "during": [unit.enterInitializationMode],
        "after": [unit.enterInitializationMode, unit.exitInitializationMode],
        "ended": [unit.enterInitializationMode, unit.exitInitializationMode, unit.terminate],
    }
    for phase, way in ways.items():
        for name, (act, allowed) in _phases(host, unit).items():
            unit.reset()
            for one in way:
                one()
            if phase in allowed.split():
                act()
                continue
            with pytest.raises(Exception, match=NOT_NOW):
                act()
            if phase == "after":
                host.step(0.0, 0.1)
            elif phase == "ended":
                assert host.get([8])[0] > 0, name
    unit.reset()
    with pytest.raises(Exception, match=NOT_NOW):
        host.step(0.0, 0.1)
