"""Who has no token gets nothing; bodies and origins are bounded too. No server is needed."""

import asyncio
from typing import Any

import pytest

guard = pytest.importorskip("asperity.app.guard", reason="the app needs asperity[app]")

TOKEN = "a-token"
COOKIE = "asperity-8123"


async def application(scope: Any, receive: Any, send: Any) -> None:
    """Reads its body and says how long it was."""
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
        return
    size, more = 0, True
    while more:
        message = await receive()
        size += len(message.get("body", b""))
        more = message.get("more_body", False)
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": str(size).encode()})


def ask(
    query: str = "",
    headers: dict[str, str] | None = None,
    bodies: tuple[bytes, ...] = (b"",),
    kind: str = "http",
) -> list[Any]:
    """Everything that is sent in answer."""
    sent: list[Any] = []
    messages = [
        {"type": "http.request", "body": body, "more_body": i < len(bodies) - 1}
        for i, body in enumerate(bodies)
    ]

    async def receive() -> Any:
        return messages.pop(0)

    async def send(message: Any) -> None:
        sent.append(message)

    pairs = [(k.encode(), v.encode("latin-1")) for k, v in (headers or {}).items()]
    scope = {"type": kind, "query_string": query.encode("latin-1"), "headers": pairs, "path": "/"}
    asyncio.run(guard.Guard(application, TOKEN, 8123)(scope, receive, send))
    return sent


def cookie(value: str = TOKEN, name: str = COOKIE) -> dict[str, str]:
    return {"cookie": f"{name}={value}"}


REFUSED = {
    "nothing": ("", {}),
    "a wrong token": ("token=a-tokem", {}),
    "no token": ("token=", {}),
    "half of it": ("token=a-tok", {}),
    "more of it": ("token=a-token-", {}),
    "no text": ("token=%ff%00\xe9", {}),
    "a wrong cookie": ("", cookie("b-token")),
    "the cookie of another port": ("", cookie(name="asperity-8124")),
    "no cookie": ("", {"cookie": ";;;=\x01"}),
    "a page of another host": ("token=a-token", {"origin": "http://evil.example", "host": "a:1"}),
    "a page of another port": ("", cookie() | {"origin": "http://a:2", "host": "a:1"}),
    "a page of no address": ("", cookie() | {"origin": "http://[", "host": "a:1"}),
    "a page of nowhere": ("", cookie() | {"origin": "null", "host": "a:1"}),
}


@pytest.mark.parametrize("case", REFUSED)
def test_who_has_no_token_gets_nothing(case: str) -> None:
    query, headers = REFUSED[case]
    start, body = ask(query, headers)
    assert start["status"] == 403
    assert b"the address that its terminal shows" in body["body"]
    assert not any(name == b"set-cookie" for name, _ in start["headers"])
    assert ask(query, headers, kind="websocket") == [{"type": "websocket.close", "code": 1008}]


@pytest.mark.parametrize(
    ("query", "headers"),
    [
        ("token=a-token", {}),
        ("session=x&token=a-token", {}),
        ("", cookie()),
        ("", {"cookie": f"other=1; {COOKIE}={TOKEN}"}),
        ("", cookie() | {"origin": "http://a:1", "host": "a:1"}),
    ],
)
def test_who_has_it_is_let_in(query: str, headers: dict[str, str]) -> None:
    start, body = ask(query, headers, (b"12", b"345"))
    assert (start["status"], body["body"]) == (200, b"5")
    answered = {name.decode(): value.decode() for name, value in start["headers"]}
    assert "default-src 'self'" in answered["content-security-policy"]
    assert answered["referrer-policy"] == "no-referrer"
    given = answered.get("set-cookie", "")
    assert given == (f"{COOKIE}={TOKEN}; HttpOnly; SameSite=Strict; Path=/" if query else "")
    assert ask(query, headers, kind="websocket") == [{"type": "websocket.accept"}]


def test_a_body_is_bounded_whatever_it_says(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guard, "MOST_BODY", 10)
    for length in ("11", "1e3", "-1", "many"):
        start, _ = ask("", cookie() | {"content-length": length}, (b"",))
        assert start["status"] == 413
    start, body = ask("", cookie() | {"content-length": "10"}, (b"12345", b"12345"))
    assert (start["status"], body["body"]) == (200, b"10")
    with pytest.raises(guard.TooLargeError):
        ask("", cookie() | {"content-length": "3"}, (b"12345", b"123456"))
