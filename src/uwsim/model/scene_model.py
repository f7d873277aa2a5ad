"""The model of a scene: everything that does not change while the scene runs."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from ..base.digest import digest_of
from ..base.engine import model_bytes, mujoco
from ..base.geometry import Pose, quaternion_from_rotation
from ..devices.device import DeviceSpec
from ..devices.object_picker import ObjectPickerSpec
from ..optics import Medium
from ..scene.mounts import MountFrames
from ..scene.spec import SceneSpec
from ..sensors.sensor import BindsSensor, MountedSensor
from .body_names import object_body, owner_of
from .collision.scene_shapes import collision_shapes
from .collision.shapes import CollisionShape
from .collision.solid_grounds import SolidGround, solid_grounds
from .parts import Part, parts_of
from .ray_bodies import RayBodies
from .resolved_scene import SimulatedScene
from .robots import find_file
from .water_density import density_levels

T = TypeVar("T")


@dataclass(frozen=True, eq=False, kw_only=True)
class SceneModel(SimulatedScene):
    """The model of a scene: everything that is computed before a simulation and then constant.

    `uwsim.physics.compile_scene.compile_scene` computes it from a scene, a seed, a timestep, search
    folders and compatibility quirks; several simulations share it. In its ``scene`` the placements
    on the floor (``<u:onFloor>``) are replaced by poses.
    """

    source: SceneSpec
    """The scene as it was read, with its integrator."""
    varied_scene: SceneSpec
    """The scene after the variations (``<u:vary>``) of the seed; its elements have their lines."""
    seed: int
    """The seed of the variations and of the random streams."""
    compatibility: frozenset[str]
    """The names of the active compatibility quirks."""
    engine_model: mujoco.MjModel
    """The model of the physics engine; each simulation uses a copy."""
    _results: dict[Callable[[SceneModel], Any], Any] = field(
        default_factory=dict, init=False, repr=False
    )

    def compute_once(self, compute: Callable[[SceneModel], T]) -> T:
        """Return the result of a function that depends on this model only, computed once.

        The function may be in a package of a higher layer. All simulations share the result, which
        must not be changed.
        """
        if compute not in self._results:
            self._results[compute] = compute(self)
        value: T = self._results[compute]
        return value

    @cached_property
    def digest(self) -> str:
        """The hash of scene, hydrodynamics and engine model; it does not depend on folders."""
        hash_of_engine = hashlib.sha256(model_bytes(self.engine_model)).hexdigest()
        return digest_of((self.scene, list(self.dynamics.items()), hash_of_engine))

    @cached_property
    def shape_owners(self) -> tuple[tuple[str, ...], npt.NDArray[np.int64]]:
        """The sorted owners of shapes, such as ``vehicle/1``, and the owner's index by shape."""
        engine = self.engine_model
        owners = [owner_of(engine.geom(i).name) for i in range(engine.ngeom)]
        names = sorted(set(owners))
        numbers = {name: i for i, name in enumerate(names)}
        return tuple(names), np.array([numbers[owner] for owner in owners], np.int64)

    @cached_property
    def parts(self) -> tuple[Part, ...]:
        """The visible parts of the scene, which are loaded at the first access."""
        return tuple(parts_of(self))

    @cached_property
    def mount_frames(self) -> tuple[MountFrames, ...]:
        """The frames of each vehicle at its pose in the file, for poses of mounted parts."""
        world_from_localized = self.scene.world_from_localized
        vehicles = enumerate(self.scene.vehicles)
        return tuple(
            MountFrames(spec, self.robots[index], world_from_localized) for index, spec in vehicles
        )

    @cached_property
    def sensor_specs(self) -> tuple[tuple[int, str, BindsSensor], ...]:
        """The sensors that are not devices: vehicle index, element name and spec of each."""
        return tuple(
            (index, element, part)
            for index, vehicle in enumerate(self.scene.vehicles)
            for element, part in vehicle.all_parts()
            if not isinstance(part, DeviceSpec) and isinstance(part, BindsSensor)
        )

    @cached_property
    def mounted_sensors(self) -> tuple[tuple[int, MountedSensor], ...]:
        """The sensors and devices with a mounting frame: vehicle index and spec of each."""
        return tuple(
            (index, part)
            for index, vehicle in enumerate(self.scene.vehicles)
            for _, part in vehicle.all_parts()
            if isinstance(part, MountedSensor)
        )

    @cached_property
    def all_shapes(self) -> Mapping[str, tuple[CollisionShape, ...]]:
        """The collision shapes by body, including bodies that the engine does not move."""
        scene = self.scene
        vehicles = range(len(scene.vehicles))
        return collision_shapes(self, vehicles, scene.solid_objects)

    @cached_property
    def placed_objects(self) -> Mapping[int, Pose]:
        """The pose in W of each object that is not a body of the engine, by object index."""
        bodies = {self.engine_model.body(i).name for i in range(self.engine_model.nbody)}
        return {
            index: _round_to_quaternion(
                self.scene.world_from_localized @ spec.localized_from_object
            )
            for index, spec in enumerate(self.scene.objects)
            if object_body(index) not in bodies
        }

    @cached_property
    def fixed_objects(self) -> Mapping[int, Pose]:
        """The pose in W of each object that never moves and cannot be picked up, by index."""
        scene = self.scene
        has_picker = any(vehicle.parts_of(ObjectPickerSpec) for vehicle in scene.vehicles)
        return {
            index: pose
            for index, pose in self.placed_objects.items()
            if scene.objects[index].is_ground or not has_picker
        }

    @cached_property
    def ray_bodies(self) -> RayBodies:
        """The visible surfaces for ray casting."""
        return RayBodies(self.scene, self.parts, self.fixed_objects)

    @cached_property
    def grounds(self) -> tuple[SolidGround, ...]:
        """The objects that are solid ground, which no body may pass through."""
        return tuple(solid_grounds(self.scene, self.shapes, self.data_path))

    @cached_property
    def density_levels(self) -> tuple[tuple[float, float], ...]:
        """The depth [m] and density [kg/m3] of each level of the water; uniform water has one."""
        return density_levels(self.scene.ocean_state, self.dynamics)

    @cached_property
    def optical_water(self) -> Medium | None:
        """The water of the physical law of images; None if the scene has the fog law."""
        water = self.scene.ocean_state.water
        if water is None:
            return None
        return water.read_medium(lambda name: find_file(name, self.scene.path, self.data_path))

    @cached_property
    def hydrodynamics_files(self) -> Mapping[str, Path]:
        """The paths of the vehicles' hydrodynamics files, by file name."""
        return {path.name: path for dynamics in self.dynamics.values() for path in dynamics.files}


def _round_to_quaternion(pose: Pose) -> Pose:
    """Return a pose after conversion to the engine's quaternion and back."""
    rotation, quaternion = np.zeros(9), quaternion_from_rotation(pose.rotation)
    mujoco.mju_normalize4(quaternion)
    mujoco.mju_quat2Mat(rotation, quaternion)
    return Pose(pose.position.copy(), rotation.reshape(3, 3))
