"""Maps as Functional Mock-up Units: the map's outputs, whatever standard, host and platform."""

import os
import platform
import resource
import shutil
import subprocess
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu

import asperity
from asperity import (
    WLF,
    Adhesion,
    FrictionMap,
    Heating,
    InvalidInput,
    PronySeries,
    SelfAffineSpectrum,
    export_fmu,
    friction_map,
)
from asperity.fmu.export import PLATFORMS, platforms

ROOT = Path(__file__).parents[3]
EXAMPLES, INCLUDE = ROOT / "cpp" / "examples", ROOT / "cpp" / "include"
HEADERS = Path(fmpy.__file__).parent / "c-code"
BOX = {"pressure": (5e4, 1e6), "velocity": (1e-5, 3.0)}
OUTPUTS = {"mu": 8, "mu_hysteresis": 9, "mu_adhesion": 10, "contact_area": 11, "traction": 12}
SLOPES = {"dmu_dlnp": 13, "dmu_dlnv": 14}
INSIDE, A_T, MAX_ERROR, CLAMP = 15, 24, 25, 26
NAN = float("nan")
on_linux = pytest.mark.skipif(
    "x86_64-linux" not in platforms(), reason=f"no FMU binary on {platform.machine()}"
)


@pytest.fixture(scope="module")
def road() -> FrictionMap:
    surface = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=2e4)
    rubber = PronySeries(
        equilibrium_modulus=3e6,
        moduli=[1e9, 3e8, 1e8, 1e7],
        relaxation_times=[1e-8, 1e-6, 1e-4, 1e-2],
    )
    return friction_map(surface, rubber, adhesion=Adhesion(shear_stress=8.3e6), **BOX, checked=0)


@pytest.fixture(scope="module")
def files(road, tmp_path_factory):
    """{(standard, points): path} of four FMUs."""
    folder = tmp_path_factory.mktemp("fmu")
    made = {}
    for fmi in ("2.0", "3.0"):
        for points in (None, 3):
            made[fmi, points] = folder / f"{fmi}-{points}.fmu"
            export_fmu(road, made[fmi, points], fmi=fmi, points=points)
    return made


class Host:
    """An instance of an FMU, by FMPy, with one interface for both standards."""

    def __init__(self, path, folder, name="one"):
        self.description = fmpy.read_model_description(str(path))
        self.version = self.description.fmiVersion
        kind = FMU2Slave if self.version == "2.0" else FMU3Slave
        self.folder = fmpy.extract(str(path), str(folder))
        self.unit = kind(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.messages = []
        self.start()

    def start(self):
        self.unit.instantiate()
        if self.version == "2.0":
            self.unit.setupExperiment(startTime=0.0)
        self.unit.enterInitializationMode()
        self.unit.exitInitializationMode()

    def set(self, references, values):
        (self.unit.setReal if self.version == "2.0" else self.unit.setFloat64)(references, values)

    def get(self, references, count=None):
        if self.version == "2.0":
            return self.unit.getReal(references)
        return self.unit.getFloat64(references, nValues=count or len(references))

    def inside(self, count=1):
        if self.version == "2.0":
            return self.unit.getInteger([INSIDE])[0]
        return self.unit.getInt32([INSIDE], nValues=count)[0]

    def clamp(self, value):
        self.unit.setBoolean([CLAMP], [value])

    def step(self, at=0.0, size=0.1):
        self.unit.doStep(at, size)

    def at(self, pressure, velocity):
        self.set([1, 2], [pressure, velocity])
        self.step()
        return self.get([*OUTPUTS.values(), *SLOPES.values()])

    def end(self):
        self.unit.terminate()
        self.unit.freeInstance()


@pytest.fixture(params=["2.0", "3.0"])
def host(request, files, tmp_path):
    made = Host(files[request.param, None], tmp_path)
    yield made
    made.end()


def of_map(road, pressure, velocity, **options):
    """The seven outputs of one point from the map itself."""
    parts = [
        getattr(road, name)(pressure, velocity, **options)
        for name in ("mu", "hysteresis", "adhesion", "contact_area", "traction")
    ]
    slopes = road.derivatives(pressure, velocity, **options)
    return [*parts, slopes.dmu_dlnp, slopes.dmu_dlnv]


def same(numbers):
    """Equal to 1e-13: the batch of Python may take other instructions than the FMU."""
    return pytest.approx(np.asarray(numbers).tolist(), rel=1e-13, abs=1e-13)


def points(count, seed=1):
    draws = np.random.default_rng(seed)
    pressure = np.exp(draws.uniform(*np.log(BOX["pressure"]), count))
    velocity = np.exp(draws.uniform(*np.log(BOX["velocity"]), count))
    return pressure, velocity * draws.choice([-1, 1], count)


def test_both_standards_are_valid(files):
    for path in files.values():
        assert validate_fmu(str(path)) == []


def test_the_same_map_gives_the_same_bytes(road, files, tmp_path):
    export_fmu(road, tmp_path / "again.fmu", fmi="3.0", points=3)
    assert (tmp_path / "again.fmu").read_bytes() == files["3.0", 3].read_bytes()


def test_description_has_units_and_words(files):
    for (fmi, count), path in files.items():
        described = fmpy.read_model_description(str(path))
        assert described.fmiVersion == fmi
        listed = {variable.name: variable for variable in described.modelVariables}
        first = "pressure[1]" if fmi == "2.0" and count else "pressure"
        assert listed[first].unit == "Pa"
        assert listed[first.replace("pressure", "traction")].unit == "Pa"
        assert listed[first.replace("pressure", "velocity")].unit == "m/s"
        assert all(one.description for one in described.modelVariables if one.name != "time")
        if fmi == "2.0" and count:
            assert [name for name in listed if name.startswith("mu[")] == [
                "mu[1]",
                "mu[2]",
                "mu[3]",
            ]


@on_linux
def test_outputs_are_those_of_the_map(host, road):
    for pressure, velocity in zip(*points(200), strict=True):
        found = host.at(float(pressure), float(velocity))
        assert found == same(of_map(road, float(pressure), float(velocity)))
        assert host.inside() == 1


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_simulation_with_variable_steps(files, road, fmi):
    times = np.array([0, 0.03, 0.1, 0.37, 0.4, 1.0])
    signals = np.array(
        [(t, 1e5 * (1 + t), 0.3 - 0.29 * t) for t in times],
        dtype=[("time", float), ("pressure", float), ("velocity", float)],
    )
    found = fmpy.simulate_fmu(
        str(files[fmi, None]),
        input=signals,
        output=["mu", "time"] if fmi == "3.0" else ["mu"],
        stop_time=1.0,
        output_interval=0.05,
        start_values={"clamp": False},
    )
    # inputs are held through a step
    before = found["time"][1:] - 0.05
    expected = road.mu(
        np.interp(before, times, signals["pressure"]), np.interp(before, times, signals["velocity"])
    )
    np.testing.assert_allclose(found["mu"][1:], expected, rtol=1e-13)


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_many_points_at_once(files, road, tmp_path, fmi):
    host = Host(files[fmi, 3], tmp_path)
    pressure, velocity = points(3, seed=2)
    if fmi == "2.0":
        references = [1 + 32 * i for i in range(3)] + [2 + 32 * i for i in range(3)]
        host.set(references, [*pressure, *velocity])
        found = host.get([8, 40, 72])
    else:
        host.set([1, 2], [*pressure, *velocity])
        found = host.get([8], 3)
    assert list(found) == same(road.mu(pressure, velocity))
    host.end()


@on_linux
@pytest.mark.parametrize(
    ("pressure", "velocity"), [(1e9, 0.1), (1e5, 0.0), (-1.0, 0.1), (1e5, 50.0), (1.0, -1e-9)]
)
def test_outside_is_clamped_or_nan(host, road, pressure, velocity):
    for clamp, outside in ((True, "clamp"), (False, "nan")):
        host.clamp(clamp)
        np.testing.assert_array_equal(
            host.at(pressure, velocity), of_map(road, pressure, velocity, outside=outside)
        )
        assert host.inside() == 0


@on_linux
@pytest.mark.parametrize(("pressure", "velocity"), [(NAN, 0.1), (1e5, NAN), (1e5, float("inf"))])
def test_nan_in_nan_out(host, pressure, velocity):
    host.clamp(False)
    assert np.isnan(host.at(pressure, velocity)).all()
    assert host.inside() == 0
    assert host.at(1e5, 0.1)[0] > 0  # and it goes on


@on_linux
def test_status_outside_is_a_warning(files, tmp_path):
    host = Host(files["2.0", None], tmp_path)
    statuses = []
    raw = host.unit.dll.fmi2DoStep
    for pressure in (1e5, 1e9, NAN, 1e5):
        host.set([1], [pressure])
        statuses.append(raw(host.unit.component, *map(_double, (0.0, 0.1)), 0))
    assert statuses == [0, 1, 1, 0]
    host.end()


def _double(x):
    import ctypes

    return ctypes.c_double(x)


@on_linux
def test_another_temperature(host, road):
    host.set([A_T], [3.0])
    assert host.at(1e5, 1e-2) == same(of_map(road, 1e5, 1e-2, a_T=3.0))


@on_linux
def test_certified_error_is_told(host, road):
    assert host.get([MAX_ERROR]) == [road.max_error]


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
def test_directional_derivatives(host, road):
    unit = host.unit
    h = 1e-5
    for pressure, velocity in zip(*points(20, seed=3), strict=True):
        pressure, velocity = float(pressure), float(velocity)
        host.set([1, 2], [pressure, velocity])
        for name, reference in OUTPUTS.items():
            for known, at in ((1, pressure), (2, velocity)):
                if host.version == "2.0":
                    slope = unit.getDirectionalDerivative([reference], [known], [2.0])[0]
                else:
                    slope = unit.getDirectionalDerivative([reference], [known], [2.0], 1)[0]
                look = getattr(
                    road, {"mu_hysteresis": "hysteresis", "mu_adhesion": "adhesion"}.get(name, name)
                )
                sides = [
                    look(
                        pressure * (np.exp(s * h) if known == 1 else 1),
                        velocity * (np.exp(s * h) if known == 2 else 1),
                        outside="clamp",
                    )
                    for s in (-1, 1)
                ]
                # second order in h; rounding of the differences is 1e-16 / 1e-5
                size = max(abs(side) for side in sides)
                assert slope * at == pytest.approx((sides[1] - sides[0]) / h, abs=1e-6 * size)


TREAD = Heating(density=1200, heat_capacity=1650, conductivity=0.23, contact_diameter=1e-3)
LAW = WLF(c1=8.86, c2=101.6, reference_temperature=293.15)


def hot_map(temperature: float | tuple[float, float]) -> FrictionMap:
    surface = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=2e4)
    rubber = PronySeries(
        equilibrium_modulus=3e6,
        moduli=[4e8, 3e8, 1e8, 3e7, 1e7],
        relaxation_times=[1e-8, 1e-7, 1e-6, 1e-4, 1e-2],
    )
    box = {"pressure": (8e4, 4e5), "velocity": (1e-2, 20.0), "temperature": temperature}
    return friction_map(surface, rubber, **box, shift=LAW, heating=TREAD, checked=0, rtol=1e-3)


@pytest.fixture(scope="module")
def hot_road() -> FrictionMap:
    return hot_map((283.15, 303.15))


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_heat_remembers_the_distance(hot_road, tmp_path, fmi):
    export_fmu(hot_road, tmp_path / "hot.fmu", fmi=fmi)
    assert validate_fmu(str(tmp_path / "hot.fmu")) == []
    host = Host(tmp_path / "hot.fmu", tmp_path / "x")
    host.set([1, 2, 3], [2e5, 1.0, 290.0])
    at = {"pressure": 2e5, "velocity": 1.0, "temperature": 290.0}
    for i in range(5):
        assert host.get([8]) == same([hot_road.mu(**at, distance=i * 1e-3)])
        assert host.get([16]) == pytest.approx([i * 1e-3])
        host.step(i * 1e-3, 1e-3)
    assert host.get([8])[0] < hot_road.mu(**at, distance=0.0)

    host.set([2], [-1.0])  # slides back
    host.step(1.0, 2e-3)
    assert host.get([16]) == pytest.approx([2e-3])
    assert host.get([8]) == same([hot_road.mu(**at, distance=2e-3)])
    host.set([2], [0.0])
    host.step()
    assert host.get([16]) == [0.0]
    host.set([2], [1.0])
    host.step(1.0, 3e-3)
    host.unit.setBoolean([4], [True])
    host.step(1.0, 1e-3)
    assert host.get([16]) == pytest.approx([1e-3])  # the reset, and this step

    host.unit.setBoolean([27], [False])  # without memory
    assert host.get([8]) == same([hot_road.mu(**at)])
    host.set([3], [350.0])  # beyond the map
    assert host.inside() == 0
    assert host.get([8]) == same([hot_road.mu(2e5, 1.0, temperature=303.15)])
    with pytest.raises(Exception, match=r"(?i)status 3|error"):
        host.set([A_T], [2.0])  # leads from no temperature to another here
    host.end()


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


def compiled(command, source, *options, target):
    if shutil.which(command) is None:
        pytest.skip(f"no {command}")
    subprocess.run([command, *options, source, "-o", target, "-ldl"], check=True)
    return target


STRICT = ("-Wall", "-Wextra", "-Werror")


@pytest.fixture(scope="module")
def c_host(tmp_path_factory):
    """The host in C, built against the standards' headers."""
    target = tmp_path_factory.mktemp("host") / "host"
    options = ("-std=c11", "-D_GNU_SOURCE", *STRICT, f"-I{HEADERS}")
    return compiled("gcc", EXAMPLES / "fmu_host" / "host.c", *options, target=target)


@pytest.fixture(scope="module")
def asked():
    """The bits of 10,000 points, three of them outside, a line each."""
    pressure, velocity = points(10000, seed=5)
    pressure[:3] = [1e9, -1.0, 1.0]
    bits = np.stack([pressure, velocity], axis=1).view(np.uint64).tolist()
    return "".join(
        f"{p >> 32:x} {p & (2**32 - 1):x} {v >> 32:x} {v & (2**32 - 1):x}\n" for p, v in bits
    )


@pytest.fixture(scope="module")
def answers(road, asked, tmp_path_factory):
    """What the map's own header gives, to the last digit."""
    folder = tmp_path_factory.mktemp("look_up")
    road.save(folder / "road.fmap")
    options = ("-std=c++17", "-O2", "-ffp-contract=off", *STRICT, f"-I{INCLUDE}")
    program = compiled(
        "g++", ROOT / "tests" / "fmu" / "look_up.cpp", *options, target=folder / "look_up"
    )
    command = [program, folder / "road.fmap"]
    return subprocess.run(command, input=asked, capture_output=True, text=True, check=True).stdout


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_a_host_in_c_gets_the_digits_of_the_map(files, c_host, asked, answers, tmp_path, fmi):
    fmpy.extract(str(files[fmi, None]), str(tmp_path))
    folder = "linux64" if fmi == "2.0" else "x86_64-linux"
    resources = tmp_path / "resources"
    address = resources.as_uri() if fmi == "2.0" else f"{resources}/"
    command = [c_host, tmp_path / "binaries" / folder / "friction.so", address, fmi[0]]
    found = subprocess.run(command, input=asked, capture_output=True, text=True, check=True)
    assert found.stdout == answers
    assert found.stderr.count("outside of the map") == 1  # said once


WINE = next(
    (p for p in ("/usr/lib/wine/wine64", shutil.which("wine64")) if p and Path(p).exists()), None
)


@on_linux
@pytest.mark.parametrize("heat", [False, True])
def test_a_tire_by_an_fmu_is_that_by_its_map(road, tmp_path, heat):
    fmap = hot_map(293.15) if heat else road
    fmap.save(tmp_path / "road.fmap")
    export_fmu(fmap, tmp_path / "road.fmu", points=200)
    fmpy.extract(str(tmp_path / "road.fmu"), str(tmp_path / "road"))
    options = ("-std=c++17", "-O2", *STRICT)
    forces = []
    for name, include, at in (("brush_map", INCLUDE, "road.fmap"), ("brush_fmu", HEADERS, "road")):
        source, target = EXAMPLES / name / "main.cpp", tmp_path / name
        compiled("g++", source, *options, f"-isystem{include}", target=target)
        ran = subprocess.run([target, tmp_path / at], capture_output=True, text=True, check=True)
        rows = [line.split(",")[:3] for line in ran.stdout.splitlines()]
        assert rows[0] == ["slip", "force_over_load", "sliding_share"]
        forces.append(np.array(rows[1:], float))
    np.testing.assert_array_equal(*forces)


@pytest.mark.skipif(
    WINE is None or "x86_64-windows" not in platforms(), reason="no wine, or no FMU for Windows"
)
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_windows_gets_the_digits_of_the_map(files, asked, answers, tmp_path, fmi):
    compiler, options = "x86_64-w64-mingw32-gcc-posix", ("-std=c11", f"-I{HEADERS}")
    if shutil.which(compiler) is None:
        pytest.skip(f"no {compiler}")
    host = tmp_path / "host.exe"
    subprocess.run([compiler, *options, EXAMPLES / "fmu_host" / "host.c", "-o", host], check=True)
    fmpy.extract(str(files[fmi, None]), str(tmp_path))
    folder = "win64" if fmi == "2.0" else "x86_64-windows"
    resources = f"file:///Z:{tmp_path}/resources" if fmi == "2.0" else f"Z:{tmp_path}\\resources\\"
    found = subprocess.run(
        [WINE, "host.exe", f"binaries\\{folder}\\friction.dll", resources, fmi[0]],
        input=asked,
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "WINEDEBUG": "-all", "WINEPREFIX": str(tmp_path / "wine")},
        check=True,
    )
    assert found.stdout == answers


@pytest.mark.skipif(shutil.which("g++") is None, reason="no C++ compiler")
def test_sources_build_anywhere(files, tmp_path):
    """The sources in the FMU are whole, and their types are those of the standards' headers."""
    fmpy.extract(str(files["3.0", None]), str(tmp_path))
    command = ["g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared", "-I."]
    headers = ["-DASPERITY_FMI_HEADERS", f"-I{HEADERS}"]
    for more in ([], headers):
        subprocess.run(
            [*command, *more, "fmu.cpp", "-o", "friction.so"], cwd=tmp_path / "sources", check=True
        )


def test_binaries_carry_no_gpl(files):
    with zipfile.ZipFile(files["2.0", None]) as archive:
        names = archive.namelist()
        assert "documentation/licenses/license.txt" in names
        sources = [name for name in names if name.startswith("sources/")]
        for name in sources:
            assert "SPDX-License-Identifier: 0BSD" in archive.read(name).decode()
        folders = {PLATFORMS[one][0] for one in platforms()}
        assert folders == {name.split("/")[1] for name in names if name.startswith("binaries/")}


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"name": "my road"}, r"name = 'my road': must be an identifier of C, such as friction"),
        ({"name": ""}, r"name = '': must be an identifier of C"),
        ({"fmi": "1.0"}, r'fmi = "1.0": must be one of "2.0", "3.0"'),
        ({"points": 0}, r"points = 0: must be a whole number, from 1 to 1000000"),
        ({"points": 2.5}, r"points = 2.5: must be a whole number"),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(road, tmp_path, options, message):
    with pytest.raises(InvalidInput, match=message):
        export_fmu(road, tmp_path / "road.fmu", **options)
    assert list(tmp_path.iterdir()) == []


def test_other_bad_input(road, tmp_path):
    with pytest.raises(InvalidInput, match=r"^map = 3: must be a FrictionMap$"):
        export_fmu(3, tmp_path / "road.fmu")
    with pytest.raises(InvalidInput, match=r"cannot be written: "):
        export_fmu(road, tmp_path / "missing" / "road.fmu")


def test_command(road, tmp_path, capsys):
    from asperity.cli import main

    road.save(tmp_path / "road.fmap")
    output = tmp_path / "road.fmu"
    assert main(["fmu", str(tmp_path / "road.fmap"), "--output", str(output), "--fmi", "3.0"]) == 0
    assert "binaries = " in capsys.readouterr().out
    assert validate_fmu(str(output)) == []
    assert main(["fmu", str(output), "--output", str(tmp_path / "no.fmu")]) == 2
    assert "is no friction map: it begins otherwise" in capsys.readouterr().err
    assert main(["fmu", str(tmp_path / "road.fmap"), "--output", str(output), "--name", "1"]) == 2
    assert "--name = '1': must be an identifier of C" in capsys.readouterr().err
    assert main(["fmu", str(output), "--output", str(output)]) == 2
    assert "is an input" in capsys.readouterr().err
    assert not (tmp_path / "no.fmu").exists()
    assert asperity.export_fmu is export_fmu
