"""The simulation and its step.

.. code-block:: text

    apply_commands -> step_devices -> advect_kinematic -> step_physics -> animate
      -> update_contacts -> publish: samples that are due (images first), messages on the bus,
         algorithms' callbacks -> observers

Time is an integer count of steps. The tail of the step (sensors and after) also runs once at
step 0, when the simulation is opened.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType, TracebackType
from typing import Any, Self

from .. import __version__
from ..bus import Algorithm, Bus
from ..errors import BadSetting, UnknownName, UwsimError
from ..geometry import Array, Pose
from ..inbox import Inbox
from ..network import nanoseconds
from ..physics.motion import Motion
from ..rendering.rendered_image import RenderedImage
from ..scene.spec import SceneSpec
from ..topics.virtual_camera_to_ros_image import ImagePublisher
from .nodes.calls import Calls
from .nodes.node import InProcessNode
from .snapshot import packed, put_state, state_of, unpacked
from .stage import SceneStage

MAX_RUN = 1000
"""Steps that are taken at once at most: Ctrl-C is heard after them."""


class Simulation:
    """A running scene: the clock, the step, and the attached algorithms.

    Args:
        scene: spec of the scene; its variations are drawn for the seed.
        options: those of `uwsim.simulation.stage.SceneStage`: ``seed``, ``stream_prefix``,
            ``timestep``, ``integrator``, ``data_path``, ``compatibility``, ``pool``,
            ``is_blind``.
    """

    def __init__(self, scene: SceneSpec, **options: Any) -> None:
        if not isinstance(scene, SceneSpec):
            raise BadSetting(
                f"A Simulation is made of what read_scene returns, not of {_shown(scene)}."
            )
        self.world = world = SceneStage(scene, **options)
        """The world of the scene."""
        scene, state = world.scene, world.state
        placed = [i for i in range(len(scene.vehicles)) if not state.is_simulated(i)]
        self._drifting = [world.numbered_vehicle(i) for i in placed]
        self._watchers: list[Callable[[], None]] = []
        self._wet_names = tuple(
            "" if i is None else scene.vehicles[i].name for i in state.submerged_vehicles()
        )
        self._nodes: list[InProcessNode] = []
        self.images = {
            each.image_topic: each for each in world.interfaces if isinstance(each, ImagePublisher)
        }
        """What publishes images, by topic."""
        self._inboxes: dict[str, Inbox[Any]] = {}
        self._is_started = False
        self._animate()

    @property
    def bus(self) -> Bus:
        """Its topics and services."""
        return self.world.bus

    @property
    def step(self) -> int:
        """Physics steps since the simulation began."""
        return self.world.step

    @property
    def timestep(self) -> float:
        """Length of a step [s]."""
        return self.world.timestep

    @property
    def time(self) -> float:
        """``step * timestep`` [s]."""
        return self.world.time

    def start(self) -> None:
        """Publish the first samples, at step 0; the first `advance` does so, too."""
        self._is_started = True
        self._publish()

    def advance(self, seconds: float | None = None) -> None:
        """Take one step, or as many whole steps as there are in some seconds (rounded).

        Raises:
            BadSetting: the time is negative or not finite.
            RunFailed: the engine cannot continue.
        """
        if not self._is_started:
            self.start()
        if seconds is None:
            self._advance()
            return
        if not 0.0 <= seconds < math.inf:
            raise BadSetting(f"advance({seconds!r}): expected a time >= 0 [s].")
        left = round(seconds / self.timestep)
        while left > 0:
            left -= self._advance(left)

    def _advance(self, wanted: int = 1) -> int:
        """Take a step, and of those wanted after it all that nothing comes between; how many."""
        self.bus.step += 1
        self.world.schedule.apply_commands()
        self._step_devices()
        self._advect_kinematic()
        n = self._n_alone(wanted) if wanted > 1 else 1
        self._step_physics(n)
        self._animate()
        self.world.touch.update(self.step)
        self._publish()
        for look in self._watchers:
            look()
        return n

    def _n_alone(self, wanted: int) -> int:
        """How many steps from this one on the forces may act alone, of those wanted.

        In the step after them a command, a sample, a timer or a device may be due; observers,
        water that is not the same everywhere and what drifts with it have to do in every step.
        """
        world, now = self.world, self.step
        delivery = self.bus.next_delivery
        if (
            delivery <= now
            or self._watchers
            or world.touch.is_laid
            or not world.state.is_dynamic
            or world.state.grips.is_carrying
            or not world.water.is_uniform
            or (self._drifting and not world.water.is_still)
        ):
            return 1
        dues = [delivery, world.schedule.due if world.network.is_idle else now]
        dues += [each.timer.due for each in self.images.values()]
        dues += [node.next_tick for node in self._nodes]
        began = self.time - self.timestep
        rests = [math.inf, *(device.rests_until(began) for device in world.devices)]
        free = (min(rests) - began) // self.timestep - 1
        n = min(wanted, MAX_RUN, min(dues) - now + 1, free)
        return max(1, int(n))

    def watch(self, look: Callable[[], None]) -> None:
        """Call ``look`` at the end of every step."""
        self._watchers.append(look)

    @property
    def topics(self) -> dict[str, str]:
        """Topic name -> message type, sorted by name."""
        return self.bus.topics

    def publish(self, topic: str, message: object) -> None:
        """Publish a message; it is delivered at the end of the next step.

        Raises:
            BadSetting: the topic carries another type.
            BadMessage: a field of the message has the wrong type or shape.
        """
        self.bus.publisher(topic, type(message))(message)

    def latest(self, topic: str) -> Any:
        """Return the newest message on a topic; None before the first.

        The topic is read from the first call on. Sensors whose messages are costly (images) publish
        only while somebody reads: ask once, then advance.

        Raises:
            UnknownName: no such topic; names the nearest.
        """
        name = topic.strip().lstrip("/")
        if name not in self._inboxes:
            if name not in self.bus.topics:
                raise UnknownName("topic", topic, self.bus.topics)
            before = self.bus.unread(name)
            self._inboxes[name] = self.bus.inbox(name, object)
            if before is not None:
                self._inboxes[name].receive(before, self.step)
        inbox = self._inboxes[name]
        inbox.take()
        return inbox.last

    def call(self, service: str, request: object) -> object:
        """Call a service and return its response.

        Raises:
            UnknownName: it is not offered; the message has the nearest name.
            BadMessage: the request is of another type.
        """
        return self.bus.services.call(service, request)

    def pose(self, name: str, of: str = "L") -> Pose:
        """Return where a body is: a vehicle, a link ``vehicle/link``, or an object.

        Args:
            name: of the body.
            of: the frame: ``L`` (that of files and topics), ``W`` (z up), or another body's name.

        Raises:
            UnknownName: there is no such body; names the nearest.
        """
        world_from_body = self.world.body(name).world_from_body
        if of == "W":
            return world_from_body
        world_from_frame = self.world.world_from_localized
        if of != "L":
            world_from_frame = self.world.body(of).world_from_body
        return world_from_frame.inverse() @ world_from_body

    def velocity(self, name: str) -> Array:
        """Return the twist of a simulated vehicle over ground, in its base frame, (6,).

        Linear [m/s] first, then angular [rad/s].

        Raises:
            UnknownName: there is no such vehicle; names the nearest.
            UwsimError: the vehicle is kinematic.
        """
        index = self.world.vehicle(name).index
        if not self.world.state.is_simulated(index):
            raise UwsimError(f"{name!r} is kinematic (no <u:dynamics>): it has no velocity.")
        return self.world.state.vehicle_velocity(index)

    def image(self, camera: str) -> RenderedImage:
        """Render what a camera sees now, without noise: colour, range and ids.

        Raises:
            UnknownName: there is no such camera; names the nearest.
            NoGraphics: there is no OpenGL.
        """
        view = self.world.camera(camera)
        return self.world.scenery.render_clean(view.world_from_camera, view.intrinsics)

    @property
    def motion(self) -> Motion:
        """Positions and velocities of all bodies, as one row of numbers."""
        return self.world.state.motion

    def _publish(self) -> None:
        bus = self.bus
        for images in self.images.values():
            images.timer.tick(bus.step)
        self.world.network.advance(nanoseconds(self.time))
        self.world.schedule.tick(bus.step)
        bus.deliver()
        for node in self._nodes:
            node.tick()
        bus.deliver()

    def _step_devices(self) -> None:
        """Let devices act, at the start of the step."""
        time = self.time - self.timestep
        for device in self.world.devices:
            device.step(time)

    def _advect_kinematic(self) -> None:
        """Advect kinematic vehicles with the water, as the original does."""
        world = self.world
        if world.water.is_still:
            return
        for vehicle in self._drifting:
            here = vehicle.world_from_base
            vehicle.drift(world.water.carried(here, self.time, self.timestep, vehicle.name))

    def _step_physics(self, n: int) -> None:
        """Advance the physics by some steps, in the flow of the water at their times."""
        state, water = self.world.state, self.world.water
        if not state.is_dynamic:
            state.fall()
            self.world.below_ground.look(self.step)
            return
        first, half = self.step, 0.5 * self.timestep  # forces act in the middle of a step
        motion = None
        if not water.is_still:
            times = [(first + k) * self.timestep - half for k in range(n)]
            motion = water.during(state.submerged_positions, times, self._wet_names)
        before = state.n_steps
        try:
            state.step(n, motion)
        finally:
            self.bus.step = first + max(0, state.n_steps - before - 1)
        self.world.below_ground.look(self.step)

    def _animate(self) -> None:
        """Move what devices animate."""
        for device in self.world.devices:
            device.animate(self.time)

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

        What it raises comes out here and out of `advance`; without ``raises`` it is kept in the
        node's ``error``, and the algorithm is not called any more. ``calls`` counts those into it.
        """
        node = InProcessNode(
            self.bus,
            name=name or type(algorithm).__name__,
            timestep=self.timestep,
            random=self.world.stream("algorithm"),
            parameters=parameters,
            raises=raises,
            calls=calls,
        )
        self._nodes.append(node)
        node.run(algorithm)
        return node

    def save(self) -> bytes:
        """Return the state as bytes, exact to the bit; `uwsim.simulation.snapshot` lists its parts.

        Raises:
            UwsimError: an algorithm is attached, whose state cannot be saved.
        """
        if self._nodes:
            names = ", ".join(node.name for node in self._nodes)
            raise UwsimError(f"Cannot be saved: {names} is attached, with a state of its own.")
        newest = {topic: (box.last, box.last_step) for topic, box in self._inboxes.items()}
        values = {"is_open": self._is_started, "newest": newest, "world": state_of(self.world)}
        return packed({"uwsim": __version__, **values})

    def restore(self, data: bytes) -> None:
        """Go back, or on, to a saved state of the same scene, seed and timestep.

        Raises:
            UwsimError: the bytes are damaged, of another scene, or of another version.
        """
        values = unpacked(data)
        if values.pop("uwsim", None) != __version__:
            raise UwsimError(f"The simulation was not saved by uwsim {__version__}.")
        if set(values) != {"is_open", "newest", "world"}:
            raise UwsimError("These bytes are no saved simulation.")
        put_state(self.world, values["world"])
        self._is_started = values["is_open"]
        for topic, (last, step) in values["newest"].items():
            if topic not in self._inboxes:
                self._inboxes[topic] = self.bus.inbox(topic, object)
            box = self._inboxes[topic]
            box.clear()
            box.last, box.last_step = last, step
        self.world.scenery.redraw()

    def close(self) -> None:
        """Release the graphics context and disconnect the algorithms."""
        for node in self._nodes:
            node.close()
        self.world.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()


def _shown(found: object) -> str:
    """``a str: 'scene.xml'``, cut where it is long."""
    text = repr(found)
    return f"a {type(found).__name__}: {text if len(text) <= 60 else text[:57] + '...'}"
