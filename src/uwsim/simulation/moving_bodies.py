"""Frames on the links of vehicles, and how they move."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Pose
from ..base.numerics.calls import address_of, function_address
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
        name: of the link.
        poses: where it is.
        mount: the frame, as a record of ``poses``.
    """

    box: Box | None = None
    """None: it is a frame alone."""

    def __init__(self, name: str, poses: Poses, mount: Mount) -> None:
        self._name, self._poses, self._mount = name, poses, mount

    @property
    def name(self) -> str:
        """The vehicle and the link."""
        return self._name

    @property
    def world_from_body(self) -> Pose:
        """Where it is now."""
        return self._poses.mount_pose(self._mount)

    @cached_property
    def functions(self) -> npt.NDArray[np.void]:
        """Its functions for compiled code: a record of `uwsim.world.mounts.MOUNT`, (1,)."""
        functions = np.zeros(1, MOUNT)
        functions["place"] = function_address(link_kernel.write_mount_frame)
        functions["move"] = function_address(link_kernel.write_mount_motion)
        functions["parameters"] = address_of(self._mount)
        return functions

    @property
    def is_compiled(self) -> bool:
        """Whether these functions follow it in compiled steps without `prepare`."""
        return True

    def prepare(self) -> None:
        """Bring what these functions read up to date."""
        self._poses.refresh()


@dataclass(frozen=True, kw_only=True)
class MovingLink:
    """How a link moves."""

    index: int
    """The number of its vehicle."""
    body: int
    """Its number in the engine."""
    motion: LinkMotion
    """How links move."""
    led: Callable[[], PlacedMotion | None]
    """The motion of its vehicle where it does not move as it is simulated; None where it does."""
    step: Callable[[], int]
    """The steps that the simulation has taken."""


class MovingBody(MountedBody):
    """A frame on a link of a vehicle whose motion is read (`uwsim.world.MovingBody`).

    Args:
        name: of the link.
        poses: where it is.
        mount: the frame, as a record of ``poses``.
        link: how its link moves.
    """

    def __init__(self, name: str, poses: Poses, mount: Mount, link: MovingLink) -> None:
        super().__init__(name, poses, mount)
        self._link = link
        self._is_led: bool | None = None

    @property
    def is_compiled(self) -> bool:
        """Whether its functions follow it in compiled steps without `prepare`."""
        return self._choose_joints() is None

    def prepare(self) -> None:
        """Bring what its functions read up to date."""
        self._poses.refresh()
        if (led := self._choose_joints()) is not None:
            led.update(self._link.step())

    def _choose_joints(self) -> PlacedMotion | None:
        """Let its functions read the joints that move it; return what leads its vehicle, if any."""
        link = self._link
        led = link.led()
        if (led is not None) is not self._is_led:
            self._is_led = led is not None
            chain = link.motion.chain(link.body, link.index if self._is_led else None)
            self._mount["chain"] = chain
        return led

    def motion(self) -> BodyMotion:
        """Return how it moves now."""
        link, point = self._link, self.world_from_body.position
        if (led := link.led()) is not None:
            led.update(link.step())
        return link.motion.point_motion(
            link.body, point, vehicle=None if led is None else link.index
        )


class CompiledVehicle:
    """A vehicle as compiled code reads it (`uwsim.world.CompiledVehicle`).

    Args:
        name: of its base.
        root: the link that is its base.
        joints: names of the joints of its joint vector.
        index: its number in the scene.
        engine: where it is.
        led_twist: returns the velocity of its base in W [m/s], and its turning in its own axes
            [rad/s], where it does not move as the engine moves it, (6,); None where it does.
    """

    def __init__(
        self,
        name: str,
        root: str,
        joints: Sequence[str],
        index: int,
        engine: Engine,
        led_twist: Callable[[], Array | None],
    ) -> None:
        self._name, self._root, self._index, self._engine = name, root, index, engine
        self._joints, self._led_twist = joints, led_twist
        self._led = np.zeros(6)  # what `led_twist` returns, for samples
        self._addresses = self._twist = np.zeros(0, np.int64)  # of what they read; of the engine's

    def base_mount(self) -> MountedBody:
        """Return the frame of its base."""
        poses = self._engine.poses
        record = poses.mount(self._index, self._root, Pose.identity())
        return MountedBody(self._name, poses, record)

    def base_sampler(self) -> Sampler:
        """Return what takes samples of its base, 18 numbers; see `uwsim.world.CompiledVehicle`."""
        place, twist = self._engine.link_motion.base_addresses(self._index)
        self._twist = twist
        self._addresses = np.concatenate([place, twist])
        return gather_sampler(
            self._addresses, prepare=self._prepare, is_alone=lambda _: self._follow()
        )

    def _prepare(self, time: float) -> None:
        """Look up where the base is, and its twist if the engine does not move it."""
        self._engine.poses.refresh()
        if not self._follow():
            twist = self._led_twist()
            assert twist is not None
            self._led[:] = twist

    def _follow(self) -> bool:
        """Whether the engine moves it; samples read its twist, else that which is led."""
        is_free = self._led_twist() is None
        self._addresses[-len(self._led) :] = self._twist if is_free else number_addresses(self._led)
        return is_free

    def joint_sampler(self) -> Sampler:
        """Return what takes samples of its joints; see `uwsim.world.CompiledVehicle`."""
        engine = self._engine
        addresses = engine.link_motion.joint_addresses(
            self._index, self._joints, with_motion=engine.is_simulated(self._index)
        )
        return gather_sampler(addresses, prepare=lambda _: None, is_alone=lambda _: True)
