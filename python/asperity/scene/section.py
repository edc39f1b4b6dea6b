"""A table of a scene that was read: its values, and errors in its keys."""

from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from asperity.base.diagnostics import Value
from asperity.io.fields import Field, arguments, names_of, read_table, refuse, rename_in_errors

Values = dict[str, Any]
Made = TypeVar("Made")


@dataclass(frozen=True)
class Section:
    """A table by its name, the file that it stands in, and its values."""

    path: Path
    name: str
    values: Values

    @classmethod
    def read(cls, path: Path, name: str, table: object, fields: Mapping[str, Field]) -> "Section":
        return cls(path, name, read_table(path, name, table, fields))

    def replace_values(self, values: Values) -> "Section":
        return replace(self, values=values)

    def refuse(self, key: str, problem: str, phrase: Value | None = None) -> NoReturn:
        refuse(self.path, f"[{self.name}] {key}", problem, phrase)

    def refuse_each(self, keys: Iterable[str], problem: str) -> None:
        for key in keys:
            if key in self.values:
                self.refuse(key, problem)

    def leave_out(self, keys: Iterable[str], where: str) -> None:
        self.refuse_each(keys, f"must be left out where {where}")

    def require(self, *keys: str, hint: str = "") -> None:
        for key in keys:
            if key not in self.values:
                self.refuse(key, "missing" + (hint and f"; {hint}"))

    def naming(self, fields: Mapping[str, Field]) -> AbstractContextManager[None]:
        """Let errors on arguments name the keys of `fields`."""
        return rename_in_errors(self.path, names_of(self.name, fields))

    def call(
        self, function: Callable[..., Made], fields: Mapping[str, Field], *parts: Any, **more: Any
    ) -> Made:
        """What a function makes of the values of `fields`, and of more."""
        with self.naming(fields):
            return function(*parts, **arguments(self.values, fields), **more)
