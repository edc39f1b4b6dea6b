#!/bin/sh
# Builds the documentation into build/docs/html. A warning is an error.
# It needs the package with its extra: pip install '.[docs]'. PYTHON names the interpreter, .venv's by default.
set -eu
cd "$(dirname "$0")/.."
python=${PYTHON:-.venv/bin/python}
"$python" -c 'import asperity, furo, myst_parser, sphinx_copybutton, sphinx_gallery' 2>/dev/null || {
  echo "docs/build.sh: $python lacks what the documentation is built with: pip install '.[docs]'" >&2
  exit 3
}
"$python" -m sphinx --builder html --fail-on-warning --keep-going --doctree-dir build/docs/doctrees "$@" docs build/docs/html
echo "docs/build.sh: see build/docs/html/index.html"
