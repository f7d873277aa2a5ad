"""The step of a simulation.

.. code-block:: text

    apply_commands -> step_devices -> advect_kinematic -> forces -> step_physics -> animate
      -> update_contacts -> publish: samples that are due (images first), messages on the bus,
         algorithms' callbacks -> observers

Time is an integer count of steps. The tail of the step (sensors and after) also runs once at
step 0, when a simulation is started.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from ..network import nanoseconds
from .forces import engine_wrenches
from .live_scene import LiveScene
from .nodes.node import InProcessNode

MAX_RUN = 1000
"""Steps that are taken at once at most: Ctrl-C is heard after them."""


class SceneStepper:
    """Takes the steps of a simulation.

    Args:
        world: the live parts of the scene.
        nodes: the attached algorithms; more may come.
        watchers: called at the end of every step; more may come.
    """

    def __init__(
        self,
        world: LiveScene,
        nodes: Sequence[InProcessNode],
        watchers: Sequence[Callable[[], None]],
    ) -> None:
        self._nodes, self._watchers = nodes, watchers
        self._bus, self._timestep = world.bus, world.model.timestep
        self._engine, self._water, self._schedule = world.engine, world.water, world.schedule
        self._devices, self._contacts = world.devices, world.contacts
        self._forces = tuple(zip(world.model.scene.forces, world.forces, strict=True))
        self._network, self._below_ground = world.network, world.below_ground
        self._image_timers = [images.timer for images in world.images.values()]
        vehicles, engine = world.model.scene.vehicles, world.engine
        placed = [i for i in range(len(vehicles)) if not engine.is_simulated(i)]
        self._drifting = [world.vehicles[i] for i in placed]
        self._drifting_names = tuple(vehicle.name for vehicle in self._drifting)
        self._wet_names = tuple(
            "" if i is None else vehicles[i].name for i in engine.submerged_bodies.vehicles
        )

    @property
    def _step(self) -> int:
        return self._bus.state.step

    @property
    def _time(self) -> float:
        return self._bus.state.step * self._timestep

    def advance(self, wanted: int = 1) -> int:
        """Take a step, and of those wanted after it all that nothing comes between.

        Returns how many it took.
        """
        self._bus.state.step += 1
        self._schedule.apply_commands()
        self._step_devices()
        drifts_alone = self._drifts_alone
        if drifts_alone:
            self._advect_kinematic()
        n, samples_last = self._plan_run(wanted) if wanted > 1 and not drifts_alone else (1, False)
        is_sampled = self._step_physics(n, samples_last=samples_last, drifts=not drifts_alone)
        self.animate()
        self._contacts.update(self._step)
        self.publish(is_sampled=is_sampled)
        for look in self._watchers:
            look()
        return n

    def _plan_run(self, wanted: int) -> tuple[int, bool]:
        """How many steps from this one on the forces may act alone, of those wanted.

        In the step after them a command, a sample, a timer or a device may be due; observers,
        forces and water that Python computes from where bodies are have to do in every step. The
        second value says whether the samples after the last of them need no preparation.
        """
        engine, water, now = self._engine, self._water, self._step
        delivery = self._bus.next_delivery
        if (
            delivery <= now
            or self._watchers
            or self._forces
            or self._contacts.is_laid
            or not engine.is_dynamic
            or engine.places_bodies
            or water.is_asked_where_bodies_are(self._wet_names)
        ):
            return 1, False
        for_python, unprepared = self._schedule.dues(now + wanted - 1)
        dues = [delivery, for_python if self._network.is_idle else now]
        dues += [timer.due for timer in self._image_timers]
        dues += [self._below_ground.due, *(node.next_tick for node in self._nodes)]
        began = self._time - self._timestep
        rests = [math.inf, *(device.idle_until(began) for device in self._devices)]
        free = (min(rests) - began) // self._timestep - 1
        n = int(min(wanted, MAX_RUN, min(dues) - now + 1, free))
        return (n, now + n <= unprepared) if n > 1 else (1, False)

    def publish(self, *, is_sampled: bool = False) -> None:
        """Take samples that are due, deliver messages and call algorithms.

        Args:
            is_sampled: whether the samples of sensors were taken with the step.
        """
        bus, step = self._bus, self._step
        for timer in self._image_timers:
            timer.tick(step)
        self._network.advance(nanoseconds(self._time))
        self._schedule.tick(step, is_sampled=is_sampled)
        bus.deliver()
        for node in self._nodes:
            node.tick()
        bus.deliver()

    def _step_devices(self) -> None:
        """Let devices act, at the start of the step."""
        time = self._time - self._timestep
        for device in self._devices:
            device.step(time)

    @property
    def _drifts_alone(self) -> bool:
        """Whether vehicles drift that have to be moved before each step, not in compiled ones."""
        engine, water = self._engine, self._water
        if not self._drifting or water.is_still:
            return False
        return (
            not engine.is_dynamic
            or engine.places_bodies  # what is carried is placed beside a vehicle that has drifted
            or bool(self._forces)
            or any(vehicle.state.placed.part is not None for vehicle in self._drifting)  # recorded
            or water.drift(self._drifting_names, self._timestep, self._time) is None
        )

    def _advect_kinematic(self) -> None:
        """Advect kinematic vehicles with the water, as the original does."""
        engine, water, timestep, now = self._engine, self._water, self._timestep, self._time
        drift = water.drift(self._drifting_names, timestep, now)
        if drift is not None:
            engine.drift(drift, now)
        for vehicle in self._drifting:
            if drift is None:
                here = water.carried(vehicle.world_from_base, now, timestep, vehicle.name)
                engine.place_vehicle(vehicle.index, here)
            if (motion := vehicle.state.placed.part) is not None:
                motion.record_drift(self._step)

    def _step_physics(self, n: int, *, samples_last: bool, drifts: bool) -> bool:
        """Advance the physics by some steps, in the flow of the water at their times.

        Args:
            n: how many.
            samples_last: take the samples that are due after the last of them.
            drifts: whether vehicles that are not simulated drift in them.

        Returns:
            Whether samples were due after the last, and taken.
        """
        engine, water = self._engine, self._water
        if self._forces:
            engine.apply_wrenches(engine_wrenches(self._forces, self._time - self._timestep))
        if not engine.is_dynamic:
            engine.step_uwsim_physics()
            self._below_ground.look(self._step)
            return False
        first = self._step
        steps, positions = range(first, first + n), engine.submerged_bodies.positions
        motion = water.during(positions, steps, self._timestep, self._wet_names)
        drift = None
        if drifts and self._drifting and motion is not None:
            drift = water.drift(self._drifting_names, self._timestep, steps[-1] * self._timestep)
        before = engine.n_steps
        try:
            is_sampled = engine.step(
                n,
                motion,
                self._schedule.table,
                first,
                samples_last=samples_last,
                drift=drift,
            )
        finally:
            self._bus.state.step = first + max(0, engine.n_steps - before - 1)
        self._below_ground.look(self._step)
        return is_sampled

    def animate(self) -> None:
        """Move what devices animate."""
        for device in self._devices:
            device.animate(self._time)
