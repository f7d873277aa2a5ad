from collections.abc import Iterator

import pytest

from uwsim.rendering.renderer import Renderer


@pytest.fixture
def renderer() -> Iterator[Renderer]:
    """An empty renderer, closed afterwards."""
    renderer = Renderer()
    yield renderer
    renderer.close()
