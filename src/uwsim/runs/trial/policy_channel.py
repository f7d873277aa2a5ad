"""The topics through which a policy observes and acts: ``observation`` and ``action``.

A benchmark with ``<u:environment>`` publishes the vector of observations on ``observation``
(std_msgs/Float64MultiArray, a labelled dimension for each part) every ``<period>``, from step 0
on. Each image is published before it on ``observation/NAME`` (sensor_msgs/Image), if the topic has
a subscriber. The newest message on ``action`` becomes commands before the next step of the
simulation. A policy is thus an algorithm like any other; `uwsim.envs` uses the same object without
messages.

With several ``<u:environment>``, each vehicle has topics of its own, ``VEHICLE/observation`` and
``VEHICLE/action``, and the algorithm's parameter ``agents`` has the names of the vehicles.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...algorithms.policy import ACTION, AGENTS, IMAGES, OBSERVATION
from ...base.geometry import Array
from ...benchmark.environment import Actuator, EnvironmentSpec, Observer, bind_images
from ...benchmark.environment.channels import VehicleState
from ...benchmark.measures import MeasureSpec
from ...benchmark.spec import BenchmarkSpec
from ...errors import BadMessage
from ...messages import (
    Float64MultiArray,
    Image,
    MultiArrayDimension,
    MultiArrayLayout,
    image_of,
)
from ...messages.observation import Observation, join_parts
from ...simulation import Simulation
from ..own_process.facts import AlgorithmFacts


class PolicyChannel:
    """The observations and actions of one vehicle in one trial.

    Args:
        spec: the environment of the vehicle.
        measures: the measures of the benchmark.
        simulation: the simulation of the trial.
        prefix: the beginning of the names of the topics.

    Raises:
        UwsimError: the scene lacks a name in the environment, or cannot execute its actions.
    """

    def __init__(
        self,
        spec: EnvironmentSpec,
        measures: Sequence[MeasureSpec],
        simulation: Simulation,
        *,
        prefix: str = "",
    ) -> None:
        self.spec = spec
        """The environment of the vehicle."""
        self._observation_topic, self._action_topic = prefix + OBSERVATION, prefix + ACTION
        world = simulation.world.measure_view
        self._simulation = simulation
        self.actuator = Actuator(spec, world)
        """The commands of an action."""
        self.observer = Observer(spec, measures, world, self.actuator.size)
        """The reader of observations."""
        self.images = bind_images(spec, world)
        """The observed images by name."""
        self.last_action = np.zeros(self.actuator.size)
        """The last action, (n,); 0 before the first."""
        self.has_acted = False
        """A flag that the first action sets."""
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
        self._publish = simulation.bus.publisher(self._observation_topic, Float64MultiArray)
        self._publish_image = {
            name: simulation.bus.publisher(f"{self._observation_topic}/{name}", Image)
            for name in self.images
        }
        self._unsubscribe = simulation.bus.subscribe(
            self._action_topic, Float64MultiArray, self._receive, check=self._check
        )
        self._stop = simulation.world.schedule.create_timer(1.0 / spec.period, self._observe)

    def take_observation(self) -> Observation:
        """Return the present observation: the vector of numbers, (n,), and images, if it has any.

        Each call takes new images, with new noise.
        """
        self.is_due = False
        state = self.observer.read(self.last_action) if self.observer.size else None
        return join_parts(state, {name: view.read() for name, view in self.images.items()})

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
        self.has_acted = True
        self.actuator.apply(self.last_action)
        self._simulation.bus.deliver()

    def close(self) -> None:
        """End the timer and the subscriptions."""
        self._stop()
        self._unsubscribe()
        self.observer.close()

    def _observe(self) -> None:
        self.is_due = True
        for name, view in self.images.items():
            if self._simulation.bus.has_subscribers(f"{self._observation_topic}/{name}"):
                pixels = view.read()
                self._publish_image[name](image_of(pixels, time=self._simulation.time))
        if self._simulation.bus.has_subscribers(self._observation_topic):
            observation = self.observer.read(self.last_action)
            self._publish(Float64MultiArray(layout=self._layout, data=observation))

    def _check(self, message: Float64MultiArray) -> None:
        data, n = message.data, self.actuator.size
        has_size = data.shape == (n,)
        if not has_size or not np.isfinite(data).all():
            wrong_part = data[~np.isfinite(data)][0] if has_size else f"{data.size} values"
            raise BadMessage(
                f"A message on {self._action_topic!r} has {wrong_part}; expected {n} finite "
                "numbers from -1 to 1 (others are clipped)."
            )

    def _receive(self, message: Float64MultiArray) -> None:
        self.set_action(message.data)


def open_channels(benchmark: BenchmarkSpec, simulation: Simulation) -> tuple[PolicyChannel, ...]:
    """Open the channel of each environment of a benchmark, in the order of the file."""
    agents = agents_of(benchmark)
    return tuple(
        PolicyChannel(
            spec, benchmark.measures, simulation, prefix=f"{spec.vehicle}/" if agents else ""
        )
        for spec in benchmark.environments
    )


def agents_of(benchmark: BenchmarkSpec) -> tuple[str, ...]:
    """Return the vehicles that have policies if there are several; otherwise none.

    Their topics are ``VEHICLE/observation`` and ``VEHICLE/action``.
    """
    vehicles = tuple(spec.vehicle for spec in benchmark.environments)
    return vehicles if len(vehicles) > 1 else ()


def agent_parameters(benchmark: BenchmarkSpec, algorithm: AlgorithmFacts) -> dict[str, str]:
    """Return the parameter ``agents``: the vehicles that have policies, separated by blanks.

    It is empty if there is one vehicle, or if the algorithm has no such parameter.
    """
    agents = agents_of(benchmark)
    names = algorithm.parameter_names
    has_parameter = names is None or AGENTS in names
    return {AGENTS: " ".join(agents)} if agents and has_parameter else {}


def image_parameters(benchmark: BenchmarkSpec, algorithm: AlgorithmFacts) -> dict[str, str]:
    """Return the parameter ``images``: the topics of observed images, separated by blanks.

    It is empty if there are no images, or if the algorithm is no policy.
    """
    agents = agents_of(benchmark)
    topics = [
        f"{spec.vehicle}/{OBSERVATION}/{image.name}" if agents else f"{OBSERVATION}/{image.name}"
        for spec in benchmark.environments
        for image in spec.image
    ]
    return {IMAGES: " ".join(topics)} if topics and algorithm.is_policy else {}
