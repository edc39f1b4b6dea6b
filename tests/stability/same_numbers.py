"""Two processes with equal numbers, each in a namespace of its own, write into one directory.

python tests/stability/same_numbers.py [--writes N]

Each writes a file of its own and one that both write, and reads both after every write: its own
must hold its own content, and the common one the whole content of one of the two. Fails where a
content was swapped, torn or lost. Needs `unshare` and the right to make a namespace of processes.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from asperity.io.files import write_whole

SIZE = 20_000  # bytes of a content, more than one write to a pipe takes whole


def content(name: str, number: int) -> bytes:
    return (f"{name}{number:09}\n".encode() * (SIZE // 11 + 1))[:SIZE]


def whole(found: bytes) -> bool:
    """Whether this is one of the contents that the two write, and nothing else."""
    name, number = found[:1].decode(), found[1:10].decode()
    return name in "ab" and number.isdigit() and found == content(name, int(number))


def write(directory: Path, name: str, writes: int) -> None:
    """What each of the two does; they begin when both are there."""
    (directory / f"{name}.number").write_text(str(os.getpid()))
    while not all((directory / f"{other}.number").exists() for other in "ab"):
        pass
    swapped = torn = 0
    for i in range(writes):
        write_whole(directory / name, content(name, i))
        swapped += (directory / name).read_bytes() != content(name, i)
        write_whole(directory / "common", content(name, i))
        torn += not whole((directory / "common").read_bytes())
    (directory / f"{name}.result").write_text(f"{swapped} {torn}")


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--writes", type=int, default=2000, help="of both together")
    parser.add_argument("--as", dest="name", help="the name of one of the two, in a directory")
    parser.add_argument("--directory", type=Path)
    args = parser.parse_args()
    if args.name is not None:
        write(args.directory, args.name, args.writes)
        return 0
    unshare = ["unshare", "--pid", "--fork"] + ([] if os.geteuid() == 0 else ["--map-root-user"])
    if (
        shutil.which("unshare") is None
        or subprocess.run([*unshare, "true"], check=False).returncode
    ):
        print("skipped: no namespaces here")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        directory = Path(folder)
        command = [*unshare, sys.executable, __file__, "--directory", folder]
        command += ["--writes", str(args.writes // 2), "--as"]
        both = [subprocess.Popen([*command, name]) for name in "ab"]
        status = [one.wait() for one in both]
        numbers = {(directory / f"{name}.number").read_text() for name in "ab"}
        counts = [(directory / f"{name}.result").read_text().split() for name in "ab"]
        swapped, torn = (sum(map(int, column)) for column in zip(*counts, strict=True))
        left = sorted(path.name for path in directory.iterdir() if path.name.startswith("."))
        kept = whole((directory / "common").read_bytes())
    print(
        f"{args.writes} writes of two processes numbered {' and '.join(numbers)}: "
        f"{swapped} swapped, {torn} torn, {len(left)} parts left, common file whole: {kept}"
    )
    return int(any(status) or len(numbers) != 1 or swapped + torn + len(left) > 0 or not kept)


if __name__ == "__main__":
    sys.exit(main())
