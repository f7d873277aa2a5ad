"""The state of a simulation is all that changes of it: what a run changes is back after restore.

Every object that a running scene leads to is visited before and after some steps, and once more
after the state was restored. What differs then is neither in the state nor follows from it.
"""

from __future__ import annotations

import os
import types
from collections import deque
from collections.abc import Iterator
from dataclasses import is_dataclass
from functools import partial
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

import uwsim
from tests.support.opened import open_scene
from uwsim.assets.bundled import bundled_files
from uwsim.base.record import GeneratorState
from uwsim.messages import (
    JointState,
    Twist,
    TwistStamped,
    UInt8MultiArray,
    Vector3,
)
from uwsim.model.scene_model import SceneModel
from uwsim.scene.reader import read_scene

EVERYTHING = Path(__file__).parent / "everything.xml"
CACHES = {
    "Bus._revision": "counts who comes and goes",
    "Bus._topics": "who is at the ends of topics, and what was said to them",
    "CompiledVehicle._sampled_twist": "is written before each sample",
    "Dvl._flow": "is written before each sample",
    "Dvl._row": "has the addresses of the water, which is compared when it is used",
    "Dvl._water": "is compared with the flow when it is used",
    "EngineContacts._arrays": "is looked up again when the memory was set",
    "EngineMemory._arena": "has gaps that the engine does not write",
    "EngineMemory._addresses": "0 for none or elsewhere, as the arena",
    "EngineMemory._struct": "has counters of the engine and paddings; what counts is in `_counts`",
    "Ground._double_areas": "is a form of the model's",
    "Ground._grids": "is a form of the model's",
    "Ground._high": "is a form of the model's",
    "Ground._low": "is a form of the model's",
    "Ground._triangles": "is a form of the model's",
    "ImagePublisher._digest": "is of the images published",
    "Inbox._n_bytes": "what a program has not taken yet",
    "Inbox._messages": "what a program has not taken yet",
    "Inbox._sizes": "what a program has not taken yet",
    "FlatPort._paraxial": "is a function of the port",
    "FlatPort.constants": "is a function of the port",
    "FlatPort.surfaces": "is a function of the port",
    "HeapModels._drawn_heaps": "is compared with the heaps when it is used",
    "Intrinsics.ray_lengths": "is a function of the pinhole",
    "Lens._constants": "is a function of the lens",
    "KinematicContacts._poses": "is compared with the poses when it is used",
    "JointCommand._named": "is compared with the message when it is used",
    "JointCommand._places": "is compared with the message when it is used",
    "LinkMotion._joint_rates": "is written before it is read",
    "LinkMotion._scratch": "is written before it is read",
    "Motion._numbers": "is written before it is read",
    "PartPoses._bodies": "is compared with the state when it is used",
    "PartPoses._carried_objects": "is compared with the state when it is used",
    "PartPoses._unattached_parts": "is compared with the state when it is used",
    "PrescribedMotion._accelerations": "is written before it is read",
    "PrescribedMotion._speeds": "is written before it is read",
    "RandomTable._rows": "is a function of the time",
    "RandomTable.record": "says where these rows are",
    "RayScene._bodies": "is compared with the engine when it is used",
    "RayScene._engine": "is MuJoCo's memory",
    "Sampler.parameters": "are the row of the sensor, and nothing of them is drawn",
    "SceneRays._carried_objects": "is compared with the state when it is used",
    "SceneRays._ray_scene": "is laid anew for other carried objects",
    "SceneRays._recorded_scene": "is compared with what is laid when it is used",
    "SceneRays._placed_bodies": "is compared with the state when it is used",
    "SceneRays._records": "are the addresses of what is laid",
    "Schedule._rows": "is written before it is read",
    "Scenery._drawn_version": "is set to draw anew",
    "Scenery._projector": "is placed when it is drawn",
    "Scenery._renderer": "draws what the state says",
    "SolidGround._faces": "is a form of the model's",
    "Stepper._plan": "is written before each step",
    "Stepper._poses": "is written before each step",
    "Stepper._rows": "is written before each step",
    "Stepper._table": "is compared with the samples when it is used",
    "TerrainTiles._handles": "are those of the tiles for the last image",
    "TerrainTiles._models": "are made again when they are drawn",
    "TerrainTiles._texture": "is made when a tile is first drawn",
    "TerrainTiles._tiles": "follow from the position of the camera at each image",
    "WaterMotion._last_added_flow": "is compared with the state when it is used",
    "WaterMotion._drift_cache": "is compared with flow and vehicles when it is used",
    "WaterMotion._point_cache": "is compared with the flow when it is used",
    "WaterMotion._wave_cache": "is compared with the flow when it is used",
    "WaterMotion._water_cache": "is compared with flow and vehicles when it is used",
    "WaterMotion._sum": "is compared with the state when it is used",
}
"""Attributes that are no state: what is written before it is read, or looked up anew."""
CONTAINERS = (dict, list, tuple, deque, set, frozenset)
LEFT_OUT = (SceneModel, mujoco.MjModel, mujoco.MjData, types.ModuleType, type, Path)
"""What does not change; MuJoCo's data is `EngineMemory`."""


class Visitor:
    """Visits a simulation several times; an object keeps the path by which it was found first."""

    def __init__(self) -> None:
        self._paths: dict[int, str] = {}
        self._kept: list[object] = []  # so that no other object gets the same id

    def visit(self, simulation: uwsim.Simulation) -> dict[str, object]:
        """Path of every value that the simulation leads to -> the value, or its bytes."""
        found: dict[str, object] = {}
        waiting: deque[tuple[str, Any]] = deque([("", simulation)])
        seen: set[int] = set()
        while waiting:
            path, value = waiting.popleft()
            if isinstance(value, np.ndarray):
                found[path] = value.tobytes()
            elif isinstance(value, np.random.Generator):
                found[path] = GeneratorState.from_generator(value)
            elif value is None or isinstance(value, bool | int | float | str | bytes | np.generic):
                found[path] = repr(value)
            elif isinstance(value, LEFT_OUT):
                continue
            elif isinstance(value, CONTAINERS) or is_dataclass(value):
                waiting += [(f"{path}{name}", each) for name, each in parts(value)]
            elif id(value) not in seen:
                seen.add(id(value))
                path = self._paths.setdefault(id(value), path)
                self._kept.append(value)
                waiting += [(f"{path}{name}", each) for name, each in parts(value)]
        return found


def parts(value: Any) -> Iterator[tuple[str, Any]]:
    """What an object leads to, with how."""
    if isinstance(value, dict):
        yield "{len}", len(value)
        yield from ((f"[{key!r:.40}]", each) for key, each in value.items())
    elif isinstance(value, CONTAINERS):
        yield "{len}", len(value)
        yield from ((f"[{i}]", each) for i, each in enumerate(value))
    elif isinstance(value, partial):
        yield from (("()", each) for each in (value.func, value.args, value.keywords))
    elif isinstance(value, types.MethodType):
        yield ".self", value.__self__
    elif isinstance(value, types.FunctionType):
        cells = value.__closure__ or ()
        yield from (
            (f"({n})", c.cell_contents)
            for n, c in zip(value.__code__.co_freevars, cells, strict=True)
            if not is_empty(c)
        )
    elif type(value).__module__.startswith(("uwsim.", "collections")):
        names = [*getattr(value, "__dict__", {})]
        names += [n for kind in type(value).__mro__ for n in getattr(kind, "__slots__", ())]
        for name in names:
            owner = f"{type(value).__name__}.{name}"
            if owner not in CACHES and hasattr(value, name):
                yield f".<{owner}>", getattr(value, name)


def is_empty(cell: types.CellType) -> bool:
    try:
        _ = cell.cell_contents
    except ValueError:
        return True
    return False


def disturb(simulation: uwsim.Simulation) -> None:
    """Command all that takes commands."""
    topics = simulation.topics
    twist = Twist(linear=Vector3(0.2, 0.1, 0.0), angular=Vector3(0.0, 0.0, 0.1))
    joints = JointState(position=np.full(5, 0.3))
    sent: list[tuple[str, object]] = [
        ("dataNavigator", TwistStamped(twist=twist)),
        ("rov/twist", TwistStamped(twist=twist)),
        ("operator/twist", TwistStamped(twist=twist)),
        ("puppet/cmd_vel", twist),
        ("rov/arm", joints),
        ("puppet/arm", joints),
        ("modem/tx", UInt8MultiArray(data=np.arange(40, dtype=np.uint8))),
        ("near/tx", UInt8MultiArray(data=np.arange(4, dtype=np.uint8))),
    ]
    for topic, message in sent:
        if topics.get(topic) == getattr(type(message), "__msgtype__", None):
            simulation.publish(topic, message)


SCENES = [*sorted(bundled_files("scenes")), "everything"]
N_CYCLES = int(os.environ.get("UWSIM_CYCLES", "12"))
"""How often a run is saved and restored."""


def opened(scene: str) -> uwsim.Simulation:
    path = EVERYTHING if scene == "everything" else bundled_files("scenes")[scene]
    simulation = open_scene(read_scene(path), seed=3)
    for topic in sorted(simulation.topics):
        simulation.latest_message(topic)
    return simulation


def run_on(simulation: uwsim.Simulation) -> None:
    disturb(simulation)
    if (
        simulation.world.model.scene.ocean_state.water is None
    ):  # fog has no effect in physical water
        simulation.set_fog(0.3)
    simulation.set_light(0.5)
    simulation.set_current((0.1, 0.2, 0.0))
    simulation.advance(0.4)


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES)
def test_what_a_run_changes_is_back_after_restore(scene: str) -> None:
    with opened(scene) as simulation:
        for step in (0.05, 0.12):
            simulation.advance(step)
            disturb(simulation)
        simulation.advance()
        visitor, state = Visitor(), simulation.state.copy()
        before = visitor.visit(simulation)
        run_on(simulation)
        assert simulation.state != state
        during = visitor.visit(simulation)
        assert sum(before.get(path) != value for path, value in during.items()) > 5
        simulation.restore(state)
        assert differing(before, visitor.visit(simulation)) == []
        assert simulation.state == state
        run_on(simulation)
        assert differing(during, visitor.visit(simulation)) == []


def differing(first: dict[str, object], second: dict[str, object]) -> list[str]:
    return sorted(p for p in {*first, *second} if first.get(p) != second.get(p))


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES)
def test_a_run_that_is_saved_and_restored_at_random_steps_is_the_same(
    scene: str,
) -> None:
    chance = np.random.default_rng(7)
    with opened(scene) as once, opened(scene) as often:
        for _ in range(N_CYCLES):
            for _ in range(int(chance.integers(1, 12))):
                once.advance()
                often.advance()
            if chance.random() < 0.3:
                disturb(once)
                disturb(often)
            saved = often.save()
            often.advance(0.002 * int(chance.integers(1, 30)))
            disturb(often)
            often.advance()
            often.restore(saved)
            assert often.state == once.state
            assert often.save() == saved
