"""Bodies, cameras, contacts, flows and rays of a scene, as its views hand them out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
import numpy.typing as npt

from ..acoustics import Material
from ..base.geometry import Intrinsics, Pose
from ..base.numerics.calls import CompiledFunction
from ..base.sampling import Sampler
from ..rays import Balls, Hits

TIMESTEP = 0.002
"""Default length of a physics step [s]."""
GRAVITY = 9.81
"""Acceleration of free fall [m/s2]."""


@dataclass(frozen=True)
class Box:
    """An axis-aligned bounding box in the frame of its body."""

    lower: tuple[float, float, float]
    """Smallest coordinates [m]."""
    upper: tuple[float, float, float]
    """Largest coordinates [m]."""

    def corners(self) -> npt.NDArray[np.float64]:
        """The eight corners, (8, 3) [m]."""
        low, high = np.array(self.lower), np.array(self.upper)
        picks = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)])
        corners: npt.NDArray[np.float64] = np.where(picks == 1, high, low)
        return corners


class Body(Protocol):
    """A node with a name and a pose: a vehicle, a link or an object."""

    @property
    def name(self) -> str:
        """The route by which it was looked up."""

    @property
    def world_from_body(self) -> Pose:
        """Where it is now (objects: the mesh frame; links: the visual frame)."""

    @property
    def box(self) -> Box | None:
        """Local bounding box of its meshes; None when it has none."""


@dataclass(frozen=True, eq=False)
class BodyMotion:
    """How a body moves over ground; in W."""

    velocity: npt.NDArray[np.float64]
    """Of its origin, (3,) [m/s]."""
    angular_velocity: npt.NDArray[np.float64]
    """Of the body, (3,) [rad/s]."""
    acceleration: npt.NDArray[np.float64]
    """Of its origin, (3,) [m/s2]."""


class Mount(Body, Protocol):
    """A frame on a link that compiled code reads, too."""

    @property
    def functions(self) -> npt.NDArray[np.void]:
        """Its functions for compiled code: a record of `uwsim.world.mounts.MOUNT`, (1,)."""

    @property
    def is_compiled(self) -> bool:
        """Whether these functions follow it in compiled steps without `prepare`."""

    def prepare(self) -> None:
        """Bring what these functions read up to date."""


class MovingBody(Mount, Protocol):
    """A frame on a link whose motion can be read."""

    def motion(self) -> BodyMotion:
        """Return how it moves now.

        Of a simulated vehicle that is the engine's. Another one moves in jumps: each counts as made
        evenly over the time since the one before (`uwsim.physics.kinematics.placed_motion`).
        """


class CompiledVehicle(Protocol):
    """A vehicle as compiled code reads it."""

    def base_mount(self) -> Mount:
        """Return the frame of its base."""

    def base_sampler(self) -> Sampler:
        """Return what takes samples of its base, 18 numbers.

        Where it is in W [m], its axes in W by rows, its velocity over ground in W [m/s], and its
        angular velocity in its own axes [rad/s].
        """

    def joint_sampler(self) -> Sampler:
        """Return what takes samples of the n joints of the joint vector, 4 n numbers.

        Positions [rad or m], velocities [rad/s or m/s], and two parts of the efforts [N m or N]; of
        a vehicle that is not simulated the positions alone.
        """


class Camera(Protocol):
    """A virtual camera of a vehicle."""

    @property
    def name(self) -> str:
        """Its name in the scene."""

    @property
    def intrinsics(self) -> Intrinsics:
        """Its pinhole."""

    @property
    def world_from_camera(self) -> Pose:
        """Where it is now; OpenGL axes."""

    @property
    def n_images(self) -> int | None:
        """Number of images due on its topics so far, read or not; None if it has no topic."""


@dataclass(frozen=True)
class Contact:
    """One point at which a body touches another, at the present step."""

    approach_speed: float
    """Relative velocity of the two along their normal, above 0 while they close [m/s]."""
    own_speed: float
    """The part of it that is the body's own motion [m/s]."""
    is_first: bool
    """Whether the engine lists the body as the first of the two."""
    other: str = ""
    """Name of what it touches."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Where, in W [m]; the origin for contacts that the engine does not simulate."""


class Actuators(Protocol):
    """The actuators of a simulated vehicle: its thrusters, then the motors of its joints."""

    @property
    def thrusters(self) -> tuple[str, ...]:
        """Names of its thrusters."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of its joints, those that mimic included."""

    @property
    def greatest_power(self) -> float:
        """Electric power of all thrusters at their greatest thrusts [W]."""

    def powers(self) -> npt.NDArray[np.float64]:
        """Electric power of the thrusters, then of the joints, (n,) [W]."""

    @property
    def compiled_powers(self) -> CompiledFunction:
        """The function that writes these for compiled code."""


@runtime_checkable
class Flow(Protocol):
    """Moving water, such as those in `uwsim.currents`; everything in L."""

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same at every point."""

    @property
    def is_still(self) -> bool:
        """Whether it never moves at all."""

    def velocity(
        self, points: npt.NDArray[np.float64], time: float, vehicles: Sequence[str] = ()
    ) -> npt.NDArray[np.float64]:
        """Return the water's velocity at ``points`` (n, 3) [m], ``time`` [s]: (n, 3) [m/s]."""

    def acceleration(
        self, points: npt.NDArray[np.float64], time: float, vehicles: Sequence[str] = ()
    ) -> npt.NDArray[np.float64]:
        """Return how fast that changes at a fixed point, (n, 3) [m/s2]."""

    def motion(
        self, points: npt.NDArray[np.float64], time: float, vehicles: Sequence[str] = ()
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Return both."""


class Rays(Protocol):
    """Ray casting against the surfaces of a scene."""

    @property
    def vehicles(self) -> Sequence[str]:
        """Name of the vehicle that each surface belongs to, by its number; or empty."""

    @property
    def materials(self) -> Sequence[Material]:
        """Acoustic material of each surface, by its number."""

    @property
    def functions(self) -> npt.NDArray[np.void]:
        """Casts rays in compiled code: a record of `uwsim.rays.scene_record.RAYS`, (1,)."""

    @property
    def is_compiled(self) -> bool:
        """Whether that finds all bodies where they are in compiled steps without `prepare`."""

    def prepare(self) -> None:
        """Bring what compiled code reads up to date."""

    def cast(
        self,
        world_from_sensor: Pose,
        directions: npt.NDArray[np.float64],
        reach: float,
        begins: npt.NDArray[np.float64] | None = None,
    ) -> Hits:
        """Cast rays from the origin of a sensor; returns the first hit of each.

        Args:
            world_from_sensor: where the sensor is.
            directions: unit vectors in its frame, (n, 3).
            reach: how far the rays go [m].
            begins: from where on each ray hits, (n,) [m]; without it from the origin.
        """

    def balls(self) -> Balls:
        """Balls that cover each surface, where they are now; heaps of sand have none."""


class Attachment(Protocol):
    """A frame fixed to a body, at whose origin a force acts: on a vehicle, a link or an object."""

    @property
    def name(self) -> str:
        """The name of the body."""

    @property
    def vehicle(self) -> str:
        """The name of the vehicle that it is on; empty on an object."""

    @property
    def world_from_body(self) -> Pose:
        """Where the frame is now; its axes are those of the body."""

    def motion(self) -> BodyMotion:
        """Return how its origin moves now, over ground, in W.

        Of a simulated vehicle and of a loose object that is the engine's. Another vehicle moves as
        `MovingBody.motion` says; another object counts as at rest.
        """
