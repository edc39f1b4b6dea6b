"""`python -m asperity` is the shell command."""

import sys

from asperity.cli import main

sys.exit(main())
