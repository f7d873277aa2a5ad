"""Poses of vehicles, links, mounts and objects, as copies."""

from __future__ import annotations

from dataclasses import dataclass, field

import mujoco
import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Pose
from ..base.numerics.calls import address_of
from ..base.numerics.linear import product, rotate, world_positions
from ..base.record import Record
from ..model.body_names import object_body, vehicle_body
from ..model.scene_model import SceneModel
from .kinematics.link_kernel import MOUNT, compute_frame, scaled_axes

Mount = npt.NDArray[np.void]
"""A record of `link_kernel.MOUNT`, (1,)."""


@dataclass(slots=True)
class PosesState(Record):
    """What changes of the frames of a scene."""

    version: int = 0
    """Grows whenever something was moved."""
    is_stale: bool = True
    """Whether the frames are out of date."""
    put: dict[int, Pose] = field(default_factory=dict)
    """Where objects were put that are no bodies of the engine."""
    carried: dict[int, tuple[int, str, Pose]] = field(default_factory=dict)
    """Objects that follow a link: number of the vehicle, link, and where on it they are."""


class Poses:
    """The frames of a scene, computed from the joints on demand.

    Args:
        scene_model: the model of the scene.
        model: that of the engine.
        data: its state.
    """

    def __init__(self, scene_model: SceneModel, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        scene, robots = scene_model.scene, scene_model.robots
        self._model, self._data = model, data
        # Views into MuJoCo's memory: to look them up by name costs more than the step.
        self.origins = data.xpos
        """Of the engine's bodies, as `refresh` left them, (nbody, 3) [m]."""
        self.axes = data.xmat.reshape(-1, 3, 3)
        """Of these, (nbody, 3, 3)."""
        ids = {model.body(i).name: i for i in range(model.nbody)}
        self._bases = {i: ids[vehicle_body(i, robots[i].root)] for i in robots}
        self._links = {
            (i, link.name): ids[vehicle_body(i, link.name)]
            for i in robots
            for link in robots[i].links
        }
        names = {i: object_body(i) for i in range(len(scene.objects))}
        self._loose = {i: ids[name] for i, name in names.items() if name in ids}
        self._placed = scene_model.placed_objects
        self._fixed = scene_model.fixed_objects
        scales = {i: vehicle.scale_factor for i, vehicle in enumerate(scene.vehicles)}
        self._scales = {i: scale for i, scale in scales.items() if scale != (1.0, 1.0, 1.0)}
        self.state = PosesState()
        """What changes of them."""

    @property
    def version(self) -> int:
        """A number that grows whenever something was moved."""
        return self.state.version

    def moved(self) -> None:
        """Mark the frames as out of date."""
        self.state.is_stale = True
        self.state.version += 1

    def refresh(self) -> None:
        """Compute the frames, if they are out of date."""
        if self.state.is_stale:
            mujoco.mj_kinematics(self._model, self._data)
            self.state.is_stale = False

    def base(self, index: int) -> int:
        """Return the engine's number of a vehicle's base."""
        return self._bases[index]

    def link_body(self, index: int, link: str) -> int:
        """Return the engine's number of a vehicle's link."""
        return self._links[index, link]

    def engine_body(self, vehicle: int | None, link: str, thing: int | None) -> int:
        """Return the engine's body whose frame is that of a link or an object; -1 for none.

        The frame of a scaled vehicle's link is none of these, nor that of an object which follows
        a link.
        """
        if vehicle is not None:
            return -1 if vehicle in self._scales else self._links[vehicle, link]
        if thing is None or thing in self._placed or thing in self.state.carried:
            return -1
        return self._loose[thing]

    def vehicle(self, index: int) -> Pose:
        """Return ``world_from_base`` of a vehicle."""
        return self._body(self._bases[index])

    def link(self, index: int, link: str) -> Pose:
        """Return ``world_from_link`` (the kinematic frame) of a vehicle's link."""
        return self._body(self._links[index, link])

    def link_frame(self, index: int, link: str) -> Array:
        """Return ``world_from_link`` with the vehicle's scale in it, (4, 4) [m]."""
        pose = self.link(index, link)
        frame = pose.matrix
        if index in self._scales:
            base, scale = self.vehicle(index).rotation, np.array(self._scales[index])
            frame[:3, :3] = scaled_axes(base, pose.rotation, scale)
        return frame

    def mount(self, index: int, link: str, link_from_part: Pose) -> Mount:
        """Return the record of a part on a link, for `mounted` and for compiled code.

        Args:
            index: number of the vehicle.
            link: name of the link.
            link_from_part: where the file puts it on the link.
        """
        body, mount = self._links[index, link], np.zeros(1, MOUNT)
        mount["origin"] = address_of(self.origins) + 24 * body
        mount["axes"] = address_of(self.axes) + 72 * body
        mount["position"], mount["rotation"] = link_from_part.position, link_from_part.rotation
        if index in self._scales:
            mount["base_axes"] = address_of(self.axes) + 72 * self._bases[index]
            mount["scale"] = self._scales[index]
        return mount

    def mounted(self, mount: Mount) -> Pose:
        """Return where a part on a link is; the vehicle's scale moves it and does not turn it."""
        self.refresh()
        frame = compute_frame(mount)
        return Pose(frame[:3], frame[3:].reshape(3, 3))

    def object(self, index: int) -> Pose:
        """Return ``world_from_object`` (before its offsets and its scale)."""
        if index in self.state.carried:
            vehicle, link, link_from_object = self.state.carried[index]
            world_from_link = self.link(vehicle, link)
            return world_from_link @ link_from_object
        if index in self._placed:
            return self.state.put.get(index, self._placed[index]).copy()
        return self._body(self._loose[index])

    def put(self, index: int, world_from_object: Pose) -> None:
        """Set the pose of an object that is no body of the engine."""
        self.state.put[index] = world_from_object

    def loose_body(self, index: int) -> int | None:
        """Return the engine's number of an object; None where it is no body of the engine."""
        return self._loose.get(index)

    def rows(self, bodies: npt.NDArray[np.intp]) -> Array:
        """Return position in W [m] and quaternion (wxyz) of bodies of the engine, (n, 7)."""
        self.refresh()
        return np.concatenate([self._data.xpos[bodies], self._data.xquat[bodies]], axis=1)

    def show(self, bodies: npt.NDArray[np.intp], rows: Array) -> None:
        """Put frames where they were in another run, for images; the engine's state stays.

        What is fixed to these bodies follows them. The next `moved` undoes it.

        Args:
            bodies: numbers of the engine's bodies.
            rows: position in W [m] and quaternion (wxyz) of each, (n, 7).
        """
        self.refresh()
        model, axes = self._model, np.zeros(9)
        shown = dict(zip(bodies.tolist(), rows, strict=True))
        follows = set(shown)
        for body in range(1, model.nbody):
            parent = int(model.body_parentid[body])
            if body in shown:
                mujoco.mju_quat2Mat(axes, np.ascontiguousarray(shown[body][3:]))
                self.origins[body], self.axes[body] = shown[body][:3], axes.reshape(3, 3)
            elif parent in follows:
                follows.add(body)
                mujoco.mju_quat2Mat(axes, model.body_quat[body])
                self.origins[body] = self.origins[parent] + rotate(
                    self.axes[parent], model.body_pos[body]
                )
                self.axes[body] = product(self.axes[parent], axes.reshape(3, 3))
        self.state.version += 1

    def is_fixed(self, index: int) -> bool:
        """Whether an object stays where it is for good."""
        return index in self._fixed

    def points(self, bodies: npt.NDArray[np.int64], on_bodies: Array) -> Array:
        """Return where points (n, 3) [m] of some bodies are, in W, (n, 3) [m]."""
        self.refresh()
        return world_positions(self.origins, self.axes, bodies, on_bodies)

    def _body(self, body: int) -> Pose:
        self.refresh()
        return Pose(self.origins[body].copy(), self.axes[body].copy())
