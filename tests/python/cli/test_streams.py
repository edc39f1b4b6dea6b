"""Standard streams that are closed, full or a terminal: a result is never lost without a word."""

import struct
import subprocess
import sys
import zlib

import pytest

from asperity import FrictionMap, PronySeries, SelfAffineSpectrum, friction_map
from asperity.cli.main import main

FRICTION = "friction scene.toml"
SHOWN = ["--version", "friction --help", "map --info road.fmap"]


def shell(line):
    """What a shell makes of `$A ...`, the command."""
    return subprocess.run(
        ["sh", "-c", f'A="{sys.executable} -m asperity"; {line}'],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )


def saved_map(folder, text=b""):
    """A map's file, into which the text is written as it is."""
    spectrum = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=2e4)
    rubber = PronySeries(equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6])
    box = {"pressure": (5e4, 5e5), "velocity": (1e-4, 1), "rtol": 0.1, "checked": 0}
    content = bytearray(friction_map(spectrum, rubber, **box, text="x" * len(text)).to_bytes())
    at = len(content) - 8 - -(-len(text) // 8) * 8
    content[at : at + len(text)] = text
    content[-8:] = struct.pack("<II", zlib.crc32(bytes(content[:-8])), 0)
    (folder / "road.fmap").write_bytes(content)
    return bytes(content)


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        *((f"{line} >/dev/full", "No space left on device") for line in SHOWN),
        (f"{FRICTION} >&-", "is closed"),
        ("--help >&-", "is closed"),
    ],
)
def test_a_result_that_cannot_be_shown_is_an_error(folder, line, reason):
    saved_map(folder)
    done = shell(f"$A {line}")
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == f"asperity: standard output: {reason}"
    assert "Traceback" not in done.stderr
    assert "Exception" not in done.stderr


def test_notes_may_be_lost_and_the_result_stays(folder):
    wanted = shell(f"$A {FRICTION}")
    assert wanted.returncode == 0
    assert "note: " in wanted.stderr
    for stream in ("2>/dev/full", "2>&-"):
        done = shell(f"$A {FRICTION} {stream}")
        assert (done.returncode, done.stdout, done.stderr) == (0, wanted.stdout, "")
    for stream in ("2>/dev/full", "<&- >&- 2>&-"):
        done = shell(f"$A {FRICTION} --output mu.csv {stream}")
        assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
        assert (folder / "mu.csv").read_text() == wanted.stdout


@pytest.mark.parametrize("line", ["frictoin 2>&-", "friction none.toml 2>/dev/full"])
def test_the_exit_status_does_not_need_standard_error(folder, line):
    done = shell(f"$A {line}")
    assert (done.returncode, done.stdout, done.stderr) == (2, "", "")


def test_no_text_of_a_map_is_obeyed_by_a_terminal(folder, capfd):
    text = b"note: \x1b[2Jgone\r\nfile = \xff\xfe\x9b\x1b]0;title\x07\n\xe2\x80\xae \xc2\xb5"
    content = saved_map(folder, text)
    loaded = FrictionMap.load("road.fmap")
    assert loaded.to_bytes() == content
    for form in ([], ["--json"]):
        assert main(["map", "--info", "road.fmap", *form]) == 0
        shown = "".join(capfd.readouterr())
        assert all(one.isprintable() or one == "\n" for one in shown)
    assert shown.count("title") == 1


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("a\nb", r"'a\nb.toml'"),
        ("a\x1b[31mb", r"'a\x1b[31mb.toml'"),
        ("a\x9bb", r"'a\x9bb.toml'"),
        ("two words", "two words.toml"),
        ("caf\udce9", r"'caf\udce9.toml'"),
    ],
)
def test_the_name_of_a_file_stays_in_its_line(folder, capfd, name, shown):
    assert main(["friction", f"{name}.toml"]) == 2
    error = capfd.readouterr().err
    assert error == f"asperity: {shown}: cannot be read: No such file or directory\n"
    (folder / f"{name}.toml").write_text((folder / "scene.toml").read_text())
    arguments = ["friction", f"{name}.toml", "scene.toml"]
    for form in ([], ["--json"]):
        assert main([*arguments, *form]) == 0
        assert main([*arguments, *form, "--output", f"{name}.csv"]) == 0
        out, notes = capfd.readouterr()
        assert all(one.isprintable() or one == "\n" for one in out + notes)
        assert all(line.startswith(("note: ", "next: ")) for line in notes.splitlines())
