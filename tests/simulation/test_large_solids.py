"""A scene of 84 000 triangles of terrain, nine rocks of 5 120 and a pipe of 17 000, all solid.

What it costs is measured by `benchmarks/solids.py`.
"""

from __future__ import annotations

import hashlib
import importlib
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.checks import check_file
from uwsim.model.collision import fixed_mesh as fixed_mesh_module
from uwsim.model.collision import polygon_cache
from uwsim.physics import engine_model as compile_module
from uwsim.scene.on_floor import OnFloorSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
MAX_SHAPES = 5000


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "path", [str(BENCHMARKS), *sys.path])
        solids = importlib.import_module("solids")
    return Path(solids.write_solid_scene(tmp_path_factory.mktemp("solids")))


@pytest.fixture
def scene(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> SceneSpec:
    """The scene, and an empty cache on the disk."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return read_scene(file).nominal_scene


def track(scene: SceneSpec) -> str:
    """Hash of all positions of a vehicle that is pushed out of the ground it begins in."""
    sunk = replace(scene.vehicles[0], position=(0.0, 0.0, -3.9), accepts=("start",))
    digest = hashlib.sha256()
    with open_scene(replace(scene, vehicles=(sunk,))) as simulation:
        row = np.zeros(simulation.world.engine.motion.size)
        n_contacts = 0
        for _ in range(20):
            simulation.advance(0.05)
            simulation.world.engine.motion.read(row)
            digest.update(row.tobytes())
            n_contacts += len(simulation.world.contacts.find("v0"))
        assert simulation.world.engine._model.ngeom < MAX_SHAPES
    assert n_contacts > 0
    return digest.hexdigest()


@pytest.mark.slow
def test_it_has_few_shapes_and_is_neither_simplified_nor_compiled_twice(
    scene: SceneSpec, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = track(scene)
    for module, name in (
        (fixed_mesh_module, "fixed_mesh"),
        (polygon_cache.convex_faces, "convex_faces"),
        (compile_module, "_compile"),
    ):
        made = getattr(module, name)
        monkeypatch.setattr(
            module, name, lambda *a, m=made, n=name: m(*a) if is_small(a) else pytest.fail(n)
        )
    assert track(scene) == found


def is_small(arguments: tuple[object, ...]) -> bool:
    """Whether it is what is touched of a part of the vehicle, which is never kept."""
    first = arguments[0]
    return isinstance(first, list) and sum(map(len, first)) < 2000


@pytest.mark.slow
def test_a_track_has_the_same_bytes_without_a_cache(
    scene: SceneSpec, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, again = track(scene), track(scene)
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))  # nothing can be kept there
    assert first == again == track(scene)


@pytest.mark.slow
def test_check_names_the_errors_and_a_remedy_and_accepts_an_error_of_the_file(
    file: Path, scene: SceneSpec, tmp_path: Path
) -> None:
    said = [one.message for one in check_file(file) if "contacts with" in one.message]
    (message,) = said
    assert "'rock0' (0.0" in message
    assert "terrain" not in message  # it is exact
    assert "<u:contactError> in the object" in message
    error = "<u:contactError>{}</u:contactError> </object>"
    text = file.read_text()
    found = {}
    for value in ("0.05", "0.01"):
        changed = file.with_name(f"error{value}.xml")
        changed.write_text(text.replace("</object>", error.format(value)))
        found[value] = [m for one in check_file(changed) if "contacts" in (m := one.message)]
    assert found["0.05"] == []
    (message,) = found["0.01"]
    assert " plates for contacts, mostly of '" in message
    assert "<u:contactError>0.06</u:contactError> in the object" in message


@pytest.mark.slow
def test_what_is_set_on_the_floor_stands_on_what_is_touched(scene: SceneSpec) -> None:
    rock = scene.objects[1]
    cap = replace(rock, name="cap", is_solid=False, on_floor=OnFloorSpec())
    with open_scene(replace(scene, objects=(*scene.objects, cap))) as simulation:
        bodies = [simulation.world.bodies.find(name) for name in (rock.name, "cap")]
        rise = float(np.subtract(*(body.world_from_body.position[2] for body in bodies)))
        box = bodies[0].box
    assert box is not None
    height = box.upper[2] - box.lower[2]
    assert -height - 0.05 < rise < -0.7 * height  # it touches the top of the rock with its foot
