r"""The reward of a step: an expression of the measures' newest samples and of these numbers.

=============  ================================================================================
effort         the mean square of the action :math:`a` [1]
change         the mean square of its change since the last action [1]
speed          the speed over ground [m/s]
turnRate       the magnitude of the angular velocity [rad/s]
tilt           the angle between the base's z axis and its direction at the start [rad]
time           the simulation time [s]
pathSpeed      the speed along the path, if the reference is one [m/s]
=============  ================================================================================

The newest sample of a measure is the first number of its log, and of a ``<pathFollowing>`` the
present distance, whichever statistic ``u:value`` selects. The other numbers of the log of some
measures have names, such as ``success_height`` of a ``<u:grasp>`` with the name ``success``
(`MeasureSpec.columns`). The name of a ``<relativePose>`` is its distance [m], that of a
``<contact>`` is 1 or 0. A step in which a measure of the
expression has no sample, or in which the expression is not finite, has the reward 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...base.expression import parse
from ...base.geometry import Array
from ...base.numerics import elementwise
from ..measures import Measure
from .channels import CHANNELS, VehicleState

REWARD_NAMES = ("effort", "change", "speed", "turnRate", "tilt", "time")
"""The names of a reward besides those of the measures."""
PATH_SPEED = "pathSpeed"
"""The name of the speed along the path, for environments whose reference is a path."""


class RewardFunction:
    """The reward of an environment.

    Args:
        text: the expression.
        names: the names of samples: those of measures, their columns, poses and contacts.
        state: the state at the start of the episode.
    """

    def __init__(self, text: str, names: Sequence[str], state: VehicleState) -> None:
        self._expression = parse(text, [*names, *REWARD_NAMES])
        self.names = frozenset(self._expression.names)
        """The names in the expression."""
        self._up = state.gravity

    def compute(
        self,
        measures: Mapping[str, Measure],
        relations: Mapping[str, float],
        state: VehicleState,
        action: Array,
    ) -> float:
        """Compute the reward of a step.

        Args:
            measures: the active measures by name.
            relations: the distances of poses [m], and contacts, by name.
            state: the state after the step, with the action before this one.
            action: the action of the step.
        """
        values: dict[str, float | None] = {
            name: measure.newest_sample for name, measure in measures.items()
        }
        for name, measure in measures.items():
            if any(text.startswith(f"{name}_") for text in self.names):
                values |= _read_columns(name, measure)
        values |= relations
        numbers = self._state_numbers(state, action)
        values |= {name: float(number) for name, number in numbers.items()}
        for name in self.names:
            values.setdefault(name, None)
        value = self._expression.evaluate(values)
        return 0.0 if value is None else value

    def _state_numbers(self, state: VehicleState, action: Array) -> dict[str, Array]:
        """Return the numbers of the state that the expression uses."""
        change = action - state.last_action
        numbers: dict[str, Array] = {
            "effort": np.mean(action * action, axis=-1),
            "change": np.mean(change * change, axis=-1),
            "speed": magnitude(state.twist[..., :3]),
            "turnRate": magnitude(state.twist[..., 3:]),
            "time": np.asarray(state.time, dtype=np.float64),
        }
        if "tilt" in self.names:
            cosine = np.sum(self._up * state.gravity, axis=-1)
            numbers["tilt"] = elementwise.arccos(np.clip(cosine, -1.0, 1.0))
        if PATH_SPEED in self.names:
            direction = CHANNELS["pathDirection"][1](state)
            numbers[PATH_SPEED] = np.sum(state.twist[..., :3] * direction, axis=-1)
        return {name: number for name, number in numbers.items() if name in self.names}


def magnitude(vector: Array) -> Array:
    """Return the length of a vector, (3,)."""
    result: Array = np.sqrt(np.sum(vector * vector, axis=-1))
    return result


def _read_columns(name: str, measure: Measure) -> dict[str, float | None]:
    """Return the newest sample of each column of a measure by name, the first one excluded."""
    labels = [label.partition(" ")[0] for label in measure.log_header]
    samples = zip(labels, measure.log_values, strict=True)
    return {f"{name}_{label}": value for label, value in samples if label != labels[0]}
