"""The server of the app: an address with a token, printed before anything slow is loaded."""

import contextlib
import importlib.util
import os
import secrets
import signal
import socket
import sys
import webbrowser
from collections.abc import Callable
from threading import Timer
from typing import Any

from asperity.base.diagnostics import MUST_BE, Argument, InvalidInput, valued
from asperity.base.table import to_install

_OPEN_AFTER = 1.5  # s, by which the server answers on most machines; a browser waits anyway
_TURN = 5e-4  # s after which a thread that computes lets the server answer
_AWAY = 60.0  # s that a page may not be heard of, as on a busy machine, before it is new
_NEEDED = {"nicegui": "NiceGUI", "matplotlib": "matplotlib", "jinja2": "Jinja2"}


def serve(host: str, port: int, *, browser: bool, tell: Callable[[str], None]) -> None:
    """Serve until it is interrupted. `tell` is given the address as soon as the port is ours; a
    `port` of 0 is any that is free."""
    for module, name in _NEEDED.items():
        if importlib.util.find_spec(module) is None:
            raise InvalidInput(f"the app needs {name}: {to_install('app')}")
    with listening(host, port) as bound:
        token = secrets.token_urlsafe(24)
        number = bound.getsockname()[1]
        shown = f"[{host}]" if ":" in host else host
        address = f"http://{shown}:{number}/?token={token}"
        tell(address)
        if browser:
            opened = Timer(_OPEN_AFTER, webbrowser.open, [address])
            opened.daemon = True
            opened.start()
        _run(bound, token, number)


def listening(host: str, port: int) -> socket.socket:
    """A socket that connections may wait at already."""
    if not 0 <= port <= 65535:
        raise InvalidInput(Argument("--port"), " ", valued(port), MUST_BE, "in 0..65535")
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    bound = socket.socket(family)  # create_server would refuse IPv4 at "::"
    try:
        if os.name == "posix":  # elsewhere it lets another program take the port
            bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        bound.bind((host, port))
        bound.listen(64)
    except OSError as error:
        bound.close()
        problem = f"--host {host}, --port {port}: cannot be listened at: {error.strerror or error}"
        raise InvalidInput(problem) from error
    return bound


def _run(bound: socket.socket, token: str, port: int) -> None:
    import uvicorn
    from fastapi import FastAPI
    from nicegui import app, ui

    from asperity.app.files import remove_old_folders
    from asperity.app.guard import Guard
    from asperity.app.page import close_all, show_page
    from asperity.app.upload import ADDRESS, receive

    remove_old_folders()
    app.config.quasar_config["loadingBar"]["skipHijack"] = True  # it has no name
    application = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    application.post(ADDRESS)(receive)
    ui.page("/", title="asperity")(show_page)
    how: dict[str, Any] = {"language": "en-US", "show_welcome_message": False}
    ui.run_with(application, title="asperity", reconnect_timeout=_AWAY, **how)
    guard = Guard(application, token, port)
    config = uvicorn.Config(
        guard, log_level="error", access_log=False, server_header=False, timeout_graceful_shutdown=2
    )
    sys.setswitchinterval(_TURN)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))  # uvicorn raises it again at its end
    hangup = getattr(signal, "SIGHUP", None)  # the terminal was closed; Windows has none
    if hangup is not None and signal.getsignal(hangup) == signal.SIG_DFL:
        signal.signal(hangup, lambda *_: signal.raise_signal(signal.SIGTERM))
    try:
        with contextlib.suppress(KeyboardInterrupt):
            uvicorn.Server(config).run(sockets=[bound])
    finally:
        close_all()
        sys.stdout.flush()
        os._exit(0)  # threads that still compute hold nothing that anybody waits for
