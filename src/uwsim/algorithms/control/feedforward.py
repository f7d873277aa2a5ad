r"""``feedforward``: station keeping that also opposes the motion of the water in waves.

The velocity loops of a vehicle control its velocity through the water, so without a command it is
carried by waves. With the velocity :math:`\hat u` of the water, the command is

.. math:: u = u_{PI} - g\,\hat u(t + \tau)

The DVL measures the velocity of the water as the difference of its bottom track and its water
track, in the axes of the vehicle. A `WaveObserver` filters it and predicts it by the horizon
:math:`\tau`: the lag of the velocity loops at the peak of the waves, 0.51 s at 5 s, and half of the
0.1 s for which a command is held. The gain g has two factors. The layer of the water track is below
the vehicle, where waves are weaker, and its beams meet different parts of a wave: with the wave
number k, the depth h, the height z of the vehicle and the height :math:`z_d = z - d - e` of a layer
d below a DVL that is e below the vehicle's middle, the measured amplitude is

.. math:: \frac{\cosh k(z_d+h)}{\cosh k(z+h)} \left(1 - k d \tanh k(z_d+h)\right)

times that at the vehicle. Then the velocity loops have a gain of 1.02 at the peak. The defaults are
those of the benchmark ``station-waves``: waves of 5 s in water of 5 m, the vehicle 1.9 m and the
layer 2.8 m deep, d = 1 m. Not modelled: waves of other periods than the peak's in gain and lag.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array
from ...bus import Node
from ...messages import DVL
from .controller import ControllerNode, Law
from .wave_observer import WaveObserver

VALID_STATUS = "A"
"""The status of a valid velocity of a DVL."""


class Feedforward(ControllerNode):
    """A proportional-integral controller with a feed-forward of the water's velocity in waves."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **ControllerNode.PARAMETERS,
        "ki": 0.04,
        "limit": 1.0,
        "period": 5.0,
        "damping": 0.1,
        "horizon": 0.56,
        "gain": 1.18,
        "dvl_topic": "/dvl",
    }
    """The parameters with their defaults: those of ``pi``; the ``period`` of the peak [s] and the
    relative ``damping`` [1] of the waves; the ``horizon`` of the prediction [s]; the ``gain`` [1];
    and the topic of the DVL."""

    def start(self, node: Node) -> None:
        """Start the controller, and observe the water with the DVL."""
        super().start(node)
        self._observer = WaveObserver(
            period=self._number("period"), damping=self._number("damping")
        )
        node.subscribe(str(self.parameters["dvl_topic"]), DVL, self._on_dvl)

    def law(self) -> Law:
        """Make the control law."""
        return _FeedforwardLaw(self, super().law())

    def _on_dvl(self, message: DVL) -> None:
        if message.bs_status == VALID_STATUS and message.ws_status == VALID_STATUS:
            surge = message.bs_longitudinal - message.ws_longitudinal
            sway = message.bs_transverse - message.ws_transverse
            self._observer.update(np.array([surge, sway]), self._node.now)

    def opposing_velocity(self) -> Array:
        """Return the part of the command that opposes the water, surge and sway, (2,) [m/s]."""
        time = self._node.now + self._number("horizon")
        return -self._number("gain") * self._observer.predict(time)


class _FeedforwardLaw:
    def __init__(self, node: Feedforward, feedback: Law) -> None:
        self._node, self._feedback = node, feedback

    def step(self, error: Array, dt: float) -> Array:
        return self._feedback.step(error, dt) + self._node.opposing_velocity()
