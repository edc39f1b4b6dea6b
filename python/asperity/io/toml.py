"""TOML text, of which the parser takes time and memory as the square of the parts of a key."""

import datetime
import re
import tomllib
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from asperity.base.diagnostics import InvalidInput, must_have
from asperity.io.table import json_text

_MOST_BYTES = 2**24
_MOST_PARTS = 32
# strings of many lines, comments, keys of one part or more; a string may be cut short
_PART = r"""(?:[\w-]++|"(?:[^"\\\n]|\\.)*+"?|'[^'\n]*+'?)"""
_TOKEN = re.compile(
    r'"""(?:[^"\\]|\\.|"(?!""))*+(?:"{3,5}|\Z)'
    r"|'''(?:[^']|'(?!''))*+(?:'{3,5}|\Z)"
    r"|\#[^\n]*+"
    rf"|(?P<key>{_PART}(?:[ \t]*+\.[ \t]*+{_PART})*+)",
    re.DOTALL,
)
_SLIPS = {  # how a value that is wrong begins, and what to do about it
    r'"(?!"")(?:[^"\\]|\\[btnfr"\\]|\\u[0-9a-fA-F]{4})*+\\(?![btnfr"\\])': (
        "in \"...\" a \\ begins a code: use / or '...' for the names of files"
    ),
    r'"(?!"")(?:[^"\\]|\\.)*+$': "the quotation mark at the end is missing",
    r"'(?!'')[^']*$": "the quotation mark at the end is missing",
    r"(True|False)\b": "must be true or false, in small letters",
    r"(?!true\b|false\b|inf\b|nan\b)([^\W\d][^#\s]*)": 'texts stand in quotation marks: "{}"',
}
_DOT = re.compile(rf"{_PART}|(?P<dot>\.)")


def read_toml_text(content: bytes, parse_float: Callable[[str], Any] = float) -> dict[str, Any]:
    """The tables of a TOML file; InvalidInput says what is wrong with it."""
    if len(content) > _MOST_BYTES:
        raise must_have("", f"at most {_MOST_BYTES}", f"has {len(content)} bytes")
    try:
        text = content.decode("utf-8")
        line = _long_key(text)
        if line is None:
            return tomllib.loads(text, parse_float=parse_float)
    except UnicodeDecodeError as error:
        raise InvalidInput(f"not a TOML file: {error}") from error
    except tomllib.TOMLDecodeError as error:
        raise InvalidInput(f"not a TOML file: {error}{_slip(text)}") from error
    except (ValueError, RecursionError):  # Python's limits
        problem = "nested too deeply, or a number of thousands of digits"
        raise InvalidInput(f"not a TOML file: {problem}") from None
    problem = f"must have at most {_MOST_PARTS} parts"
    raise InvalidInput(f"not a TOML file: a key at line {line}: {problem}")


def toml_value(value: Any) -> str:
    """A value as TOML writes it: a number as it was typed, or in the digits that read back."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int) and value.bit_length() > 1000:
        return hex(value)  # Python writes no integer of so many decimals
    if isinstance(value, int | float):  # inf and nan are TOML's words too
        return str(value)
    if isinstance(value, datetime.date | datetime.time):
        return value.isoformat()
    if isinstance(value, str):
        return json_text(value)
    if isinstance(value, Mapping):
        inside = [f"{_key(key)} = {toml_value(one)}" for key, one in value.items()]
        return f"{{{', '.join(inside)}}}"
    return f"[{', '.join(map(toml_value, value))}]"


def _key(key: str) -> str:
    return key if re.fullmatch("[A-Za-z0-9_-]+", key) else json_text(key)


def _slip(text: str) -> str:
    """What is often wrong with a value of one line, in words; empty where it is not."""
    for number, line in enumerate(text.splitlines(), start=1):
        for pattern, problem in _SLIPS.items():
            if match := re.match(rf"\s*[\w.-]+\s*=\s*\[?\s*{pattern}", line):
                return f"; line {number}: {problem.format(*match.groups())}"
    return ""


def _long_key(text: str) -> int | None:
    """The line of the first key of too many parts."""
    for token in _TOKEN.finditer(text):
        key = token["key"]
        if key and key.count(".") >= _MOST_PARTS:
            dots = sum(part["dot"] is not None for part in _DOT.finditer(key))
            if dots >= _MOST_PARTS:
                return text.count("\n", 0, token.start()) + 1
    return None
