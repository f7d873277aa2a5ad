"""The live parts of one running scene, bound and put together."""

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
from .datagrams import Datagrams
from .forces import bind_forces
from .markers import SERVICE, Markers
from .physical_scene import PhysicalScene
from .scene_devices import bind_devices
from .scene_sensors import SceneSensors
from .scenery.renderer_pool import RendererPool
from .trajectories import RATE, Trajectory
from .world_views.device_view import DeviceView
from .world_views.measure_view import MeasureView
from .world_views.sensor_view import SensorView
from .world_views.stage_view import StageView
from .world_views.topic_view import TopicView

TRACE = "/network/trace"
"""Topic of what becomes of packets."""


class LiveScene:
    """A scene at work: its engine, water, vehicles, sensors, devices, topics, and its views.

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
        physical = PhysicalScene(model, stream_prefix=stream_prefix, runs_code=runs_code, pool=pool)
        self.model = model
        """What does not change while the scene runs: ``model.scene`` is its spec."""
        self.bus = physical.bus
        """Its topics and services."""
        self.schedule = physical.schedule
        """What is to be done at a later step."""
        self.engine = physical.engine
        """Where everything is, and what moves it."""
        self.below_ground = physical.below_ground
        """Whether a body has passed through the ground."""
        self.vehicles = physical.vehicles
        """The vehicles, by their number in the file or by name."""
        self.scenery = physical.scenery
        """The visual side of the scene."""
        self.rays = physical.rays
        """Ray casting against the scene."""
        self.bodies = physical.bodies
        """Vehicles, links and objects, by name."""
        self.contacts = physical.contacts
        """Contacts between bodies."""
        self.water = physical.water
        """How its water moves."""
        self.stream = physical.stream
        """Returns the random generator of a name."""
        self.sensors = SceneSensors(model, self.vehicles, SensorView(physical, is_blind=is_blind))
        """The sensors, by element and name."""
        self.network = _network(physical)
        """The packets between communication devices."""
        self._datagrams = Datagrams(udp_address)
        world = DeviceView(physical, self.network, self._datagrams)
        self.devices, patterns = bind_devices(physical, self.sensors, world)
        """What acts in the step, in the file's order."""
        self.files = {**model.hydrodynamics_files, **self.water.files, **patterns}
        """Files of hydrodynamics, of currents, and of a projector's pattern, by name."""
        self.forces = bind_forces(physical)
        """What acts on bodies besides the water, in the file's order."""
        self.markers = _markers(model, lambda: self.time)
        """What programs have spawned."""
        self.bus.services.serve(SERVICE, SpawnMarker, self.markers.answer)
        self.trajectories = tuple(self._bound_trajectories())
        """What ``showTrajectory`` asks for."""
        topics = TopicView(physical, self.sensors, self.markers, is_blind=is_blind)
        self.interfaces = tuple(_bound_interfaces(model.scene, topics))
        """What publishes and listens, in the file's order."""
        self.images = {
            each.image_topic: each for each in self.interfaces if isinstance(each, ImagePublisher)
        }
        """What publishes images, by topic."""
        self.measure_view = MeasureView(physical, self.sensors)
        """The scene as measures and triggers see it."""
        self.stage_view = StageView(physical, self.sensors, self.measure_view)
        """The scene as scene updaters see it."""

    def _bound_trajectories(self) -> Iterator[Trajectory]:
        spec = self.model.scene
        localized_from_world = spec.world_from_localized.inverse()
        for shown in spec.sim_params.show_trajectory:
            with suppress(UnknownName):
                body = self.bodies.find(shown.target.strip("/"))
                trajectory = Trajectory(shown, body, localized_from_world, lambda: self.time)
                self.schedule.create_timer(RATE, trajectory.look)
                yield trajectory

    @property
    def time(self) -> float:
        """The simulation time [s]."""
        return self.bus.state.step * self.model.timestep

    def close(self) -> None:
        """Give back the graphics context and close the ports."""
        self.scenery.close()
        self._datagrams.close()


def _bound_interfaces(spec: SceneSpec, world: TopicView) -> Iterator[Interface]:
    for interface in spec.ros_interfaces:
        # one that names what is not there is left out, as in the original
        with suppress(UnknownName):
            if interface.is_simulated():
                yield cast("SimulatedInterface", interface).bind(world)


def _markers(model: SceneModel, clock: Callable[[], float]) -> Markers:
    """Return the keeper of markers, which finds meshes as the scene does."""
    place = Path(model.scene.path) if model.scene.path else None
    return Markers(clock, partial(has_model, named_by=place, data_path=model.data_path))


def _network(physical: PhysicalScene) -> Network:
    """Return the network of a scene; of several channels of one name it has the first."""
    spec = physical.model.scene
    channels: dict[str, Channel] = {}
    for custom in spec.custom_comms_channels:
        channels.setdefault(custom.name, custom.bind())
    for acoustic in spec.acoustic_comms_channels:
        channels.setdefault(acoustic.name, acoustic.bind())
    surface = spec.ocean_state.ocean_surface_height
    network = Network(physical.stream, surface=surface, channels=channels)
    if spec.net_tracing_script is not None:
        publish = physical.bus.publisher(TRACE, String)
        network.trace = lambda line: publish(String(data=line))
    return network
