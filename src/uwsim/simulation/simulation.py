"""The Python interface of a running scene."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from types import MappingProxyType, TracebackType
from typing import Any, Self

from ..base.deprecation import deprecated_name, renamed_parameters
from ..base.geometry import Array, Pose
from ..base.record import assign
from ..bus import Algorithm, Bus
from ..errors import BadSetting, UwsimError, short_repr
from ..model.scene_model import SceneModel
from ..physics.compile_scene import recompile
from ..rendering.rendered_image import RenderedImage
from ..world import Flow
from .access import arguments, placing
from .access.boxes import OrientedBox, oriented_boxes
from .access.topics import TopicAccess
from .live_scene import LiveScene
from .nodes.calls import Calls
from .nodes.node import InProcessNode
from .scene_stepper import SceneStepper
from .scenery.renderer_pool import RendererPool
from .state.state import RunningIdentity, State


class Simulation:
    """A running scene: the clock, the step, and the attached algorithms.

    Args:
        model: the compiled scene, from `uwsim.physics.compile_scene.compile_scene`; its seed is the
            seed of every random stream.
        stream_prefix: the prefix of the name of every random stream.
        pool: the pool of renderers; None: the simulation has its own renderer.
        is_blind: True to publish black images on topics, and to render nothing for them.
        runs_code: True to run the Python code to which the scene refers; False: a current that
            requires such code is zero.
        udp_address: the address of this computer at which ``<fdm>`` receives packets; None: none.
    """

    def __init__(
        self,
        model: SceneModel,
        *,
        stream_prefix: str = "",
        pool: RendererPool | None = None,
        is_blind: bool = False,
        runs_code: bool = True,
        udp_address: str | None = None,
    ) -> None:
        if not isinstance(model, SceneModel):
            raise BadSetting(
                f"A Simulation needs a SceneModel, which compile_scene returns, not a "
                f"{type(model).__name__}: {short_repr(model)}."
            )
        self._own_pool = RendererPool()
        self._make_scene = partial(
            LiveScene,
            stream_prefix=stream_prefix,
            pool=pool or self._own_pool,
            is_blind=is_blind,
            runs_code=runs_code,
            udp_address=udp_address,
        )
        self._step_callbacks: list[Callable[[], None]] = []
        self._nodes: list[InProcessNode] = []
        self._open(model)

    def _open(self, model: SceneModel, read_topics: Iterable[str] = ()) -> None:
        """Start a model at step 0, and open an inbox for each of ``read_topics``."""
        self.world = world = self._make_scene(model)
        """The parts of the running scene."""
        self._stepper = SceneStepper(world, self._nodes, self._step_callbacks)
        self._access = TopicAccess(self.bus, read_topics)
        self._state = self._make_state()
        self._stepper.animate()

    def _make_state(self) -> State:
        world = self.world
        return State(
            identity=RunningIdentity(world.model),
            bus=world.bus.state,
            engine=world.engine.state,
            vehicles=[vehicle.state for vehicle in world.vehicles],
            sensors=[sensor.state for sensor in world.sensors.bound_sensors],
            devices=[device.state for device in world.devices],
            forces=[force.state for force in world.forces],
            interfaces=[interface.state for interface in world.interfaces],
            faults=[topic.state for topic in world.sensors.faulty_topics],
            scenery=world.scenery.state,
            water=world.water.state,
            contacts=world.contacts.state,
            below_ground=world.below_ground.state,
            schedule=world.schedule.state,
            network=world.network.state,
            markers=world.markers.state,
            trajectories=[trajectory.state for trajectory in world.trajectories],
            access=self._access.state,
            nodes=[],
        )

    def reset(self, seed: int | None = None) -> None:
        """Start again at step 0, with the variations (``<u:vary>``) of a seed.

        The state is then equal to that of a new simulation with this seed. `world` is a new object.
        Topics that `latest_message` reads, and callbacks of `watch`, remain.

        Args:
            seed: the new seed of every random stream; None: the same seed again.

        Raises:
            BadSetting: the seed is negative, or not a whole number.
            UwsimError: an algorithm is attached, whose state cannot be reset.
        """
        if self._nodes:
            names = ", ".join(node.name for node in self._nodes)
            raise UwsimError(
                f"{names} is attached; its state cannot be reset. Load the scene again."
            )
        model = self.world.model
        if seed is not None:
            model = recompile(model, arguments.check_seed(seed))
        self.world.close()
        self._open(model, self._access.topics_read)

    @property
    def state(self) -> State:
        """The state of the simulation; it changes with each step, a ``copy()`` does not."""
        return self._state

    @property
    def bus(self) -> Bus:
        """The bus, which carries the topics and services."""
        return self.world.bus

    @property
    def step(self) -> int:
        """The number of physics steps since the start."""
        return self._state.bus.step

    @property
    def timestep(self) -> float:
        """The length of a step [s]."""
        return self.world.model.timestep

    @property
    def time(self) -> float:
        """The simulation time, ``step * timestep`` [s]."""
        return self._state.bus.step * self.world.model.timestep

    def advance(self, seconds: float | None = None) -> None:
        """Take one step, or the number of steps nearest to a time [s].

        The first call also publishes the samples of step 0; ``advance(0.0)`` does only this.

        Raises:
            BadSetting: the time is negative or not finite.
            RunFailed: the engine cannot continue, for example because of invalid numbers.
        """
        if not self._access.state.is_started:
            self._access.state.is_started = True
            self._stepper.publish()
        if seconds is None:
            self._stepper.advance()
            return
        n_left = arguments.count_steps(seconds, self.timestep)
        while n_left > 0:
            n_left -= self._stepper.advance(n_left)

    @renamed_parameters(look="callback")
    def watch(self, callback: Callable[[], None]) -> None:
        """Call ``callback`` at the end of every step."""
        self._step_callbacks.append(callback)

    @property
    def topics(self) -> dict[str, str]:
        """The message types by topic name, sorted by name."""
        return self.bus.topics

    def publish(self, topic: str, message: object) -> None:
        """Publish a message; it is delivered at the end of the next step.

        For an existing topic without a subscriber, a warning is printed on standard error, once.

        Raises:
            UnknownName: there is no such topic; the error message suggests the nearest topic with a
                subscriber.
            BadSetting: the topic carries another type of message.
            BadMessage: a field of the message has the wrong type or shape.
        """
        self._access.publish(topic, message)

    def latest_message(self, topic: str) -> Any:
        """Return the newest message on a topic; None before the first.

        The topic is read from the first call on. Sensors with costly messages (images) publish only
        while their topic is read: call this once, then advance.

        Raises:
            UnknownName: there is no such topic; the error message suggests the nearest name.
        """
        return self._access.latest_message(topic)

    @deprecated_name("latest_message")
    def latest(self, topic: str) -> Any:
        """Call `latest_message`; this is its deprecated name."""
        return self.latest_message(topic)

    def call(self, service: str, request: object) -> object:
        """Call a service and return its response.

        Raises:
            UnknownName: no node offers the service; the error message suggests the nearest name.
            BadMessage: the request has the wrong type.
        """
        return self.bus.services.call(service, request)

    @renamed_parameters(of="frame")
    def pose(self, name: str, frame: str = "L") -> Pose:
        """Return the pose of a body: a vehicle, a link ``vehicle/link``, or an object.

        Args:
            name: the name of the body.
            frame: ``L`` (the frame of files and topics), ``W`` (z up), or another body's name.

        Raises:
            UnknownName: there is no such body; the error message suggests the nearest name.
        """
        world_from_body = self.world.bodies.find(name).world_from_body
        return placing.world_from_frame(self.world, frame).inverse() @ world_from_body

    @renamed_parameters(of="frame")
    def set_pose(self, name: str, pose: Pose, frame: str = "L") -> None:
        """Set the pose of a vehicle or an object, at rest; afterwards `pose` returns this pose.

        Args:
            name: the name of a vehicle, or of an object that can move (``<physics>`` and a mass).
            pose: the pose of the vehicle or object in ``frame``.
            frame: the reference frame, as in `pose`.

        Raises:
            UnknownName: there is no such vehicle, object or frame; the error message suggests the
                nearest name.
            BadSetting: the pose is not a finite `Pose`, or a coordinate in W exceeds 1e6 m.
            UwsimError: the object is fixed, or a vehicle holds it.
        """
        world_from_frame = placing.world_from_frame(self.world, frame)
        placing.place(self.world, name, arguments.check_pose(name, world_from_frame, pose))

    def velocity(self, name: str) -> Array:
        """Return the twist of a vehicle with dynamics, over ground in its base frame, (6,).

        The linear velocity [m/s] is first, then the angular velocity [rad/s].

        Raises:
            UnknownName: there is no such vehicle; the error message suggests the nearest name.
            UwsimError: the vehicle is kinematic.
        """
        vehicle = self.world.vehicles.find(name)
        if not self.world.engine.has_dynamics(vehicle.index):
            raise UwsimError(
                f"{name!r} is kinematic (no <u:dynamics>); expected a vehicle with dynamics."
            )
        return vehicle.velocity

    def image(self, camera: str) -> RenderedImage:
        """Render the present image of a camera without noise.

        The image has the colour, the range, and the id of the link or object in each pixel.

        Raises:
            UnknownName: there is no such camera; the error message suggests the nearest name.
            NoGraphics: no OpenGL context can be created.
        """
        view, scenery = self.world.sensors.camera(camera), self.world.scenery
        image = scenery.render_clean(
            view.world_from_camera, view.intrinsics, is_polished=view.is_polished
        )
        return replace(image, world_from_camera=view.world_from_camera, names=scenery.part_names)

    @renamed_parameters(of="frame")
    def boxes(self, frame: str = "L") -> dict[str, OrientedBox]:
        """Return the 3-D bounding boxes of all links and objects, by their names in `image`.

        Args:
            frame: the frame in which the boxes are returned, as in `pose`. For boxes in a camera's
                frame, request ``W``, and transform them by the inverse of the camera's pose
                ``simulation.world.sensors.camera(name).world_from_camera``.

        Raises:
            UnknownName: there is no such frame; the error message suggests the nearest name.
        """
        return oriented_boxes(
            self.world.scenery, placing.world_from_frame(self.world, frame).inverse()
        )

    def set_fog(self, density: float) -> None:
        """Set the fog density [1/m], 0 for clear water.

        Raises:
            BadSetting: the density is not a finite number of at least 0.
            UwsimError: the scene has physical water.
        """
        self.world.scenery.set_fog(arguments.check_number("set_fog", density))

    def set_light(self, rate: float) -> None:
        """Set the factor by which the light is scaled, 1 by default.

        Raises:
            BadSetting: the factor is not a finite number of at least 0.
        """
        self.world.scenery.set_light_rate(arguments.check_number("set_light", rate))

    def set_current(self, velocity: Sequence[float] | Flow | None) -> None:
        """Add a current to those of the scene; it replaces the current of an earlier call.

        Args:
            velocity: the velocity of the water in the frame of the scene file, (3,) [m/s]; or a
                `Flow`; None: no added current.

        Raises:
            BadSetting: the velocity is not three numbers, or a component exceeds
                `uwsim.currents.current.MAX_SPEED`. If a `Flow` raises an exception or returns a
                wrong shape, `advance` raises BadSetting.
        """
        self.world.water.set(arguments.flow_of(velocity))

    def attach(
        self,
        algorithm: Algorithm,
        *,
        name: str | None = None,
        parameters: Mapping[str, float | str] = MappingProxyType({}),
        raises: bool = True,
        calls: Calls | None = None,
    ) -> InProcessNode:
        """Connect an algorithm to the bus and start it.

        Args:
            algorithm: the algorithm, an object with a method ``start(node)``.
            name: the name of its node; None: the name of its class.
            parameters: the parameters of the algorithm.
            raises: True: its exceptions are raised here and by `advance`. False: an exception is
                stored in ``error`` of the node, and the algorithm is not called again.
            calls: the counter of the algorithm's calls; None: they are not counted.

        Raises:
            BadSetting: the algorithm is a class, or has no method ``start(node)``.
        """
        arguments.check_algorithm(algorithm)
        node = InProcessNode(
            self.bus,
            name=name or type(algorithm).__name__,
            timestep=self.timestep,
            rng=self.world.stream("algorithm"),
            parameters=parameters,
            raises=raises,
            calls=calls,
        )
        self._nodes.append(node)
        self.state.nodes.append(node.state)
        node.run(algorithm)
        return node

    def save(self) -> bytes:
        """Return `state` as bytes, bit-exact.

        Raises:
            UwsimError: an attached algorithm has no ``save`` and ``restore``.
        """
        return self.state.to_bytes()

    def restore(self, data: bytes | State) -> None:
        """Set the simulation to a saved state of the same scene, seed and timestep.

        Args:
            data: the bytes of `save`, or a copy of `state`.

        Raises:
            UwsimError: the bytes are damaged, or belong to another scene, seed, timestep or
                version; other algorithms are attached; or one of them has no ``save`` and
                ``restore``. The simulation then does not change.
        """
        state = data if isinstance(data, State) else State.from_bytes(data)
        names, names_saved = (
            [node.name for node in state_record.nodes] for state_record in (self.state, state)
        )
        if names != names_saved:
            raise UwsimError(
                f"The saved simulation has the algorithms {names_saved}, this one has {names}. "
                "Attach the same algorithms in the same order before you restore it."
            )
        previous_state = self.state.copy()
        try:
            assign(self.state, state)
        except BaseException:
            assign(self.state, previous_state)
            raise
        finally:
            self.world.scenery.redraw()

    def close(self) -> None:
        """Disconnect the algorithms, close the ports and release the graphics context."""
        for node in self._nodes:
            node.close()
        self.world.close()
        self._own_pool.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()
