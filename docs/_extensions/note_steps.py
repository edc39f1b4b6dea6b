"""What to do about the notes of the core, as its sources say."""

import re
from pathlib import Path

CORE = Path(__file__).parents[2] / "cpp/src"
_CALL = re.compile(r'\b(?:note|warning|fatal)\(\s*(?="([a-z0-9-]+)")')
_TOKEN = re.compile(r'"(?:[^"\\\n]|\\.)*"|[(){}\[\],]')
_WORDS = re.compile(r'"((?:[^"\\\n]|\\.)*)"')


def steps_of_core() -> dict[str, str]:
    """What to do about each of the core's notes that say it: their last argument, or the advice in
    the sentence."""
    steps = {}
    for path in sorted(CORE.rglob("*.?pp")):
        text = path.read_text(encoding="utf-8")
        for call in _CALL.finditer(text):
            _, sentence, *step = _arguments(text, call.end())
            said = step[0] if step else sentence.partition("advice(")[2].partition(")")[0]
            words = _WORDS.findall(said)
            if step and not words:  # a constant of this name
                name = said.strip(" {}\n")
                words = re.findall(rf'{name} = "(.*?)";', text)
            if "advice(" in said or not step:  # the first is the code of the advice
                words = words[1:]
            if words:
                whole = (" or " if "?" in said else "").join(words).replace('\\"', '"')
                steps[call[1]] = whole if whole == whole.rstrip() else f"{whole}..."
    return steps


def _arguments(text: str, begin: int) -> list[str]:
    """The arguments of a call in C++, from the place behind its parenthesis."""
    depth, result = 1, []
    for token in _TOKEN.finditer(text, begin):
        depth += (token[0] in "({[") - (token[0] in ")}]")
        if depth == 0 or (depth == 1 and token[0] == ","):
            result.append(text[begin : token.start()])
            begin = token.end()
        if depth == 0:
            break
    return result
