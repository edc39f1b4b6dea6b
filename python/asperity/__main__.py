"""`python -m asperity` is the shell command."""

import sys

from asperity.cli.cli import main

sys.exit(main())
