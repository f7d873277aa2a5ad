r"""``position-p`` and ``position-pi``: controllers of position with the true position error.

They read the ``positionError`` e of an environment's observation, in the axes of the vehicle, and
command a velocity through the water, which the vehicle's velocity loops keep:

.. math:: u = K_p e + K_i \int e \, dt, \qquad |u_i| \le u_{max}

In a steady current c, without an integral, the vehicle stays :math:`c / K_p` from its place. The
integral of an axis is held while its command is at the limit. The heading stays as it is: the
commanded turn rates are 0. The velocity of a moving place is not used.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..base.geometry import Array
from .control.controller import StationKeeper
from .control.observation_controller import ObservationController


class PositionPI(ObservationController):
    """A proportional-integral controller of position: no offset in a steady current."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "kp": 0.8,
        "ki": 0.1,
        "limit": 0.6,
        **ObservationController.PARAMETERS,
    }
    """The gains ``kp`` [1/s] and ``ki`` [1/s^2], the speed ``limit`` of an axis [m/s], and the
    topic of the commands."""

    def _read_parameters(self, parameters: Mapping[str, float | str]) -> None:
        super()._read_parameters(parameters)
        gains = {name: float(self._parameters.get(name, 0.0)) for name in ("kp", "ki", "limit")}
        self._law = StationKeeper(**gains, n_axes=3)

    def command(self, parts: Mapping[str, Array], dt: float) -> tuple[Array, float]:
        """Return the commanded velocity and no turn rate; see `ObservationController`."""
        return self._law.step(parts["positionError"], dt), 0.0


class PositionP(PositionPI):
    """A proportional controller of position: a steady current c leaves the offset c/kp."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        name: value for name, value in PositionPI.PARAMETERS.items() if name != "ki"
    }
    """The parameters of `PositionPI` without the integral."""
