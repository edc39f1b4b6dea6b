"""What a page keeps, and its folder, which goes with it."""

from collections.abc import Iterator

import pytest

from asperity.app.state import State


@pytest.fixture
def state() -> Iterator[State]:
    made = State()
    yield made
    made.close()
    assert not made.folder.path.exists()
