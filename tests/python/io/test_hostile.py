"""Small files that would take gigabytes or minutes: one line, in seconds, within 300 MB."""

import io
import json
import os
import struct
import subprocess
import sys
import zipfile
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

SCENE = """
[surface]
rms_height_m = 1e-4
hurst = 0.8
q0_per_m = 1e3
q1_per_m = 1e6
[rubber]
equilibrium_modulus_pa = 1e6
moduli_pa = [1e7]
relaxation_times_s = [1e-3]
[conditions]
pressure_pa = 1e5
velocity_m_s = 1.0
"""
SCANNED = SCENE.replace("rms_height_m = 1e-4\nhurst = 0.8\n", "")
READ = "asperity.read_surface(path, pixel_size=1e-6, unit='m')"
SHOWN = "from asperity.cli import main; sys.exit(main(['friction', path]))"
DROPPED = """
from asperity.app.files import Folder
from asperity.app.opened import opened
opened([(path, open(path, "rb").read())], Folder())
"""


BLOCKS = 20  # of 16 MiB: more than what may be taken


@cache
def zipped(method, *names):
    """Members of zeros, in pieces."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", method, compresslevel=9) as archive:
        for name in names:
            with archive.open(name, "w", force_zip64=True) as member:
                for _ in range(BLOCKS):
                    member.write(bytes(2**24))
    return out.getvalue()


def understated(archive):
    """The same, declared to inflate to 16 bytes."""
    with zipfile.ZipFile(io.BytesIO(archive)) as whole:
        size = whole.infolist()[0].file_size
    for form in ("<Q", "<I"):
        archive = archive.replace(struct.pack(form, size), struct.pack(form, 16))
    return archive


def header(shape):
    out = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        out, {"descr": "<f8", "fortran_order": False, "shape": shape}
    )
    return out.getvalue()


@cache
def array_of_zeros():
    out = io.BytesIO()
    archive = zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED)
    with archive, archive.open("h.npy", "w", force_zip64=True) as member:
        member.write(header((2**21, BLOCKS)))
        for _ in range(BLOCKS):
            member.write(bytes(2**24))
    return out.getvalue()


def many_parts(form):
    return lambda: (SCENE + form.format(".".join(["a"] * 40_000))).encode()


HOSTILE: dict[str, tuple[str, Callable[[], bytes], str]] = {
    "bzip2": ("a.zip", lambda: zipped(zipfile.ZIP_BZIP2, "a.toml"), DROPPED),
    "lzma": ("a.zip", lambda: zipped(zipfile.ZIP_LZMA, "a.toml"), DROPPED),
    "deflate": ("a.zip", lambda: zipped(zipfile.ZIP_DEFLATED, "a.toml"), DROPPED),
    "sizes": ("a.zip", lambda: understated(zipped(zipfile.ZIP_DEFLATED, "a.toml")), DROPPED),
    "npz": ("a.npz", array_of_zeros, READ),
    "npz that is a contact": ("a.npz", array_of_zeros, "asperity.ScanContact.load(path)"),
    "npy": ("a.npy", lambda: header((2**20, 2**20)), READ),
    "key": ("a.toml", many_parts("{} = 1\n"), SHOWN),
    "table": ("a.toml", many_parts("[{}]\n"), SHOWN),
    "key within": ("a.toml", many_parts('[x]\ny = {{ z = """a"""", {} = 1 }}\n'), SHOWN),
    "name of a table": ("a.toml", lambda: (SCENE + f"[{'a' * 3_000_000}]\n").encode(), SHOWN),
    "word": ("a.toml", lambda: (SCENE + f'method = "{"a" * 3_000_000}"\n').encode(), SHOWN),
    "number": ("a.toml", lambda: SCENE.replace("1e5", "1" * 4_000).encode(), SHOWN),
    "name of a file": (
        "a.toml",
        lambda: SCANNED.replace("[surface]", f'[surface]\nfile = "{"a" * 3_000_000}"').encode(),
        SHOWN,
    ),
    "cell": ("a.csv", lambda: b"1,2\n3," + b"a" * 3_000_000, READ),
}


SERVER = """
import contextlib, io, json, os, resource, sys, time
import asperity, asperity.app.opened, asperity.cli

def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024

for line in sys.stdin:
    path, code = json.loads(line)
    if os.fork():
        if os.wait()[1]:
            print("null", flush=True)
        continue
    resource.setrlimit(resource.RLIMIT_CPU, (60, 60))
    before, said = peak(), io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.suppress(SystemExit):
        try:
            exec(code, {"asperity": asperity, "path": path, "sys": sys})
        except asperity.InvalidInput as error:
            print(error, file=sys.stderr)
    print(json.dumps([said.getvalue(), peak() - before, time.process_time()]), flush=True)
    os._exit(0)
"""


@pytest.fixture(scope="module")
def refused():
    """The line that a process of its own says, in 300 MB and 10 s of processor time; what is
    imported is imported once."""
    with subprocess.Popen(
        [sys.executable, "-c", SERVER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as server:
        assert server.stdin is not None
        assert server.stdout is not None

        def ask(path, code):
            print(json.dumps([str(path), code]), file=server.stdin, flush=True)
            answer = json.loads(server.stdout.readline())
            assert answer is not None, "it died"
            said, megabytes, seconds = answer
            assert said.count("\n") == 1, said[:2000]
            assert megabytes < 300
            assert seconds < 10
            return said

        yield ask


@pytest.mark.parametrize("name", HOSTILE)
def test_a_small_file_cannot_take_much(tmp_path, refused, name):
    file, content, code = HOSTILE[name]
    path = tmp_path / file
    path.write_bytes(content())
    assert path.stat().st_size < 2**22
    assert len(refused(path, code)) < 1000


def test_a_file_without_an_end_is_refused(tmp_path, refused):
    endless = Path("/proc/kmsg")
    if not endless.exists() or not os.access(endless, os.R_OK):
        pytest.skip("there is no /proc/kmsg to read")
    for name, code in (("a.toml", SHOWN), ("a.csv", READ), ("a.npy", READ)):
        (tmp_path / name).symlink_to(endless)
        assert "is empty" in refused(tmp_path / name, code)
