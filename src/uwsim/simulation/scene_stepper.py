"""The sequence of a step of a simulation.

.. code-block:: text

    apply_commands -> step_devices -> drift_kinematic_vehicles -> forces -> step_physics -> animate
      -> update_contacts -> publish: samples that are due (images first), messages on the bus,
         algorithms' callbacks -> step callbacks

Time is an integer count of steps. `publish` also runs once at step 0, when a simulation is started.
Several steps are taken at once, in compiled code, if no Python code is due between them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from ..network import nanoseconds
from .forces import engine_wrenches
from .live_scene import LiveScene
from .nodes.node import InProcessNode

MAX_STEPS_AT_ONCE = 1000
"""The maximum number of steps taken at once, after which Ctrl-C takes effect."""


class SceneStepper:
    """The object that takes the steps of a simulation.

    Args:
        world: the parts of the running scene.
        nodes: the nodes of the attached algorithms; the list may grow.
        step_callbacks: the functions called at the end of every step; the list may grow.
    """

    def __init__(
        self,
        world: LiveScene,
        nodes: Sequence[InProcessNode],
        step_callbacks: Sequence[Callable[[], None]],
    ) -> None:
        self._nodes, self._step_callbacks = nodes, step_callbacks
        self._bus, self._timestep = world.bus, world.model.timestep
        self._engine, self._water, self._schedule = world.engine, world.water, world.schedule
        self._devices, self._contacts = world.devices, world.contacts
        self._forces = tuple(zip(world.model.scene.forces, world.forces, strict=True))
        self._network, self._below_ground = world.network, world.below_ground
        self._image_timers = [images.timer for images in world.images.values()]
        vehicles, engine = world.model.scene.vehicles, world.engine
        kinematic_indices = [i for i in range(len(vehicles)) if not engine.has_dynamics(i)]
        self._kinematic_vehicles = [world.vehicles[i] for i in kinematic_indices]
        self._kinematic_names = tuple(vehicle.name for vehicle in self._kinematic_vehicles)
        self._submerged_names = tuple(
            "" if i is None else vehicles[i].name for i in engine.submerged_bodies.vehicles
        )

    @property
    def _step(self) -> int:
        return self._bus.state.step

    @property
    def _time(self) -> float:
        return self._bus.state.step * self._timestep

    def advance(self, n_max: int = 1) -> int:
        """Take one step, or several at once if no Python code is due between them.

        Args:
            n_max: the maximum number of steps.

        Returns:
            The number of steps taken.
        """
        self._bus.state.step += 1
        self._schedule.apply_commands()
        self._step_devices()
        needs_python = self._needs_drift_in_python
        if needs_python:
            self._drift_kinematic_vehicles()
        n, samples_last = (
            self._count_steps_without_python(n_max)
            if n_max > 1 and not needs_python
            else (1, False)
        )
        is_sampled = self._step_physics(
            n, samples_last=samples_last, drifts_vehicles=not needs_python
        )
        self.animate()
        self._contacts.update(self._step)
        self.publish(is_sampled=is_sampled)
        for callback in self._step_callbacks:
            callback()
        return n

    def _count_steps_without_python(self, n_max: int) -> tuple[int, bool]:
        """Return how many steps compiled code can take at once, this step included.

        They end before Python has to handle a command, a sample, a timer or a device. Step
        callbacks, forces, and water that Python computes from positions need Python at every step.
        The second value is True if compiled code can also take the samples after the last step.
        """
        engine, water, now = self._engine, self._water, self._step
        next_delivery = self._bus.next_delivery
        if (
            next_delivery <= now
            or self._step_callbacks
            or self._forces
            or self._contacts.has_overlaps
            or not engine.is_dynamic
            or engine.needs_single_steps
            or water.needs_positions(self._submerged_names)
        ):
            return 1, False
        python_due, preparation_due = self._schedule.due_steps(now + n_max - 1)
        due_steps = [next_delivery, python_due if self._network.is_idle else now]
        due_steps += [timer.due for timer in self._image_timers]
        due_steps += [self._below_ground.due, *(node.next_tick for node in self._nodes)]
        start_time = self._time - self._timestep
        idle_times = [math.inf, *(device.idle_until(start_time) for device in self._devices)]
        n_idle_steps = (min(idle_times) - start_time) // self._timestep - 1
        n = int(min(n_max, MAX_STEPS_AT_ONCE, min(due_steps) - now + 1, n_idle_steps))
        return (n, now + n <= preparation_due) if n > 1 else (1, False)

    def publish(self, *, is_sampled: bool = False) -> None:
        """Take samples that are due, deliver messages and call algorithms.

        Args:
            is_sampled: True if compiled code has already taken the samples of this step.
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
        time = self._time - self._timestep
        for device in self._devices:
            device.step(time)

    @property
    def _needs_drift_in_python(self) -> bool:
        """True if Python, not compiled code, has to move kinematic vehicles before each step."""
        engine, water = self._engine, self._water
        if not self._kinematic_vehicles or water.is_still:
            return False
        return (
            not engine.is_dynamic
            or engine.needs_single_steps  # a held object has to follow a vehicle that has drifted
            or bool(self._forces)
            or any(
                v.state.prescribed_motion.part is not None for v in self._kinematic_vehicles
            )  # recorded
            or water.drift_function(self._kinematic_names, self._timestep, self._time) is None
        )

    def _drift_kinematic_vehicles(self) -> None:
        """Move kinematic vehicles with the water, as the original UWSim does."""
        engine, water, timestep, now = self._engine, self._water, self._timestep, self._time
        drift = water.drift_function(self._kinematic_names, timestep, now)
        if drift is not None:
            engine.drift(drift, now)
        for vehicle in self._kinematic_vehicles:
            if drift is None:
                world_from_base = water.drifted_pose(
                    vehicle.world_from_base, now, timestep, vehicle.name
                )
                engine.place_vehicle(vehicle.index, world_from_base)
            if (motion := vehicle.state.prescribed_motion.part) is not None:
                motion.record_drift(self._step)

    def _step_physics(self, n: int, *, samples_last: bool, drifts_vehicles: bool) -> bool:
        """Advance the physics by some steps, in the flow of the water at the time of each step.

        Args:
            n: the number of steps.
            samples_last: take the samples that are due after the last step.
            drifts_vehicles: move kinematic vehicles with the water in compiled code.

        Returns:
            True if samples were due after the last step, and were taken.
        """
        engine, water = self._engine, self._water
        if self._forces:
            engine.apply_wrenches(engine_wrenches(self._forces, self._time - self._timestep))
        if not engine.is_dynamic:
            engine.step_original_physics()
            self._below_ground.check(self._step)
            return False
        first_step = self._step
        steps, positions = range(first_step, first_step + n), engine.submerged_bodies.positions
        motion = water.motion_during(positions, steps, self._timestep, self._submerged_names)
        drift = None
        if drifts_vehicles and self._kinematic_vehicles and motion is not None:
            drift = water.drift_function(
                self._kinematic_names, self._timestep, steps[-1] * self._timestep
            )
        n_steps_before = engine.n_steps
        try:
            is_sampled = engine.step(
                n,
                motion,
                self._schedule.table,
                first_step,
                samples_last=samples_last,
                drift=drift,
            )
        finally:
            self._bus.state.step = first_step + max(0, engine.n_steps - n_steps_before - 1)
        self._below_ground.check(self._step)
        return is_sampled

    def animate(self) -> None:
        """Apply the motions that devices animate, such as sway."""
        for device in self._devices:
            device.animate(self._time)
