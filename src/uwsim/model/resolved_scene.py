"""A scene with the contents of its other files: robots, hydrodynamics, collision shapes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ..scene.hydrodynamics import VehicleHydrodynamics
from ..scene.spec import SceneSpec
from ..scene.urdf.robot import RobotSpec
from .collision.shapes import CollisionShape


@dataclass(frozen=True, eq=False, kw_only=True)
class ResolvedScene:
    """A scene with the robots of its vehicles."""

    scene: SceneSpec
    """The spec of the scene."""
    robots: Mapping[int, RobotSpec]
    """The robot of each vehicle, by the vehicle's index in the scene."""
    data_path: tuple[Path, ...] = ()
    """The folders that are searched for files."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SimulatedScene(ResolvedScene):
    """A scene with everything from which the model of the physics engine is compiled."""

    dynamics: Mapping[int, VehicleHydrodynamics]
    """The hydrodynamics of each vehicle with dynamics, by the vehicle's index."""
    shapes: Mapping[str, tuple[CollisionShape, ...]]
    """The collision shapes of the engine's bodies, by the name of the body."""
    timestep: float
    """The length of a step [s]."""
