"""The directive `codes`: the codes of notes or of errors, and what they mean."""

from docutils import nodes
from note_steps import steps_of_core
from sphinx.util.docutils import SphinxDirective

from asperity.base.codes import ERRORS, KINDS


class Codes(SphinxDirective):
    """A table of the codes of `notes` or `errors`."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        if self.arguments[0] == "notes":
            lines = ["| code | severity | meaning | what to do |", "| --- | --- | --- | --- |"]
            steps = steps_of_core()
            for code, kind in KINDS.items():
                step = kind.next_step or steps.get(code, "")
                lines.append(f"| `{code}` | {kind.severity} | {kind.meaning} | {step} |")
        else:
            lines = ["| code | meaning |", "| --- | --- |"]
            lines += [f"| `{code}` | {what} |" for code, what in ERRORS.items()]
        return self.parse_text_to_nodes("\n".join(lines))


def setup(app):
    app.add_directive("codes", Codes)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
