r"""``formation-pi``, ``formation-p``: each of several vehicles is kept at its desired position.

Each vehicle has its own ``VEHICLE/observation``. With its ``positionError`` e and
``referenceVelocity`` r, in the axes of the vehicle, it gets the velocity through the water

.. math:: u = r + K_p e + K_i \int e \, dt, \qquad |u_i| \le u_{max}

where the part of e is limited, as is its sum with r. The integral takes the place of the current,
which is not measured. The headings stay as they are, and the vehicles know nothing of one another
but their desired positions: collisions are not avoided. ``formation-p`` has no integral.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import ClassVar

import numpy as np

from ...bus import Node
from ...errors import BadSetting
from ...messages import Float64MultiArray, TwistStamped
from ..parametric import ParametricAlgorithm, start_benchmark, velocity_command
from ..policy import AGENTS, OBSERVATION, slices_of
from .controller import StationKeeper

CHANNELS = ("positionError", "referenceVelocity")
"""The parts of each observation that are needed."""


class FormationPI(ParametricAlgorithm):
    """A proportional-integral controller of the positions of several vehicles."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "kp": 0.8,
        "ki": 0.1,
        "limit": 0.6,
        AGENTS: "",
    }
    """The gains ``kp`` [1/s] and ``ki`` [1/s^2], the speed ``limit`` of an axis [m/s], and the
    vehicles, which the benchmark sets."""

    def start(self, node: Node) -> None:
        """Subscribe to the observations of each vehicle, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node, self._limit = node, float(self._parameters["limit"])
        vehicles = str(self._parameters[AGENTS]).split()
        if not vehicles:
            raise BadSetting("The benchmark has less than two <u:environment>; expected several.")
        self._laws = {vehicle: self._make_law() for vehicle in vehicles}
        self._times: dict[str, float] = {}
        self._publishers = {
            vehicle: node.publisher(f"{vehicle}/twist", TwistStamped) for vehicle in vehicles
        }
        for vehicle in vehicles:
            node.subscribe(
                f"{vehicle}/{OBSERVATION}", Float64MultiArray, partial(self._command, vehicle)
            )
        start_benchmark(node)

    def _make_law(self) -> StationKeeper:
        gains = {name: float(self._parameters[name]) for name in ("kp", "ki", "limit")}
        return StationKeeper(**gains, n_axes=3)

    def _command(self, vehicle: str, message: Float64MultiArray) -> None:
        parts = {name: message.data[part] for name, part in slices_of(message).items()}
        for channel in CHANNELS:
            if channel not in parts:
                raise BadSetting(f"The observation of {vehicle!r} has no {channel}.")
        now = self._node.now
        dt = now - self._times.get(vehicle, now)
        self._times[vehicle] = now
        correction = self._laws[vehicle].step(parts["positionError"], dt)
        velocity = np.clip(parts["referenceVelocity"] + correction, -self._limit, self._limit)
        self._publishers[vehicle](velocity_command(velocity, 0.0, time=now))


class FormationP(FormationPI):
    """A proportional controller of the positions of several vehicles."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**FormationPI.PARAMETERS, "ki": 0.0}
    """The parameters of `FormationPI`; the gain ``ki`` is 0."""
