r"""The reward of a step: an expression of the measures' newest samples and of these numbers.

=============  ================================================================================
effort         the mean square of the action :math:`a` [1]
change         the mean square of its change since the last action [1]
speed          the speed over ground [m/s]
turnRate       the magnitude of the angular velocity [rad/s]
tilt           the angle between the base's z axis and its direction at the start [rad]
time           the simulation time [s]
=============  ================================================================================

The newest sample of a measure is the first number of its log: for a ``<positionError>`` the
present distance, whichever statistic ``u:value`` selects. A step in which a measure of the
expression has no sample, or in which the expression is not finite, has the reward 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...base.expression import parse
from ...base.geometry import Array
from ...base.numerics import elementwise
from ...base.numerics.linear import length
from ..measures import Measure
from .channels import VehicleState

REWARD_NAMES = ("effort", "change", "speed", "turnRate", "tilt", "time")
"""The names of a reward besides those of the measures."""


class RewardFunction:
    """The reward of an environment.

    Args:
        text: the expression.
        measures: the names of the measures.
        state: the state at the start of the episode.
    """

    def __init__(self, text: str, measures: Sequence[str], state: VehicleState) -> None:
        self._expression = parse(text, [*measures, *REWARD_NAMES])
        self._names = set(self._expression.names)
        self._up = state.gravity

    def compute(self, measures: Mapping[str, Measure], state: VehicleState, action: Array) -> float:
        """Compute the reward of a step.

        Args:
            measures: the active measures by name.
            state: the state after the step, with the action before this one.
            action: the action of the step.
        """
        values: dict[str, float | None] = {
            name: _newest_sample(measure) for name, measure in measures.items()
        }
        change = action - state.last_action
        values |= {
            "effort": float(np.mean(action * action)),
            "change": float(np.mean(change * change)),
            "speed": length(state.twist[:3]),
            "turnRate": length(state.twist[3:]),
            "time": state.time,
        }
        if "tilt" in self._names:
            cosine = float(np.sum(self._up * state.gravity))
            values["tilt"] = float(elementwise.arccos(min(1.0, max(-1.0, cosine))))
        for name in self._names:
            values.setdefault(name, None)
        value = self._expression.evaluate(values)
        return 0.0 if value is None else value


def _newest_sample(measure: Measure) -> float | None:
    values = measure.log_values
    return values[0] if values else measure.value
