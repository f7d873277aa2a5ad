r"""Step response: rise time, overshoot, settling time and integrals of an error.

The error :math:`e(t)` is set point less output, a vector in general; t counts from its first
sample, :math:`e_0`, which is the step. Performance indices (Ogata, *Modern Control Engineering*,
3rd ed. 1997, ch. 4; ITAE: Graham and Lathrop, *Trans. AIEE* 72, 1953, 273-288):

.. math::
    \text{ISE} = \int |e|^2 dt \qquad \text{IAE} = \int |e|\, dt \qquad
    \text{ITAE} = \int t\,|e|\, dt

Between samples a body's error runs straight, one that comes in messages holds. With the direction
of the step, :math:`n = e_0 / |e_0|`, the part of it done is :math:`y = 1 - e \cdot n / |e_0|`,
from 0 to 1 (Ogata, 5th ed. 2010, section 5-3; Franklin, Powell and Emami-Naeini, *Feedback Control
of Dynamic Systems*, 7th ed. 2015, section 3.4):

- *overshoot*: :math:`|e_0| \max(0, \max y - 1)`, also in percent of the step;
- *rise time*: from the first sample with :math:`y \ge 0.1` to the first with :math:`y \ge 0.9`;
- *settling time*: of the first sample from which on :math:`|e| \le b\,|e_0|` to the end, with the
  band b, 2 % unless another is given;
- *steady-state error*: the size of the mean of e over the last tenth of the time.

Overshoot, percentages and band refer to the set point, where the books take the final value: the
same where there is no steady-state error, and honest about it where there is one.
"""

from __future__ import annotations

from array import array

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import dot, length, product

RISE = (0.1, 0.9)
"""Parts of the step between which the rise time runs [1]."""
TAIL = 0.1
"""Share of the time, at its end, that counts as steady [1]."""
INTEGRALS = ("ise", "iae", "itae")
"""Numbers that are there from the first sample on, without a step."""
Shape = tuple[dict[str, float | None], dict[str, str]]
"""Numbers, and why those are None that are."""
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
"""Number -> unit where the error is in metres, and where it has none."""


class StepResponse:
    """A sampled error signal; integrals are updated at once, the shape is computed on demand."""

    def __init__(self, timestep: float, *, band: float, least_step: float, holds: bool) -> None:
        """Begin without a sample.

        Args:
            timestep: length of a step of the simulation [s].
            band: half-width of the settling band, relative to the step [1].
            least_step: a first error up to this is no step.
            holds: whether the error holds between samples; else it runs straight.
        """
        self._timestep = timestep
        self._band, self._least_step, self._holds = band, least_step, holds
        self._steps = array("q")  # since the first sample, of each
        self._errors = array("d")  # one sample behind the other
        self._last: Array = np.zeros(0)
        self._size = 0.0  # of the last error
        self.ise, self.iae, self.itae = 0.0, 0.0, 0.0
        """Integrals so far."""
        self._found: tuple[int, Shape] | None = None  # number of samples, and what they gave

    @property
    def n(self) -> int:
        """How many samples there were."""
        return len(self._steps)

    @property
    def size(self) -> float | None:
        """Of the newest error."""
        return self._size if self._steps else None

    def add(self, error: Array, steps: int) -> None:
        """Take a sample (k,), so many measured steps after the last; 0 for the first."""
        before, last = self._size, self._last
        size = length(error)
        since = self._steps[-1] if self._steps else 0
        self._steps.append(since + steps)
        self._errors.extend(error.tolist())
        self._last, self._size = error, size
        if steps == 0:
            return
        start, end = since * self._timestep, (since + steps) * self._timestep
        seconds = steps * self._timestep
        if self._holds:
            self.ise += before * before * seconds
            self.iae += before * seconds
            self.itae += before * 0.5 * (start + end) * seconds
        else:
            self.ise += (before * before + dot(last, error) + size * size) * seconds / 3.0
            self.iae += 0.5 * (before + size) * seconds
            self.itae += 0.5 * (start * before + end * size) * seconds

    def shape(self) -> Shape:
        """Return the numbers of the response, and why those are None that are."""
        if self._found is None or self._found[0] != self.n:
            self._found = (self.n, self._look())
        return self._found[1]

    def _look(self) -> Shape:
        found: dict[str, float | None] = dict.fromkeys(
            ("step", "overshoot", "overshoot_percent", "rise_time", "settling_time",
             "steady_state_error")
        )  # fmt: skip
        if not self._steps:
            return found, {}
        times = np.array(self._steps) * self._timestep  # (n,) [s]
        errors = np.array(self._errors).reshape(len(times), -1)  # (n, k)
        step = length(errors[0])
        tail = errors[times >= (1.0 - TAIL) * times[-1]].mean(axis=0)
        found["step"] = step
        found["steady_state_error"] = length(tail)
        if step <= self._least_step:
            why = f"no step: the error was {step:.3g} at the start"
            return found, dict.fromkeys((name for name in found if found[name] is None), why)
        reasons: dict[str, str] = {}
        done = 1.0 - product(errors, errors[0] / step) / step
        found["overshoot"] = max(0.0, float(done.max()) - 1.0) * step
        found["overshoot_percent"] = max(0.0, float(done.max()) - 1.0) * 100.0
        least, most = RISE
        if done.max() >= most:
            found["rise_time"] = float(times[done >= most][0] - times[done >= least][0])
        else:
            reasons["rise_time"] = f"never rose to {most:.0%} of the step"
        outside = np.flatnonzero(np.linalg.norm(errors, axis=1) > self._band * step)
        first = int(outside[-1]) + 1 if len(outside) else 0
        if first < len(times):
            found["settling_time"] = float(times[first])
        else:
            reasons["settling_time"] = f"not within {self._band:.3g} of the step at the end"
        return found, reasons
