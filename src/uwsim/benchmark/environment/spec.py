"""The elements of ``<u:environment>``.

.. code-block:: xml

    <u:environment>
      <vehicle>bluerov2</vehicle> <reference>offset</reference> <period>0.05</period>
      <observation>positionError heading gravity linearVelocity angularVelocity</observation>
      <relativePose> <name>dock</name> <from>bluerov2</from> <to>dock</to> </relativePose>
      <contact> <name>touched</name> <target>bluerov2</target> <other>dock</other> </contact>
      <topicField> <topic>/bluerov2/dvl</topic> <field>velocity</field> </topicField>
      <image> <sensor>camera</sensor> <width>128</width> <height>96</height> </image>
      <action> <topic>/bluerov2/thrusters</topic> </action>
      <reward>exp(-offset) - 0.01*effort</reward>
      <success>offset &lt; 0.1</success>
      <episodeLevels> <name>current</name> <values>0 0.1 0.2 0.3</values> </episodeLevels>
    </u:environment>
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...base.expression import ScoreError, parse
from ...base.external_values import MAX_COMMAND
from ...errors import did_you_mean
from ...messages.observation import STATE
from ...schema import Numbers, Spec, element
from ...world import ImageContent
from ..measures import MeasureSpec, PathFollowingSpec, PositionErrorSpec, TrackingErrorSpec
from ..metrics.held_commands import TWIST_UNITS, WRENCH_UNITS
from ..reference_trajectory import TrajectorySpec
from .channels import CHANNELS, PATH_CHANNELS, REFERENCE_CHANNELS
from .episode_levels import EpisodeLevelsSpec
from .relations import ContactSpec, RelativePoseSpec
from .reward import PATH_SPEED, REWARD_NAMES

AXES = (*TWIST_UNITS, *WRENCH_UNITS)
"""The axes of commands by twists and wrenches."""
MAX_PERIOD = 60.0
"""The greatest time between two actions [s]."""
MAX_SIZE = 4096
"""The greatest number of numbers of an array in a message."""


@dataclass(frozen=True, kw_only=True)
class TopicFieldSpec(Spec):
    """A ``<topicField>`` element: numbers of the newest message on a topic."""

    topic: str
    """The name of the topic."""
    field: str
    """The field of the message, such as ``twist.twist.linear`` or ``range``; all numbers of a field
    with fields of its own."""
    size: int = element(default=1, minimum=1, maximum=MAX_SIZE)
    """The number of numbers, if the field is an array."""


@dataclass(frozen=True, kw_only=True)
class ImageSpec(Spec):
    """An ``<image>`` element: the image of a camera or a sonar at the time of the observation.

    It has the noise of the sensor, and does not depend on the rate of the sensor's topics: the n-th
    observed image has the noise of the n-th image on a topic. The faults of a sensor are not in it.
    """

    sensor: str
    """The name of the camera, the depth camera or the sonar."""
    content: ImageContent = "image"
    """The sensor's own image (``image``), the ``grey`` values of a colour camera, or the ``depth``
    along the optical axis of a camera [m]; no surface: the distance of the far plane."""
    width: int | None = element(default=None, minimum=1, maximum=MAX_SIZE)
    """The width at which a camera is rendered; by default its own [px]."""
    height: int | None = element(default=None, minimum=1, maximum=MAX_SIZE)
    """The height at which a camera is rendered; by default its own [px]."""

    @property
    def name(self) -> str:
        """The name of the image in observations: that of the sensor, with ``_depth`` for depths."""
        return f"{self.sensor}_depth" if self.content == "depth" else self.sensor

    @property
    def size(self) -> tuple[int, int] | None:
        """The width and height [px]; None: those of the sensor."""
        if self.width is None or self.height is None:
            return None
        return self.width, self.height


@dataclass(frozen=True, kw_only=True)
class ActionSpec(Spec):
    """An ``<action>`` element: the commands on a topic.

    Each number of the action is from -1 to 1, and is multiplied by its limit.
    """

    topic: str
    """The topic of the commands (Float64MultiArray, Twist, TwistStamped, Wrench, WrenchStamped or
    JointState)."""
    axes: str = ""
    """The axes of a twist (``vx`` ... ``wz``) or of a wrench (``fx`` ... ``tz``), or the names of
    joints, separated by blanks; absent for thrusters. Other axes are 0."""
    limits: Numbers = element(default=())
    """The command for an action of 1, a number for each axis, or one for all
    [m/s, rad/s, N, N m, rad or 1], above 0; by default 1."""


@dataclass(frozen=True, kw_only=True)
class EnvironmentSpec(Spec):
    """A ``<u:environment>`` element: what a policy observes and commands, and its reward."""

    vehicle: str = element(refers_to="vehicle")
    """The vehicle whose state is observed."""
    period: float = element(default=0.05, exclusive_minimum=0.0, maximum=MAX_PERIOD)
    """The time between two actions [s]."""
    reference: str | None = element(default=None)
    """The measure that has the desired position: a ``<positionError>`` or a
    ``<u:trackingError>``; or the path: a ``<pathFollowing>`` with ``<u:path>``."""
    observation: str = ""
    """The observed quantities of the vehicle's state, separated by blanks, as ``positionError
    heading``; the page environments has a table of them."""
    relative_pose: tuple[RelativePoseSpec, ...] = ()
    """The observed poses of bodies in the frames of others, which follow the state."""
    contact: tuple[ContactSpec, ...] = ()
    """The observed contacts, which follow the poses."""
    topic_field: tuple[TopicFieldSpec, ...] = ()
    """The observed numbers of messages, which follow the contacts."""
    image: tuple[ImageSpec, ...] = ()
    """The observed images."""
    action: tuple[ActionSpec, ...]
    """The commands of which an action consists."""
    reward: str = "0"
    """The reward of a step: an expression of the newest samples of the measures, of the names of
    poses and contacts, and of the names of `uwsim.benchmark.environment.reward`."""
    success: str | None = element(default=None)
    """The criterion of success at the end of an episode: an expression of the values of the
    measures; other than 0 is a success. By default the status ``ok`` is a success."""
    episode_levels: tuple[EpisodeLevelsSpec, ...] = ()
    """The levels from which an episode is drawn, for each swept parameter; by default all."""

    @property
    def channels(self) -> tuple[str, ...]:
        """The names of the observed quantities of the state."""
        return tuple(self.observation.split())

    @property
    def relations(self) -> tuple[RelativePoseSpec | ContactSpec, ...]:
        """The observed relations of bodies, in the order of the observation."""
        return (*self.relative_pose, *self.contact)

    def sample_names(self, measures: Sequence[MeasureSpec]) -> list[str]:
        """Return the names in a reward besides `REWARD_NAMES`.

        They are those of the measures, of their columns, and of the relations; with a path also
        `PATH_SPEED`.
        """
        columns = [f"{spec.name}_{column}" for spec in measures for column in spec.columns]
        relations = [spec.name for spec in self.relations]
        path_names = [] if self.path_measure(measures) is None else [PATH_SPEED]
        return [*(spec.name for spec in measures), *columns, *relations, *path_names]

    def trajectory(self, measures: Sequence[MeasureSpec]) -> TrajectorySpec | None:
        """Return the desired position at each time; None without a reference."""
        for spec in measures:
            if spec.name == self.reference and isinstance(spec, TrackingErrorSpec):
                return spec.trajectory
            if spec.name == self.reference and isinstance(spec, PositionErrorSpec):
                return TrajectorySpec(shape="point", centre=spec.position)
        return None

    def reference_vehicle(self, measures: Sequence[MeasureSpec]) -> str | None:
        """Return the vehicle relative to which the desired position is; None: it is in L."""
        for spec in measures:
            if spec.name == self.reference and isinstance(spec, TrackingErrorSpec):
                return spec.relative_to
        return None

    def path_measure(self, measures: Sequence[MeasureSpec]) -> PathFollowingSpec | None:
        """Return the measure with the path; None if the reference is none."""
        for spec in measures:
            if (
                isinstance(spec, PathFollowingSpec)
                and spec.name == self.reference
                and spec.reference is not None
            ):
                return spec
        return None

    def errors(self, measures: Sequence[MeasureSpec]) -> Iterator[tuple[str, str]]:
        """Yield the errors of the element: the name of a child, and the message.

        Args:
            measures: the measures of the benchmark.
        """
        names = [spec.name for spec in measures]
        for channel in self.channels:
            if channel not in CHANNELS:
                yield (
                    "observation",
                    f"<observation> names {channel[:60]!r}.{did_you_mean(channel, CHANNELS)} "
                    f"Known: {', '.join(CHANNELS)}",
                )
            elif channel in REFERENCE_CHANNELS and self.trajectory(measures) is None:
                yield "observation", f"{channel} in <observation> needs a <reference>"
            elif channel in PATH_CHANNELS and self.path_measure(measures) is None:
                yield (
                    "observation",
                    f"{channel} in <observation> needs a <reference> to a <pathFollowing> with "
                    "<u:path>",
                )
        if not (self.channels or self.topic_field or self.relations or self.image):
            yield (
                "observation",
                "nothing is observed; expected <observation>, <topicField> or <image>",
            )
        yield from self._relation_errors([*names, *REWARD_NAMES])
        yield from self._image_errors()
        if not self.action:
            yield "action", "there is no <action>; expected one at least"
        yield from self._reference_errors(measures)
        yield from self._action_errors()
        for tag, text, valid_names in (
            ("reward", self.reward, [*self.sample_names(measures), *REWARD_NAMES]),
            ("success", self.success or "0", names),
        ):
            try:
                parse(text, valid_names)
            except ScoreError as error:
                yield tag, f"<{tag}>: {error.message} (column {error.column + 1})"

    def _relation_errors(self, other_names: Sequence[str]) -> Iterator[tuple[str, str]]:
        """Yield the errors of the names of poses and contacts."""
        taken_names = set(other_names)
        for spec in self.relations:
            tag = "relativePose" if isinstance(spec, RelativePoseSpec) else "contact"
            if not spec.name.isidentifier() or not spec.name.isascii():
                yield tag, f"<name> is {spec.name[:60]!r}; expected letters, digits and _"
            elif spec.name in taken_names:
                yield (
                    tag,
                    f"<name> is {spec.name[:60]!r}, which is taken; expected another",
                )
            taken_names.add(spec.name)

    def _reference_errors(self, measures: Sequence[MeasureSpec]) -> Iterator[tuple[str, str]]:
        known_names = [
            spec.name
            for spec in measures
            if isinstance(spec, PositionErrorSpec | TrackingErrorSpec)
            or (isinstance(spec, PathFollowingSpec) and spec.reference is not None)
        ]
        if self.reference is not None and self.reference not in known_names:
            yield (
                "reference",
                f"<reference> names {self.reference[:60]!r}, which is no <positionError>, "
                "<u:trackingError> or <pathFollowing> with <u:path>."
                f"{did_you_mean(self.reference, known_names)} "
                f"Known: {', '.join(known_names) or 'none'}",
            )

    def _image_errors(self) -> Iterator[tuple[str, str]]:
        names = [image.name for image in self.image]
        for index, image in enumerate(self.image):
            if image.name == STATE or image.name in names[:index]:
                yield "image", f"two parts of an observation have the name {image.name[:60]!r}"
            if (image.width is None) != (image.height is None):
                yield "image", f"the image of {image.sensor[:60]!r} needs <width> and <height>"

    def _action_errors(self) -> Iterator[tuple[str, str]]:
        topics = [action.topic for action in self.action]
        for i, action in enumerate(self.action):
            if action.topic in topics[:i]:
                yield (
                    "action",
                    f"two actions have the topic {action.topic[:60]!r}, of which the last would "
                    "replace the first; expected one with all axes",
                )
            if not all(0.0 < limit <= MAX_COMMAND for limit in action.limits):
                yield (
                    "action",
                    f"<limits> of {action.topic!r} is {list(action.limits)}; expected numbers "
                    f"above 0, at most {MAX_COMMAND:g}",
                )
            axes = action.axes.split()
            if duplicates := [axis for j, axis in enumerate(axes) if axis in axes[:j]]:
                yield "action", f"<axes> names {duplicates[0][:60]!r} twice; expected once"
            n_axes, n_limits = len(axes), len(action.limits)
            if n_limits > 1 and n_axes and n_limits != n_axes:
                yield (
                    "action",
                    f"<limits> of {action.topic!r} has {n_limits} numbers for {n_axes} axes; "
                    "expected one for each axis, or one for all",
                )
