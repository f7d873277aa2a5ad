"""The topics through which a policy observes and acts: ``observation`` and ``action``.

A benchmark with ``<u:environment>`` publishes the vector of observations on ``observation``
(std_msgs/Float64MultiArray, a labelled dimension for each part) every ``<period>``, from step 0
on. The newest message on ``action`` becomes commands before the next step of the simulation. A
policy is thus an algorithm like any other; `uwsim.envs` uses the same object without messages.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.geometry import Array
from ...benchmark.environment import Actuator, EnvironmentSpec, Observer
from ...benchmark.environment.channels import VehicleState
from ...benchmark.measures import MeasureSpec
from ...benchmark.spec import BenchmarkSpec
from ...errors import BadMessage
from ...messages import Float64MultiArray, MultiArrayDimension, MultiArrayLayout
from ...simulation import Simulation

OBSERVATION, ACTION = "observation", "action"
"""The names of the topics."""


class PolicyChannel:
    """The observations and actions of one trial.

    Args:
        spec: the environment of the benchmark.
        measures: the measures of the benchmark.
        simulation: the simulation of the trial.

    Raises:
        UwsimError: the scene lacks a name in the environment, or cannot execute its actions.
    """

    def __init__(
        self, spec: EnvironmentSpec, measures: Sequence[MeasureSpec], simulation: Simulation
    ) -> None:
        world = simulation.world.measure_view
        self._simulation = simulation
        self.actuator = Actuator(spec, world)
        """The commands of an action."""
        self.observer = Observer(spec, measures, world, self.actuator.size)
        """The reader of observations."""
        self.last_action = np.zeros(self.actuator.size)
        """The last action, (n,); 0 before the first."""
        self.is_due = False
        """A flag that is set when an observation is due, until it is taken."""
        self._pending_action: Array | None = None
        self._layout = MultiArrayLayout(
            dim=[
                MultiArrayDimension(label=name, size=size, stride=size)
                for name, size in self.observer.layout
            ],
            data_offset=0,
        )
        self._publish = simulation.bus.publisher(OBSERVATION, Float64MultiArray)
        self._unsubscribe = simulation.bus.subscribe(
            ACTION, Float64MultiArray, self._receive, check=self._check
        )
        self._stop = simulation.world.schedule.create_timer(1.0 / spec.period, self._observe)

    def take_observation(self) -> Array:
        """Return the present observation, (n,)."""
        self.is_due = False
        return self.observer.read(self.last_action)

    def state(self) -> VehicleState:
        """Return the present state of the vehicle."""
        return self.observer.state(self.last_action)

    def set_action(self, action: Array) -> None:
        """Set the action that the next step applies, (n,)."""
        self._pending_action = np.clip(action, -1.0, 1.0)

    def apply(self) -> None:
        """Publish the commands of a new action; the next step of the simulation obeys them."""
        if self._pending_action is None:
            return
        self.last_action, self._pending_action = self._pending_action, None
        self.actuator.apply(self.last_action)
        self._simulation.bus.deliver()

    def close(self) -> None:
        """End the timer and the subscriptions."""
        self._stop()
        self._unsubscribe()
        self.observer.close()

    def _observe(self) -> None:
        self.is_due = True
        if self._simulation.bus.has_subscribers(OBSERVATION):
            observation = self.observer.read(self.last_action)
            self._publish(Float64MultiArray(layout=self._layout, data=observation))

    def _check(self, message: Float64MultiArray) -> None:
        if message.data.shape != (self.actuator.size,) or not np.isfinite(message.data).all():
            raise BadMessage(
                f"A message on {ACTION!r} has {message.data.size} values; expected "
                f"{self.actuator.size} finite numbers from -1 to 1."
            )

    def _receive(self, message: Float64MultiArray) -> None:
        self.set_action(message.data)


def open_channel(benchmark: BenchmarkSpec, simulation: Simulation) -> PolicyChannel | None:
    """Open the channel of a benchmark's environment; return None if it has none."""
    if benchmark.environment is None:
        return None
    return PolicyChannel(benchmark.environment, benchmark.measures, simulation)
