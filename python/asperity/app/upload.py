"""A place to drop files or to choose them: the browser's own, which has a name, keys and drops."""

import asyncio
import secrets
from collections.abc import Awaitable, Callable
from html import escape
from weakref import WeakValueDictionary

from fastapi import Request, Response
from nicegui import background_tasks, events, ui
from starlette.datastructures import UploadFile
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect

from asperity.app.files import MOST_BYTES, MOST_FILES
from asperity.app.guard import TooLargeError

ADDRESS = "/upload/{key}"
Files = list[tuple[str, bytes]]  # names as the client has them, and contents

# A long name would be refused with its whole request; of it the ending is needed.
_SEND = f"""async (event) => {{
  const input = event.target, place = input.parentElement, files = [...input.files];
  if (!files.length) return;
  place.setAttribute('aria-busy', 'true');
  const form = new FormData();
  for (const file of files) form.append('file', file, file.name.slice(-100));
  try {{
    if (files.some((file) => file.size > {MOST_BYTES}))
      throw new Error('a file must have at most {MOST_BYTES // 2**20} MB');
    const answer = await fetch('ADDRESS', {{ method: 'POST', body: form }});
    if (!answer.ok) throw new Error(await answer.text());
  }} catch (error) {{
    const names = files.map((file) => file.name.slice(-40)).join(', ').slice(0, 200);
    emit(`${{names}} did not arrive: ${{error.message.trim().slice(0, 300)}}: choose it again`);
  }} finally {{
    input.value = '';
    place.setAttribute('aria-busy', 'false');
  }}
}}"""


class Upload:
    """Files that are dropped are taken in the order in which they arrived, one drop at a time."""

    def __init__(
        self,
        label: str,
        take: Callable[[Files], Awaitable[None]],
        say: Callable[[str], None],
        *,
        multiple: bool = False,
    ) -> None:
        self._take, self._say = take, say
        self.turn = asyncio.Lock()  # held while files are taken
        self._client = ui.context.client
        key = secrets.token_urlsafe(12)
        uploads[key] = self
        with ui.element("label").classes("upload"):
            ui.html(escape(label), sanitize=False, tag="span")
            place = ui.element("input").props(f'type="file" {"multiple" if multiple else ""}')
            place.on("change", self._failed, js_handler=_SEND.replace("ADDRESS", f"/upload/{key}"))

    def arrived(self, files: Files) -> None:
        """Take them once those before are taken."""
        background_tasks.create(self._in_turn(files))

    async def _in_turn(self, files: Files) -> None:
        with self._client:
            async with self.turn:
                await self._take(files)

    def _failed(self, event: events.GenericEventArguments) -> None:
        self._say(" ".join(str(event.args).split()))


# by the ends of their addresses; the page's elements hold them
uploads: "WeakValueDictionary[str, Upload]" = WeakValueDictionary()


async def receive(request: Request, key: str) -> Response:
    """Answer a form with files; what is no such form is refused in one line."""
    upload = uploads.get(key)
    if upload is None:
        return _refused(404, "the page is gone")
    try:
        async with request.form(max_files=MOST_FILES) as form:
            parts = [one for _, one in form.multi_items() if isinstance(one, UploadFile)]
            files = [(part.filename or "file", await part.read()) for part in parts]
    except HTTPException as error:
        return _refused(error.status_code, str(error.detail))
    except TooLargeError:
        return _refused(413, f"a file must have at most {MOST_BYTES // 2**20} MB")
    except ClientDisconnect:  # nobody waits for an answer
        return Response(status_code=400)
    if not files:
        return _refused(400, "no part of the request is a file")
    upload.arrived(files)
    return Response(status_code=204)


def _refused(status: int, problem: str) -> Response:
    return Response(f"{problem}\n", status, media_type="text/plain")
