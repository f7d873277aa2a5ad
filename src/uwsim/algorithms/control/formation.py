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
from contextlib import suppress
from functools import partial
from typing import ClassVar

import numpy as np

from ...bus import Node
from ...errors import BadSetting, UnknownName
from ...messages import Empty, Float64MultiArray, Twist, TwistStamped, Vector3, header
from ..policy import AGENTS, OBSERVATION, START_SERVICE, slices_of
from ..tracker_node import merge_parameters
from .controller import StationKeeper

CHANNELS = ("positionError", "referenceVelocity")
"""The parts of each observation that are needed."""


class FormationPI:
    """A proportional-integral controller of the positions of several vehicles."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "kp": 0.8,
        "ki": 0.1,
        "limit": 0.6,
        AGENTS: "",
    }
    """The gains ``kp`` [1/s] and ``ki`` [1/s^2], the speed ``limit`` of an axis [m/s], and the
    vehicles, which the benchmark sets."""

    def __init__(self) -> None:
        self._parameters: dict[str, float | str] = dict(self.PARAMETERS)

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters in force, after `start`."""
        return dict(self._parameters)

    def start(self, node: Node) -> None:
        """Subscribe to the observations of each vehicle, and start the benchmark."""
        self._parameters = merge_parameters(self.PARAMETERS, node.parameters)
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
        with suppress(UnknownName):
            node.call(START_SERVICE, Empty())

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
        x, y, z = velocity.tolist()
        twist = Twist(linear=Vector3(x=x, y=y, z=z), angular=Vector3(x=0.0, y=0.0, z=0.0))
        self._publishers[vehicle](TwistStamped(header=header(now), twist=twist))


class FormationP(FormationPI):
    """A proportional controller of the positions of several vehicles."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**FormationPI.PARAMETERS, "ki": 0.0}
    """The parameters of `FormationPI`; the gain ``ki`` is 0."""
