"""Frames on the links of vehicles, and their motion."""

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
from ..physics.kinematics.placed_motion import PlacedMotion
from ..physics.poses import Mount, Poses
from ..world import BodyMotion, Box
from ..world.mounts import MOUNT


class MountedBody:
    """A frame on a link of a vehicle (`uwsim.world.Mount`).

    Args:
        name: the name of the link.
        poses: the poses of the engine.
        mount: the frame, as a record of ``poses``.
    """

    box: Box | None = None
    """The bounding box: None, as it is a frame alone."""

    def __init__(self, name: str, poses: Poses, mount: Mount) -> None:
        self._name, self._poses, self._mount = name, poses, mount

    @property
    def name(self) -> str:
        """The names of the vehicle and the link."""
        return self._name

    @property
    def world_from_body(self) -> Pose:
        """The present pose of the frame."""
        return self._poses.mount_pose(self._mount)

    @cached_property
    def functions(self) -> npt.NDArray[np.void]:
        """The functions for compiled code, a record of `uwsim.world.mounts.MOUNT`, (1,)."""
        functions = np.zeros(1, MOUNT)
        functions["place"] = function_address(link_kernel.write_mount_frame)
        functions["move"] = function_address(link_kernel.write_mount_motion)
        functions["parameters"] = address_of(self._mount)
        return functions

    @property
    def is_compiled(self) -> bool:
        """True if these functions follow the frame in compiled steps without `prepare`."""
        return True

    def prepare(self) -> None:
        """Update the values that these functions read."""
        self._poses.refresh()


@dataclass(frozen=True, kw_only=True)
class MovingLink:
    """The motion of a link."""

    index: int
    """The number of its vehicle."""
    body: int
    """The number of the link in the engine."""
    motion: LinkMotion
    """The motion of links."""
    placed_motion: Callable[[], PlacedMotion | None]
    """The motion of its vehicle, if poses are set; None where the engine moves it."""
    step: Callable[[], int]
    """The number of steps that the simulation has taken."""


class MovingBody(MountedBody):
    """A frame on a link of a vehicle whose motion is read (`uwsim.world.MovingBody`).

    Args:
        name: the name of the link.
        poses: the poses of the engine.
        mount: the frame, as a record of ``poses``.
        link: the motion of its link.
    """

    def __init__(self, name: str, poses: Poses, mount: Mount, link: MovingLink) -> None:
        super().__init__(name, poses, mount)
        self._link = link
        self._is_placed: bool | None = None

    @property
    def is_compiled(self) -> bool:
        """True if the functions follow the frame in compiled steps without `prepare`."""
        return self._select_joints() is None

    def prepare(self) -> None:
        """Update the values that the functions read."""
        self._poses.refresh()
        if (placed_motion := self._select_joints()) is not None:
            placed_motion.update(self._link.step())

    def _select_joints(self) -> PlacedMotion | None:
        """Make the functions read the joints of the frame; return the placed motion, if any."""
        link = self._link
        placed_motion = link.placed_motion()
        if (placed_motion is not None) is not self._is_placed:
            self._is_placed = placed_motion is not None
            chain = link.motion.chain(link.body, link.index if self._is_placed else None)
            self._mount["chain"] = chain
        return placed_motion

    def motion(self) -> BodyMotion:
        """Return the present motion of the frame."""
        link, point = self._link, self.world_from_body.position
        if (placed_motion := link.placed_motion()) is not None:
            placed_motion.update(link.step())
        return link.motion.point_motion(
            link.body, point, vehicle=None if placed_motion is None else link.index
        )


class CompiledVehicle:
    """The samplers of a vehicle for compiled code (`uwsim.world.CompiledVehicle`).

    Args:
        name: the name of its base.
        root: the link that is its base.
        joints: the names of the joints of its joint vector.
        index: the number of the vehicle in the scene.
        engine: the engine, which has its pose.
        placed_twist: returns the velocity of its base in W [m/s] and the angular velocity in its
            axes [rad/s], (6,), if its poses are set; None where the engine moves it.
    """

    def __init__(
        self,
        name: str,
        root: str,
        joints: Sequence[str],
        index: int,
        engine: Engine,
        placed_twist: Callable[[], Array | None],
    ) -> None:
        self._name, self._root, self._index, self._engine = name, root, index, engine
        self._joints, self._placed_twist = joints, placed_twist
        self._sampled_twist = np.zeros(6)
        self._twist_addresses = np.zeros(0, np.int64)  # of the engine's twist
        self._addresses = self._twist_addresses  # of the pose and the twist

    def base_mount(self) -> MountedBody:
        """Return the frame of its base."""
        poses = self._engine.poses
        record = poses.mount(self._index, self._root, Pose.identity())
        return MountedBody(self._name, poses, record)

    def base_sampler(self) -> Sampler:
        """Return a sampler of the base, 18 numbers; see `uwsim.world.CompiledVehicle`."""
        pose_addresses, twist_addresses = self._engine.link_motion.base_addresses(self._index)
        self._twist_addresses = twist_addresses
        self._addresses = np.concatenate([pose_addresses, twist_addresses])
        return gather_sampler(
            self._addresses, prepare=self._prepare, is_alone=lambda _: self._select_twist()
        )

    def _prepare(self, time: float) -> None:
        """Refresh the pose of the base, and its twist if the engine does not move it."""
        self._engine.poses.refresh()
        if not self._select_twist():
            twist = self._placed_twist()
            assert twist is not None
            self._sampled_twist[:] = twist

    def _select_twist(self) -> bool:
        """Make samples read the engine's twist or the placed one; return True for the engine's."""
        is_free = self._placed_twist() is None
        self._addresses[-len(self._sampled_twist) :] = (
            self._twist_addresses if is_free else number_addresses(self._sampled_twist)
        )
        return is_free

    def joint_sampler(self) -> Sampler:
        """Return a sampler of the joints; see `uwsim.world.CompiledVehicle`."""
        engine = self._engine
        addresses = engine.link_motion.joint_addresses(
            self._index, self._joints, with_motion=engine.is_simulated(self._index)
        )
        return gather_sampler(addresses, prepare=prepare_nothing, is_alone=lambda _: True)
