"""A running scene: its parts, which are bound to each other and connected to the bus."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import cast

from ..assets import has_model
from ..errors import UnknownName
from ..messages import SpawnMarker, String
from ..model.scene_model import SceneModel
from ..network import Channel, Network
from ..scene.spec import SceneSpec
from ..topics.interface import Interface, SimulatedInterface
from ..topics.virtual_camera_to_ros_image import ImagePublisher
from .connections import OpenConnections
from .datagrams import Datagrams
from .forces import bind_forces
from .markers import SERVICE, Markers
from .physical_scene import PhysicalScene
from .scene_devices import bind_devices
from .scene_sensors import SceneSensors
from .scenery.renderer_pool import RendererPool
from .trajectories import SAMPLE_RATE, Trajectory
from .world_views.device_view import DeviceView
from .world_views.measure_view import MeasureView
from .world_views.sensor_view import SensorView
from .world_views.stage_view import StageView
from .world_views.topic_view import TopicView

TRACE_TOPIC = "/network/trace"
"""The topic that reports the fate of packets."""


class LiveScene:
    """The parts of a running scene: engine, water, vehicles, sensors, devices, topics, views.

    Args:
        model: the compiled scene.
        udp_address: the address of this computer at which ``<fdm>`` receives datagrams, and with
            which devices open connections to programs outside; None: none.
        stream_prefix: the prefix of the names of random streams.
        runs_code: True to run the Python code to which the scene refers; False: a current that
            requires such code is zero.
        pool: the pool of renderers; None: the scene has a renderer of its own.
        is_blind: True to publish black images on topics, and to render nothing for them.
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
        scene = PhysicalScene(model, stream_prefix=stream_prefix, runs_code=runs_code, pool=pool)
        self.model = model
        """The compiled scene, which does not change while it runs; ``model.scene`` is its spec."""
        self.bus = scene.bus
        """The topics and services."""
        self.schedule = scene.schedule
        """The timers, and the commands of the next step."""
        self.engine = scene.engine
        """The engine, which stores the poses and moves the bodies."""
        self.below_ground = scene.below_ground
        """The check for bodies that have passed through the ground."""
        self.vehicles = scene.vehicles
        """The vehicles, by their number in the file or by name."""
        self.scenery = scene.scenery
        """The rendering of the scene."""
        self.rays = scene.rays
        """The ray casting against the scene."""
        self.bodies = scene.bodies
        """The vehicles, links and objects, by name."""
        self.contacts = scene.contacts
        """The contacts between bodies."""
        self.water = scene.water
        """The motion of the water."""
        self.stream = scene.stream
        """The function that returns the random generator of a stream's name."""
        self.sensors = SceneSensors(model, self.vehicles, SensorView(scene, is_blind=is_blind))
        """The sensors, which are found by element and name."""
        self.network = _make_network(scene)
        """The packets between communication devices."""
        self._datagrams = Datagrams(udp_address)
        self._connections = None if udp_address is None else OpenConnections(udp_address)
        world = DeviceView(scene, self.network, self._datagrams, self._connections)
        self.devices, patterns = bind_devices(scene, self.sensors, world)
        """The devices, which act in each step, in the file's order."""
        self.files = {**model.hydrodynamics_files, **self.water.files, **patterns}
        """The paths of hydrodynamics, current and pattern files, by file name."""
        self.forces = bind_forces(scene)
        """The forces on bodies besides those of the water, in the file's order."""
        self.markers = _make_markers(model, lambda: self.time)
        """The markers that programs have added."""
        self.bus.services.serve(SERVICE, SpawnMarker, self.markers.answer)
        self.trajectories = tuple(self._bind_trajectories())
        """The trajectories of ``<showTrajectory>`` elements."""
        topics = TopicView(scene, self.sensors, self.markers, self.forces, is_blind=is_blind)
        self.interfaces = tuple(_bind_interfaces(model.scene, topics))
        """The elements of ``<rosInterfaces>``, which publish and subscribe, in the file's order."""
        self.images = {
            interface.image_topic: interface
            for interface in self.interfaces
            if isinstance(interface, ImagePublisher)
        }
        """The publishers of camera images, by topic."""
        self.measure_view = MeasureView(scene, self.sensors)
        """The view of the scene for measures and triggers."""
        self.stage_view = StageView(scene, self.sensors, self.measure_view)
        """The view of the scene for scene updaters."""

    def _bind_trajectories(self) -> Iterator[Trajectory]:
        scene_spec = self.model.scene
        localized_from_world = scene_spec.world_from_localized.inverse()
        for spec in scene_spec.sim_params.show_trajectory:
            with suppress(UnknownName):
                body = self.bodies.find(spec.target.strip("/"))
                trajectory = Trajectory(spec, body, localized_from_world, lambda: self.time)
                self.schedule.create_timer(SAMPLE_RATE, trajectory.add_point)
                yield trajectory

    @property
    def time(self) -> float:
        """The simulation time [s]."""
        return self.bus.state.step * self.model.timestep

    def close(self) -> None:
        """Release the graphics context and close the ports."""
        self.scenery.close()
        self._datagrams.close()
        if self._connections is not None:
            self._connections.close()


def _bind_interfaces(spec: SceneSpec, world: TopicView) -> Iterator[Interface]:
    for interface in spec.ros_interfaces:
        # an interface that names a missing part is left out, as in the original UWSim
        with suppress(UnknownName):
            if interface.is_simulated():
                yield cast("SimulatedInterface", interface).bind(world)


def _make_markers(model: SceneModel, clock: Callable[[], float]) -> Markers:
    scene_path = Path(model.scene.path) if model.scene.path else None
    return Markers(clock, partial(has_model, named_by=scene_path, data_path=model.data_path))


def _make_network(scene: PhysicalScene) -> Network:
    """Return the network of a scene; the first of several channels with one name is used."""
    spec = scene.model.scene
    channels: dict[str, Channel] = {}
    for custom_channel in spec.custom_comms_channels:
        channels.setdefault(custom_channel.name, custom_channel.bind())
    for acoustic_channel in spec.acoustic_comms_channels:
        channels.setdefault(acoustic_channel.name, acoustic_channel.bind())
    surface = spec.ocean_state.ocean_surface_height
    network = Network(scene.stream, surface=surface, channels=channels)
    if spec.net_tracing_script is not None:
        publish = scene.bus.publisher(TRACE_TOPIC, String)
        network.trace = lambda line: publish(String(data=line))
    return network
