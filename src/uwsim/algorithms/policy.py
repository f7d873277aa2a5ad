"""Policies: algorithms that are functions of the observation of a benchmark's environment.

A benchmark with ``<u:environment>`` publishes its observations on ``observation`` and takes actions
from ``action``. A class whose objects are functions of an observation is thus an algorithm:

.. code-block:: python

    class Policy:
        def __call__(self, observation):   # (n,) -> (m,), numbers from -1 to 1
            return -0.5 * observation[:8]

The parts of an observation are the dimensions of the message, whose labels are their names. A class
with an attribute ``layout`` receives them there: a dictionary of slices by name.

If several vehicles have policies, each has an object of the class, and topics of its own,
``VEHICLE/observation`` and ``VEHICLE/action``. An attribute ``agent`` receives the vehicle's name.

If the environment observes images, the observation is that of `uwsim.envs.BenchmarkEnv`: a
dictionary with ``state`` and the images, or a single image. Their topics are ``observation/NAME``.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any, Protocol, cast

import numpy as np
import numpy.typing as npt

from ..bus import Algorithm, Node
from ..errors import BadMessage, UnknownName, short_repr
from ..messages import Empty, Float64MultiArray, Image, MultiArrayLayout, array_of
from ..messages.observation import join_parts

OBSERVATION, ACTION, START_SERVICE = "observation", "action", "startBench"
"""The topics of a policy, and the service that starts some benchmarks."""
AGENTS = "agents"
"""The parameter with the names of the vehicles that have policies, if there are several."""
IMAGES = "images"
"""The parameter of a policy that has the topics of the observed images, separated by blanks."""


class Policy(Protocol):
    """A function from an observation to an action."""

    def __call__(self, observation: Any, /) -> npt.ArrayLike:
        """Return the action for an observation: numbers from -1 to 1, (m,)."""


class PolicyNode:
    """An algorithm that applies a policy to each observation.

    Args:
        make_policy: the function that makes the policy of a vehicle.
    """

    def __init__(self, make_policy: Callable[[], Policy]) -> None:
        self._make_policy = make_policy
        self._first_policy = make_policy()  # an error of it is one of the algorithm's constructor

    def start(self, node: Node) -> None:
        """Subscribe to the observations of each vehicle, and start the benchmark."""
        agents = str(node.parameters.get(AGENTS, "")).split()
        images = str(node.parameters.get(IMAGES, "")).split()
        for i, agent in enumerate(agents or [""]):
            policy = self._first_policy if i == 0 else self._make_policy()
            if agent and hasattr(policy, "agent"):
                policy.agent = agent
            prefix = f"{agent}/" if agent else ""
            loop = _PolicyLoop(policy, node.publisher(prefix + ACTION, Float64MultiArray))
            for topic in images:
                name = topic.removeprefix(f"{prefix}{OBSERVATION}/")
                if name != topic:
                    node.subscribe(topic, Image, partial(loop.on_image, name))
            node.subscribe(prefix + OBSERVATION, Float64MultiArray, loop.on_observation)
        with suppress(UnknownName):
            node.call(START_SERVICE, Empty())


class _PolicyLoop:
    """The policy of one vehicle."""

    def __init__(self, policy: Policy, publish: Callable[[Float64MultiArray], None]) -> None:
        self._policy, self._publish = policy, publish
        self._layout: dict[str, slice] = {}
        self._images: dict[str, npt.NDArray[Any]] = {}

    def on_image(self, name: str, message: Image) -> None:
        self._images[name] = array_of(message).copy()

    def on_observation(self, message: Float64MultiArray) -> None:
        if not self._layout:
            self._layout = slices_of(message)
            if hasattr(self._policy, "layout"):
                self._policy.layout = self._layout
        state = message.data.copy() if message.data.size else None
        action = self._policy(join_parts(state, self._images))
        try:
            data = np.asarray(action, dtype=np.float64).reshape(-1)
        except (TypeError, ValueError):
            raise BadMessage(
                f"The policy returned {short_repr(action)}; expected an array of numbers from -1 "
                "to 1."
            ) from None
        layout = MultiArrayLayout(dim=[], data_offset=0)
        self._publish(Float64MultiArray(layout=layout, data=data))


def slices_of(message: Float64MultiArray) -> dict[str, slice]:
    """Return the part of each labelled dimension of an observation."""
    slices, start = {}, 0
    for dimension in message.layout.dim:
        slices[dimension.label] = slice(start, start + dimension.size)
        start += dimension.size
    return slices


def is_policy(value: object) -> bool:
    """Return whether a class makes policies: it has ``__call__``, and no ``start(node)``."""
    return (
        isinstance(value, type)
        and any("__call__" in vars(cls) for cls in value.__mro__ if cls is not object)
        and not hasattr(value, "start")
    )


def make_algorithm_of(cls: type[Any]) -> Algorithm:
    """Make the algorithm of a class: an object of it, or a node for the policy that it makes."""
    return PolicyNode(cls) if is_policy(cls) else cast("Algorithm", cls())
