"""A scene on the way to its model: with its robots, then with what the engine is made of."""

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
    """A scene whose robots are read."""

    scene: SceneSpec
    """The spec."""
    robots: Mapping[int, RobotSpec]
    """The robot of each vehicle, by its number in the scene."""
    data_path: tuple[Path, ...] = ()
    """The folders in which files are looked for."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SimulatedScene(ResolvedScene):
    """A scene with all that the engine's model is compiled from."""

    dynamics: Mapping[int, VehicleHydrodynamics]
    """The hydrodynamics of each vehicle that is simulated, by its number."""
    shapes: Mapping[str, tuple[CollisionShape, ...]]
    """The collision shapes of what is simulated, by the name of its body."""
    timestep: float
    """The length of a step [s]."""
