"""Settings of the documentation. `sh docs/build.sh` builds it; warnings are errors."""

import re
import sys
import warnings
from pathlib import Path

import asperity

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_extensions"))

project = "asperity"
author = "the asperity authors"
copyright = "the asperity authors"
version = release = asperity.__version__
stated = re.search(r"VERSION ([0-9.]+)", (HERE.parent / "CMakeLists.txt").read_text())
if stated is None or stated[1] != version:
    warnings.warn(f"the installed asperity is {version}, the sources are another", stacklevel=1)

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinx_copybutton",
    "sphinx-mathjax-offline",
    "sphinx_gallery.gen_gallery",
    "command_line",
    "codes",
]
exclude_patterns = ["_build", "examples/README.rst", "examples/*.py", "benchmarks/*.md"]
suppress_warnings = ["config.cache"]

myst_enable_extensions = ["dollarmath", "deflist", "colon_fence"]
myst_heading_anchors = 3
math_number_all = False

autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True}
default_role = "py:obj"
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
python_maximum_signature_line_length = 80

html_theme = "furo"
html_title = f"asperity {version}"
html_static_path = ["_static"]
html_css_files = ["asperity.css"]
html_js_files = ["search_offline.js"]
html_theme_options = {"navigation_with_keys": True}
html_copy_source = False

sphinx_gallery_conf = {
    "reset_modules": ("matplotlib", "gallery_style.style"),
    "examples_dirs": "examples",
    "gallery_dirs": "gallery",
    "filename_pattern": r"/plot_",
    "within_subsection_order": "FileNameSortKey",
    "download_all_examples": False,
    "show_signature": False,
    "remove_config_comments": True,
    "abort_on_example_error": True,
    "capture_repr": (),
    "min_reported_time": 5,
    "write_computation_times": False,  # a page that fetches scripts from elsewhere
    "image_scrapers": ("matplotlib",),
    "image_srcset": ["2x"],
}


def plain_text(app, what, name, obj, options, lines):
    """Docstrings are plain text, |E| and E* are no markup; `a, b : type` becomes an entry each."""
    result, held = [], []
    for line in lines:
        if not line.lstrip().startswith((">>>", "...")):
            line = re.sub(r"(?<!\\)([|*])", r"\\\1", line)
        together = re.match(r"(\w+(?:, \w+)+) : (.*)", line)
        if held and (together or not line.startswith("    ")):
            for entry in held[0].split(", "):
                result += [f"{entry} : {held[1]}", *held[2:]]
            held = []
        if together and what == "class":
            held = [together[1], together[2]]
        elif held:
            held.append(line)
        else:
            result.append(line)
    lines[:] = result


def short_types(app, what, name, obj, options, signature, returned):
    """Say ArrayLike and ndarray for what their definitions spell out."""

    array_like = r"[\w.~]*_Buffer \| [^,()]*_NestedSequence\[complex \| bytes \| str\]"
    array = r"[\w.~]*ndarray\[tuple\[[\w.~]*Any, \.\.\.\], [\w.~]*dtype\[[\w.~]*\]\]"

    def short(text):
        return re.sub(array, "ndarray", re.sub(array_like, "ArrayLike", text))

    return (signature and short(signature), returned and short(returned))


def setup(app):
    app.connect("autodoc-process-docstring", plain_text, priority=100)  # before napoleon
    app.connect("autodoc-process-signature", short_types)
