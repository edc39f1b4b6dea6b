"""`python -m asperity` is the shell command."""

import sys

from asperity.cli.main import main

sys.exit(main())
