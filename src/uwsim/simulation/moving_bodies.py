"""Frames that are fixed to links of vehicles, and the motion of these frames."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Pose
from ..base.numerics.calls import address_of, function_address, prepare_nothing
from ..base.sampling import Sampler, gather_sampler, number_addresses
from ..physics.engine import Engine
from ..physics.kinematics import link_kernel
from ..physics.kinematics.link_motion import LinkMotion
from ..physics.kinematics.prescribed_motion import PrescribedMotion
from ..physics.poses import Mount, Poses
from ..world import BodyMotion, Box
from ..world.mounts import MOUNT


class MountedBody:
    """A frame that is fixed to a link of a vehicle (`uwsim.world.Mount`).

    Args:
        name: the name ``vehicle/link``.
        poses: the poses of the engine's bodies.
        mount: the record of the frame, from `Poses.mount`.
    """

    box: Box | None = None
    """The bounding box: None, as a frame has no mesh."""

    def __init__(self, name: str, poses: Poses, mount: Mount) -> None:
        self._name, self._poses, self._mount = name, poses, mount

    @property
    def name(self) -> str:
        """The name ``vehicle/link``."""
        return self._name

    @property
    def world_from_body(self) -> Pose:
        """The present pose of the frame in W."""
        return self._poses.mount_pose(self._mount)

    @cached_property
    def functions(self) -> npt.NDArray[np.void]:
        """The addresses of the functions for compiled code, a record of `MOUNT`, (1,)."""
        functions = np.zeros(1, MOUNT)
        functions["pose"] = function_address(link_kernel.write_mount_frame)
        functions["motion"] = function_address(link_kernel.write_mount_motion)
        functions["parameters"] = address_of(self._mount)
        return functions

    @property
    def is_compiled(self) -> bool:
        """True if the functions stay valid during compiled steps without a call of `prepare`."""
        return True

    def prepare(self) -> None:
        """Update the values that `functions` read."""
        self._poses.refresh()


@dataclass(frozen=True, kw_only=True)
class MovingLink:
    """A link of a vehicle, and the objects from which its motion is read."""

    index: int
    """The index of the vehicle in the scene."""
    body: int
    """The MuJoCo ID of the link's body."""
    motion: LinkMotion
    """The motion of points on links."""
    prescribed_motion: Callable[[], PrescribedMotion | None]
    """A function that returns the prescribed motion of the vehicle; None if forces move it."""
    step: Callable[[], int]
    """A function that returns the number of steps taken so far."""


class MovingBody(MountedBody):
    """A frame that is fixed to a link, with its motion (`uwsim.world.MovingBody`).

    Args:
        name: the name ``vehicle/link``.
        poses: the poses of the engine's bodies.
        mount: the record of the frame, from `Poses.mount`.
        link: the link, and the sources of its motion.
    """

    def __init__(self, name: str, poses: Poses, mount: Mount, link: MovingLink) -> None:
        super().__init__(name, poses, mount)
        self._link = link
        self._is_prescribed: bool | None = None

    @property
    def is_compiled(self) -> bool:
        """True if the functions stay valid during compiled steps without a call of `prepare`."""
        return self._select_motion_source() is None

    def prepare(self) -> None:
        """Update the values that `functions` read."""
        self._poses.refresh()
        if (prescribed_motion := self._select_motion_source()) is not None:
            prescribed_motion.update(self._link.step())

    def _select_motion_source(self) -> PrescribedMotion | None:
        """Choose the motion that `functions` read; return the prescribed motion, if any."""
        link = self._link
        prescribed_motion = link.prescribed_motion()
        if (prescribed_motion is not None) is not self._is_prescribed:
            self._is_prescribed = prescribed_motion is not None
            chain = link.motion.chain(link.body, link.index if self._is_prescribed else None)
            self._mount["chain"] = chain
        return prescribed_motion

    def motion(self) -> BodyMotion:
        """Return the present motion of the frame."""
        link, point = self._link, self.world_from_body.position
        if (prescribed_motion := link.prescribed_motion()) is not None:
            prescribed_motion.update(link.step())
        return link.motion.point_motion(
            link.body, point, vehicle=None if prescribed_motion is None else link.index
        )


class CompiledVehicle:
    """The samplers of a vehicle for compiled code (`uwsim.world.CompiledVehicle`).

    Args:
        name: the name ``vehicle/root link``.
        root: the name of the root link, whose frame is the base frame.
        joints: the names of the joints in the joint vector.
        index: the index of the vehicle in the scene.
        engine: the engine, which stores the pose of the vehicle.
        prescribed_twist: returns the twist of the base if the motion is prescribed: linear in W
            [m/s], angular in the axes of the base [rad/s], (6,); None if forces move the vehicle.
    """

    def __init__(
        self,
        name: str,
        root: str,
        joints: Sequence[str],
        index: int,
        engine: Engine,
        prescribed_twist: Callable[[], Array | None],
    ) -> None:
        self._name, self._root, self._index, self._engine = name, root, index, engine
        self._joints, self._prescribed_twist = joints, prescribed_twist
        self._sampled_twist = np.zeros(6)
        self._twist_addresses = np.zeros(0, np.int64)  # of the engine's twist
        self._addresses = self._twist_addresses  # of the pose and the twist

    def base_mount(self) -> MountedBody:
        """Return the base frame."""
        poses = self._engine.poses
        mount = poses.mount(self._index, self._root, Pose.identity())
        return MountedBody(self._name, poses, mount)

    def base_sampler(self) -> Sampler:
        """Return a sampler of the pose and twist of the base; see `uwsim.world.CompiledVehicle`."""
        pose_addresses, twist_addresses = self._engine.link_motion.base_addresses(self._index)
        self._twist_addresses = twist_addresses
        self._addresses = np.concatenate([pose_addresses, twist_addresses])
        return gather_sampler(
            self._addresses,
            prepare=self._prepare,
            can_skip_prepare=lambda _: self._select_twist_source(),
        )

    def _prepare(self, time: float) -> None:
        """Update the pose of the base, and its twist if its motion is prescribed."""
        self._engine.poses.refresh()
        if not self._select_twist_source():
            twist = self._prescribed_twist()
            assert twist is not None
            self._sampled_twist[:] = twist

    def _select_twist_source(self) -> bool:
        """Choose the twist of the engine or the prescribed twist; return True for the engine."""
        is_from_engine = self._prescribed_twist() is None
        self._addresses[-len(self._sampled_twist) :] = (
            self._twist_addresses if is_from_engine else number_addresses(self._sampled_twist)
        )
        return is_from_engine

    def joint_sampler(self) -> Sampler:
        """Return a sampler of the joint positions; see `uwsim.world.CompiledVehicle`."""
        engine = self._engine
        addresses = engine.link_motion.joint_addresses(
            self._index, self._joints, with_motion=engine.has_dynamics(self._index)
        )
        return gather_sampler(addresses, prepare=prepare_nothing, can_skip_prepare=lambda _: True)
