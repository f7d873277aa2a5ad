"""The world of a scene: bodies, cameras, topics, as measures, triggers and sensors see it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress

import numpy as np
import numpy.typing as npt

from ..acoustics import SeaWater
from ..base.geodesy import Geodetic
from ..base.geometry import Intrinsics, Pose
from ..base.rng import stream
from ..bus import Bus
from ..errors import UnknownName
from ..model.scene_model import SceneModel
from ..physics.engine import Engine
from ..scene.urdf.robot import RobotSpec
from ..sensors.pinhole import cast_depth, cast_surfaces
from ..sensors.sensor import Sensor
from ..sensors.virtual_camera import VirtualCamera
from ..world import Actuators, Contact
from .bodies import SceneBody, find_body, name_bodies
from .collision.below_ground import BelowGround
from .collision.contacts import Contacts
from .collision.start_depths import lift_from_ground
from .scenery.renderer_pool import RendererPool
from .scenery.scene_rays import SceneRays
from .scenery.scenery import Scenery
from .vehicles import SceneVehicle, bind_vehicles
from .water.water_motion import water_motion


class SceneWorld:
    """A scene with its bodies, cameras and topics (`uwsim.world.World`, `uwsim.world.SensorWorld`).

    Args:
        model: of the scene.
        stream_prefix: prefix of the name of every random stream.
        runs_code: let Python code that the scene names run; without it that water is still.
        pool: lends the renderer; without one the scene has a renderer of its own.
        is_blind: images on topics are black, nothing is drawn for them.
    """

    def __init__(
        self,
        model: SceneModel,
        *,
        stream_prefix: str = "",
        runs_code: bool = True,
        pool: RendererPool | None = None,
        is_blind: bool = False,
    ) -> None:
        self.model = model
        """What does not change while the scene runs."""
        self.scene = scene = model.scene
        """Spec of the scene with the variations of this seed, and everything placed."""
        self._prefix = stream_prefix
        self.is_blind = is_blind
        """Whether images on topics are black."""
        self._bus = Bus()
        self.files = dict(model.hydrodynamics_files)
        """Hydrodynamics files of vehicles, and files of currents, by name."""
        self.engine = Engine(model)
        """Where everything is, and what moves it."""
        if model.dynamics or scene.has_uwsim_physics:
            lift_from_ground(model, self.engine)
        self.below_ground = BelowGround(model, self.engine)
        """Whether a body has passed through the ground."""
        self.every_vehicle = bind_vehicles(model, self.engine, lambda: self._bus.state.step)
        """The vehicles, by their number in the file."""
        self.scenery = Scenery(model, self.engine, pool)
        """The visual side of the scene."""
        self.rays = SceneRays(model, self.engine, self.scenery.heaps)
        """Ray casting against the scene."""
        self._bodies = name_bodies(model, self.engine)
        self.touch = Contacts(model, self.engine)
        """Contacts between bodies."""
        self.water = water_motion(model, self.stream, runs_code=runs_code)
        """How its water moves."""
        self.files |= self.water.files
        self._sensors = self._bound_sensors()
        self.every_sensor: tuple[Sensor, ...] = tuple(self._sensors.values())
        """The sensors that are no devices, in the file's order."""
        self._cameras = {
            name: sensor
            for (_, name), sensor in self._sensors.items()
            if isinstance(sensor, VirtualCamera)
        }
        self.cameras = tuple(self._cameras)
        """Names of the virtual cameras, in the file's order."""

    @property
    def robots(self) -> Mapping[int, RobotSpec]:
        """The robot of each vehicle, by its number in the scene."""
        return self.model.robots

    @property
    def timestep(self) -> float:
        """Length of a step [s]."""
        return self.model.timestep

    @property
    def compatibility(self) -> frozenset[str]:
        """The compatibility quirks that are on."""
        return self.model.compatibility

    @property
    def density_levels(self) -> tuple[tuple[float, float], ...]:
        """Depth [m] and density [kg/m3] of the water's levels; one level of uniform water."""
        return self.model.density_levels

    def _bound_sensors(self) -> dict[tuple[str, str], Sensor]:
        """Sensors by element and name; where two share both, the last has it."""
        sensors: dict[tuple[str, str], Sensor] = {}
        for index, element, spec in self.model.sensor_specs:
            # a sensor on a link that is not there is left out, as in the original
            with suppress(UnknownName):
                sensors[element, spec.name] = spec.bind(self, self.every_vehicle[index])
        return sensors

    @property
    def bus(self) -> Bus:
        """Its topics and services."""
        return self._bus

    @property
    def step(self) -> int:
        """Physics steps since the simulation began."""
        return self._bus.state.step

    @property
    def time(self) -> float:
        """``step * timestep`` [s]."""
        return self._bus.state.step * self.timestep

    @property
    def world_from_localized(self) -> Pose:
        """W from L: the scene's offset."""
        return self.scene.world_from_localized

    @property
    def sea_water(self) -> SeaWater:
        """The water as an acoustic medium."""
        return self.scene.ocean_state.sea_water

    @property
    def surface_height(self) -> float:
        """Height of the water's surface in W [m]."""
        return self.scene.ocean_state.ocean_surface_height

    def water_velocity(
        self, points: npt.NDArray[np.float64], time: float, vehicle: str
    ) -> npt.NDArray[np.float64]:
        """Return the velocity of the water at points of W (n, 3) [m], at ``time`` [s]."""
        return self.water.velocity(points, time, vehicle)

    @property
    def earth_origin(self) -> Geodetic | None:
        """Where on Earth the origin of W is: x east, y north; None if the scene does not say."""
        origin = self.scene.ned_origin
        return None if origin is None else origin.place

    def body(self, name: str) -> SceneBody:
        """Find a vehicle, link or object by its route (see `name_bodies`)."""
        return find_body(name, self._bodies)

    def contacts(self, name: str) -> Sequence[Contact]:
        """Where a vehicle (all its links) or object touches others now.

        Raises:
            UnknownName: there is none of that name.
            UwsimError: it cannot be touched.
        """
        return self.touch.contacts(name)

    def contact_forces(self, name: str) -> Mapping[str, npt.NDArray[np.float64]]:
        """Forces on a vehicle or object of what it touches, by its name, (3,) in W [N].

        Raises:
            UnknownName: there is none of that name.
        """
        return self.touch.forces(name)

    def actuators(self, name: str) -> Actuators | None:
        """The actuators of a vehicle; None if it is not simulated; UnknownName if there is none."""
        actuation = self.engine.actuation.get(self.vehicle(name).index)
        return None if actuation is None else actuation.actuators()

    def camera(self, name: str) -> VirtualCamera:
        """Find a virtual camera."""
        if name not in self._cameras:
            raise UnknownName("virtual camera", name, self._cameras)
        return self._cameras[name]

    def sensor(self, name: str, elements: tuple[str, ...]) -> Sensor:
        """Find a sensor, or a device that measures, read from one of these elements."""
        known = {given: each for (kind, given), each in self._sensors.items() if kind in elements}
        if name not in known:
            raise UnknownName(" or ".join(elements), name, known)
        return known[name]

    @property
    def vehicles(self) -> tuple[str, ...]:
        """Names of the vehicles, in the file's order."""
        return tuple(vehicle.name for vehicle in self.scene.vehicles)

    def vehicle(self, name: str) -> SceneVehicle:
        """Find a vehicle; UnknownName if there is none."""
        if name not in self.vehicles:
            raise UnknownName("vehicle", name, self.vehicles)
        return self.every_vehicle[self.vehicles.index(name)]

    def numbered_vehicle(self, index: int) -> SceneVehicle:
        """Return a vehicle by its number in the file: names may be shared."""
        return self.every_vehicle[index]

    def stream(self, name: str) -> np.random.Generator:
        """Return the random generator of that name."""
        return stream(self.model.seed, self._prefix + name)

    def render(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        std: float,
        random: np.random.Generator,
        grey: bool,
    ) -> npt.NDArray[np.uint8]:
        """Render a camera's image, with noise, (h, w, 3) or (h, w) when ``grey``."""
        return self.scenery.render(world_from_camera, intrinsics, std=std, random=random, grey=grey)

    def depth(self, world_from_camera: Pose, intrinsics: Intrinsics) -> npt.NDArray[np.float64]:
        """Measure the depth of each pixel, (h, w) [m]; in a blind world by rays, not the renderer.

        Their depths differ by the renderer's rounding, about 1e-6 of the depth, and at the edges of
        bodies, where a pixel may be of either.
        """
        if self.is_blind:
            return cast_depth(self.rays, world_from_camera, intrinsics)
        return self.scenery.depth(world_from_camera, intrinsics)

    @property
    def part_names(self) -> Mapping[int, str]:
        """Number in segmentation images -> ``vehicle/link`` or object."""
        return self.scenery.part_names

    def segmentation(
        self, world_from_camera: Pose, intrinsics: Intrinsics
    ) -> npt.NDArray[np.uint16]:
        """Return the number of the body that each pixel sees, (h, w); 0: none.

        In a blind world by rays, which meet no ghosts either.
        """
        if self.is_blind:
            return cast_surfaces(self.rays, world_from_camera, intrinsics)
        return self.scenery.segmentation(world_from_camera, intrinsics)
