r"""Step response: rise time, overshoot, settling time and integrals of an error.

The error :math:`e(t)` is the setpoint minus the output, a vector in general. The time t begins at
the first sample of the error, :math:`e_0`, which is called the step. Performance indices (Ogata,
*Modern Control Engineering*, 3rd ed. 1997, ch. 4; ITAE: Graham and Lathrop, *Trans. AIEE* 72, 1953,
273-288):

.. math::
    \text{ISE} = \int |e|^2 dt \qquad \text{IAE} = \int |e|\, dt \qquad
    \text{ITAE} = \int t\,|e|\, dt

Between two samples, the position error of a body is assumed to be linear in time, and an error from
messages to be constant. With the direction of the step, :math:`n = e_0 / |e_0|`, the response is
:math:`y = 1 - e \cdot n / |e_0|`, which begins at 0 and is 1 at the setpoint (Ogata, 5th ed. 2010,
section 5-3; Franklin, Powell and Emami-Naeini, *Feedback Control of Dynamic Systems*, 7th ed. 2015,
section 3.4):

- *overshoot*: :math:`|e_0| \max(0, \max y - 1)`, also in percent of the step;
- *rise time*: from the first sample with :math:`y \ge 0.1` to the first with :math:`y \ge 0.9`;
- *settling time*: the time of the first sample from which on :math:`|e| \le b\,|e_0|` until the
  end, with the half-width b of the settling band, 2 % by default;
- *steady-state error*: the norm of the mean of e over the last tenth of the time.

Overshoot, percentages and band refer to the setpoint, while the cited books refer to the final
value. The two are equal if there is no steady-state error.
"""

from __future__ import annotations

from array import array

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import dot, length, product

RISE_RANGE = (0.1, 0.9)
"""The values of the response y between which the rise time is measured [1]."""
STEADY_SHARE = 0.1
"""The fraction of the time, at its end, over which the steady-state error is averaged [1]."""
INTEGRALS = ("ise", "iae", "itae")
"""The performance indices, which do not depend on the size of the step."""
Shape = tuple[dict[str, float | None], dict[str, str]]
"""The other quantities by name, and the reason for each that is None."""
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
"""The units of each quantity: for an error in metres, and for an error without unit."""


class StepResponse:
    """The step response of a sampled error.

    The integrals are updated with each sample; the other quantities are computed on demand.
    """

    def __init__(
        self, timestep: float, *, band: float, least_step: float, is_constant: bool
    ) -> None:
        """Create a step response without samples.

        Args:
            timestep: the length of a step of the simulation [s].
            band: the half-width of the settling band, relative to the step [1].
            least_step: the largest first error that is too small to evaluate its response, in the
                unit of the error.
            is_constant: True if the error is constant between samples; False: linear in time.
        """
        self._timestep = timestep
        self._band, self._least_step, self._is_constant = band, least_step, is_constant
        self._steps = array("q")  # simulation step of each sample; 0 is the first
        self._errors = array("d")  # the components of all samples, one sample after the other
        self._last_error: Array = np.zeros(0)  # (k,)
        self._size = 0.0  # norm of the last error
        self.ise, self.iae, self.itae = 0.0, 0.0, 0.0
        """The performance indices so far."""
        self._cached_shape: tuple[int, Shape] | None = None  # number of samples, their shape

    @property
    def n(self) -> int:
        """The number of samples."""
        return len(self._steps)

    @property
    def size(self) -> float | None:
        """The norm of the newest error; None without samples."""
        return self._size if self._steps else None

    def add(self, error: Array, steps: int) -> None:
        """Add a sample of the error.

        Args:
            error: the error, (k,).
            steps: the number of steps since the last sample while the measure was active; 0 for
                the first sample, and for the first one after a pause.
        """
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
        """Return the quantities other than the indices, and the reason for each that is None."""
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
