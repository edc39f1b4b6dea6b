# The compiled core, private to the package. What stands above it has types of its own.
from typing import Any

from asperity.base.diagnostics import Error as Error
from asperity.base.diagnostics import InvalidInput as InvalidInput
from asperity.base.diagnostics import NotConverged as NotConverged
from asperity.base.diagnostics import OutOfRange as OutOfRange

__version__: str

def __getattr__(name: str) -> Any: ...
