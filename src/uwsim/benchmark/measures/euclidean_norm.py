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

PATIENCE = 1.0
"""An estimate older than this is never scored [s]."""
COUNTS = ("refused", "frames", "answered")
"""Details of how many there were."""
Sample = tuple[float, list[float]]
"""A norm, and the components under its root."""


@dataclass(frozen=True, kw_only=True)
class EuclideanNormSpec(MeasureSpec):
    """A ``<euclideanNorm>`` element of a benchmark file."""

    values: ClassVar[tuple[str, ...]] = VALUES
    error_flag: ClassVar[int] = 1

    ground_truth: GroundTruthSpec
    """What the estimate should be."""
    target: str
    """Topic of the estimate (std_msgs/Float32MultiArray)."""
    truth: Literal["original", "face"] = element(
        default="original", attribute=True, namespaced=True
    )
    """``original``, or ``face``: corners and centre of the target's top face (``u:truth``)."""

    auto_init: Literal["always", "once"] = element(
        default="always", attribute=True, namespaced=True
    )
    """When ``publishOn`` is called: ``always`` when the measure starts, as the original does, or
    ``once``, until it was called for the first time (``u:autoInit``)."""

    def errors(self) -> Sequence[str]:
        """A face is the true one of a camera's image only; ``once`` needs a service to call."""
        found = []
        if self.truth == "face" and self.ground_truth.camera is None:
            found.append(
                "u:truth='face' needs a ground truth of type cornersFromCamera or "
                "centroidFromCamera"
            )
        if self.auto_init == "once" and self.ground_truth.publish_on is None:
            found.append("u:autoInit='once' needs <publishOn> in <groundTruth>: a service to call")
        return found

    @property
    def once_initialised(self) -> EuclideanNormSpec:
        """The same spec; with ``u:autoInit="once"`` it initialises no algorithm again."""
        if self.auto_init == "always":
            return self
        truth: Any = self.ground_truth
        return dataclasses.replace(self, ground_truth=dataclasses.replace(truth, publish_on=None))

    @property
    def start_value(self) -> float:
        """The original's start value."""
        return -1.0

    def bind(self, world: World) -> EuclideanNorm:
        """Listen to the estimate; raises UnknownName if a body of the truth is not there."""
        return EuclideanNorm(self, world, self.ground_truth.bind(world, self.truth))


class EuclideanNorm(Measure):
    r"""Distance between truth :math:`g` and estimate :math:`e`.

    .. math:: \lVert g - e \rVert = \sqrt{\sum_i (g_i - e_i)^2}

    The last value is that of the newest estimate against the truth at the step at which it arrived;
    the components are :math:`g_i - e_i`. The statistics are over time, not over messages:

    .. math:: \text{mean} = \frac1K \sum_{k=1}^K \lVert g(t_k) - e(t_k) \rVert

    with :math:`t_k` the steps at which the truth's camera took an image while the measure was on
    (every step, where no camera takes images), after what was published at that step arrived, and
    :math:`e(t_k)` the newest estimate by then; before the first one, the first. So every image
    counts once, answered or not, so that publishing more or less often changes nothing.

    There is no value when no estimate came, or none for more than 1 s while the measure was on: an
    old estimate is never scored. What has the wrong length or is not finite is no estimate. At the
    start, what arrived before is forgotten and ``publishOn`` is given the truth.

    Details, besides the statistics: ``n``, how many estimates were published; ``refused``, how many
    messages were no estimates; ``frames``, over how many :math:`t_k` the statistics are;
    ``answered``, the share of these by which a new estimate had arrived since the one before.

    The log has the norm at the newest image, or at the newest estimate if that came later, and
    nothing from 1 s after the last estimate on.

    Compatibility ``last-norm`` keeps the last norm, however old it is, as the original does,
    and reads estimates that come after it went off; where its log has no new estimate, the
    components are 0.
    """

    unit = "1"
    detail_units: ClassVar[Mapping[str, str]] = dict.fromkeys(COUNTS, "1")
    fed_by_algorithm = True

    def __init__(self, spec: EuclideanNormSpec, world: World, truth: GroundTruth) -> None:
        self.unit = spec.ground_truth.unit  # type: ignore[misc]  # depends on what is compared
        self._world, self._truth = world, truth
        self._topic, self._which = spec.target, spec.value
        self._publish_on = spec.ground_truth.publish_on
        self._last_norm_stands = "last-norm" in world.compatibility
        self._inbox = world.bus.inbox(spec.target, Float32MultiArray)
        self._frames = Signal(truth.components)
        self._n_images: int | None = None  # of the truth's camera, at the last look
        self._last: Sample | None = None  # of the newest estimate with a truth, as it arrived
        self._newest: Sample | None = None  # at the newest image or estimate; None without a truth
        self._without: dict[str, int] = {}  # images that have no truth, by the reason
        self._n = self._n_refused = self._n_answered = 0
        self._estimate: Array | None = None  # in force (k,)
        self._unanswered: list[Array] = []  # truths before the first estimate, (k,) each
        self._is_new = False  # whether an estimate arrived at this step
        self._is_answered = False  # ... or since the last image
        self._refused = ""  # why the newest message was not scored
        self._notes: list[str] = []
        self._has_initialised = False
        self._start: Array | None = None  # what publishOn was given last (k,)
        self._n_at_start = 0  # estimates that are exactly that
        self._waits_since: int | None = None  # step of the last estimate, or of the start
        self._silence = (0, 0)  # the longest: its length [steps], the step at which it began

    def start(self) -> None:
        """Discard old estimates and send the truth to ``publishOn`` where the file says so."""
        self._inbox.clear()
        self._estimate, self._newest, self._is_answered = None, None, False
        self._unanswered.clear()
        self._waits_since = self._world.step
        self._n_images = self._truth.n_images
        if self._publish_on is not None:
            self._publish(self._publish_on)

    def update(self) -> None:
        """Take what arrived; and a sample, if there was an image."""
        self._is_new = self._read()
        self._is_answered |= self._is_new
        if self._waits_since is not None:
            waited = self._world.step - self._waits_since
            if waited > self._silence[0]:
                self._silence = (waited, self._waits_since)
        if self._is_due():
            self._take_sample()

    @property
    def value(self) -> float | None:
        """The last norm, or the statistic given by ``u:value``."""
        if self._last_norm_stands and self._waits_since is not None:
            self._read()
        if self.why:
            return None
        if self._which == "last":
            return None if self._last is None else self._last[0]
        return self._frames.value(self._which)

    @property
    def why(self) -> str | None:
        """Why there is no value."""
        if self._waits_since is None:
            return "it was never on"
        if self._last is not None and self.longest_silence <= PATIENCE:
            is_empty = self._which != "last" and not self._frames.n
            return "its camera took no image while the measure was on" if is_empty else None
        if self._refused:
            return self._refused
        if self._last is None:
            return f"no estimate on {self._topic!r}"
        began = self._silence[1] * self._world.timestep  # [s]
        return f"no estimate on {self._topic!r} for {self.longest_silence:g} s from {began:g} s on"

    @property
    def details(self) -> dict[str, float | None]:
        """The statistics of the norm and of each component, and how many there were of what."""
        found = self._frames.details
        found |= {name: float(self._n) for name in found if name.rpartition(".")[2] == "n"}
        frames = self._frames.n
        return {
            **found,
            "refused": float(self._n_refused),
            "frames": float(frames),
            "answered": self._n_answered / frames if frames else None,
        }

    @property
    def reasons(self) -> dict[str, str]:
        """Why no share is known."""
        if self._frames.n:
            return {}
        return {"answered": self.why or "its camera took no image while the measure was on"}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The norm, then each component."""
        return ("total", *self._truth.components)

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """At the newest image, or estimate; none without a truth, or 1 s after the last estimate.

        With the compatibility ``last-norm`` the newest estimate's, however old it is.
        """
        shown = self._last if self._last_norm_stands else self._newest
        if shown is None or (not self._last_norm_stands and self._silence_now > PATIENCE):
            return (None,) * (1 + len(self._truth.components))
        norm, components = shown
        if self._last_norm_stands and not self._is_new:
            return (norm, *(0.0,) * len(components))
        return (norm, *components)

    @property
    def notes(self) -> tuple[str, ...]:
        """What became of ``publishOn``, and whether all estimates are what it was given."""
        return (*self._notes, *self.remarks)

    @property
    def remarks(self) -> tuple[str, ...]:
        """Which images had no truth, and whether all estimates are what ``publishOn`` was given."""
        n = self._frames.n + len(self._unanswered) + sum(self._without.values())  # images
        without = self._without if self.why is None else {}  # else the row says why
        lacking = tuple(
            f"{k} of {n} {self._instants} are not scored: {why}" for why, k in without.items()
        )
        if self._n < 2 or self._n_at_start < self._n:
            return lacking
        return (
            *lacking,
            f"all estimates are exactly the start that {self._publish_on!r} was given: the target "
            "is at rest and the algorithm took no step, or refused each as no better",
        )

    @property
    def _instants(self) -> str:
        """What the statistics are over."""
        return "steps" if self._n_images is None else "images"

    @property
    def has_initialised(self) -> bool:
        """Whether ``publishOn`` was called."""
        return self._has_initialised

    @property
    def longest_silence(self) -> float:
        """Longest time without an estimate while it was on [s]."""
        if self._last_norm_stands and self._last is not None:
            return 0.0
        return self._silence[0] * self._world.timestep

    @property
    def _silence_now(self) -> float:
        """Time since the last estimate, or since the start [s]."""
        since = self._world.step if self._waits_since is None else self._waits_since
        return (self._world.step - since) * self._world.timestep

    @property
    def ground_truth(self) -> Array | None:
        """The truth now."""
        return self._truth.read()

    @property
    def estimate(self) -> Array | None:
        """The newest message, whether it could be scored or not."""
        last = self._inbox.last_message
        return None if last is None else np.asarray(last.data, dtype=np.float64)

    def close(self) -> None:
        """Unsubscribe."""
        self._inbox.close()
        self._truth.close()

    def _read(self) -> bool:
        """Take what arrived; return whether an estimate was among it, which is then in force."""
        messages = self._inbox.take()
        if not messages:
            return False
        good = [e for message in messages if (e := self._accepted(message)) is not None]
        if not good:
            return False
        self._n += len(good)
        if (start := self._start) is not None:
            self._n_at_start += sum(bool((e == start).all()) for e in good)
        self._estimate = good[-1]
        self._waits_since = self._world.step
        truth = self._truth.read()
        self._refused = "" if truth is not None else f"no truth: {self._truth.missing}"
        self._newest = None if truth is None else compared(truth, good[-1])
        self._last = self._newest or self._last
        for before in self._unanswered:
            self._frames.add(*compared(before, good[-1]))
        self._unanswered.clear()
        return True

    def _accepted(self, message: Float32MultiArray) -> Array | None:
        """Return the numbers of an estimate; None for what is none, and remember why."""
        estimate: Array = np.asarray(message.data, dtype=np.float64)
        n = len(self._truth.components)
        if estimate.shape != (n,):
            self._refused = (
                f"the estimate on {self._topic!r} has {estimate.size} numbers, expected {n}"
            )
        elif not np.isfinite(estimate).all():
            self._refused = f"the estimate on {self._topic!r} is not finite"
        else:
            return estimate
        self._n_refused += 1
        return None

    def _is_due(self) -> bool:
        """Whether the camera took an image since the last look; without one, always."""
        before, self._n_images = self._n_images, self._truth.n_images
        return self._n_images is None or self._n_images != before

    def _take_sample(self) -> None:
        """Compare the estimate in force with the truth; keep the truth until there is one."""
        truth = self._truth.read()
        if truth is None:
            why = self._truth.missing
            self._without[why] = self._without.get(why, 0) + 1
            self._newest = None
            return
        self._n_answered += self._is_answered
        self._is_answered = False
        if self._estimate is None:
            self._unanswered.append(truth)
        else:
            self._newest = compared(truth, self._estimate)
            self._frames.add(*self._newest)

    def _publish(self, service: str) -> None:
        truth = self._truth.read()
        if not self._world.bus.services.serves(service):
            self._notes.append(f"{service!r} was not called: it is not offered")
        elif truth is None:
            self._notes.append(f"{service!r} was not called: {self._truth.missing}")
        else:
            given = truth.astype(np.float32)
            self._start = given.astype(np.float64)
            self._world.bus.services.call(service, GTpublish(given))
            self._has_initialised = True


def compared(truth: Array, estimate: Array) -> Sample:
    """Return the norm of the difference, and its components."""
    error = truth - estimate
    return length(error), error.tolist()
