"""Forms with files, and what is sent in their place: an answer of one line, never a traceback."""

import asyncio
from typing import Any

import pytest

from asperity.app.files import MOST_FILES

upload = pytest.importorskip("asperity.app.upload", reason="the app needs asperity[app]")
requests = pytest.importorskip("starlette.requests", reason="the app needs asperity[app]")

FORM = "multipart/form-data; boundary=b"


class Taker:
    """Stands where a page waits for files."""

    def __init__(self) -> None:
        self.files: list[tuple[str, bytes]] = []

    def arrived(self, files: list[tuple[str, bytes]]) -> None:
        self.files += files


def part(disposition: str, content: str = "abc") -> str:
    return f"--b\r\nContent-Disposition: form-data; {disposition}\r\n\r\n{content}\r\n"


def send(body: Any, kind: str = FORM, key: str = "a-key") -> tuple[int, str, Taker]:
    """Status and text of the answer, and who was to have the files. A body that is an exception
    is one that ends so."""
    taker = Taker()
    upload.uploads["a-key"] = taker
    headers = [(b"content-type", kind.encode())]
    scope = {"type": "http", "method": "POST", "headers": headers, "app": None}

    async def receive() -> Any:
        if isinstance(body, Exception):
            raise body
        if body is None:
            return {"type": "http.disconnect"}
        return {"type": "http.request", "body": body.encode(), "more_body": False}

    answer = asyncio.run(upload.receive(requests.Request(scope, receive), key))
    return answer.status_code, bytes(answer.body).decode(), taker


def test_files_of_a_form_arrive_in_their_order() -> None:
    one, two = 'name="file"; filename="a.csv"', 'name="file"; filename="b.csv"'
    status, _, taker = send(part(one, "1") + part(two, "2") + "--b--\r\n")
    assert status == 204
    assert taker.files == [("a.csv", b"1"), ("b.csv", b"2")]


HOSTILE = {
    "a name in another coding alone": (part("name=\"file\"; filename*=UTF-8''a.npy"), FORM, 400),
    "no name of a file": (part('name="file"'), FORM, 400),
    "no name of a part": (part('filename="a"'), FORM, 400),
    "no disposition": ("--b\r\nContent-Type: text/plain\r\n\r\nabc\r\n", FORM, 400),
    "a name of 30,000 characters": (part(f'name="file"; filename="{"x" * 30000}"'), FORM, 400),
    "too many files": (part('name="file"; filename="a"') * (MOST_FILES + 1), FORM, 400),
    "a large field": (part('name="file"', "x" * 2**21), FORM, 400),
    "no boundary": ("abc", "multipart/form-data", 400),
    "no form": ("abc", "text/plain", 400),
    "a form of fields": ("file=abc", "application/x-www-form-urlencoded", 400),
    "an empty body": ("", FORM, 400),
    "a body that is too long": (upload.TooLargeError(), FORM, 413),
    "a sender that is gone": (None, FORM, 400),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_what_is_no_form_with_files_is_refused(case: str) -> None:
    body, kind, expected = HOSTILE[case]
    end = "--b--\r\n" if isinstance(body, str) and body.startswith("--b") else ""
    status, text, taker = send(body + end if isinstance(body, str) else body, kind)
    assert status == expected, text
    assert text.count("\n") == (body is not None)
    assert len(text) < 200
    assert taker.files == []


def test_a_page_that_is_gone_takes_nothing() -> None:
    assert send(part('name="file"; filename="a"'), key="b-key")[0] == 404
