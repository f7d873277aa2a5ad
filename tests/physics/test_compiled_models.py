"""Models that were kept on disk are the models that were compiled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from uwsim.base.geometry import Pose
from uwsim.model.body_names import object_body
from uwsim.model.collision.shapes import CollisionShape
from uwsim.model.resolved_scene import SimulatedScene
from uwsim.physics import compiled_models
from uwsim.physics import engine_model as compile_module
from uwsim.physics.compiled_models import NoContent, cached_model, content_digest
from uwsim.physics.engine_model import compile_engine_model
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.spec import SceneSpec
from uwsim.schema.source_line import SourceLine

STEPS = tuple(
    CollisionShape(
        kind="box",
        size=(0.1, 0.1, 0.1),
        body_from_shape=Pose(np.array([k, 0.0, 0.1 * k]), np.eye(3)),
    )
    for k in range(20)
)
WEDGE = CollisionShape(
    kind="hull",
    body_from_shape=Pose.identity(),
    corners=np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
)
TILE = CollisionShape(
    kind="height field",
    body_from_shape=Pose.identity(),
    size=(1.0, 1.0, 0.5, 1.0),
    heights=np.array([[0.0, 0.5], [0.25, 0.0]]),
)
STAIRS = ObjectSpec(name="stairs", file="", physics=PhysicsSpec(mass=0.0))
SCENE = SceneSpec(objects=(STAIRS,))
SHAPES = {object_body(0): (*STEPS, WEDGE, TILE)}


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(compiled_models, "MIN_SHAPES", 10)
    return tmp_path / "uwsim" / "compiled"


def simulated(scene: SceneSpec, timestep: float, shapes: Any) -> SimulatedScene:
    return SimulatedScene(scene=scene, robots={}, dynamics={}, shapes=shapes, timestep=timestep)


def bytes_of(model: mujoco.MjModel) -> bytes:
    packed = np.zeros(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, packed)
    return packed.tobytes()


def model(timestep: float = 0.002, **changes: object) -> bytes:
    return bytes_of(compile_engine_model(simulated(replace(SCENE, **changes), timestep, SHAPES)))  # type: ignore[arg-type]


def test_a_kept_model_is_read_and_not_compiled(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = model()
    (file,) = cache.iterdir()
    with monkeypatch.context() as patch:
        patch.setattr(compile_module, "_compile", lambda *_: pytest.fail("was compiled again"))
        assert model() == found
    file.write_bytes(file.read_bytes()[:-100])
    assert model() == found
    monkeypatch.setattr(compiled_models, "MIN_SHAPES", 10_000)
    assert model() == found


def test_another_scene_or_step_is_another_model(cache: Path) -> None:
    found = model()
    assert model(0.004) != found
    assert model(objects=(replace(STAIRS, position=(0.0, 0.0, 1.0)),)) != found
    assert len(list(cache.iterdir())) == 3


def test_few_shapes_leave_nothing_on_the_disk(cache: Path) -> None:
    compile_engine_model(simulated(SCENE, 0.002, {object_body(0): STEPS[:5]}))
    assert not cache.exists()


def moved(shape: CollisionShape, **changes: object) -> tuple[CollisionShape, ...]:
    return (*STEPS, WEDGE, TILE, replace(shape, **changes))  # type: ignore[arg-type]


CONTENTS: dict[str, object] = {
    "none": None, "zero": 0, "false": False, "float": 0.0, "negative": -0.0, "text": "0",
    "bytes": b"0", "path": Path("0"), "one": (1,), "two": (1, 1), "nested": ((1,), 1),
    "joined": ("ab", "c"), "split": ("a", "bc"), "empty": (), "mapping": {"a": 1},
    "swapped": {1: "a"}, "array": np.zeros(2), "integers": np.zeros(2, np.int64),
    "row": np.zeros((1, 2)), "pose": Pose.identity(), "spec": STAIRS,
    "friction": PhysicsSpec(mass=0.0, friction=0.3), "shapes": moved(WEDGE),
    "wider": moved(WEDGE, size=(1.0,)), "kind": moved(WEDGE, kind="box"),
    "corners": moved(WEDGE, corners=np.eye(3)), "no corners": moved(WEDGE, corners=None),
    "heights": moved(TILE, heights=np.eye(2)),
    "place": moved(TILE, body_from_shape=STEPS[1].body_from_shape),
    "form": moved(WEDGE, corners=np.eye(3).reshape(1, 9)),
}  # fmt: skip


def test_values_that_differ_have_other_hashes() -> None:
    digests = {name: content_digest([value]) for name, value in CONTENTS.items()}
    assert len(set(digests.values())) == len(CONTENTS)
    assert digests == {name: content_digest([value]) for name, value in CONTENTS.items()}


def test_where_a_spec_was_read_is_no_part_of_its_content() -> None:
    lines = [SourceLine("a.xml", 3), SourceLine("b.xml", 30, {"name": 31}), None]
    digests = {content_digest([replace(STAIRS, source_line=line)]) for line in lines}
    assert len(digests) == 1


def test_what_cannot_be_hashed_is_compiled_anew(cache: Path) -> None:
    def build() -> mujoco.MjModel:
        return mujoco.MjSpec().compile()

    unknown: Callable[[], mujoco.MjModel] = build
    with pytest.raises(NoContent, match="function"):
        content_digest([unknown])
    assert bytes_of(cached_model([unknown], 100, build)) == bytes_of(build())
    assert not cache.exists()
