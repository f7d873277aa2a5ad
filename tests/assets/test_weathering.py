"""Weathering: another surface for each pattern, the same shape for all."""

from __future__ import annotations

import numpy as np

from uwsim.assets import load_model
from uwsim.assets.mesh import Model
from uwsim.assets.weathering import weather_model


def box() -> Model:
    return load_model("objects/blackbox_uib_trimesh.osg")


def face(pattern: int, strength: float = 0.12) -> np.ndarray:
    texture = weather_model(box(), pattern, strength).meshes[0].texture
    assert texture is not None
    return texture.pixels


def test_pattern_0_and_strength_0_are_the_model_itself() -> None:
    model = box()
    assert weather_model(model, 0, 0.5) is model
    assert weather_model(model, 7, 0.0) is model


def test_each_pattern_is_another_and_always_the_same() -> None:
    assert np.array_equal(face(3), face(3))
    assert not np.array_equal(face(3), face(4))
    model = box()
    assert weather_model(model, 3, 0.12) is weather_model(model, 3, 0.12)  # so it is uploaded once


def test_brightness_varies_by_the_strength_and_not_on_the_whole() -> None:
    plain = face(0).astype(float)
    factors = [face(pattern, 0.1) / np.maximum(plain, 1.0) for pattern in range(1, 6)]
    middle = np.concatenate([f[(plain > 60.0) & (plain < 180.0)] for f in factors])
    assert abs(middle.mean() - 1.0) < 0.01
    assert 0.08 < middle.std() < 0.12


def test_shape_and_name_stay_and_shared_textures_stay_shared() -> None:
    model = box()
    made = weather_model(model, 5, 0.2)
    assert (made.name, made.sha256, made.box) == (model.name, model.sha256, model.box)
    for before, after in zip(model.meshes, made.meshes, strict=True):
        assert after.vertices is before.vertices
    shared = {id(mesh.texture) for mesh in model.meshes}
    assert len({id(mesh.texture) for mesh in made.meshes}) == len(shared)
    names = {mesh.texture.name for mesh in made.meshes if mesh.texture is not None}
    assert all(name.endswith("+5*0.2") for name in names)
