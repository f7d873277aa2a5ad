"""Scenes that vary from seed to seed do not fill the memory of the graphics side."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from uwsim.assets import load_model
from uwsim.assets.mesh import Model
from uwsim.assets.weathering import weather_model
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.gpu_model import MAX_UNUSED_SCENES
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

BOX = load_model("objects/blackbox.osg")
FROM_ABOVE = Pose(np.array([0.0, 0.0, 1.0]), np.eye(3))  # the camera looks along -z


@pytest.fixture
def renderer() -> Iterator[Renderer]:
    made = Renderer()
    yield made
    made.close()


def drawn(renderer: Renderer, *models: Model) -> bytes:
    """An image of a scene, which is cleared after it."""
    for number, model in enumerate(models, start=1):
        renderer.add(model, number)
    image = renderer.draw(FROM_ABOVE, Intrinsics.from_fovy(32, 24, 1.0), Water(), Light())
    renderer.clear()
    assert image.colour is not None
    return image.colour.tobytes()


def test_models_that_no_recent_scene_used_are_removed(renderer: Renderer) -> None:
    models = renderer._models
    counts = []
    for pattern in range(1, 4 * MAX_UNUSED_SCENES):
        drawn(renderer, BOX, weather_model(BOX, pattern, 0.5))
        counts.append((len(models._models), len(models._textures)))
    assert counts[-1] == counts[2 * MAX_UNUSED_SCENES]
    assert counts[-1][0] <= MAX_UNUSED_SCENES + 2
    assert id(BOX) in models._models


def test_an_image_is_the_same_after_its_model_was_removed(renderer: Renderer) -> None:
    worn = weather_model(BOX, 1, 0.5)
    first = drawn(renderer, worn)
    others = [drawn(renderer, weather_model(BOX, 2 + k, 0.5)) for k in range(2 * MAX_UNUSED_SCENES)]
    assert id(worn) not in renderer._models._models
    assert drawn(renderer, worn) == first
    assert len({first, *others}) == len(others) + 1
    assert drawn(renderer, replace(worn)) == first
