"""A scene as measures, updaters, sensors, devices and forces see it: one Protocol each."""

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
from ..network import Network
from .parts import Actuators, Attachment, Body, Camera, Contact, Flow, Rays


class TimedWorld(Protocol):
    """The clock and the topics of a simulation: what all its parts see."""

    @property
    def step(self) -> int:
        """Physics steps since the simulation began."""

    @property
    def timestep(self) -> float:
        """Length of a step [s]."""

    @property
    def time(self) -> float:
        """``step * timestep`` [s]."""

    @property
    def bus(self) -> Bus:
        """Its topics and services."""


class World(TimedWorld, Protocol):
    """The simulation as a measure or a trigger sees it."""

    @property
    def world_from_localized(self) -> Pose:
        """W from L: the scene's offset."""

    @property
    def compatibility(self) -> frozenset[str]:
        """The names of the compatibility quirks that are on (`uwsim.base.compatibility`)."""

    def body(self, name: str) -> Body:
        """Find a vehicle, link or object by its route ``a/b``; UnknownName if none."""

    def contacts(self, name: str) -> Sequence[Contact]:
        """Where a vehicle (all its links) or object touches others now; UnknownName if none."""

    def contact_forces(self, name: str) -> Mapping[str, npt.NDArray[np.float64]]:
        """Forces on a vehicle or object of what it touches; UnknownName if there is none.

        The sum over all contacts with each other thing, by its name, (3,) in W [N], in the last
        step. Empty where nothing is touched, or the engine does not simulate it.
        """

    def actuators(self, name: str) -> Actuators | None:
        """The actuators of a vehicle; None if it is not simulated; UnknownName if there is none."""

    def camera(self, name: str) -> Camera:
        """Find a virtual camera; UnknownName if none."""

    def stream(self, name: str) -> np.random.Generator:
        """The random generator of that name under the run's seed."""


class Stage(TimedWorld, Protocol):
    """The simulation as a scene updater sees it: setters, and the world of measures."""

    @property
    def world(self) -> World:
        """Bodies, cameras, contacts, and the compatibility quirks that are on."""

    def stream(self, name: str) -> np.random.Generator:
        """The random generator of that name under the run's seed."""

    @property
    def vehicles(self) -> tuple[str, ...]:
        """Names of the vehicles, in the file's order."""

    @property
    def fog_colour(self) -> tuple[float, float, float]:
        """Colour of the fog [0..1]."""

    def find(self, name: str, *, named_by: str) -> Path:
        """Find a file named in the file ``named_by``; AssetNotFound lists the folders searched."""

    def set_fog(self, density: float) -> None:
        """Set the fog density [1/m] of the water; its colour stays the scene's."""

    def set_light_rate(self, rate: float) -> None:
        """Scale the light of the scene; 1 is as usual."""

    def set_camera_noise(self, std: float) -> None:
        """Set the noise [0..1] of every colour camera."""

    def set_joints(self, vehicle: str, values: Mapping[int, float]) -> None:
        """Set joints by their number in the joint vector [rad or m], clamped to limits."""

    def set_current(self, current: Flow | None) -> None:
        """Add a flow to the currents of the scene; None removes it."""

    def put_back(self, vehicle: str) -> None:
        """Put a vehicle where the scene put it, at rest; UnknownName if there is none."""

    def every(self, rate: float, call: Callable[[], None]) -> Callable[[], None]:
        """Have ``call`` called at the samples of ``rate`` [Hz] from now on; returns how to stop."""


class DeviceWorld(TimedWorld, Protocol):
    """The simulation as a device sees it: surfaces, sand, actuators, packets and timers."""

    @property
    def world_from_localized(self) -> Pose:
        """W from L: the scene's offset."""

    @property
    def compatibility(self) -> frozenset[str]:
        """The names of the compatibility quirks that are on (`uwsim.base.compatibility`)."""

    def stream(self, name: str) -> np.random.Generator:
        """The random generator of that name under the run's seed."""

    def actuators(self, name: str) -> Actuators | None:
        """The actuators of a vehicle; None if it is not simulated; UnknownName if there is none."""

    @property
    def rays(self) -> Rays:
        """The surfaces of the scene where they are now."""

    @property
    def network(self) -> Network:
        """The packets between communication devices."""

    @property
    def ned_origin(self) -> Geodetic:
        """Where on Earth the origin of W is."""

    def dig(self, point: npt.NDArray[np.float64]) -> int:
        """Take sand around a point in W (3,) [m]; returns how many columns of it lost some."""

    def catchable(self, surface: int) -> int | None:
        """Return the number of the object with a surface; None where nothing may pick it up."""

    def datagrams(self, port: int) -> Callable[[], Sequence[bytes]] | None:
        """Return what returns the UDP packets that have come to a port since its last call.

        None where the simulation takes none.
        """

    def every(
        self,
        rate: float,
        call: Callable[[], None],
        *,
        is_needed: Callable[[], bool] | None = None,
        sampling: Sampling | None = None,
    ) -> Callable[[], None]:
        """Have ``call`` called at the samples of ``rate`` [Hz] from now on; returns how to stop.

        With ``is_needed`` it is called only where that says so; ``sampling`` takes a sample before,
        needed or not.
        """


class SensorWorld(TimedWorld, Protocol):
    """The simulation as a sensor sees it: surfaces, light and sound."""

    @property
    def world_from_localized(self) -> Pose:
        """W from L: the scene's offset."""

    @property
    def compatibility(self) -> frozenset[str]:
        """The names of the compatibility quirks that are on (`uwsim.base.compatibility`)."""

    def stream(self, name: str) -> np.random.Generator:
        """The random generator of that name under the run's seed."""

    @property
    def rays(self) -> Rays:
        """The surfaces of the scene where they are now."""

    @property
    def sea_water(self) -> SeaWater:
        """The water as an acoustic medium."""

    @property
    def surface_height(self) -> float:
        """Height of the water's surface in W [m]."""

    @property
    def density_levels(self) -> Sequence[tuple[float, float]]:
        """Depth [m] and density [kg/m3] of the water's levels; one level of uniform water."""

    def compiled_water(self, vehicle: str, n: int) -> CompiledFunction | None:
        """Return the water at ``n`` points as a vehicle feels it; None if Python has to be asked.

        See `uwsim.world.mounts.read_water`; it is another one after the water has changed.
        """

    def water_velocity(
        self, points: npt.NDArray[np.float64], time: float, vehicle: str
    ) -> npt.NDArray[np.float64]:
        """Return the velocity of the water at points of W, (n, 3) [m/s].

        Args:
            points: (n, 3) [m].
            time: [s].
            vehicle: name of the vehicle that asks: some currents are felt by one alone.
        """

    @property
    def earth_origin(self) -> Geodetic | None:
        """Where on Earth the origin of W is: x east, y north; None if the scene does not say."""

    def render(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        std: float,
        random: np.random.Generator,
        grey: bool,
        is_polished: bool = False,
    ) -> npt.NDArray[np.uint8]:
        """Render the image of a camera, with noise; row 0 is the top.

        Args:
            world_from_camera: where the camera is; OpenGL axes.
            intrinsics: its pinhole.
            std: noise of each channel, 0..1.
            random: the camera's random stream.
            grey: give (h, w), each term of the sum cut to a whole number; else (h, w, 3).
            is_polished: draw soft shadows, highlights and smooth edges.
        """

    def depth(self, world_from_camera: Pose, intrinsics: Intrinsics) -> npt.NDArray[np.float64]:
        """Measure the distance along the optical axis of each pixel, (h, w) [m].

        What is nearer than the near plane is not seen; +inf where nothing is before the far plane.

        Args:
            world_from_camera: where the camera is; OpenGL axes.
            intrinsics: its pinhole.
        """


class ForceWorld(Protocol):
    """The simulation as a force (`uwsim.forces`) sees it."""

    @property
    def timestep(self) -> float:
        """Length of a step [s]."""

    @property
    def world_from_localized(self) -> Pose:
        """W from L: the scene's offset."""

    @property
    def surface_height(self) -> float:
        """Height of the water's surface in W [m]."""

    def attach(self, name: str, position: Sequence[float] = (0.0, 0.0, 0.0)) -> Attachment:
        """Fix a frame to a body; UnknownName if there is none.

        Args:
            name: a vehicle (its base), a link ``vehicle/link`` (its kinematic frame), or an object
                (its mesh frame), as `World.body` has them.
            position: of the frame's origin in the body, (3,) [m].
        """

    def water_velocity(
        self, points: npt.NDArray[np.float64], time: float, vehicle: str
    ) -> npt.NDArray[np.float64]:
        """Return the velocity of the water at points of W, (n, 3) [m/s].

        Args:
            points: (n, 3) [m].
            time: [s].
            vehicle: name of the vehicle whose water it is: some currents are felt by one alone;
                empty for none.
        """

    def water_density(self, points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Return the density of the water at points of W (n, 3) [m], (n,) [kg/m3]; 0 above it."""

    def stream(self, name: str) -> np.random.Generator:
        """The random generator of that name under the run's seed."""
