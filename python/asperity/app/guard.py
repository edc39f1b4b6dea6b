"""Who may talk to the app: whoever knows its token, from its own pages, and in bounded requests."""

import hmac
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from asperity.app.files import MOST_BYTES

MOST_BODY = MOST_BYTES + 2**20  # of a request: a file and what forms put around it
_REFUSED = "asperity app: open the address that its terminal shows, with the token.\n"
_TOO_LARGE = f"A file must have at most {MOST_BYTES // 2**20} MB.\n"
_CLOSE = {"connection": "close"}
_HEADERS = {
    # everything comes from here; the page's own framework compiles templates
    "content-security-policy": "default-src 'self'; script-src 'self' 'unsafe-inline' "
    "'unsafe-eval'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "font-src 'self' data:; connect-src 'self' ws: wss:; object-src 'none'; base-uri 'self'; "
    "form-action 'self'; frame-ancestors 'none'",
    "referrer-policy": "no-referrer",
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
}


class Guard:
    """Stands before an ASGI application.

    The token comes once in the address and from then on in a cookie that no script reads. Pages of
    others, who may share the host but not its port, are told by the header Origin.
    """

    def __init__(self, application: ASGIApp, token: str, port: int) -> None:
        self._application, self._token = application, token
        self._cookie = f"asperity-{port}"  # cookies know no ports

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._application(scope, receive, send)
            return
        connection = HTTPConnection(scope)
        by_address = self._is_token(connection.query_params.get("token", ""))
        by_cookie = self._is_token(connection.cookies.get(self._cookie, ""))
        may_talk = (by_address or by_cookie) and not _foreign(connection.headers)
        length = connection.headers.get("content-length", "0")
        if scope["type"] == "websocket" and not may_talk:
            await send({"type": "websocket.close", "code": 1008})
        elif scope["type"] == "websocket":
            await self._application(scope, receive, send)
        elif not may_talk:
            await PlainTextResponse(_REFUSED, 403, _CLOSE)(scope, receive, send)
        elif not length.isdigit() or int(length) > MOST_BODY:
            await PlainTextResponse(_TOO_LARGE, 413, _CLOSE)(scope, receive, send)
        else:
            answer = self._with_headers(send, cookie=by_address)
            await self._application(scope, _bounded(receive), answer)

    def _is_token(self, given: str) -> bool:
        return hmac.compare_digest(given.encode(), self._token.encode())

    def _with_headers(self, send: Send, *, cookie: bool) -> Send:
        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in _HEADERS.items():
                    headers.append(name, value)
                if cookie:
                    given = f"{self._cookie}={self._token}; HttpOnly; SameSite=Strict; Path=/"
                    headers.append("set-cookie", given)
            await send(message)

        return answer


class TooLargeError(Exception):
    """A body went on beyond the length that it stated."""


def _bounded(receive: Receive) -> Receive:
    """A body that is cut off where it becomes too long, whatever its header says."""
    seen = 0

    async def bounded() -> Message:
        nonlocal seen
        message = await receive()
        seen += len(message.get("body", b""))
        if seen > MOST_BODY:
            raise TooLargeError
        return message

    return bounded


def _foreign(headers: Headers) -> bool:
    """Whether a page of another origin asks."""
    origin = headers.get("origin")
    try:
        return origin is not None and urlsplit(origin).netloc != headers.get("host")
    except ValueError:  # as of "http://["
        return True
