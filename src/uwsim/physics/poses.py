"""The poses of vehicles, links, mounts and objects; all methods return copies."""

from __future__ import annotations

from dataclasses import dataclass, field

import mujoco
import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Pose
from ..base.numerics.calls import address_of
from ..base.numerics.linear import product, rotate, world_positions
from ..base.record import Record
from ..model.body_names import object_body, segment_body, vehicle_body
from ..model.scene_model import SceneModel
from .kinematics.fixtures import Fixtures
from .kinematics.link_kernel import MOUNT, compute_frame, scaled_axes
from .kinematics.segments import SegmentBodies

Mount = npt.NDArray[np.void]
"""A record of `link_kernel.MOUNT`, (1,)."""


@dataclass(slots=True)
class PosesState(Record):
    """The state of the poses of a scene."""

    version: int = 0
    """The number of changes of poses so far."""
    is_stale: bool = True
    """True if the engine's frames are out of date."""
    placed_poses: dict[int, Pose] = field(default_factory=dict)
    """The set poses in W of objects that are not bodies of the engine, by index."""
    carriers: dict[int, tuple[int, str, Pose]] = field(default_factory=dict)
    """The vehicle, the link, and the pose in the link's frame of each object that follows a link,
    by the index of the object."""


class Poses:
    """The poses of a scene, computed from the positions of joints on demand.

    Args:
        scene_model: the model of the scene.
        model: the engine's model.
        data: the engine's state.
    """

    def __init__(self, scene_model: SceneModel, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        scene, robots = scene_model.scene, scene_model.robots
        self._model, self._data = model, data
        # Views into MuJoCo's memory: access by name takes longer than the step.
        self.origins = data.xpos
        """The origins of the engine's bodies in W, as `refresh` computed them, (nbody, 3) [m]."""
        self.axes = data.xmat.reshape(-1, 3, 3)
        """The rotation matrices ``world_from_body`` of these bodies, (nbody, 3, 3)."""
        ids = {model.body(i).name: i for i in range(model.nbody)}
        self.fixtures = Fixtures(scene, model, data)
        """The hinges and slides of objects."""
        self._bases = {i: ids[vehicle_body(i, robots[i].root)] for i in robots}
        self._links = {
            (i, link.name): ids[vehicle_body(i, link.name)]
            for i in robots
            for link in robots[i].links
        }
        names = {i: object_body(i) for i in range(len(scene.objects))}
        self._loose_bodies = {i: ids[name] for i, name in names.items() if name in ids}
        self._segments = {name: body for name, body in ids.items() if name.startswith("force/")}
        self._initial_poses = scene_model.placed_objects
        self._fixed = scene_model.fixed_objects
        scales = {i: vehicle.scale_factor for i, vehicle in enumerate(scene.vehicles)}
        self._scales = {i: scale for i, scale in scales.items() if scale != (1.0, 1.0, 1.0)}
        self.state = PosesState()
        """The state of the poses."""

    @property
    def version(self) -> int:
        """A number that grows whenever a body was moved."""
        return self.state.version

    def mark_stale(self) -> None:
        """Mark the frames as out of date."""
        self.state.is_stale = True
        self.state.version += 1

    def refresh(self) -> None:
        """Compute the frames if they are out of date."""
        if self.state.is_stale:
            mujoco.mj_kinematics(self._model, self._data)
            self.state.is_stale = False

    def base(self, index: int) -> int:
        """Return the MuJoCo body ID of a vehicle's base."""
        return self._bases[index]

    def link_body(self, index: int, link: str) -> int:
        """Return the MuJoCo body ID of a vehicle's link."""
        return self._links[index, link]

    def engine_body(self, vehicle: int | None, link: str, index: int | None) -> int:
        """Return the engine's body with the frame of a part of the scene; -1 without such a body.

        A link of a scaled vehicle and an object that follows a link have none.

        Args:
            vehicle: the index of the vehicle; None for an object or a segment.
            link: the name of the link; or of a segment, as of `segment_body`.
            index: the index of the object; None for a link or a segment.
        """
        if vehicle is not None:
            return -1 if vehicle in self._scales else self._links[vehicle, link]
        if index is None:
            return self._segments[link]
        if index in self._initial_poses or index in self.state.carriers:
            return -1
        return self._loose_bodies[index]

    def vehicle(self, index: int) -> Pose:
        """Return ``world_from_base`` of a vehicle."""
        return self._body(self._bases[index])

    def link(self, index: int, link: str) -> Pose:
        """Return ``world_from_link`` (the kinematic frame) of a vehicle's link."""
        return self._body(self._links[index, link])

    def link_frame(self, index: int, link: str) -> Array:
        """Return ``world_from_link`` including the scale of the vehicle, (4, 4)."""
        pose = self.link(index, link)
        frame = pose.matrix
        if index in self._scales:
            base, scale = self.vehicle(index).rotation, np.array(self._scales[index])
            frame[:3, :3] = scaled_axes(base, pose.rotation, scale)
        return frame

    def mount(self, index: int, link: str, link_from_part: Pose) -> Mount:
        """Return the record of a part mounted on a link, for `mount_pose` and for compiled code.

        Args:
            index: the index of the vehicle.
            link: the name of the link.
            link_from_part: the pose of the part in the frame of the link.
        """
        body, mount = self._links[index, link], np.zeros(1, MOUNT)
        mount["origin"] = address_of(self.origins) + 24 * body
        mount["axes"] = address_of(self.axes) + 72 * body
        mount["position"], mount["rotation"] = link_from_part.position, link_from_part.rotation
        if index in self._scales:
            mount["base_axes"] = address_of(self.axes) + 72 * self._bases[index]
            mount["scale"] = self._scales[index]
        return mount

    def mount_pose(self, mount: Mount) -> Pose:
        """Return ``world_from_part``; the scale of a vehicle moves the part without turning it."""
        self.refresh()
        frame = compute_frame(mount)
        return Pose(frame[:3], frame[3:].reshape(3, 3))

    def object(self, index: int) -> Pose:
        """Return ``world_from_object``, without the offset and scale of the object's visual."""
        if index in self.state.carriers:
            vehicle, link, link_from_object = self.state.carriers[index]
            world_from_link = self.link(vehicle, link)
            return world_from_link @ link_from_object
        if index in self._initial_poses:
            return self.state.placed_poses.get(index, self._initial_poses[index]).copy()
        return self._body(self._loose_bodies[index])

    def segment_body(self, name: str) -> int:
        """Return the MuJoCo ID of a segment that a force places, by its name in the model."""
        return self._segments[name]

    def segments(self, force: int, n: int, length: float) -> SegmentBodies:
        """Return the cylinders that show a force.

        Args:
            force: the index of the force in the scene.
            n: the number of cylinders.
            length: the length of a cylinder [m].
        """
        first = int(self._model.body_mocapid[self._segments[segment_body(force, 0)]])
        rows = slice(first, first + n)
        positions, quaternions = self._data.mocap_pos[rows], self._data.mocap_quat[rows]
        return SegmentBodies(positions, quaternions, length, self.mark_stale)

    def segment(self, name: str) -> Pose:
        """Return ``world_from_segment`` of a segment that a force places."""
        return self._body(self._segments[name])

    def place_object(self, index: int, world_from_object: Pose) -> None:
        """Set the pose of an object that is not a body of the engine."""
        self.state.placed_poses[index] = world_from_object

    def loose_body(self, index: int) -> int | None:
        """Return the MuJoCo ID of an object; None if it is not a body of the engine."""
        return self._loose_bodies.get(index)

    def read_frames(self, bodies: npt.NDArray[np.intp]) -> Array:
        """Return the position in W [m] and quaternion (wxyz) of bodies of the engine, (n, 7)."""
        self.refresh()
        return np.concatenate([self._data.xpos[bodies], self._data.xquat[bodies]], axis=1)

    def set_frames(self, bodies: npt.NDArray[np.intp], rows: Array) -> None:
        """Overwrite the computed frames of bodies, to render poses of another run.

        Child bodies follow these bodies. The engine's state is not changed, and the frames are
        computed again after the next `mark_stale`.

        Args:
            bodies: the MuJoCo IDs of the bodies.
            rows: the position in W [m] and quaternion (wxyz) of each body, (n, 7).
        """
        self.refresh()
        model, axes = self._model, np.zeros(9)
        rows_by_body = dict(zip(bodies.tolist(), rows, strict=True))
        moved_bodies = set(rows_by_body)
        for body in range(1, model.nbody):
            parent = int(model.body_parentid[body])
            if body in rows_by_body:
                mujoco.mju_quat2Mat(axes, np.ascontiguousarray(rows_by_body[body][3:]))
                self.origins[body], self.axes[body] = rows_by_body[body][:3], axes.reshape(3, 3)
            elif parent in moved_bodies:
                moved_bodies.add(body)
                mujoco.mju_quat2Mat(axes, model.body_quat[body])
                self.origins[body] = self.origins[parent] + rotate(
                    self.axes[parent], model.body_pos[body]
                )
                self.axes[body] = product(self.axes[parent], axes.reshape(3, 3))
        self.state.version += 1

    def is_fixed(self, index: int) -> bool:
        """Return whether an object never moves."""
        return index in self._fixed

    def points(self, bodies: npt.NDArray[np.int64], on_bodies: Array) -> Array:
        """Return the positions in W of points that are fixed to bodies, (n, 3) [m].

        Args:
            bodies: the MuJoCo ID of the body of each point, (n,).
            on_bodies: the points in the frames of their bodies, (n, 3) [m].
        """
        self.refresh()
        return world_positions(self.origins, self.axes, bodies, on_bodies)

    def _body(self, body: int) -> Pose:
        self.refresh()
        return Pose(self.origins[body].copy(), self.axes[body].copy())
