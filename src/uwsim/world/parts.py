"""The bodies, cameras, contacts, flows and ray casters that the views of a simulation return."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol, runtime_checkable

import numpy as np
import numpy.typing as npt

from ..acoustics import Material
from ..base.geometry import Intrinsics, Pose
from ..base.numerics.calls import CompiledFunction
from ..base.numerics.linear import length
from ..base.sampling import Sampler
from ..rays import Balls, Hits

TIMESTEP = 0.002
"""The default length of a physics step [s]."""
GRAVITY = 9.81
"""The acceleration of free fall [m/s2]."""


@dataclass(frozen=True)
class Box:
    """An axis-aligned bounding box in the frame of its body."""

    lower: tuple[float, float, float]
    """The smallest coordinates [m]."""
    upper: tuple[float, float, float]
    """The largest coordinates [m]."""

    def corners(self) -> npt.NDArray[np.float64]:
        """Return the eight corners, (8, 3) [m]."""
        low, high = np.array(self.lower), np.array(self.upper)
        is_upper = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)])
        corners: npt.NDArray[np.float64] = np.where(is_upper == 1, high, low)
        return corners


@dataclass(frozen=True, eq=False)
class WaterSurface:
    """The surface of the water."""

    height: float
    """The height of the still surface in W [m]."""
    waves: CompiledFunction | None = None
    """The function of its waves, see `uwsim.world.mounts.read_surface`; None if it is level."""

    @property
    def wave_addresses(self) -> tuple[int, int]:
        """The numbers of `calls.FUNCTION`: the addresses of the waves, 0 if it is level."""
        return (0, 0) if self.waves is None else self.waves.addresses


@dataclass(frozen=True, eq=False)
class LineOfSight:
    """The line from a camera to a point that it looks at."""

    camera: npt.NDArray[np.float64]
    """The position of the camera in W, (3,) [m]."""
    point: npt.NDArray[np.float64]
    """The point in W, (3,) [m]."""

    @property
    def length(self) -> float:
        """The length of the line [m]."""
        return length(self.point - self.camera)


class Body(Protocol):
    """A vehicle, a link or an object, with a name and a pose."""

    @property
    def name(self) -> str:
        """The name in the scene: ``vehicle``, ``vehicle/link`` or ``object``."""

    @property
    def world_from_body(self) -> Pose:
        """The present pose in W: of a base, a link's visual frame or an object's mesh frame."""

    @property
    def box(self) -> Box | None:
        """The bounding box of the visuals in the frame of the body.

        Objects and ``link@visual`` have one; None for other frames, and without a visual.
        """


@dataclass(frozen=True, eq=False)
class BodyMotion:
    """The motion of a body over ground, in W."""

    velocity: npt.NDArray[np.float64]
    """The velocity of the body's origin, (3,) [m/s]."""
    angular_velocity: npt.NDArray[np.float64]
    """The angular velocity of the body, (3,) [rad/s]."""
    acceleration: npt.NDArray[np.float64]
    """The acceleration of the body's origin, (3,) [m/s2]."""


class Mount(Body, Protocol):
    """A frame on a link that compiled code can read as well."""

    @property
    def functions(self) -> npt.NDArray[np.void]:
        """The functions that compiled code calls: a record of `uwsim.world.mounts.MOUNT`, (1,)."""

    @property
    def is_compiled(self) -> bool:
        """True if these functions give the pose in compiled steps without a call of `prepare`."""

    def prepare(self) -> None:
        """Update the inputs of these functions."""


class MovingBody(Mount, Protocol):
    """A frame on a link whose motion can be read."""

    def motion(self) -> BodyMotion:
        """Return the present motion.

        The motion of a vehicle with dynamics is that of the physics engine. A kinematic vehicle
        moves in jumps, each of which is spread evenly over the time since the last jump
        (`uwsim.physics.kinematics.prescribed_motion`).
        """


class CompiledVehicle(Protocol):
    """The interface of a vehicle for compiled code."""

    def base_mount(self) -> Mount:
        """Return the frame of the base."""

    def base_sampler(self) -> Sampler:
        """Return the sampler of the base, whose samples have 18 numbers.

        The numbers are the position in W [m], the axes in W by rows, the velocity over ground in W
        [m/s], and the angular velocity in base axes [rad/s].
        """

    def joint_sampler(self) -> Sampler:
        """Return the sampler of the n joints of the joint vector, whose samples have 4 n numbers.

        The numbers are positions [rad or m], velocities [rad/s or m/s], and the two parts of the
        efforts [N m or N]. For a kinematic vehicle, they are the positions alone.
        """


class Camera(Protocol):
    """A virtual camera of a vehicle."""

    @property
    def name(self) -> str:
        """The name in the scene."""

    @property
    def intrinsics(self) -> Intrinsics:
        """The pinhole model."""

    @property
    def world_from_camera(self) -> Pose:
        """The present pose in W; OpenGL axes (x right, y up, looking along -z)."""

    @property
    def n_images(self) -> int | None:
        """The number of images due on the camera's topics so far; None if it has no topic."""


ImageContent = Literal["image", "grey", "depth"]
"""The content of an observed image: the sensor's own, grey values, or depths."""


class ImageView(Protocol):
    """The images of a camera or a sonar, rendered when they are read.

    They are uint8, uint16 (0 to 4095) or, with depths, float32; row 0 is the top.
    """

    @property
    def shape(self) -> tuple[int, int, int]:
        """The height, the width, and the number of channels: 3, or 1 without colours."""

    @property
    def number_type(self) -> type[np.uint8 | np.uint16 | np.float32]:
        """The type of the numbers."""

    @property
    def maximum(self) -> float:
        """The greatest number; the least is 0."""

    def read(self) -> npt.NDArray[Any]:
        """Take the present image."""


@dataclass(frozen=True)
class Contact:
    """A point of contact of a body with another body, at the present step."""

    approach_speed: float
    """The relative velocity of the bodies along the normal, positive while they approach [m/s]."""
    own_speed: float
    """The part of the approach speed that is due to the body's own motion [m/s]."""
    is_first: bool
    """True if the engine lists the body as the first of the two."""
    other: str = ""
    """The name of the other body."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The position in W [m]; 0 for contacts that the engine does not simulate."""


class Actuators(Protocol):
    """The actuators of a vehicle with dynamics: the thrusters, then the motors of the joints."""

    @property
    def thrusters(self) -> tuple[str, ...]:
        """The names of the thrusters."""

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the joints, including mimic joints."""

    @property
    def greatest_power(self) -> float:
        """The electric power of all thrusters at maximum thrust [W]."""

    def powers(self) -> npt.NDArray[np.float64]:
        """Return the electric power of the thrusters, then of the joints, (n,) [W]."""

    @property
    def compiled_powers(self) -> CompiledFunction:
        """The function that writes these powers for compiled code."""


@runtime_checkable
class Flow(Protocol):
    """The motion of the water (`uwsim.currents`).

    Points, velocities and accelerations are in L, the frame of the scene file. ``vehicles`` has the
    name of the vehicle at each point, ``""`` for none, since some currents act on selected vehicles
    only; an empty sequence means that no point belongs to a vehicle.
    """

    @property
    def is_uniform(self) -> bool:
        """True if the velocity is the same at every point."""

    @property
    def is_still(self) -> bool:
        """True if the water never moves."""

    def velocity(
        self, points: npt.NDArray[np.float64], time: float, vehicles: Sequence[str] = ()
    ) -> npt.NDArray[np.float64]:
        """Return the water's velocity at ``points`` (n, 3) [m], ``time`` [s]: (n, 3) [m/s]."""

    def acceleration(
        self, points: npt.NDArray[np.float64], time: float, vehicles: Sequence[str] = ()
    ) -> npt.NDArray[np.float64]:
        """Return the local rate of change of the velocity, (n, 3) [m/s2]."""

    def motion(
        self, points: npt.NDArray[np.float64], time: float, vehicles: Sequence[str] = ()
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Return velocity and acceleration."""


class Rays(Protocol):
    """A ray caster against the surfaces of a scene."""

    @property
    def vehicles(self) -> Sequence[str]:
        """The name of the vehicle or tether of each surface, or empty, by index of surface."""

    @property
    def materials(self) -> Sequence[Material]:
        """The acoustic material of each surface, by index of surface."""

    @property
    def functions(self) -> npt.NDArray[np.void]:
        """The functions that compiled code calls: a `uwsim.rays.scene_record.RAYS`, (1,)."""

    @property
    def is_compiled(self) -> bool:
        """True if these functions use present poses in compiled steps without `prepare`."""

    def prepare(self) -> None:
        """Update the inputs of these functions."""

    def cast(
        self,
        world_from_sensor: Pose,
        directions: npt.NDArray[np.float64],
        reach: float,
        starts: npt.NDArray[np.float64] | None = None,
    ) -> Hits:
        """Cast rays from the origin of a sensor; return the first hit of each.

        Args:
            world_from_sensor: the pose of the sensor in W.
            directions: the directions of the rays, unit vectors in the sensor's frame, (n, 3).
            reach: the length of the rays [m].
            starts: the distance from which on each ray can hit a surface, (n,) [m]; None: 0.
        """

    def balls(self) -> Balls:
        """Return balls that cover the surfaces at their present poses, except heaps of sand."""


class Surroundings(Protocol):
    """The lines, holes and surfaces of a scene, for measures."""

    def course(self, name: str) -> npt.NDArray[np.float64]:
        """Return the line of an object with a ``<u:course>``; raise UnknownName if there is none.

        It is the line at the beginning of the simulation, without its buried stretches, (n, 3) in W
        [m].
        """

    def holes(self, name: str) -> npt.NDArray[np.float64]:
        """Return the holes of an object with a ``<u:net>``; raise UnknownName if there is none.

        They are the centre of each in W at the beginning of the simulation, and its radius, (n, 4)
        [m].
        """

    @property
    def rays(self) -> Rays:
        """The ray caster against the surfaces of the scene at their present poses."""


class Attachment(Protocol):
    """A frame on a vehicle, a link or an object; a force acts at the origin of the frame."""

    @property
    def name(self) -> str:
        """The name of the body."""

    @property
    def vehicle(self) -> str:
        """The name of the vehicle; empty on an object."""

    @property
    def world_from_body(self) -> Pose:
        """The present pose of the frame; its axes are those of the body."""

    def motion(self) -> BodyMotion:
        """Return the present motion of the frame's origin over ground, in W.

        The motion of a vehicle with dynamics or a loose object is that of the physics engine. A
        kinematic vehicle moves as in `MovingBody.motion`; another object is at rest.
        """

    def mass(self) -> npt.NDArray[np.float64] | None:
        r"""Return the mass that a force at the frame's origin accelerates, in W, (3, 3) [kg].

        It is :math:`(J M^{-1} J^T)^{-1}` with the mass matrix M of the last step, which includes
        the added mass, and the Jacobian J of the origin. None for a body that forces do not move.
        """


class TetherControl(Protocol):
    """A tether, for the topics that report it and command its winch."""

    @property
    def name(self) -> str:
        """The name of the tether."""

    @property
    def length(self) -> float:
        """The unstretched length that is paid out [m]."""

    @property
    def end_tensions(self) -> tuple[float, float]:
        """The tensions at the first and at the last end [N]."""

    @property
    def winch_speed(self) -> float:
        """The speed at which the winch pays out now [m/s]; 0 without a winch."""

    @property
    def has_winch(self) -> bool:
        """True if the tether has a winch, whose speed can be set."""

    def set_winch_speed(self, speed: float) -> None:
        """Set the speed of the winch [m/s], positive to pay out; its limits apply."""

    @property
    def break_report(self) -> str | None:
        """A sentence about the break of the tether; None before."""


class Segments(Protocol):
    """The cylinders that show the body of a force, such as a tether."""

    def place(self, nodes: npt.NDArray[np.float64], broken_segment: int) -> None:
        """Place the cylinders between successive nodes.

        Those that are not needed lie within others.

        Args:
            nodes: the nodes in W, (n + 1, 3) [m], for at most as many segments as cylinders.
            broken_segment: the index of a segment that is not shown; -1: none.
        """
