r"""Control: effort and variation of a controller's commands, and the step response of its error.

.. code-block:: xml

    <u:control>
      <name>control</name>
      <topic>/dataNavigator</topic> <axes>vx vy</axes>
      <target>girona500</target> <position> <x>3</x> <y>2</y> <z>1.5</z> </position>
      <band>0.05</band>
      <quantity>settlingTime</quantity>
    </u:control>
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ...base.geometry import Array
from ...base.inbox import Inbox
from ...errors import BadSetting, UnknownName
from ...messages import Float32MultiArray, Float64, Float64MultiArray
from ...schema import element
from ...world import Body, World
from ..metrics.held_commands import FIXED, READERS, Figure, HeldCommands
from ..metrics.step_response import INTEGRALS, UNITS, StepResponse
from .measure import Measure, MeasureSpec

OF_COMMANDS = ("variation", "effort", "max")
"""Quantities that need a topic of commands; the others need an error."""
ERRORS: tuple[type, ...] = (Float64, Float32MultiArray, Float64MultiArray)
"""What an error may come in."""


@dataclass(frozen=True, kw_only=True)
class ControlSpec(MeasureSpec):
    """A ``<u:control>`` element of a benchmark file: commands, an error, or both."""

    topic: str | None = element(default=None)
    """Topic of the commands (Twist, TwistStamped, Wrench, WrenchStamped, Float64MultiArray or
    JointState)."""
    axes: str = ""
    """Axes of the commands that count, separated by blanks; all when left out."""
    target: str | None = element(default=None, refers_to="body")
    """Route of the body whose error counts."""
    position: tuple[float, float, float] | None = None
    """Where the target should be, in L [m]."""
    error_topic: str | None = element(default=None)
    """Topic with the error instead (std_msgs/Float64, Float32MultiArray or
    Float64MultiArray)."""
    band: float = element(default=0.02, above=0.0, below=1.0)
    """Half-width of the settling band, relative to the step [1]."""
    least_step: float = element(default=0.01, minimum=0.0)
    """A first error up to this is no step [m, or the error topic's unit]."""
    quantity: (
        Literal[
            "variation", "effort", "max", "ise", "iae", "itae", "overshoot", "riseTime",
            "settlingTime", "steadyStateError",
        ]
        | None
    ) = element(default=None)  # fmt: skip
    """Which of its details is its value; without: ``variation`` where there is a topic, else
    ``iae``."""

    @property
    def judged(self) -> str:
        """The quantity that is its value."""
        return self.quantity or ("variation" if self.topic is not None else "iae")

    @property
    def has_error(self) -> bool:
        """Whether an error is judged, too."""
        return self.target is not None or self.error_topic is not None

    def errors(self) -> Sequence[str]:
        """Elements that do not go together."""
        found = []
        if self.topic is None and not self.has_error:
            found.append("needs a <topic> of commands, a <target>, or an <errorTopic>")
        if self.target is not None and self.error_topic is not None:
            found.append("<target> and <errorTopic> both give the error; use one")
        if (self.target is None) != (self.position is None):
            found.append("<target> and <position> go together; give both or none")
        if self.axes and self.topic is None:
            found.append("<axes> are those of a <topic>, which is not given")
        if self.quantity in OF_COMMANDS and self.topic is None:
            found.append(f"<quantity> {self.quantity!r} is that of a <topic>, which is not given")
        if self.quantity not in (None, *OF_COMMANDS) and not self.has_error:
            found.append(
                f"<quantity> {self.quantity!r} needs an error: <target> and <position>, "
                "or <errorTopic>"
            )
        return found

    def bind(self, world: World) -> Control:
        """Find body and topics.

        Raises:
            UnknownName: there is no such body, or commands of that type have no such axis.
            BadSetting: a topic is known to carry something else.
        """
        body = None if self.target is None else world.body(self.target)
        commands = errors = None
        if self.topic is not None:
            carried = _check_type(world, self.topic, tuple(READERS))
            for axis in self.axes.split() if carried in FIXED else ():
                if axis not in FIXED[carried]:
                    raise UnknownName("axis", axis, FIXED[carried])
            commands = world.bus.inbox(self.topic, object, latched=True)
        if self.error_topic is not None:
            _check_type(world, self.error_topic, ERRORS)
            errors = world.bus.inbox(self.error_topic, object)
        return Control(self, world, body, commands, errors)


class Control(Measure):
    """Effort and variation of the commands, and the shape of an error over time.

    *Commands.* They are counted as `uwsim.benchmark.metrics.held_commands` describes. A command
    holds until the next. What is in force when the measure goes on counts for effort and largest
    value, not as a change. Details: ``variation``, ``effort`` and ``max`` over all axes that count,
    the same of each axis, and ``n``, the number of messages since the measure went on. Sums over
    axes of different units are sums of bare numbers: choose ``axes``.

    *Error.* Either the body's: ``position`` less where its origin is, in L, at every step; or
    what comes on the error topic, held from message to message. Details: those of
    `uwsim.benchmark.metrics.step_response`. Time counts from the first error.

    What passes while the measure is off does not count. A message that is not finite, or not of
    the kind and size of those before, is ignored, with a note.
    """

    def __init__(
        self,
        spec: ControlSpec,
        world: World,
        body: Body | None,
        commands: Inbox[object] | None,
        errors: Inbox[object] | None,
    ) -> None:
        self._spec, self._world = spec, world
        self._body, self._inbox, self._errors = body, commands, errors
        self.fed_by_algorithm = body is None or commands is not None  # type: ignore[misc]
        self._localized_from_world = world.world_from_localized.inverse()
        self._goal = np.array(spec.position or (0.0, 0.0, 0.0))  # in L [m]
        self._commands = HeldCommands(tuple(spec.axes.split()))
        if spec.topic is not None:
            self._commands.expect(FIXED.get(world.bus.message_type(spec.topic) or object, {}))
        self._response = StepResponse(
            world.timestep, band=spec.band, least_step=spec.least_step, holds=body is None
        )
        self._n = 0  # commands
        self._came = False  # whether any command did
        self._passed_over = False  # whether any message was
        self._refused = ""  # why the newest message could not be taken
        self._was_on = False
        self._now = 0  # step of the last look
        self._since = 0  # step up to which the command in force was counted
        self._sampled: int | None = None  # step of the last error, while on
        self._error: Array | None = None  # the newest (k,)

    # -- what happens --------------------------------------------------------------------------

    def start(self) -> None:
        """Take what is in force; what passed while it was off does not count."""
        self._let_last()
        self._was_on = True
        self._now = self._since = self._world.step
        self._sampled = None
        for message in self._inbox.take() if self._inbox is not None else ():
            self._take(message, counts=False)
        self._commands.notice()
        self._sample()

    def update(self) -> None:
        """Take what has come, and the error."""
        messages = self._inbox.take() if self._inbox is not None else ()
        self._now = self._world.step
        if messages:
            self._let_last()
            for message in messages:
                self._take(message, counts=True)
        self._sample()

    def _let_last(self) -> None:
        """Count the command in force up to now."""
        self._commands.last((self._now - self._since) * self._world.timestep)
        self._since = self._now

    def _take(self, message: object, *, counts: bool) -> None:
        reader = READERS.get(type(message))
        if reader is None:
            self._pass_over(self._spec.topic, message, tuple(READERS))
            return
        command = reader(message)
        self._came = True
        units = {name: axis.unit for name, axis in self._commands.axes.items()}
        fits = all(units.get(name, unit) == unit for name, unit in command.units.items())
        if not fits or not all(map(math.isfinite, command.values.values())):
            self._passed_over = True
            return
        if counts:
            self._n += 1
            self._commands.change(command)
        else:
            self._commands.hold(command)

    def _sample(self) -> None:
        """Take the error as it is now, if there is one."""
        if self._body is not None:
            here = self._body.world_from_body.position[None]
            self._error = self._goal - self._localized_from_world.transform(here)[0]
        for message in self._errors.take() if self._errors is not None else ():
            self._hear(message)
        if self._error is not None:
            steps = 0 if self._sampled is None else self._now - self._sampled
            self._response.add(self._error, steps)
            self._sampled = self._now

    def _hear(self, message: Any) -> None:
        """Take a message of the error topic."""
        if not isinstance(message, ERRORS):
            self._pass_over(self._spec.error_topic, message, ERRORS)
            return
        data = message.data  # type: ignore[attr-defined]  # every type of ERRORS has it
        error = np.atleast_1d(np.asarray(data, dtype=np.float64))  # (k,)
        fits = self._error is None or error.shape == self._error.shape
        if fits and error.size and np.isfinite(error).all():
            self._error = error
        else:
            self._passed_over = True

    def _pass_over(self, topic: str | None, message: object, types: tuple[type, ...]) -> None:
        self._refused = f"{topic!r} carries {_name(type(message))}; expected {_names(types)}"

    # -- results --------------------------------------------------------------------------

    @property
    def value(self) -> float | None:
        """The quantity asked for."""
        return self._figure(_snake(self._spec.judged))[0]

    @property
    def unit(self) -> str:  # type: ignore[override]  # it is that of the commands
        """Of the value."""
        return self._figure(_snake(self._spec.judged))[1]

    @property
    def why(self) -> str | None:
        """Why there is no value."""
        if self.value is not None:
            return None
        return self.reasons[_snake(self._spec.judged)]

    @property
    def details(self) -> dict[str, float | None]:
        """Every number there is."""
        return {name: value for name, (value, _) in self._figures().items()}

    @property
    def detail_units(self) -> dict[str, str]:  # type: ignore[override]  # those of the commands
        """Their units."""
        return {name: unit for name, (_, unit) in self._figures().items()}

    @property
    def reasons(self) -> dict[str, str]:
        """Why details are None that are."""
        shape = self._response.shape()[1]
        absent = self._no_error() if self._response.n == 0 else ""
        found = {}
        for name, (value, _) in self._figures().items():
            if value is not None:
                continue
            if not self._was_on:
                found[name] = "it was never on"
            elif name in UNITS:
                found[name] = absent or shape[name]
            else:
                found[name] = self._no_command()
        return found

    @property
    def notes(self) -> tuple[str, ...]:
        """That messages were passed over, and axes that never came."""
        notes = []
        if self._refused:
            notes.append(self._refused)
        if self._passed_over:
            notes.append("messages were passed over: not finite, or not of the kind before")
        lacking = [axis for axis in self._commands.chosen if axis not in self._commands.axes]
        if lacking and self._commands.is_known:
            notes.append(f"no command had the axis {', '.join(lacking)}")
        return tuple(notes)

    @property
    def log_header(self) -> tuple[str, ...]:
        """Of the commands and of the error, whichever there are."""
        has_error = self._spec.has_error
        error = "error" if self._body is None else f"error [{self._error_unit('step')}]"
        return (
            *(("variation", "effort", "n") if self._inbox is not None else ()),
            *((error, "iae") if has_error else ()),
        )

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """As of now."""
        values: list[float | None] = []
        if self._inbox is not None:
            self._let_last()
            values += [self._commands.variation, self._commands.effort, float(self._n)]
        if self._spec.has_error:
            values += [self._response.size, self._response.iae if self._response.n else None]
        return tuple(values)

    def close(self) -> None:
        """Unsubscribe."""
        for inbox in (self._inbox, self._errors):
            if inbox is not None:
                inbox.close()

    def _figure(self, name: str) -> Figure:
        """One number and its unit; those that need no look at the whole response cost little."""
        if name in OF_COMMANDS:
            self._let_last()
            return self._commands.total(name)
        if name in INTEGRALS:
            return self._integrals()[name]
        return self._shape()[name]

    def _figures(self) -> dict[str, Figure]:
        """Every number and its unit."""
        found: dict[str, Figure] = {}
        if self._inbox is not None:
            self._let_last()
            found |= self._commands.figures()
            found["n"] = (float(self._n), "1")
        if self._spec.has_error:
            found |= {**self._integrals(), **self._shape()}
        return found

    def _integrals(self) -> dict[str, Figure]:
        response = self._response
        values = (response.ise, response.iae, response.itae)
        return {
            name: (value if response.n else None, self._error_unit(name))
            for name, value in zip(INTEGRALS, values, strict=True)
        }

    def _shape(self) -> dict[str, Figure]:
        return {
            name: (value, self._error_unit(name))
            for name, value in self._response.shape()[0].items()
        }

    def _error_unit(self, name: str) -> str:
        of_a_body, of_a_topic = UNITS[name]
        return of_a_topic if self._body is None else of_a_body

    def _no_command(self) -> str:
        came = self._commands.is_known
        lacking = ", ".join(self._commands.chosen)
        if not came and self._came and lacking:
            return f"the commands on {self._spec.topic!r} have no axis {lacking}"
        return self._refused or f"no command on {self._spec.topic!r}"

    def _no_error(self) -> str:
        return self._refused or f"no error on {self._spec.error_topic!r}"


def _check_type(world: World, topic: str, types: tuple[type, ...]) -> type:
    """Return what a topic is known to carry, else `object`; BadSetting if it is none of these."""
    carried = world.bus.message_type(topic)
    if carried is not None and carried not in types:
        raise BadSetting(f"{topic!r} carries {_name(carried)}; expected {_names(types)}.")
    return carried or object


def _name(type: type) -> str:
    return str(getattr(type, "__msgtype__", type.__name__))


def _names(types: tuple[type, ...]) -> str:
    return "one of " + ", ".join(sorted(_name(type).rpartition("/")[2] for type in types))


def _snake(name: str) -> str:
    """``settlingTime`` -> ``settling_time``."""
    return "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name)
