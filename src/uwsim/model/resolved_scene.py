"""A scene before its model is compiled: with its robots, then with the engine's inputs."""

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
    """A scene with its robots."""

    scene: SceneSpec
    """The spec."""
    robots: Mapping[int, RobotSpec]
    """The robot of each vehicle, by its number in the scene."""
    data_path: tuple[Path, ...] = ()
    """The folders that are searched for files."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SimulatedScene(ResolvedScene):
    """A scene with everything from which the engine's model is compiled."""

    dynamics: Mapping[int, VehicleHydrodynamics]
    """The hydrodynamics of each vehicle that is simulated, by its number."""
    shapes: Mapping[str, tuple[CollisionShape, ...]]
    """The collision shapes of the simulated bodies, by the name of the body."""
    timestep: float
    """The length of a step [s]."""
