"""The simulation: one step after the other.

.. code-block:: text

    commands from the bus -> devices -> forces -> physics step -> clock
      -> sensors whose period is due (images last) -> messages on the bus
      -> algorithms' callbacks -> observers

Time is an integer count of steps. The tail of the step (sensors and after) also runs once at
step 0, when the simulation is opened.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from ..bus import Algorithm, Bus, Inbox
from ..chance import stream
from ..currents import Place, TotalCurrent, bind_currents
from ..errors import BadSetting, Fault, UnknownName
from ..geometry import Array, Intrinsics, Pose
from ..linear import product
from ..physics.motion import Motion
from ..physics.state import State
from ..rendering.grey import grey_truncated
from ..rendering.noise import add_noise
from ..rendering.renderer import Picture
from ..rendering.water import Light, Water
from ..scene.ros_interfaces import VirtualCameraToROSImageSpec
from ..scene.spec import SceneSpec
from ..scene.variation import varied
from ..sensors.virtual_camera import VirtualCamera
from ..world import TIMESTEP, Actuators, Contact, Flow
from .below import Below, below
from .bodies import (
    SceneBody,
    find_body,
    find_file,
    name_bodies,
    read_robots,
)
from .calls import Calls
from .carriers import carriers_of
from .collision_shapes import simulated_shapes
from .commands import Commands
from .dynamics import read_dynamics
from .floor import set_on_floor
from .image_publisher import ImagePublisher, SampleTimer
from .node import InProcessNode
from .parts import Part
from .plausibility import doubts_about
from .scenery import Scenery
from .state_publishers import state_publishers
from .studio import Studio
from .thruster_faults import ThrusterFaults
from .touch import Touch

M = TypeVar("M")
ALL_TARGETS = frozenset({"colour", "range", "ids"})


class Simulation:
    """A scene that lives: implements `uwsim.world.Stage` and owns the bus and the clock.

    Args:
        scene: what the file says; what varies in it is drawn for the seed.
        seed: the run's seed.
        stream_prefix: stands in front of the name of every random stream.
        timestep: length of a step [s].
        data_path: folders in which files are looked for.
        compatibility: the original's slips asked for.
        is_blind: publish black images, drawing nothing.
        runs_code: let Python code that the scene names run; without it that water is still.
        studio: lends the renderer; without one the simulation has a renderer of its own.
    """

    def __init__(
        self,
        scene: SceneSpec,
        *,
        seed: int = 0,
        stream_prefix: str = "",
        timestep: float = TIMESTEP,
        data_path: tuple[Path, ...] = (),
        compatibility: frozenset[str] = frozenset(),
        is_blind: bool = False,
        runs_code: bool = True,
        studio: Studio | None = None,
    ) -> None:
        if not isinstance(scene, SceneSpec):
            raise BadSetting(
                f"A Simulation is made of what read_scene returns, not of {_shown(scene)}."
            )
        data_path = tuple(Path(folder) for folder in data_path)
        scene = varied(scene, seed)
        self.robots = read_robots(scene, data_path)
        """The robot of each vehicle, by its number in the scene."""
        self._as_written = scene
        self._scene = scene = set_on_floor(scene, self.robots, data_path)
        self._seed = seed
        self._prefix = stream_prefix
        self._timestep = timestep
        self._data_path = data_path
        self._compatibility = compatibility
        self.bus = Bus()
        """Topics and services of this simulation."""
        self._dynamics = dynamics = read_dynamics(scene, self.robots, data_path)
        self.files = {path.name: path for one in dynamics.values() for path in one.files}
        """Side files of vehicles, and files of currents, by name."""
        shapes = simulated_shapes(scene, self.robots, dynamics, data_path)
        self._state = State(scene, self.robots, dynamics, timestep, shapes)
        carriers = carriers_of(scene, self.robots, self._state)
        self._scenery = Scenery(scene, self.robots, self._state, carriers, data_path, studio)
        self._bodies = name_bodies(
            scene, self.robots, self._state, self._scenery.parts, compatibility
        )
        self._water = Water(
            fog=scene.ocean_state.fog.density,
            fog_colour=scene.ocean_state.fog.color,
            colour=scene.ocean_state.color,
            attenuation=scene.ocean_state.attenuation,
            surface_height=scene.ocean_state.ocean_surface_height,
            fog_distance="clip" if "fog-distance" in compatibility else "ray",
        )
        self._light = Light(rate=scene.sim_params.light_rate, shadows=scene.has_sun_shadows)
        place = Place(
            stream=self.stream,
            find=lambda name: find_file(name, scene.path, data_path),
            world_from_localized=scene.world_from_localized,
            runs_code=runs_code,
            surface_height=scene.ocean_state.ocean_surface_height,
        )
        self._scene_current = bind_currents(scene.ocean_state.currents, place)
        for current in scene.ocean_state.currents:
            self.files |= current.files(place)
        self._flow: Flow = self._scene_current
        self._localized_from_world = scene.world_from_localized.inverse()
        self._drifting = [
            (i, v) for i, v in enumerate(scene.vehicles) if not self._state.is_simulated(i)
        ]
        self._current: Flow | None = None
        self._timers: list[SampleTimer] = []
        self._watchers: list[Callable[[], None]] = []
        self._wet_names = tuple(
            "" if i is None else scene.vehicles[i].name for i in self._state.wet_vehicles()
        )
        self._swaying = [(i, v) for i, v in enumerate(scene.vehicles) if v.sways]
        self._sway()
        robots = [self.robots[i] for i in range(len(scene.vehicles))]
        self._commands = Commands(scene, robots, self._state, self.bus, timestep)
        self._thruster_faults = ThrusterFaults(scene, self._state)
        self._touch = Touch(scene, self.robots, self._state, data_path, timestep)
        for rate, tell in state_publishers(
            scene, self.robots, self._state, self._touch, self.bus, lambda: self.time
        ):
            self.every(rate, tell)
        self._nodes: list[InProcessNode] = []
        self._cameras: dict[str, VirtualCamera] = {}
        for vehicle, carrier in zip(scene.vehicles, carriers, strict=True):
            for spec in vehicle.virtual_cameras:
                # a sensor on a link that is not there is left out, as in the original
                if carrier.has_link(spec.relative_to):
                    self._cameras.setdefault(spec.name, spec.bind(self, carrier))
        self.images: dict[str, ImagePublisher] = {}
        """What publishes images, by topic."""
        for interface in scene.ros_interfaces:
            if isinstance(interface, VirtualCameraToROSImageSpec):
                camera = self._cameras.get(interface.camera_name)
                if camera is not None and not interface.depth:
                    self.images[interface.image_topic] = ImagePublisher(
                        interface, camera, self.bus, timestep, is_blind=is_blind
                    )

    @cached_property
    def warnings(self) -> tuple[Fault, ...]:
        """What of the scene seems not to be meant, with the lines of the file."""
        return tuple(doubts_about(self._as_written, self.robots, self._dynamics, self._data_path))

    # -- the clock and the step ---------------------------------------------------------------

    @property
    def step(self) -> int:
        """Physics steps since the simulation began."""
        return self.bus.step

    @property
    def timestep(self) -> float:
        """Length of a step [s]."""
        return self._timestep

    @property
    def time(self) -> float:
        """``step * timestep`` [s]."""
        return self.bus.step * self._timestep

    def open(self) -> None:
        """Run the tail of step 0: first samples, first messages."""
        self._tail()

    def advance(self) -> None:
        """Take one step."""
        self.bus.step += 1
        self._commands.carry_out()
        self._drift()
        self._push()
        self._sway()
        self._touch.look(self.step)
        self._tail()
        for look in self._watchers:
            look()

    def watch(self, look: Callable[[], None]) -> None:
        """Have ``look`` called at the end of every step."""
        self._watchers.append(look)

    @property
    def motion(self) -> Motion:
        """Where everything is and how it moves, as numbers."""
        return self._state.motion

    def _tail(self) -> None:
        step = self.bus.step
        for images in self.images.values():
            if step >= images.due:
                images.publish()
        for timer in self._timers:
            timer.tick(step)
        self.bus.deliver()
        for node in self._nodes:
            node.tick()
        self.bus.deliver()

    def _drift(self) -> None:
        """Carry kinematic vehicles with the water: ``p += v dt``, as the original does."""
        if self._current is None and not self._scene.ocean_state.currents:
            return
        for index, vehicle in self._drifting:
            world_from_base = self._state.vehicle_pose(index)
            position = world_from_base.position[None]
            point = self._localized_from_world.transform(position)  # (1, 3) [m]
            velocity = self._flow.velocity(point, self.time, (vehicle.name,))[0]  # (3,) [m/s]
            moved = self.world_from_localized.transform(point + velocity * self._timestep)[0]
            self._state.place_vehicle(index, Pose(moved, world_from_base.rotation))

    def _push(self) -> None:
        """Let the forces act on what is simulated, in the water as it moves now."""
        if not self._state.is_dynamic:
            self._state.fall()
            return
        points = self._localized_from_world.transform(self._state.wet_positions())
        time = self.time - self._timestep
        velocity = self._flow.velocity(points, time, self._wet_names)
        acceleration = self._flow.acceleration(points, time, self._wet_names)
        turn = self._localized_from_world.rotation
        self._thruster_faults.apply(time)
        self._state.step(product(velocity, turn), product(acceleration, turn))

    def _sway(self) -> None:
        for index, vehicle in self._swaying:
            localized_from_base = vehicle.localized_from_base_at(self.time)
            self._state.place_vehicle(index, self.world_from_localized @ localized_from_base)

    def attach(
        self,
        algorithm: Algorithm,
        *,
        name: str,
        parameters: Mapping[str, float | str],
        raises: bool = True,
        calls: Calls | None = None,
    ) -> InProcessNode:
        """Let an algorithm in through its door and start it.

        What it raises comes out here and out of `advance`; without ``raises`` it is kept in the
        node's ``error``, and the algorithm is not called any more. ``calls`` counts those into it.
        """
        node = InProcessNode(
            self.bus,
            name=name,
            timestep=self._timestep,
            random=self.stream("algorithm"),
            parameters=parameters,
            raises=raises,
            calls=calls,
        )
        self._nodes.append(node)
        node.run(algorithm)
        return node

    def close(self) -> None:
        """Give back the graphics context and take the algorithms off the bus."""
        for node in self._nodes:
            node.close()
        self._scenery.close()

    # -- what measures and triggers see (uwsim.world.World) ------------------------------------

    @property
    def world_from_localized(self) -> Pose:
        """W from L: the scene's offset."""
        return self._scene.world_from_localized

    @property
    def compatibility(self) -> frozenset[str]:
        """The original's slips asked for."""
        return self._compatibility

    @property
    def vehicles(self) -> tuple[str, ...]:
        """Names of the vehicles, in the file's order."""
        return tuple(vehicle.name for vehicle in self._scene.vehicles)

    def body(self, name: str) -> SceneBody:
        """Find a vehicle, link or object by its route (see `name_bodies`)."""
        return find_body(name, self._bodies)

    def contacts(self, name: str) -> Sequence[Contact]:
        """Where a vehicle (all its links) or object touches others now.

        Raises:
            UnknownName: there is none of that name.
            UwsimError: it cannot be touched.
        """
        return self._touch.contacts(name)

    def actuators(self, name: str) -> Actuators | None:
        """What drives a vehicle; None if it is not simulated; UnknownName if there is none."""
        return self._state.actuators(self._vehicle(name))

    def camera(self, name: str) -> VirtualCamera:
        """Find a virtual camera."""
        if name not in self._cameras:
            raise UnknownName("virtual camera", name, self._cameras)
        return self._cameras[name]

    @property
    def cameras(self) -> tuple[str, ...]:
        """Names of the virtual cameras, in the file's order."""
        return tuple(self._cameras)

    def message_type(self, topic: str) -> type | None:
        """What a topic carries; None while nobody has said."""
        return self.bus.message_type(topic)

    def inbox(self, topic: str, type: type[M], *, latched: bool = False) -> Inbox[M]:
        """Collect the messages of a topic from now on; latched: beginning with the newest."""
        return self.bus.inbox(topic, type, latched=latched)

    def publisher(self, topic: str, type: type[M]) -> Callable[[M], None]:
        """Return ``publish(message)``."""
        return self.bus.publisher(topic, type)

    def has_readers(self, topic: str) -> bool:
        """Whether anybody would see a message on ``topic``."""
        return self.bus.has_readers(topic)

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service."""
        self.bus.serve(name, type, handler)

    def offer(self, name: str, type: type[M], handler: Callable[[M], object]) -> Callable[[], None]:
        """Offer a service together with others: a call reaches all; returns how to leave."""
        return self.bus.offer(name, type, handler)

    def withdraw(self, name: str) -> None:
        """Stop offering a service."""
        self.bus.withdraw(name)

    def serves(self, name: str) -> bool:
        """Whether somebody offers the service."""
        return self.bus.serves(name)

    def call(self, name: str, request: object) -> object:
        """Call a service."""
        return self.bus.call(name, request)

    def stream(self, name: str) -> np.random.Generator:
        """Return the random generator of that name."""
        return stream(self._seed, self._prefix + name)

    # -- what sensors see (uwsim.world.SensorWorld) --------------------------------------------

    def photograph(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        std: float,
        random: np.random.Generator,
        grey: bool,
    ) -> npt.NDArray[np.uint8]:
        """Draw what a camera would see now, with noise, (h, w, 3) or (h, w) when ``grey``."""
        picture = self._scenery.draw(
            world_from_camera,
            intrinsics,
            self._water,
            self._light,
            targets=frozenset({"colour"}),
            colour="linear16" if std > 0.0 else "uint8",
        )
        assert picture.colour is not None
        if picture.colour.dtype == np.uint16:
            pixels = add_noise(picture.colour.view(np.uint16), std, random)
        else:
            pixels = picture.colour.view(np.uint8)
        return grey_truncated(pixels) if grey else pixels

    def picture(
        self, world_from_camera: Pose, intrinsics: Intrinsics, *, fog: float | None = None
    ) -> Picture:
        """Draw a noise-free picture with range and ids, as things stand, or at another fog."""
        water = self._water if fog is None else replace(self._water, fog=fog)
        return self._scenery.draw(
            world_from_camera, intrinsics, water, self._light, targets=ALL_TARGETS, colour="uint8"
        )

    def look(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        targets: Collection[str] = ALL_TARGETS,
        hidden: frozenset[int] = frozenset(),
        fog: float | None = None,
    ) -> Picture:
        """Draw what a viewer sees who is no camera of the scene: ghosts, too, and air above water.

        Args:
            world_from_camera: where the viewer is; OpenGL axes.
            intrinsics: the pinhole.
            targets: some of colour, range, ids.
            hidden: numbers of parts that are left out.
            fog: density of the fog instead of the scene's [1/m].
        """
        density = self._water.fog if fog is None else fog
        return self._scenery.draw(
            world_from_camera,
            intrinsics,
            replace(self._water, fog=density, has_air=True, fog_distance="ray"),
            self._light,
            targets=frozenset(targets),
            colour="uint8",
            hidden=hidden,
        )

    @property
    def parts(self) -> tuple[Part, ...]:
        """The models of the scene and whose they are."""
        return self._scenery.parts

    def corners(self, part: Part) -> Array:
        """Return the corners of a part's box where it is now, in W, (8, 3) [m]."""
        world_from_mesh = self._scenery.world_from_mesh(part)
        return product(part.model.box.corners(), world_from_mesh[:3, :3].T) + world_from_mesh[:3, 3]

    @property
    def renderer_name(self) -> str:
        """What draws the pictures; makes the graphics context if there is none yet."""
        return self._scenery.renderer_name

    @property
    def part_names(self) -> dict[int, str]:
        """Number in segmentation pictures -> ``vehicle/link`` or object."""
        return {part.id: part.name for part in self._scenery.parts}

    @property
    def made_hashes(self) -> dict[str, str]:
        """Name of each model that is of no file -> sha256 of its arrays, sorted by name."""
        made = [part.model for part in self._scenery.parts if not part.model.files]
        models = {model.name: model.sha256 for model in made}
        return {name: models[name] for name in sorted(models)}

    # -- what scene updaters may turn (uwsim.world.Stage) --------------------------------------

    @property
    def fog_colour(self) -> tuple[float, float, float]:
        """What replaces what the water hides [0..1]."""
        return self._water.fog_colour

    def find(self, name: str, *, beside: str) -> Path:
        """Find a file that the file ``beside`` names; AssetNotFound says where it was sought."""
        return find_file(name, beside, self._data_path)

    def set_fog(self, density: float) -> None:
        """Set the fog density [1/m] of the water; its colour stays.

        The original sets the colour of its window's fog to (0, 0.05, 0.3) here, and leaves that of
        its cameras as the scene has it.
        """
        self._water = replace(self._water, fog=density)

    def set_light_rate(self, rate: float) -> None:
        """Scale the light of the scene; 1 is as usual."""
        self._light = replace(self._light, rate=rate)

    def set_camera_noise(self, std: float) -> None:
        """Set the noise [0..1] of every colour camera."""
        for camera in self._cameras.values():
            camera.std = std

    def joints(self, vehicle: str) -> npt.NDArray[np.float64]:
        """Return the joint vector of a vehicle, (n,) [rad or m]; UnknownName if there is none."""
        return self._state.joints(self._vehicle(vehicle))

    def below(self, vehicle: str) -> tuple[Below, ...]:
        """Return what lies straight below a vehicle's origin, the nearest first."""
        index = self._vehicle(vehicle)
        others = [
            part for part in self._scenery.parts if part.vehicle != index and not part.is_hidden
        ]
        return below(self._state.vehicle_pose(index).position, self._scenery, others)

    def _vehicle(self, name: str) -> int:
        if name not in self.vehicles:
            raise UnknownName("vehicle", name, self.vehicles)
        return self.vehicles.index(name)

    def set_joints(self, vehicle: str, values: Mapping[int, float]) -> None:
        """Set joints by their number in the joint vector [rad or m], clamped to limits."""
        index = self._vehicle(vehicle)
        joints = self._state.joints(index)
        for number, value in values.items():
            if 0 <= number < len(joints):
                joints[number] = value
        self._state.set_joints(index, joints)

    def set_current(self, current: Flow | None) -> None:
        """Let the water move so, besides the scene's own currents; None: no more."""
        self._current = current
        if current is None:
            self._flow = self._scene_current
        else:
            several = bool(self._scene.ocean_state.currents)
            self._flow = TotalCurrent([self._scene_current, current]) if several else current

    def put_back(self, vehicle: str) -> None:
        """Put a vehicle where the scene put it, at rest."""
        index = self._vehicle(vehicle)
        localized_from_base = self._scene.vehicles[index].localized_from_base_at(self.time)
        self._state.place_vehicle(index, self.world_from_localized @ localized_from_base)

    def every(self, rate: float, call: Callable[[], None]) -> Callable[[], None]:
        """Have ``call`` called at the samples of ``rate`` [Hz] from now on; returns how to stop."""
        timer = SampleTimer(self.bus.step, rate, self._timestep, call)
        self._timers.append(timer)
        return lambda: self._timers.remove(timer) if timer in self._timers else None


def _shown(found: object) -> str:
    """``a str: 'scene.xml'``, cut where it is long."""
    text = repr(found)
    return f"a {type(found).__name__}: {text if len(text) <= 60 else text[:57] + '...'}"
