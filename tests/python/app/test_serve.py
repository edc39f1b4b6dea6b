"""The server answers nobody without the token, and serves everything that its page needs."""

import errno
import os
import re
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from asperity.app.serve import listening
from asperity.cli.main import main
from helpers.served import served

pytest.importorskip("nicegui", reason="the app needs asperity[app]")
pytest.importorskip("matplotlib", reason="the app needs asperity[app]")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with served() as (line, _):
        yield line


def get(url: str, headers: dict[str, str] | None = None) -> tuple[int, dict[str, str], str]:
    request = urllib.request.Request(url, headers=headers or {})
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, dict(answer.headers), answer.read().decode(errors="replace")
    except urllib.error.HTTPError as error:
        return error.code, dict(error.headers), error.read().decode(errors="replace")


def test_the_address_is_of_this_machine_and_has_a_long_token(address: str) -> None:
    assert re.fullmatch(r"http://127\.0\.0\.1:\d+/\?token=[\w-]{32}", address)


def test_nothing_is_there_without_the_token(address: str) -> None:
    root = address.partition("?")[0]
    status, headers, page = get(address)
    assert status == 200
    files = set(re.findall(r'"(/_nicegui/[^"]+)"', page))
    assert len(files) > 5
    cookie = headers["set-cookie"].partition(";")[0]
    for path in ["", "favicon.ico", "nowhere", "_nicegui_ws/socket.io/?EIO=4", *sorted(files)[:5]]:
        url = root + path.removeprefix("/")
        assert get(url)[0] == 403, url
        assert get(f"{root}?token=wrong")[0] == 403
        assert get(url, {"Cookie": cookie, "Origin": "http://evil.example"})[0] == 403
    for path in sorted(files)[:5]:
        assert get(root + path.removeprefix("/"), {"Cookie": cookie})[0] == 200, path


def test_the_page_names_no_other_host(address: str) -> None:
    page = get(address)[2]
    hosts = {urlsplit(one).netloc for one in re.findall(r"https?://[^\s\"'<>\\)]+", page)}
    assert hosts <= {"www.w3.org", urlsplit(address).netloc}
    for path in ("docs", "redoc", "openapi.json"):
        assert get(address.replace("/?", f"/{path}?"))[0] == 404


def test_a_port_that_is_taken_or_none_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        number, in_use = taken.getsockname()[1], os.strerror(errno.EADDRINUSE)
        for options, problem in (
            (["--port", f"{number}"], f"{number}: cannot be listened at: {in_use}\n"),
            (["--port", "70000"], "--port 70000: must be in 0..65535"),
            (["--port", "-1"], "--port -1: must be in 0..65535"),
            (["--host", "256.0.0.1"], "--host 256.0.0.1"),
        ):
            assert main(["app", "--no-browser", *options]) == 2
            out, err = capsys.readouterr()
            assert out == ""
            assert problem in err
            assert err.count("\n") == 1


@pytest.mark.skipif(not socket.has_dualstack_ipv6(), reason="there is no IPv6 here")
def test_all_addresses_are_those_of_both_kinds() -> None:
    with listening("::", 0) as bound:
        for host in ("127.0.0.1", "::1"):
            socket.create_connection((host, bound.getsockname()[1]), timeout=10).close()


@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="there is no SIGHUP here")
def test_a_closed_terminal_leaves_no_folder(tmp_path: Path) -> None:
    """Its session's folder goes; at its start the app removes one that a killed app left."""
    left = tmp_path / "asperity-app-12345678"
    left.mkdir()
    os.utime(left, (0, 0))
    run = [sys.executable, "-m", "asperity", "app", "--no-browser"]
    environment = {**os.environ, "TMPDIR": str(tmp_path), "MPLBACKEND": "agg"}
    with subprocess.Popen(
        run,
        stdout=subprocess.PIPE,
        text=True,
        env=environment,
        # a test run under nohup hands its ignored signal on
        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL),
    ) as process:
        assert process.stdout is not None
        assert get(process.stdout.readline().strip())[0] == 200
        (session,) = tmp_path.glob("asperity-app-*")
        assert session != left
        process.send_signal(signal.SIGHUP)
        process.wait(30)
    assert list(tmp_path.glob("asperity-app-*")) == []
