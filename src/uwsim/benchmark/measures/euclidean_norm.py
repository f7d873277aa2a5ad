r"""Euclidean norm: how far the algorithm's estimate is from the truth.

.. code-block:: xml

    <euclideanNorm u:value="mean" u:truth="face">
      <name>corners</name>
      <groundTruth type="cornersFromCamera">
        <camera>bowtech1</camera> <target>blackbox</target> <publishOn>autoInit</publishOn>
      </groundTruth>
      <target>cornersTopic</target>
      <log>0.1</log>
    </euclideanNorm>
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from ...dialect import element
from ...geometry import Array
from ...messages import Float32MultiArray, GTpublish
from ...world import World
from ..ground_truth import GroundTruth, GroundTruthSpec
from .measure import Measure, MeasureSpec
from .signal import VALUES, Signal

PATIENCE = 1.0
"""An estimate older than this is never scored [s]."""


@dataclass(frozen=True, kw_only=True)
class EuclideanNormSpec(MeasureSpec):
    """A ``<euclideanNorm>`` element of a benchmark file."""

    values: ClassVar[tuple[str, ...]] = VALUES

    ground_truth: GroundTruthSpec
    """What the estimate should be."""
    target: str
    """Topic of the estimate (std_msgs/Float32MultiArray)."""
    truth: Literal["original", "face"] = element(
        default="original", attribute=True, namespaced=True
    )
    """``original``, or ``face``: corners and centre of the target's top face (``u:truth``)."""

    def faults(self) -> Sequence[str]:
        """A face is the true one of a camera's picture only."""
        if self.truth == "original" or self.ground_truth.camera is not None:
            return ()
        return (
            "u:truth='face' needs a ground truth of type cornersFromCamera or centroidFromCamera",
        )

    def bind(self, world: World) -> EuclideanNorm:
        """Listen to the estimate; raises UnknownName if a body of the truth is not there."""
        return EuclideanNorm(self, world, self.ground_truth.bind(world, self.truth))


class EuclideanNorm(Measure):
    r"""Distance between truth :math:`g` and estimate :math:`e`.

    .. math:: \lVert g - e \rVert = \sqrt{\sum_i (g_i - e_i)^2}

    One sample for each step at which a new estimate arrived, against the truth at that step; the
    components are :math:`g_i - e_i`. There is no value when there was no sample, or when no
    estimate came for more than 1 s while the measure was on: an old estimate is never scored. At
    the start, what arrived before is forgotten and ``publishOn`` is given the truth.

    Compatibility ``last-norm`` lets the last norm stand, however old it is, as the original does;
    where its log has no new estimate, the components are 0 beside it.
    """

    unit = "1"
    fed_by_algorithm = True

    def __init__(self, spec: EuclideanNormSpec, world: World, truth: GroundTruth) -> None:
        self.unit = spec.ground_truth.unit  # type: ignore[misc]  # depends on what is compared
        self._world, self._truth = world, truth
        self._topic, self._which = spec.target, spec.value
        self._publish_on = spec.ground_truth.publish_on
        self._last_norm_stands = "last-norm" in world.compatibility
        self._inbox = world.inbox(spec.target, Float32MultiArray)
        self._signal = Signal(truth.components)
        self._is_new = False  # whether there was a sample at this step
        self._refused = ""  # why the newest estimate was not scored
        self._notes: list[str] = []
        self._waits_since: int | None = None  # step of the last good estimate, or of the start
        self._silence = (0, 0)  # the longest: its length [steps], the step at which it began

    def start(self) -> None:
        """Forget old estimates and hand out the truth where the file says so."""
        self._inbox.clear()
        self._waits_since = self._world.step
        if self._publish_on is not None:
            self._publish(self._publish_on)

    def update(self) -> None:
        """Score the newest estimate, if one arrived."""
        messages = self._inbox.take()
        n_before = self._signal.n
        if messages:
            self._score(np.asarray(messages[-1].data, dtype=np.float64))
        if self._waits_since is not None:
            waited = self._world.step - self._waits_since
            if waited > self._silence[0]:
                self._silence = (waited, self._waits_since)
        self._is_new = self._signal.n > n_before

    @property
    def value(self) -> float | None:
        """The last norm, or the statistic that ``u:value`` asks for."""
        return None if self.why else self._signal.value(self._which)

    @property
    def why(self) -> str | None:
        """Why there is no value."""
        if self._waits_since is None:
            return "it was never on"
        is_silent = self.longest_silence > PATIENCE and not self._last_norm_stands
        if self._signal.n and not is_silent:
            return None
        if self._refused:
            return self._refused
        if not self._signal.n:
            return f"no estimate on {self._topic!r}"
        began = self._silence[1] * self._world.timestep  # [s]
        return f"no estimate on {self._topic!r} for {self.longest_silence:g} s from {began:g} s on"

    @property
    def details(self) -> dict[str, float | None]:
        """The statistics of the norm and of each component."""
        return self._signal.details

    @property
    def log_header(self) -> tuple[str, ...]:
        """The norm, then each component."""
        return ("total", *self._signal.components)

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The newest sample."""
        if self._last_norm_stands and self._signal.n and not self._is_new:
            return (self._signal.last[0], *(0.0,) * len(self._signal.components))
        return self._signal.last

    @property
    def notes(self) -> tuple[str, ...]:
        """What became of ``publishOn``, if it could not be called."""
        return tuple(self._notes)

    @property
    def longest_silence(self) -> float:
        """Longest time without an estimate of the right length while it was on [s]."""
        return self._silence[0] * self._world.timestep

    @property
    def ground_truth(self) -> Array | None:
        """The truth now."""
        return self._truth.read()

    @property
    def estimate(self) -> Array | None:
        """The newest estimate, whether it could be scored or not."""
        last = self._inbox.last
        return None if last is None else np.asarray(last.data, dtype=np.float64)

    def close(self) -> None:
        """Listen no more."""
        self._inbox.close()

    def _score(self, estimate: Array) -> None:
        truth = self._truth.read()
        length = len(self._truth.components)
        if estimate.shape != (length,):
            self._refused = (
                f"the estimate on {self._topic!r} has {estimate.size} numbers, expected {length}"
            )
        elif not np.isfinite(estimate).all():
            self._refused = f"the estimate on {self._topic!r} is not finite"
        else:
            self._waits_since = self._world.step
            self._refused = "" if truth is not None else f"no truth: {self._truth.missing}"
            if truth is not None:
                error = truth - estimate
                self._signal.add(float(np.sqrt(error @ error)), error.tolist())

    def _publish(self, service: str) -> None:
        truth = self._truth.read()
        if not self._world.serves(service):
            self._notes.append(f"{service!r} was not called: nobody serves it")
        elif truth is None:
            self._notes.append(f"{service!r} was not called: {self._truth.missing}")
        else:
            self._world.call(service, GTpublish(truth.astype(np.float32)))
