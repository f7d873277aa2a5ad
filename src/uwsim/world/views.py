"""The views of a simulation for measures, scene updaters, sensors, devices and forces."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Protocol

import numpy as np
import numpy.typing as npt

from ..acoustics import SeaWater
from ..base.geodesy import Geodetic
from ..base.geometry import Intrinsics, Pose
from ..base.numerics.calls import CompiledFunction
from ..base.sampling import Sampling
from ..bus import Bus
from ..cameras.exposure import Exposure, PlainExposure
from ..network import Network
from ..optics import Medium
from .connections import Connections
from .parts import (
    Actuators,
    Attachment,
    Body,
    Camera,
    Contact,
    Flow,
    ImageContent,
    ImageView,
    LineOfSight,
    Rays,
    Segments,
    Surroundings,
    WaterSurface,
)


class TimedWorld(Protocol):
    """The clock and the topics of a simulation, which most views contain."""

    @property
    def step(self) -> int:
        """The number of physics steps since the simulation began."""

    @property
    def timestep(self) -> float:
        """The length of a step [s]."""

    @property
    def time(self) -> float:
        """``step * timestep`` [s]."""

    @property
    def bus(self) -> Bus:
        """The topics and services."""


class World(TimedWorld, Protocol):
    """The view of the simulation for measures and triggers."""

    @property
    def world_from_localized(self) -> Pose:
        """The transform from L to W, which the scene file sets as an offset."""

    @property
    def compatibility(self) -> frozenset[str]:
        """The names of the active compatibility quirks (`uwsim.base.compatibility`)."""

    def body(self, name: str) -> Body:
        """Return a vehicle ``a``, link ``a/b`` or object ``c``; raise UnknownName if none."""

    def contacts(self, name: str) -> Sequence[Contact]:
        """Return the contacts of a vehicle's links, or of an object; raise UnknownName if none."""

    def contact_forces(self, name: str) -> Mapping[str, npt.NDArray[np.float64]]:
        """Return the contact forces on a vehicle or object; raise UnknownName if there is none.

        Each force is the sum over all contacts in the last step with another body, by whose name it
        is found, (3,) in W [N]. The mapping is empty without contacts, and for a kinematic vehicle.
        """

    def actuators(self, name: str) -> Actuators | None:
        """Return the actuators of a vehicle; None if it is kinematic; raise UnknownName if none."""

    def twist(self, name: str) -> npt.NDArray[np.float64]:
        """Return the velocity over ground of a vehicle's base; raise UnknownName if none.

        The linear velocity [m/s] is first, then the angular velocity [rad/s], in base axes, (6,).
        """

    @property
    def surroundings(self) -> Surroundings:
        """The lines, holes and surfaces of the scene."""

    def joint_position(self, name: str) -> float:
        """Return the position of the hinge [rad] or slide [m] of an object.

        Raises:
            UnknownName: there is no such object with a joint.
        """

    def camera(self, name: str) -> Camera:
        """Return a virtual camera; raise UnknownName if there is none."""

    def image_view(
        self, name: str, content: ImageContent, size: tuple[int, int] | None
    ) -> ImageView:
        """Return the images of a camera or a sonar, with noise of their own.

        Args:
            name: the name of the sensor.
            content: the content of the images.
            size: the width and height of a camera's images [px]; None: those of the sensor.

        Raises:
            UnknownName: there is no such sensor.
            BadSetting: the sensor has no such content or size.
        """

    def stream(self, name: str) -> np.random.Generator:
        """Return the random generator of a name, which the seed of the run determines."""


class StageWater(Protocol):
    """The water for scene updaters: its waves, and the optical properties of physical water."""

    @property
    def medium(self) -> Medium | None:
        """The optical properties in the scene file; None if the water is not physical."""

    def set_medium(self, medium: Medium, *, sight: LineOfSight | None = None) -> None:
        """Set the optical properties; raise UwsimError if the water is not physical.

        Args:
            medium: the water, in red, green and blue.
            sight: the line of sight to a white board, for which the exposure of the cameras is set
                anew; None: the exposure remains.
        """

    def set_wave_height(self, height: float | None) -> None:
        """Set the significant wave height [m]; None: the scene's; raise UwsimError if no waves."""


class Stage(TimedWorld, Protocol):
    """The view of the simulation for scene updaters: setters, and the view of measures."""

    @property
    def world(self) -> World:
        """The view for measures: bodies, cameras, contacts, random streams, and quirks."""

    @property
    def vehicles(self) -> tuple[str, ...]:
        """The names of the vehicles, in the file's order."""

    @property
    def water(self) -> StageWater:
        """The waves and the physical water, which scene updaters change."""

    @property
    def fog_colour(self) -> tuple[float, float, float]:
        """The colour of the fog [0..1]."""

    def find(self, name: str, *, named_by: str) -> Path:
        """Find a file; raise AssetNotFound, which lists the searched folders, if there is none.

        Args:
            name: the name of the file.
            named_by: the element or option that names it, for the message.
        """

    def set_fog(self, density: float) -> None:
        """Set the fog density of the water [1/m]; its colour remains that of the scene."""

    def set_light_rate(self, rate: float) -> None:
        """Scale the light of the scene by a factor; 1 is the light in the scene file."""

    def set_camera_noise(self, std: float | None) -> None:
        """Set the standard deviation of the noise of every colour camera [1: full scale].

        None: the noise in the scene file; raise UwsimError if every camera has a response.
        """

    def set_joints(self, vehicle: str, values: Mapping[int, float]) -> None:
        """Set joints, by index in the joint vector, to values [rad or m], clamped to limits."""

    def set_current(self, current: Flow | None) -> None:
        """Add a flow to the currents of the scene; None removes it."""

    def put_back(self, vehicle: str) -> None:
        """Return a vehicle to its pose in the scene, at rest; raise UnknownName if none."""

    def create_timer(self, rate: float, call: Callable[[], None]) -> Callable[[], None]:
        """Call a function at a ``rate`` [Hz] from now on; return one that stops the calls."""


class DeviceWorld(TimedWorld, Protocol):
    """The view of the simulation for devices: surfaces, sand, actuators, packets and timers."""

    @property
    def world_from_localized(self) -> Pose:
        """The transform from L to W, which the scene file sets as an offset."""

    @property
    def compatibility(self) -> frozenset[str]:
        """The names of the active compatibility quirks (`uwsim.base.compatibility`)."""

    def stream(self, name: str) -> np.random.Generator:
        """Return the random generator of a name, which the seed of the run determines."""

    def actuators(self, name: str) -> Actuators | None:
        """Return the actuators of a vehicle; None if it is kinematic; raise UnknownName if none."""

    @property
    def rays(self) -> Rays:
        """The ray caster against the surfaces of the scene at their present poses."""

    @property
    def network(self) -> Network:
        """The network of communication devices."""

    @property
    def ned_origin(self) -> Geodetic:
        """The position of the origin of W on Earth."""

    def dig(self, point: npt.NDArray[np.float64]) -> int:
        """Remove sand around a point in W (3,) [m]; return the number of columns that lost sand."""

    def pickable_object(self, surface: int) -> int | None:
        """Return the index of the object of a surface; None if no picker can pick it up."""

    def datagrams(self, port: int) -> Callable[[], Sequence[bytes]] | None:
        """Return a function that returns the UDP datagrams received at a port since its last call.

        None if the simulation receives none.
        """

    @property
    def connections(self) -> Connections | None:
        """The connections to programs outside; None if the simulation has none."""

    def create_timer(
        self,
        rate: float,
        call: Callable[[], None],
        *,
        is_needed: Callable[[], bool] | None = None,
        sampling: Sampling | None = None,
    ) -> Callable[[], None]:
        """Call a function at a ``rate`` [Hz] from now on; return one that stops the calls.

        The function is called only if ``is_needed`` returns True. ``sampling`` takes a sample
        before each call.
        """


class SensorWorld(Protocol):
    """The view of the simulation for sensors: surfaces, light and sound."""

    @property
    def time(self) -> float:
        """The simulation time [s]."""

    @property
    def bus(self) -> Bus:
        """The topics and services."""

    @property
    def world_from_localized(self) -> Pose:
        """The transform from L to W, which the scene file sets as an offset."""

    @property
    def compatibility(self) -> frozenset[str]:
        """The names of the active compatibility quirks (`uwsim.base.compatibility`)."""

    def body(self, name: str) -> Body:
        """Return a vehicle ``a``, link ``a/b`` or object ``c``; raise UnknownName if none."""

    def stream(self, name: str) -> np.random.Generator:
        """Return the random generator of a name, which the seed of the run determines."""

    @property
    def rays(self) -> Rays:
        """The ray caster against the surfaces of the scene at their present poses."""

    @property
    def sea_water(self) -> SeaWater:
        """The acoustic properties of the water."""

    @property
    def surface(self) -> WaterSurface:
        """The surface of the water."""

    @property
    def density_levels(self) -> Sequence[tuple[float, float]]:
        """The depths [m] at which the water's density [kg/m3] is given; uniform water has one."""

    def compiled_water(self, vehicle: str, n: int) -> CompiledFunction | None:
        """Return the compiled function of the water's velocity at ``n`` points; None without one.

        See `uwsim.world.mounts.read_water`. After a change of the currents, call this again.
        """

    def water_velocity(
        self, points: npt.NDArray[np.float64], time: float, vehicle: str
    ) -> npt.NDArray[np.float64]:
        """Return the velocity of the water at points, in W, (n, 3) [m/s].

        Args:
            points: the points in W, (n, 3) [m].
            time: the simulation time [s].
            vehicle: the name of the vehicle; some currents act on one vehicle alone.
        """

    @property
    def earth_origin(self) -> Geodetic | None:
        """The position of the origin of W on Earth (x east, y north); None if it is not set."""

    def render(
        self, exposure: Exposure | PlainExposure
    ) -> npt.NDArray[np.uint8] | npt.NDArray[np.uint16]:
        """Take the image of a camera, (h, w, 3), or (h, w) if it is grey; row 0 is the top."""

    def depth(self, world_from_camera: Pose, intrinsics: Intrinsics) -> npt.NDArray[np.float64]:
        """Return the distance along the optical axis of each pixel, (h, w) [m].

        Surfaces nearer than the near plane are invisible. A pixel without a surface has +inf.

        Args:
            world_from_camera: the pose of the camera; OpenGL axes.
            intrinsics: the pinhole model of the camera.
        """


class ForceWorld(Protocol):
    """The view of the simulation for forces (`uwsim.forces`)."""

    @property
    def timestep(self) -> float:
        """The length of a step [s]."""

    @property
    def world_from_localized(self) -> Pose:
        """The transform from L to W, which the scene file sets as an offset."""

    @property
    def surface_height(self) -> float:
        """The height of the water's surface in W [m]."""

    def attach(self, name: str, position: Sequence[float] = (0.0, 0.0, 0.0)) -> Attachment:
        """Attach a frame to a body; raise UnknownName if there is none.

        Args:
            name: a vehicle (its base), a link ``vehicle/link`` (its kinematic frame), or an object
                (its mesh frame), as in `World.body`.
            position: the origin of the frame in the body, (3,) [m].
        """

    def segments(self, name: str) -> Segments:
        """Return the cylinders that show a force, by its name; see `ForceSpec.drawn_segments`."""

    @property
    def rays(self) -> Rays:
        """The ray caster against the surfaces of the scene at their present poses."""

    def water_velocity(
        self, points: npt.NDArray[np.float64], time: float, vehicle: str
    ) -> npt.NDArray[np.float64]:
        """Return the velocity of the water at points, in W, (n, 3) [m/s].

        Args:
            points: the points in W, (n, 3) [m].
            time: the simulation time [s].
            vehicle: the name of the vehicle, or empty; some currents act on one vehicle alone.
        """

    def water_density(self, points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Return the density of the water at points in W (n, 3) [m], (n,) [kg/m3]; 0 in air."""

    def stream(self, name: str) -> np.random.Generator:
        """Return the random generator of a name, which the seed of the run determines."""
