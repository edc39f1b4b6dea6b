"""The directive `scene-keys`: the keys of a table of scenes, by their declarations."""

from docutils import nodes
from docutils.statemachine import StringList
from scene_tables import table
from sphinx.util.docutils import SphinxDirective


class SceneKeys(SphinxDirective):
    """A table of the keys: `law` of [surface], `correction`, `adhesion`, `heating` and others."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        lines = StringList(table(self.arguments[0]), source="scene-keys")
        return self.parse_text_to_nodes("\n".join(lines))


def setup(app):
    app.add_directive("scene-keys", SceneKeys)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
