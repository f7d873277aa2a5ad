r"""Step response: rise time, overshoot, settling time and integrals of an error.

The error :math:`e(t)` is set point less output, a vector in general; t counts from its first
sample, :math:`e_0`, which is the step. Performance indices (Ogata, *Modern Control Engineering*,
3rd ed. 1997, ch. 4; ITAE: Graham and Lathrop, *Trans. AIEE* 72, 1953, 273-288):

.. math::
    \text{ISE} = \int |e|^2 dt \qquad \text{IAE} = \int |e|\, dt \qquad
    \text{ITAE} = \int t\,|e|\, dt

Between samples the error of a body is linear in time, and one from messages is constant. With the
direction of the step, :math:`n = e_0 / |e_0|`, the response is :math:`y = 1 - e \cdot n / |e_0|`,
from 0 to 1 (Ogata, 5th ed. 2010, section 5-3; Franklin, Powell and Emami-Naeini, *Feedback Control
of Dynamic Systems*, 7th ed. 2015, section 3.4):

- *overshoot*: :math:`|e_0| \max(0, \max y - 1)`, also in percent of the step;
- *rise time*: from the first sample with :math:`y \ge 0.1` to the first with :math:`y \ge 0.9`;
- *settling time*: of the first sample from which on :math:`|e| \le b\,|e_0|` to the end, with the
  band b, 2 % unless another is given;
- *steady-state error*: the size of the mean of e over the last tenth of the time.

Overshoot, percentages and band refer to the set point; the books use the final value. Both are
equal without a steady-state error; with one, only the set point shows it.
"""

from __future__ import annotations

from array import array

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import dot, length, product

RISE_RANGE = (0.1, 0.9)
"""The parts of the step between which the rise time is measured [1]."""
STEADY_SHARE = 0.1
"""The share of the time, at its end, that counts as steady [1]."""
INTEGRALS = ("ise", "iae", "itae")
"""The numbers that exist from the first sample on, without a step."""
Shape = tuple[dict[str, float | None], dict[str, str]]
"""Numbers, and the reasons why those are None that are."""
UNITS = {
    "ise": ("m^2 s", "s"),
    "iae": ("m s", "s"),
    "itae": ("m s^2", "s^2"),
    "step": ("m", "1"),
    "overshoot": ("m", "1"),
    "overshoot_percent": ("%", "%"),
    "rise_time": ("s", "s"),
    "settling_time": ("s", "s"),
    "steady_state_error": ("m", "1"),
}
"""The unit of each number for an error in metres, and for one without unit."""


class StepResponse:
    """A sampled error signal; integrals are updated at once, the shape is computed on demand."""

    def __init__(
        self, timestep: float, *, band: float, least_step: float, is_constant: bool
    ) -> None:
        """Create a response without a sample.

        Args:
            timestep: the length of a step of the simulation [s].
            band: the half-width of the settling band, relative to the step [1].
            least_step: the greatest first error that is no step.
            is_constant: the error is constant between samples; otherwise it is linear in time.
        """
        self._timestep = timestep
        self._band, self._least_step, self._is_constant = band, least_step, is_constant
        self._steps = array("q")  # of each sample, since the first
        self._errors = array("d")  # the samples in sequence
        self._last_error: Array = np.zeros(0)
        self._size = 0.0  # of the last error
        self.ise, self.iae, self.itae = 0.0, 0.0, 0.0
        """The integrals so far."""
        self._cached_shape: tuple[int, Shape] | None = (
            None  # the number of samples, and their shape
        )

    @property
    def n(self) -> int:
        """The number of samples."""
        return len(self._steps)

    @property
    def size(self) -> float | None:
        """The magnitude of the newest error."""
        return self._size if self._steps else None

    def add(self, error: Array, steps: int) -> None:
        """Add a sample (k,) a number of measured steps after the last; 0 for the first."""
        last_size, last_error = self._size, self._last_error
        size = length(error)
        last_step = self._steps[-1] if self._steps else 0
        self._steps.append(last_step + steps)
        self._errors.extend(error.tolist())
        self._last_error, self._size = error, size
        if steps == 0:
            return
        start, end = last_step * self._timestep, (last_step + steps) * self._timestep
        dt = steps * self._timestep
        if self._is_constant:
            self.ise += last_size * last_size * dt
            self.iae += last_size * dt
            self.itae += last_size * 0.5 * (start + end) * dt
        else:
            self.ise += (last_size * last_size + dot(last_error, error) + size * size) * dt / 3.0
            self.iae += 0.5 * (last_size + size) * dt
            self.itae += 0.5 * (start * last_size + end * size) * dt

    def shape(self) -> Shape:
        """Return the numbers of the response, and the reasons why some are None."""
        if self._cached_shape is None or self._cached_shape[0] != self.n:
            self._cached_shape = (self.n, self._compute_shape())
        return self._cached_shape[1]

    def _compute_shape(self) -> Shape:
        values: dict[str, float | None] = dict.fromkeys(
            ("step", "overshoot", "overshoot_percent", "rise_time", "settling_time",
             "steady_state_error")
        )  # fmt: skip
        if not self._steps:
            return values, {}
        times = np.array(self._steps) * self._timestep  # (n,) [s]
        errors = np.array(self._errors).reshape(len(times), -1)  # (n, k)
        step = length(errors[0])
        tail = errors[times >= (1.0 - STEADY_SHARE) * times[-1]].mean(axis=0)
        values["step"] = step
        values["steady_state_error"] = length(tail)
        if step <= self._least_step:
            reason = f"no step: the error was {step:.3g} at the start"
            return values, dict.fromkeys((name for name in values if values[name] is None), reason)
        reasons: dict[str, str] = {}
        response = 1.0 - product(errors, errors[0] / step) / step
        values["overshoot"] = max(0.0, float(response.max()) - 1.0) * step
        values["overshoot_percent"] = max(0.0, float(response.max()) - 1.0) * 100.0
        low, high = RISE_RANGE
        if response.max() >= high:
            values["rise_time"] = float(times[response >= high][0] - times[response >= low][0])
        else:
            reasons["rise_time"] = f"never rose to {high:.0%} of the step"
        indices_outside = np.flatnonzero(np.linalg.norm(errors, axis=1) > self._band * step)
        settling_index = int(indices_outside[-1]) + 1 if len(indices_outside) else 0
        if settling_index < len(times):
            values["settling_time"] = float(times[settling_index])
        else:
            reasons["settling_time"] = f"not within {self._band:.3g} of the step at the end"
        return values, reasons
