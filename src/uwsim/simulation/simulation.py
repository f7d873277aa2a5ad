"""The simulation: one step after the other.

.. code-block:: text

    commands from the bus -> devices -> forces -> physics step -> clock
      -> sensors whose period is due (images last) -> messages on the bus
      -> algorithms' callbacks -> observers

Time is an integer count of steps. The tail of the step (sensors and after) also runs once at
step 0, when the simulation is opened.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..bus import Algorithm, Bus
from ..errors import BadSetting
from ..physics.motion import Motion
from ..scene.spec import SceneSpec
from ..topics.virtual_camera_to_ros_image import ImagePublisher
from .calls import Calls
from .node import InProcessNode
from .stage import SceneStage
from .thruster_faults import ThrusterFaults


class Simulation:
    """A scene that lives: the clock, the step, and the algorithms at its topics.

    Args:
        scene: what the file says; what varies in it is drawn for the seed.
        options: those of `uwsim.simulation.world.SceneWorld`: ``seed``, ``stream_prefix``,
            ``timestep``, ``integrator``, ``data_path``, ``compatibility``, ``studio``,
            ``is_blind``.
    """

    def __init__(self, scene: SceneSpec, **options: Any) -> None:
        if not isinstance(scene, SceneSpec):
            raise BadSetting(
                f"A Simulation is made of what read_scene returns, not of {_shown(scene)}."
            )
        self.world = world = SceneStage(scene, **options)
        """What is in the scene."""
        scene, state = world.scene, world.state
        self._drifting = [(i, v) for i, v in enumerate(scene.vehicles) if not state.is_simulated(i)]
        self._watchers: list[Callable[[], None]] = []
        self._wet_names = tuple(
            "" if i is None else scene.vehicles[i].name for i in state.wet_vehicles()
        )
        self._swaying = [(i, v) for i, v in enumerate(scene.vehicles) if v.sways]
        self._sway()
        self._thruster_faults = ThrusterFaults(scene, state)
        self._nodes: list[InProcessNode] = []
        self.images = {
            each.image_topic: each for each in world.interfaces if isinstance(each, ImagePublisher)
        }
        """What publishes images, by topic."""

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

    def open(self) -> None:
        """Run the tail of step 0: first samples, first messages."""
        self._tail()

    def advance(self) -> None:
        """Take one step."""
        self.bus.step += 1
        self.world.apply_commands()
        self._drift()
        self._push()
        self._sway()
        self.world.touch.look(self.step)
        self._tail()
        for look in self._watchers:
            look()

    def watch(self, look: Callable[[], None]) -> None:
        """Have ``look`` called at the end of every step."""
        self._watchers.append(look)

    @property
    def motion(self) -> Motion:
        """Where everything is and how it moves, as numbers."""
        return self.world.state.motion

    def _tail(self) -> None:
        bus = self.bus
        for images in self.images.values():
            images.tick(bus.step)
        self.world.tick()
        bus.deliver()
        for node in self._nodes:
            node.tick()
        bus.deliver()

    def _drift(self) -> None:
        """Carry kinematic vehicles with the water, as the original does."""
        world = self.world
        if world.water.is_still:
            return
        for index, vehicle in self._drifting:
            here = world.state.vehicle_pose(index)
            moved = world.water.carried(here, self.time, self.timestep, vehicle.name)
            world.state.place_vehicle(index, moved)

    def _push(self) -> None:
        """Let the forces act on what is simulated, in the water as it moves now."""
        state, water = self.world.state, self.world.water
        if not state.is_dynamic:
            state.fall()
            return
        middle = self.time - 0.5 * self.timestep  # of the step, where forces act
        motion = water.at(state.wet_positions(), middle, self._wet_names)
        self._thruster_faults.apply(self.time - self.timestep)
        state.step(*motion)

    def _sway(self) -> None:
        for index, vehicle in self._swaying:
            localized_from_base = vehicle.localized_from_base_at(self.time)
            world_from_base = self.world.world_from_localized @ localized_from_base
            self.world.state.place_vehicle(index, world_from_base)

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
            timestep=self.timestep,
            random=self.world.stream("algorithm"),
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
        self.world.scenery.close()


def _shown(found: object) -> str:
    """``a str: 'scene.xml'``, cut where it is long."""
    text = repr(found)
    return f"a {type(found).__name__}: {text if len(text) <= 60 else text[:57] + '...'}"
