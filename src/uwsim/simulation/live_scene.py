"""The live parts of one running scene, bound and put together."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import cast

import numpy as np

from ..assets import has_model
from ..base import rng
from ..bus import Bus
from ..errors import UnknownName
from ..messages import SpawnMarker, String
from ..model.scene_model import SceneModel
from ..network import Channel, Network
from ..physics.engine import Engine
from ..scene.spec import SceneSpec
from ..topics.interface import Binds, Interface
from ..topics.virtual_camera_to_ros_image import ImagePublisher
from .bodies import SceneBodies
from .collision.below_ground import BelowGround
from .collision.contacts import Contacts
from .collision.start_depths import lift_from_ground
from .datagrams import Datagrams
from .forces import bind_forces
from .markers import SERVICE, Markers
from .scene_devices import bind_devices
from .scene_sensors import SceneSensors
from .scenery.renderer_pool import RendererPool
from .scenery.scene_rays import SceneRays
from .scenery.scenery import Scenery
from .schedule import Schedule
from .trajectories import RATE, Trajectory
from .vehicles import SceneVehicles
from .water.water_motion import water_motion
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
        self.model = model
        """What does not change while the scene runs: `model.scene` is its spec."""
        self._prefix = stream_prefix
        self.bus = Bus()
        """Its topics and services."""
        self.files = dict(model.hydrodynamics_files)
        """Hydrodynamics files of vehicles, files of currents and of a projector, by name."""
        self.schedule = Schedule(self.bus, model.timestep)
        """What is to be done at a later step."""
        self._bind_bodies(pool)
        self.water = water_motion(model, self.stream, runs_code=runs_code)
        """How its water moves."""
        self.files |= self.water.files
        self.sensors = SceneSensors(model.scene, self.vehicles, SensorView(self, is_blind=is_blind))
        """The sensors, by element and name."""
        self.network = _network(model.scene, self)
        """The packets between communication devices."""
        self.datagrams = Datagrams(udp_address)
        """The UDP ports at which packets are taken."""
        self.devices = tuple(bind_devices(self))
        """What acts in the step, in the file's order."""
        self.forces = bind_forces(self)
        """What acts on bodies besides the water, in the file's order."""
        self._bind_topics(is_blind=is_blind)
        self.measure_view = MeasureView(self)
        """The scene as measures and triggers see it."""
        self.stage_view = StageView(self)
        """The scene as scene updaters see it."""

    def _bind_bodies(self, pool: RendererPool | None) -> None:
        """Bind what is in the scene, before all that senses it and acts in it."""
        model = self.model
        self.engine = engine = Engine(model)
        """Where everything is, and what moves it."""
        if model.dynamics or model.scene.has_uwsim_physics:
            lift_from_ground(model, engine)
        self.below_ground = BelowGround(model, engine)
        """Whether a body has passed through the ground."""
        self.vehicles = SceneVehicles(model, engine, self.bus)
        """The vehicles, by their number in the file or by name."""
        self.scenery = Scenery(model, engine, pool)
        """The visual side of the scene."""
        self.rays = SceneRays(model, engine, self.scenery.heaps)
        """Ray casting against the scene."""
        self.bodies = SceneBodies(model, engine)
        """Vehicles, links and objects, by name."""
        self.contacts = Contacts(model, engine)
        """Contacts between bodies."""

    def _bind_topics(self, *, is_blind: bool) -> None:
        """Bind what publishes and listens."""
        spec = self.model.scene
        place = Path(spec.path) if spec.path else None
        self.markers = Markers(
            lambda: self.time, partial(has_model, named_by=place, data_path=self.model.data_path)
        )
        """What programs have spawned."""
        self.bus.services.serve(SERVICE, SpawnMarker, self.markers.answer)
        self.trajectories = tuple(self._bound_trajectories())
        """What ``showTrajectory`` asks for."""
        self.interfaces = tuple(_bound_interfaces(spec, TopicView(self, is_blind=is_blind)))
        """What publishes and listens, in the file's order."""
        self.images = {
            each.image_topic: each for each in self.interfaces if isinstance(each, ImagePublisher)
        }
        """What publishes images, by topic."""

    def _bound_trajectories(self) -> Iterator[Trajectory]:
        spec = self.model.scene
        localized_from_world = spec.world_from_localized.inverse()
        for shown in spec.sim_params.show_trajectory:
            with suppress(UnknownName):
                body = self.bodies.find(shown.target.strip("/"))
                trajectory = Trajectory(shown, body, localized_from_world, lambda: self.time)
                self.schedule.every(RATE, trajectory.look)
                yield trajectory

    @property
    def time(self) -> float:
        """The simulation time [s]."""
        return self.bus.state.step * self.model.timestep

    def stream(self, name: str) -> np.random.Generator:
        """Return the random generator of that name."""
        return rng.stream(self.model.seed, self._prefix + name)

    def close(self) -> None:
        """Give back the graphics context and close the ports."""
        self.scenery.close()
        self.datagrams.close()


def _bound_interfaces(spec: SceneSpec, world: TopicView) -> Iterator[Interface]:
    for interface in spec.ros_interfaces:
        # one that names what is not there is left out, as in the original
        with suppress(UnknownName):
            if interface.is_simulated():
                yield cast("Binds", interface).bind(world)


def _network(spec: SceneSpec, scene: LiveScene) -> Network:
    """Return the network of a scene; of several channels of one name it has the first."""
    channels: dict[str, Channel] = {}
    for custom in spec.custom_comms_channels:
        channels.setdefault(custom.name, custom.bind())
    for acoustic in spec.acoustic_comms_channels:
        channels.setdefault(acoustic.name, acoustic.bind())
    surface = spec.ocean_state.ocean_surface_height
    network = Network(scene.stream, surface=surface, channels=channels)
    if spec.net_tracing_script is not None:
        publish = scene.bus.publisher(TRACE, String)
        network.trace = lambda line: publish(String(data=line))
    return network
