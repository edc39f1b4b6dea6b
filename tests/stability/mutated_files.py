"""Files of every kind, mutated: each is read, or refused in one line that names it.

python tests/stability/mutated_files.py [--files N] [--seed S] [KIND...]

Every file is given to the shell command that reads it. Allowed ends: a result (exit status 0), or
one line and the status 1 or 2, within a minute of this process's time and --gigabytes of memory.
Anything else, a traceback above all, is printed with the mutation and fails the run.
"""

import contextlib
import inspect
import io
import random
import resource
import signal
import struct
import sys
import tempfile
import traceback
import warnings
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
from options import options

import asperity
from asperity.cli.main import main as command
from asperity_scripts.validate.contacts import read_contacts

SECONDS = 60
SCENE = """\
[surface]
rms_height_m = 1e-5
hurst = 0.8
q0_per_m = 2e3
q1_per_m = 1e5

[rubber]
equilibrium_modulus_pa = 3e6
moduli_pa = [1e7, 1e8]
relaxation_times_s = [1e-2, 1e-5]

[conditions]
pressure_pa = [1e5, 2e5]
velocity_m_s = { from = 1e-3, to = 1, points = 3 }

[correction]
kind = "s-factor"

[adhesion]
shear_stress_pa = 5e6

[solver]
rtol = 1e-4
"""
MASTER = SCENE.replace(
    SCENE[SCENE.index("equilibrium") : SCENE.index("[conditions]")], 'master_curve = "{file}"\n'
)
HARD = [
    "nan",
    "inf",
    "-inf",
    "1e400",
    "-1",
    "0",
    "1e-320",
    "9" * 20,
    "1,5",
    "0x1F",
    "1_000",
    "\xb5",
]
HARD += ["\x00", "\x1b[31m", "\udcff"]


def scan() -> np.ndarray:
    spectrum = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=2e3, q1=1e5)
    return asperity.synthesize(spectrum, shape=(24, 20), pixel_size=3e-5, seed=1).heights


def lines(rows: object, header: str = "") -> bytes:
    text = "\n".join(",".join(f"{cell:.6g}" for cell in row) for row in rows)
    return f"{header}\n{text}\n".lstrip("\n").encode()


def saved(save: Callable[..., None], **arrays: np.ndarray) -> bytes:
    out = io.BytesIO()
    save(
        out, *([] if save is np.savez else arrays.values()), **(arrays if save is np.savez else {})
    )
    return out.getvalue()


def fmap() -> bytes:
    spectrum = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=2e3, q1=1e5)
    rubber = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e7], relaxation_times=[1e-2])
    box = {"pressure": (1e4, 1e6), "velocity": (1e-3, 1.0), "rtol": 0.01, "checked": 0}
    return asperity.friction_map(spectrum, rubber, **box, text="made = 'here'\n").to_bytes()


def isotherms() -> bytes:
    rows = [
        (f, t, 1e6 + 1e7 * w * w / (1 + w * w), 1e5 + 1e7 * w / (1 + w * w))
        for t, shift in ((10, 1e2), (25, 1.0), (40, 1e-2))
        for f in np.geomspace(0.1, 100, 8)
        for w in (f * shift,)
    ]
    return lines(rows, "f,T,G1,G2")


DMA = ["--columns", "frequency=f,temperature=T,storage=G1,loss=G2", "--modulus", "G"]
DMA += ["--units", "frequency=Hz,temperature=C,modulus=Pa"]
SPECTRUM = ["spectrum", "{file}", "--pixel-size", "3e-5", "--unit", "m"]
HEADER = "# Channel: height\n# Width: 600 µm\n# Height: 720 µm\n# Value units: m\n"


def table(rows: object) -> bytes:
    return lines(rows).replace(b",", b"\t")


def kinds() -> dict[str, tuple[str, bytes, list[str]]]:
    """(name of the file, its content, the command that reads it) by kind."""
    h = scan()
    w = np.geomspace(1e-2, 1e8, 30)
    master = np.column_stack([w, 3e6 + 1e8 * w / (w + 1e4), 1e7 * w / (w + 1e4) + 1e5])
    measured = [
        (v, 0.3 + 8 * np.exp(-0.3 * np.log10(v / 0.01) ** 2) / 10, p)
        for p in (1e5, 2e5)
        for v in np.geomspace(1e-3, 1, 6)
    ]
    shifts = [(283.15, 2), (298.15, 0), (313.15, -2)]
    bem = Path(inspect.getfile(read_contacts)).with_name("bem_area.csv").read_bytes()
    return {
        "scene": ("f.toml", SCENE.encode(), ["friction", "{file}"]),
        "npy": ("f.npy", saved(np.save, h=h), SPECTRUM),
        "npy32": ("f.npy", saved(np.save, h=h.astype(np.float32)), SPECTRUM),
        "npz": ("f.npz", saved(np.savez, h=h), SPECTRUM),
        "csv": ("f.csv", lines(h), SPECTRUM),
        "line": ("f.txt", lines(h[:1].T), SPECTRUM),
        "header": ("f.txt", HEADER.encode() + table(h), ["spectrum", "{file}"]),
        "master": ("f.csv", lines(master, ",".join(MASTER_COLUMNS)), ["friction", "{scene}"]),
        "isotherms": ("f.csv", isotherms(), ["rubber", "{file}", *DMA]),
        "shifts": (
            "f.csv",
            lines(shifts, "temperature_k,log10_a_t"),
            [*SHIFTED, "--shift", "{file}"],
        ),
        "measured": (
            "f.csv",
            lines(measured, "velocity_m_s,mu,pressure_pa"),
            ["fit", "{scene}", "{file}"],
        ),
        "contacts": ("f.csv", b"\n".join(bem.splitlines()[:12]) + b"\n", []),
        "map": ("f.fmap", fmap(), ["map", "--info", "{file}"]),
    }


MASTER_COLUMNS = ("angular_frequency_rad_s", "storage_modulus_pa", "loss_modulus_pa")
SHIFTED = ["rubber", "{dma}", *DMA]


def mutated(content: bytes, draw: random.Random) -> bytes:
    """One to three changes of bytes, words, lines or parts."""
    data = bytearray(content)
    for _ in range(draw.choice((1, 1, 1, 2, 3))):
        size = len(data)
        at = draw.randrange(size + 1)
        other = draw.randrange(size + 1)
        first, last = min(at, other), max(at, other)
        match draw.randrange(14):
            case 0:
                data[at : at + 1] = bytes([draw.randrange(256)])
            case 1:
                del data[at:]
            case 2:
                del data[first:last]
            case 3:
                data[at:at] = data[first : min(last, first + 1000)]
            case 4:
                data[at:at] = draw.randbytes(draw.randint(1, 16))
            case 5:
                data[at : at + 8] = struct.pack(
                    "<d", draw.choice((np.nan, np.inf, -1e300, 0, 1e-320))
                )
            case 6:
                data[at : at + 4] = struct.pack("<I", draw.choice((0, 1, 2**31 - 1, 2**32 - 1)))
            case 7 | 8 | 9:  # a word of a text
                words = bytes(data).split(draw.choice((b",", b" ", b"\n", b"\t")))
                chosen = draw.randrange(len(words))
                begin = sum(len(word) + 1 for word in words[:chosen])
                hard = draw.choice(HARD).encode(errors="surrogateescape")
                data[begin : begin + len(words[chosen])] = hard
            case _:  # a digit
                digits = [i for i, byte in enumerate(data) if byte in b"0123456789"]
                data[draw.choice(digits or [0])] = draw.choice(b"0123456789")
        if not data:
            return b""
    return bytes(data)


def repaired(content: bytes) -> bytes:
    """A map whose size and checksum are those of its content."""
    if len(content) < 32:
        return content
    body = content[:16] + struct.pack("<Q", len(content)) + content[24:-8]
    return body + struct.pack("<II", zlib.crc32(body), 0)


def refuse(*_: object) -> None:
    raise TimeoutError("took too long")


def problem(name: str, arguments: list[str]) -> tuple[str, str]:
    """(how it ended, what is wrong with that or nothing)."""
    out, err = io.StringIO(), io.StringIO()
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            if arguments:
                status = command(arguments)
            else:
                try:
                    status, said = 0, read_contacts(Path(name))
                    out.write(repr(said))
                except asperity.InvalidInput as error:
                    status = 2
                    err.write(f"asperity: {error}\n")
    except (Exception, SystemExit):
        return "trouble", traceback.format_exc(limit=-1)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    told = err.getvalue()
    if not all(one.isprintable() or one == "\n" for one in told):
        return "trouble", f"characters that a terminal obeys: {told!r}"
    if status == 0:
        return "read", "" if out.getvalue() else "no result"
    fine = told.startswith("asperity: ") and told.count("\n") == 1 and not out.getvalue()
    if "out of memory" in told:
        return "trouble", told
    return "refused", "" if fine and status in (1, 2) else f"status {status}: {told!r}"


def run(kind: str, files: int, seed: int) -> int:
    name, content, arguments = kinds()[kind]
    draw = random.Random(f"{kind} {seed}")
    ends = {"read": 0, "refused": 0, "trouble": 0}
    wrong = 0
    scene = MASTER.replace("{file}", name) if kind == "master" else SCENE
    Path("scene.toml").write_text(scene)
    Path("dma.csv").write_bytes(isotherms())
    known = {"{file}": name, "{scene}": "scene.toml", "{dma}": "dma.csv"}
    given = [known.get(one, one) for one in arguments]
    for number in range(-1, files):
        data = content if number < 0 else mutated(content, draw)
        if kind == "map" and number >= 0 and draw.random() < 0.7:
            data = repaired(data)
        Path(name).write_bytes(data)
        end, trouble = problem(name, given)
        if number < 0 and end != "read":
            trouble = trouble or "the file as it was is refused"
        ends[end] += number >= 0
        if trouble:
            wrong += 1
            kept = Path(tempfile.gettempdir()) / f"mutated-{kind}-{seed}-{number}-{name}"
            kept.write_bytes(data)
            print(f"{kind} {number} (kept as {kept}): {trouble}")
    print(
        f"{kind:10} {files} files: {ends['read']} read, {ends['refused']} refused, {wrong} wrong",
        flush=True,
    )
    return wrong


def main() -> int:
    args = options(__doc__, kinds(), files=300, seed=1, gigabytes=4.0)
    most = int(args.gigabytes * 2**30)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    signal.signal(signal.SIGPROF, refuse)
    warnings.simplefilter("error")
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        wrong = sum(run(kind, args.files, args.seed) for kind in args.kinds)
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
