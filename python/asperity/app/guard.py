"""Who may talk to the app: whoever knows its token, from its own pages, and in bounded requests."""

import hmac
from collections.abc import Awaitable, Callable, MutableMapping
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qs, urlsplit

from asperity.app.files import MOST_BYTES

Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Application = Callable[[Message, Receive, Send], Awaitable[None]]

MOST_BODY = MOST_BYTES + 2**20  # of a request: a file and what forms put around it
_REFUSED = "asperity app: open the address that its terminal shows, with the token.\n"
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

    def __init__(self, application: Application, token: str, port: int) -> None:
        self._application = application
        self._token = token
        self._cookie = f"asperity-{port}"  # cookies know no ports

    async def __call__(self, scope: Message, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._application(scope, receive, send)
            return
        headers = {k.decode("latin-1").lower(): v.decode("latin-1") for k, v in scope["headers"]}
        by_address = self._is_token(_in_address(scope))
        if not (by_address or self._is_token(self._in_cookie(headers))) or _foreign(headers):
            await _refuse(scope, send, 403, _REFUSED)
            return
        if scope["type"] != "http":
            await self._application(scope, receive, send)
            return
        length = headers.get("content-length", "0")
        if not length.isdigit() or int(length) > MOST_BODY:
            most = MOST_BYTES // 2**20
            await _refuse(scope, send, 413, f"A file must have at most {most} MB.\n")
            return
        answer = self._with_headers(send, cookie=by_address)
        await self._application(scope, _bounded(receive), answer)

    def _is_token(self, given: str) -> bool:
        return hmac.compare_digest(given.encode(), self._token.encode())

    def _in_cookie(self, headers: dict[str, str]) -> str:
        try:
            result = SimpleCookie(headers.get("cookie", "")).get(self._cookie)
        except CookieError:
            return ""
        return "" if result is None else result.value

    def _with_headers(self, send: Send, *, cookie: bool) -> Send:
        added = dict(_HEADERS)
        if cookie:
            added["set-cookie"] = f"{self._cookie}={self._token}; HttpOnly; SameSite=Strict; Path=/"

        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start":
                pairs = [(k.encode(), v.encode()) for k, v in added.items()]
                message["headers"] = [*message.get("headers", []), *pairs]
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


def _in_address(scope: Message) -> str:
    query: bytes = scope.get("query_string", b"")
    return parse_qs(query.decode("latin-1")).get("token", [""])[0]


def _foreign(headers: dict[str, str]) -> bool:
    """Whether a page of another origin asks."""
    origin = headers.get("origin")
    try:
        return origin is not None and urlsplit(origin).netloc != headers.get("host")
    except ValueError:  # as of "http://["
        return True


async def _refuse(scope: Message, send: Send, status: int, text: str) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008})
        return
    kind = [(b"content-type", b"text/plain; charset=utf-8"), (b"connection", b"close")]
    await send({"type": "http.response.start", "status": status, "headers": kind})
    await send({"type": "http.response.body", "body": text.encode()})
