"""The world of a scene with the setters of scene updaters."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, TypeVar, cast

from ..assets import has_model
from ..assets.pattern import read_pattern
from ..base.geodesy import Geodetic
from ..base.geometry import Array, Pose
from ..devices.device import Device, DeviceSpec
from ..devices.lamp import MountedLamp
from ..devices.led_array import Led, LedArray
from ..devices.structured_light_projector import MountedProjector
from ..errors import AssetNotFound, SceneError, UnknownName, UwsimError
from ..messages import SpawnMarker, String
from ..model.robots import find_file
from ..model.scene_model import SceneModel
from ..network import Channel, Network
from ..scene.spec import SceneSpec
from ..schema import diagnostic_at
from ..sensors.sensor import Sensor
from ..topics.frames import Frame
from ..topics.interface import Binds, Interface
from ..world import Flow
from .datagrams import Datagrams
from .faulty_topic import FaultyTopic, faults_of
from .forces import bind_forces
from .frames import object_frames, vehicle_frames
from .markers import SERVICE, Markers
from .scenery.renderer_pool import RendererPool
from .schedule import Schedule
from .trajectories import RATE, Trajectory
from .vehicles import SceneVehicle
from .world import SceneWorld

M = TypeVar("M")
TRACE = "/network/trace"
"""Topic of what becomes of packets."""


class SceneStage(SceneWorld):
    """A scene world whose fog, light, noise, currents and arms can be set (`uwsim.world.Stage`).

    Args:
        model: of the scene.
        udp_address: of this computer, at which ``<fdm>`` takes packets; None: it takes none.
        stream_prefix: prefix of the name of every random stream.
        runs_code: let Python code that the scene names run; without it that water is still.
        pool: lends the renderer; without one the scene has a renderer of its own.
        is_blind: images on topics are black, nothing is drawn for them.
    """

    def __init__(
        self,
        model: SceneModel,
        *,
        udp_address: str | None = None,
        stream_prefix: str = "",
        runs_code: bool = True,
        pool: RendererPool | None = None,
        is_blind: bool = False,
    ) -> None:
        super().__init__(
            model, stream_prefix=stream_prefix, runs_code=runs_code, pool=pool, is_blind=is_blind
        )
        self.network = Network(
            self.stream,
            surface=self.scene.ocean_state.ocean_surface_height,
            channels=_channels(self.scene),
        )
        """The packets between communication devices."""
        if self.scene.net_tracing_script is not None:
            publish = self.bus.publisher(TRACE, String)
            self.network.trace = lambda line: publish(String(data=line))
        self._datagrams = Datagrams(udp_address)
        self.schedule = Schedule(self.timestep)
        """What is to be done at a later step."""
        self.faulty_topics: list[FaultyTopic] = []
        """The topics of sensors with faults."""
        self.devices = tuple(self._bound_devices())
        """What acts in the step, in the file's order."""
        self.forces = bind_forces(self)
        """What acts on bodies besides the water, in the file's order."""
        place = Path(self.scene.path) if self.scene.path else None
        self.markers = Markers(
            lambda: self.time, partial(has_model, named_by=place, data_path=model.data_path)
        )
        """What programs have spawned."""
        self.bus.services.serve(SERVICE, SpawnMarker, self.markers.answer)
        self.trajectories = tuple(self._bound_trajectories())
        """What ``showTrajectory`` asks for."""
        self.interfaces = tuple(self._bound_interfaces())
        """What publishes and listens, in the file's order."""

    def _bound_devices(self) -> Iterator[Device]:
        lamps: list[MountedLamp] = []
        leds: list[Led] = []
        projectors: list[MountedProjector] = []
        for spec, vehicle in zip(self.scene.vehicles, self.every_vehicle, strict=True):
            for element, part in spec.all_parts():
                if isinstance(part, DeviceSpec):
                    device = self._bound_device(element, part, vehicle)
                    if device is None:
                        continue
                    yield device
                    if isinstance(device, Sensor):
                        self._sensors[element, getattr(part, "name", "")] = device
                    if isinstance(device, MountedLamp) and not spec.vr:
                        lamps.append(device)
                    if isinstance(device, LedArray) and not spec.vr:
                        leds.extend(device.leds)
                    if isinstance(device, MountedProjector) and not spec.vr:
                        projectors.append(device)
        self.scenery.set_lamps(lamps, leds)
        for projector in projectors[-1:]:
            self._set_projector(projector)

    def _set_projector(self, projector: MountedProjector) -> None:
        """Load its image; in a scene of the original one without its image shines nothing."""
        try:
            path = self.find(projector.spec.image_name, named_by=self.scene.path)
        except AssetNotFound:
            if not self.scene.is_original:
                raise
            return
        self.files |= {path.name: path}
        self.scenery.set_projector(projector, read_pattern(path))

    def _bound_device(self, element: str, spec: DeviceSpec, vehicle: SceneVehicle) -> Device | None:
        try:
            return spec.bind(self, vehicle)
        except UnknownName as error:
            if spec.is_left_out:
                return None
            if spec.source_line is None:
                raise
            raise SceneError([diagnostic_at(spec, f"<{element}>: {error}")]) from error

    def sensor_publisher(self, sensor: str, topic: str, type_: type) -> Callable[[Any], None]:
        """Return what publishes the messages of a sensor on a topic, with the sensor's faults."""
        publish: Callable[[Any], None] = self.bus.publisher(topic, type_)
        faults = faults_of(self.scene, sensor, topic, type_, self.stream)
        if not faults:
            return publish
        self.faulty_topics.append(FaultyTopic(faults, publish, lambda: self.time))
        return self.faulty_topics[-1].publish

    def _bound_interfaces(self) -> Iterator[Interface]:
        for spec in self.scene.ros_interfaces:
            # one that names what is not there is left out, as in the original
            with suppress(UnknownName):
                if spec.is_simulated():
                    yield cast("Binds", spec).bind(self)

    def _bound_trajectories(self) -> Iterator[Trajectory]:
        localized_from_world = self.world_from_localized.inverse()
        for spec in self.scene.sim_params.show_trajectory:
            with suppress(UnknownName):
                body = self.body(spec.target.strip("/"))
                trajectory = Trajectory(spec, body, localized_from_world, lambda: self.time)
                self.every(RATE, trajectory.look)
                yield trajectory

    @property
    def ned_origin(self) -> Geodetic:
        """Where on Earth the origin of W is."""
        return self.earth_origin or Geodetic(latitude=0.0, longitude=0.0)

    def dig(self, point: Array) -> int:
        """Take sand around a point in W (3,) [m]; returns how many columns of it lost some."""
        return sum(heap.dig(point) for heap in self.scenery.heaps)

    def catchable(self, surface: int) -> int | None:
        """Return the number of the object with a surface; None where nothing may pick it up."""
        objects = {part.id: part.object for part in self.scenery.parts}
        thing = objects.get(surface)
        if thing is None or self.scene.objects[thing].is_ground:
            return None
        return thing if self.engine.grips.can_hold(thing) else None

    def datagrams(self, port: int) -> Callable[[], Sequence[bytes]] | None:
        """Return what returns the UDP packets that have come to a port since its last call."""
        return self._datagrams.open(port)

    def close(self) -> None:
        """Give back the graphics context and close the ports."""
        self.scenery.close()
        self._datagrams.close()

    def find(self, name: str, *, named_by: str) -> Path:
        """Find a file named in the file ``named_by``; AssetNotFound lists the folders searched."""
        return find_file(name, named_by, self.model.data_path)

    @property
    def fog_colour(self) -> tuple[float, float, float]:
        """Colour of the fog [0..1]."""
        return self.scenery.state.water.fog_colour

    def set_fog(self, density: float) -> None:
        """Set the fog density [1/m] of the water; its colour stays.

        The original sets the colour of its window's fog to (0, 0.05, 0.3) here, and leaves that of
        its cameras as the scene has it.
        """
        self.scenery.state.water = replace(self.scenery.state.water, fog=density)

    def set_light_rate(self, rate: float) -> None:
        """Scale the light of the scene; 1 is as usual."""
        self.scenery.state.light = replace(self.scenery.state.light, rate=rate)

    def set_camera_noise(self, std: float) -> None:
        """Set the noise [0..1] of every colour camera."""
        for name in self.cameras:
            self.camera(name).state.std = std

    def set_current(self, current: Flow | None) -> None:
        """Add a flow to the currents of the scene; None removes it."""
        self.water.set(current)

    def joints(self, vehicle: str) -> Array:
        """Return the joint vector of a vehicle, (n,) [rad or m]; UnknownName if there is none."""
        return self.engine.joints(self.vehicle(vehicle).index)

    def set_joints(self, vehicle: str, values: Mapping[int, float]) -> None:
        """Set joints by their number in the joint vector [rad or m], clamped to limits."""
        moved = self.vehicle(vehicle)
        joints = moved.joints
        for number, value in values.items():
            if 0 <= number < len(joints):
                joints[number] = value
        moved.set_joints(joints)

    def place(self, name: str, world_from_body: Pose) -> None:
        """Place a vehicle or an object, at rest.

        Raises:
            UnknownName: there is none of that name; names the nearest.
            UwsimError: the object is fixed, or a vehicle holds it.
        """
        if name in self.vehicles:
            self.vehicle(name).place(world_from_body)
            return
        names = [thing.name for thing in self.scene.objects]
        if name not in names:
            raise UnknownName("vehicle or object", name, [*self.vehicles, *names])
        index = names.index(name)
        if not self.engine.grips.can_hold(index):
            raise UwsimError(
                f"{name!r} cannot be placed: it is fixed, or a vehicle holds it. Set "
                f"object[{name}].position when the scene is loaded, or vary it with <u:vary>."
            )
        mesh_from_object = self.body(name).world_from_body.inverse() @ self.engine.poses.object(
            index
        )
        self.engine.grips.place(index, world_from_body @ mesh_from_object)

    def put_back(self, vehicle: str) -> None:
        """Put a vehicle where the scene put it, at rest."""
        self.vehicle(vehicle).put_back()

    def frames(self, *, with_objects: bool) -> Sequence[Frame]:
        """List the frames of vehicles, their links and sensors, and those of objects."""
        frames = [*vehicle_frames(self.model, self.every_vehicle, self.engine)]
        return [*frames, *object_frames(self.scene, self.body)] if with_objects else frames

    def marker_frames(self) -> Sequence[Frame]:
        """List the frames of the markers that are there now."""
        return self.markers.frames()

    def every(self, rate: float, call: Callable[[], None]) -> Callable[[], None]:
        """Have ``call`` called at the samples of ``rate`` [Hz] from now on; returns how to stop."""
        return self.schedule.every(self.step, rate, call)

    def at_next_step(self, apply: Callable[[M], None]) -> Callable[[M], None]:
        """Return what has ``apply(message)`` called at the start of the next step."""
        return self.schedule.at_next_step(apply)


def _channels(scene: SceneSpec) -> dict[str, Channel]:
    """The channels of the network by name; of several of one name the first."""
    channels: dict[str, Channel] = {}
    for custom in scene.custom_comms_channels:
        channels.setdefault(custom.name, custom.bind())
    for acoustic in scene.acoustic_comms_channels:
        channels.setdefault(acoustic.name, acoustic.bind())
    return channels
