r"""Euclidean norm: the distance between an algorithm's estimate and the ground truth.

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

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length
from ...messages import Float32MultiArray, GTpublish
from ...schema import element
from ...world import World
from ..ground_truth import GroundTruth, GroundTruthSpec
from ..metrics.signal import VALUES, Signal
from .measure import Measure, MeasureSpec

MAX_AGE = 1.0
"""The greatest age of an estimate that is scored [s]."""
DIMENSIONLESS_DETAILS = ("refused", "frames", "answered")
"""The details without unit: two counts and a share."""
Sample = tuple[float, list[float]]
"""The norm of an error, and the components of the error."""


@dataclass(frozen=True, kw_only=True)
class EuclideanNormSpec(MeasureSpec):
    """A ``<euclideanNorm>`` element of a benchmark file."""

    values: ClassVar[tuple[str, ...]] = VALUES
    error_flag: ClassVar[int] = 1

    ground_truth: GroundTruthSpec
    """The ground truth with which the estimate is compared."""
    target: str
    """The topic of the estimate (std_msgs/Float32MultiArray)."""
    truth: Literal["original", "face"] = element(
        default="original", attribute=True, namespaced=True
    )
    """The truth of a target in an image (``u:truth``): ``original`` for the corners and centroid of
    the original UWSim, ``face`` for the corners and centre of the target's top face."""
    auto_init: Literal["always", "once"] = element(
        default="always", attribute=True, namespaced=True
    )
    """The starts of the measure at which it calls ``publishOn`` (``u:autoInit``): ``always``, as in
    the original UWSim, or ``once``, only until the service was called."""

    def errors(self) -> Sequence[str]:
        """Return errors: ``face`` without a camera, or ``once`` without a service to call."""
        errors = []
        if self.truth == "face" and self.ground_truth.camera is None:
            errors.append(
                "u:truth='face' needs a ground truth of type cornersFromCamera or "
                "centroidFromCamera"
            )
        if self.auto_init == "once" and self.ground_truth.publish_on is None:
            errors.append("u:autoInit='once' needs <publishOn> in <groundTruth>: a service to call")
        return errors

    @property
    def spec_once_initialised(self) -> EuclideanNormSpec:
        """The spec itself; with ``u:autoInit="once"`` a copy without the call of ``publishOn``."""
        if self.auto_init == "always":
            return self
        truth: Any = self.ground_truth
        return dataclasses.replace(self, ground_truth=dataclasses.replace(truth, publish_on=None))

    @property
    def start_value(self) -> float:
        """The value that the original UWSim reports before the first estimate."""
        return -1.0

    def bind(self, world: World) -> EuclideanNorm:
        """Subscribe to the estimate; raises UnknownName if a body of the truth is unknown."""
        return EuclideanNorm(self, world, self.ground_truth.bind(world, self.truth))


class EuclideanNorm(Measure):
    r"""The distance between the ground truth :math:`g` and an estimate :math:`e`.

    .. math:: \lVert g - e \rVert = \sqrt{\sum_i (g_i - e_i)^2}

    The value ``last`` compares the newest estimate with the truth at the step at which the estimate
    arrived; the components are :math:`g_i - e_i`. The statistics are over time, not over messages:

    .. math:: \text{mean} = \frac1K \sum_{k=1}^K \lVert g(t_k) - e(t_k) \rVert

    Here :math:`t_k` are the steps at which the truth's camera took an image while the measure was
    active (every step, if no camera takes images), after the messages of that step have arrived.
    :math:`e(t_k)` is the newest estimate at that time; before the first estimate has arrived, it is
    the first estimate. Every image therefore counts once, whether the algorithm answered it with an
    estimate or not, and whatever the rate of the estimates.

    There is no value if there was no estimate, or none for more than 1 s while the measure was
    active: an old estimate is never scored. A message of the wrong length, or with a number that is
    not finite, is no estimate. When the measure starts, it discards earlier messages and calls the
    service ``publishOn`` with the truth.

    Details, besides the statistics: ``n``, the number of estimates; ``refused``, the number of
    invalid messages; ``frames``, the number of steps :math:`t_k` in the statistics; ``answered``,
    the fraction of these steps with a new estimate since the previous such step.

    The log has the norm at the newest image, or at the newest estimate if that arrived later. It
    has no norm while the newest estimate is older than 1 s.

    Compatibility ``last-norm``: as in the original UWSim, the newest estimate is scored at any age,
    and so are estimates that arrive after the measure stopped; at a step without a new estimate the
    components in the log are 0.
    """

    unit = "1"
    detail_units: ClassVar[Mapping[str, str]] = dict.fromkeys(DIMENSIONLESS_DETAILS, "1")
    fed_by_algorithm = True

    def __init__(self, spec: EuclideanNormSpec, world: World, truth: GroundTruth) -> None:
        self.unit = spec.ground_truth.unit  # type: ignore[misc]  # depends on what is compared
        self._world, self._truth = world, truth
        self._topic, self._statistic = spec.target, spec.value
        self._publish_on = spec.ground_truth.publish_on
        self._keeps_last_norm = "last-norm" in world.compatibility
        self._inbox = world.bus.inbox(spec.target, Float32MultiArray)
        self._image_errors = Signal(truth.components)  # the errors at the steps t_k
        self._n_images: int | None = None  # images of the truth's camera at the last update
        # The error of the newest estimate that had a truth, at the step of its arrival.
        self._last_sample: Sample | None = None
        # The error at the newest image or estimate; None if there was no truth.
        self._newest_sample: Sample | None = None
        self._n_without_truth: dict[str, int] = {}  # images without a truth, by the reason
        self._n_estimates = self._n_invalid = self._n_answered = 0
        self._estimate: Array | None = None  # the newest estimate since the start (k,)
        self._waiting_truths: list[Array] = []  # truths before the first estimate, (k,) each
        self._is_new = False  # whether an estimate arrived at this step
        self._is_answered = False  # whether an estimate arrived since the last image
        self._error = ""  # what is wrong with the newest message
        self._notes: list[str] = []
        self._has_initialised = False
        self._start_truth: Array | None = None  # the last truth sent to publishOn (k,)
        self._n_at_start = 0  # estimates that are equal to that truth
        self._wait_start: int | None = None  # step of the last estimate, or of the start
        self._longest_wait = (0, 0)  # longest time without estimate: [steps], step of its start

    def start(self) -> None:
        """Discard old estimates, and call ``publishOn`` with the truth if the file names it."""
        self._inbox.clear()
        self._estimate, self._newest_sample, self._is_answered = None, None, False
        self._waiting_truths.clear()
        self._wait_start = self._world.step
        self._n_images = self._truth.n_images
        if self._publish_on is not None:
            self._publish(self._publish_on)

    def update(self) -> None:
        """Read the received estimates, and take a sample if the camera took an image."""
        self._is_new = self._read()
        self._is_answered |= self._is_new
        if self._wait_start is not None:
            wait = self._world.step - self._wait_start
            if wait > self._longest_wait[0]:
                self._longest_wait = (wait, self._wait_start)
        if self._is_due():
            self._take_sample()

    @property
    def value(self) -> float | None:
        """The last norm, or the statistic given by ``u:value``."""
        if self._keeps_last_norm and self._wait_start is not None:
            self._read()
        if self.missing_reason:
            return None
        if self._statistic == "last":
            return None if self._last_sample is None else self._last_sample[0]
        return self._image_errors.value(self._statistic)

    @property
    def missing_reason(self) -> str | None:
        """The reason why there is no value."""
        if self._wait_start is None:
            return "it was never on"
        if self._last_sample is not None and self.longest_silence <= MAX_AGE:
            is_empty = self._statistic != "last" and not self._image_errors.n
            return "its camera took no image while the measure was on" if is_empty else None
        if self._error:
            return self._error
        if self._last_sample is None:
            return f"no estimate on {self._topic!r}"
        start, silence = self._longest_wait[1] * self._world.timestep, self.longest_silence  # [s]
        return f"no estimate on {self._topic!r} for {silence:g} s from {start:g} s on"

    @property
    def details(self) -> dict[str, float | None]:
        """The statistics of the norm and of each component, and the numbers of messages."""
        values = self._image_errors.details
        values |= {key: float(self._n_estimates) for key in values if key.rpartition(".")[2] == "n"}
        n_frames = self._image_errors.n
        return {
            **values,
            "refused": float(self._n_invalid),
            "frames": float(n_frames),
            "answered": self._n_answered / n_frames if n_frames else None,
        }

    @property
    def reasons(self) -> dict[str, str]:
        """The reason why the fraction of answered images is None."""
        if self._image_errors.n:
            return {}
        return {
            "answered": self.missing_reason or "its camera took no image while the measure was on"
        }

    @property
    def log_header(self) -> tuple[str, ...]:
        """The names of the norm and of the components of the error."""
        return ("total", *self._truth.components)

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The norm and components of the error at the newest image or estimate.

        They are None without a truth, and while the newest estimate is older than 1 s. With the
        compatibility ``last-norm`` they belong to the newest estimate, however old it is.
        """
        sample = self._last_sample if self._keeps_last_norm else self._newest_sample
        if sample is None or (not self._keeps_last_norm and self._present_silence > MAX_AGE):
            return (None,) * (1 + len(self._truth.components))
        norm, components = sample
        if self._keeps_last_norm and not self._is_new:
            return (norm, *(0.0,) * len(components))
        return (norm, *components)

    @property
    def notes(self) -> tuple[str, ...]:
        """The notes on calls of ``publishOn`` that were not possible, and the `remarks`."""
        return (*self._notes, *self.remarks)

    @property
    def remarks(self) -> tuple[str, ...]:
        """The remarks on images without truth, and on estimates that are all the start value.

        The start value is the truth with which ``publishOn`` was called.
        """
        n_images = (
            self._image_errors.n + len(self._waiting_truths) + sum(self._n_without_truth.values())
        )
        # A row without a value states the reason itself.
        counts = self._n_without_truth if self.missing_reason is None else {}
        remarks = tuple(
            f"{n} of {n_images} {self._instants} are not scored: {reason}"
            for reason, n in counts.items()
        )
        if self._n_estimates < 2 or self._n_at_start < self._n_estimates:
            return remarks
        return (
            *remarks,
            f"all estimates are exactly the start that {self._publish_on!r} was given: the target "
            "is at rest and the algorithm took no step, or refused each as no better",
        )

    @property
    def _instants(self) -> str:
        return "steps" if self._n_images is None else "images"

    @property
    def has_initialised(self) -> bool:
        """True if ``publishOn`` was called."""
        return self._has_initialised

    @property
    def longest_silence(self) -> float:
        """The longest time without an estimate while the measure was active [s]."""
        if self._keeps_last_norm and self._last_sample is not None:
            return 0.0
        return self._longest_wait[0] * self._world.timestep

    @property
    def _present_silence(self) -> float:
        """The time since the last estimate, or since the start of the measure [s]."""
        start = self._world.step if self._wait_start is None else self._wait_start
        return (self._world.step - start) * self._world.timestep

    @property
    def ground_truth(self) -> Array | None:
        """The present truth (k,)."""
        return self._truth.read()

    @property
    def estimate(self) -> Array | None:
        """The numbers of the newest message, valid or not."""
        message = self._inbox.last_message
        return None if message is None else np.asarray(message.data, dtype=np.float64)

    def close(self) -> None:
        """Unsubscribe."""
        self._inbox.close()
        self._truth.close()

    def _read(self) -> bool:
        """Read the received messages; return whether a valid estimate was among them."""
        messages = self._inbox.take()
        if not messages:
            return False
        estimates = [e for message in messages if (e := self._read_estimate(message)) is not None]
        if not estimates:
            return False
        self._n_estimates += len(estimates)
        if (start := self._start_truth) is not None:
            self._n_at_start += sum(bool((e == start).all()) for e in estimates)
        self._estimate = estimates[-1]
        self._wait_start = self._world.step
        truth = self._truth.read()
        self._error = "" if truth is not None else f"no truth: {self._truth.absence_reason}"
        self._newest_sample = None if truth is None else compare(truth, estimates[-1])
        self._last_sample = self._newest_sample or self._last_sample
        for waiting_truth in self._waiting_truths:
            self._image_errors.add(*compare(waiting_truth, estimates[-1]))
        self._waiting_truths.clear()
        return True

    def _read_estimate(self, message: Float32MultiArray) -> Array | None:
        """Return the estimate in a message (k,); None, and a stored error, for an invalid one."""
        estimate: Array = np.asarray(message.data, dtype=np.float64)
        n = len(self._truth.components)
        if estimate.shape != (n,):
            self._error = (
                f"the estimate on {self._topic!r} has {estimate.size} numbers, expected {n}"
            )
        elif not np.isfinite(estimate).all():
            self._error = f"the estimate on {self._topic!r} is not finite"
        else:
            return estimate
        self._n_invalid += 1
        return None

    def _is_due(self) -> bool:
        """Return whether the camera took an image since the last call; True without a camera."""
        n_before, self._n_images = self._n_images, self._truth.n_images
        return self._n_images is None or self._n_images != n_before

    def _take_sample(self) -> None:
        """Compare the newest estimate with the truth; before the first one, store the truth."""
        truth = self._truth.read()
        if truth is None:
            reason = self._truth.absence_reason
            self._n_without_truth[reason] = self._n_without_truth.get(reason, 0) + 1
            self._newest_sample = None
            return
        self._n_answered += self._is_answered
        self._is_answered = False
        if self._estimate is None:
            self._waiting_truths.append(truth)
        else:
            self._newest_sample = compare(truth, self._estimate)
            self._image_errors.add(*self._newest_sample)

    def _publish(self, service: str) -> None:
        truth = self._truth.read()
        if not self._world.bus.services.is_offered(service):
            self._notes.append(f"{service!r} was not called: it is not offered")
        elif truth is None:
            self._notes.append(f"{service!r} was not called: {self._truth.absence_reason}")
        else:
            sent_truth = truth.astype(np.float32)
            self._start_truth = sent_truth.astype(np.float64)
            self._world.bus.services.call(service, GTpublish(sent_truth))
            self._has_initialised = True


def compare(truth: Array, estimate: Array) -> Sample:
    """Return the norm and the components of the error, truth minus estimate, (k,) each."""
    error = truth - estimate
    return length(error), error.tolist()
