"""The directive `command-line`: the help of every verb of the shell command, by its own parser."""

import argparse
import os

from docutils import nodes
from docutils.parsers.rst import Directive

from asperity.cli.parser import parser


class CommandLine(Directive):
    """A section for each verb with what `asperity VERB --help` prints."""

    def run(self) -> list[nodes.Node]:
        os.environ["COLUMNS"] = "88"
        (verbs,) = (a for a in parser()._actions if isinstance(a, argparse._SubParsersAction))
        return [self.section(name, verb) for name, verb in verbs.choices.items()]

    def section(self, name: str, verb: argparse.ArgumentParser) -> nodes.section:
        title = f"asperity {name}"
        section = nodes.section(ids=[nodes.make_id(title)], names=[title])
        self.state.document.note_implicit_target(section)
        section += nodes.title(title, title)
        text = verb.format_help()
        section += nodes.literal_block(text, text, language="text")
        return section


def setup(app):
    app.add_directive("command-line", CommandLine)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
