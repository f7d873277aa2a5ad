r"""Control: the effort and variation of a controller's commands, and its step response.

.. code-block:: xml

    <u:control>
      <name>control</name>
      <topic>/dataNavigator</topic> <axes>vx vy</axes>
      <target>girona500</target> <position> <x>3</x> <y>2</y> <z>1.5</z> </position>
      <band>0.05</band>
      <quantity>settlingTime</quantity>
    </u:control>

L is the localized world frame.
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
from ..metrics.held_commands import KNOWN_AXES, READERS, HeldCommands, Quantity
from ..metrics.step_response import INTEGRALS, UNITS, StepResponse
from .measure import Measure, MeasureSpec

COMMAND_QUANTITIES = ("variation", "effort", "max")
"""The quantities of the commands; all others are quantities of the error."""
ERROR_TYPES: tuple[type, ...] = (Float64, Float32MultiArray, Float64MultiArray)
"""The types of messages with an error."""


@dataclass(frozen=True, kw_only=True)
class ControlSpec(MeasureSpec):
    """A ``<u:control>`` element: it evaluates commands, a control error, or both."""

    topic: str | None = element(default=None)
    """The topic of the commands (Twist, TwistStamped, Wrench, WrenchStamped, Float64MultiArray or
    JointState)."""
    axes: str = ""
    """The axes of the commands that are evaluated, separated by blanks; if absent, all axes."""
    target: str | None = element(default=None, refers_to="body")
    """The route of the body whose position error is evaluated."""
    position: tuple[float, float, float] | None = None
    """The desired position of the target, in the localized world frame L [m]."""
    error_topic: str | None = element(default=None)
    """The topic on which the algorithm publishes the error, instead of a target (std_msgs/Float64,
    Float32MultiArray or Float64MultiArray)."""
    band: float = element(default=0.02, exclusive_minimum=0.0, exclusive_maximum=1.0)
    """The half-width of the settling band, relative to the step [1]."""
    least_step: float = element(default=0.01, minimum=0.0)
    """The largest first error that is too small to evaluate a step response
    [m, or the error topic's unit]."""
    quantity: (
        Literal[
            "variation", "effort", "max", "ise", "iae", "itae", "overshoot", "riseTime",
            "settlingTime", "steadyStateError",
        ]
        | None
    ) = element(default=None)  # fmt: skip
    """The quantity that is the value of the measure; if absent, ``variation`` with a ``<topic>``,
    else ``iae``."""

    @property
    def selected_quantity(self) -> str:
        """The quantity that is the value of the measure."""
        return self.quantity or ("variation" if self.topic is not None else "iae")

    @property
    def has_error(self) -> bool:
        """True if the measure evaluates an error."""
        return self.target is not None or self.error_topic is not None

    def errors(self) -> Sequence[str]:
        """Return errors in the combination of elements."""
        errors = []
        if self.topic is None and not self.has_error:
            errors.append("needs a <topic> of commands, a <target>, or an <errorTopic>")
        if self.target is not None and self.error_topic is not None:
            errors.append("<target> and <errorTopic> both give the error; use one")
        if (self.target is None) != (self.position is None):
            errors.append("<target> and <position> go together; give both or none")
        if self.axes and self.topic is None:
            errors.append("<axes> are those of a <topic>, which is not given")
        if self.quantity in COMMAND_QUANTITIES and self.topic is None:
            errors.append(f"<quantity> {self.quantity!r} is that of a <topic>, which is not given")
        if self.quantity not in (None, *COMMAND_QUANTITIES) and not self.has_error:
            errors.append(
                f"<quantity> {self.quantity!r} needs an error: <target> and <position>, "
                "or <errorTopic>"
            )
        return errors

    def bind(self, world: World) -> Control:
        """Resolve the body, and subscribe to the topics.

        Raises:
            UnknownName: there is no such body, or commands of the topic's type lack an axis.
            BadSetting: a topic has a type that cannot be evaluated.
        """
        body = None if self.target is None else world.body(self.target)
        commands = errors = None
        if self.topic is not None:
            type_ = _check_type(world, self.topic, tuple(READERS))
            for axis in self.axes.split() if type_ in KNOWN_AXES else ():
                if axis not in KNOWN_AXES[type_]:
                    raise UnknownName("axis", axis, KNOWN_AXES[type_])
            commands = world.bus.inbox(self.topic, object, latched=True)
        if self.error_topic is not None:
            _check_type(world, self.error_topic, ERROR_TYPES)
            errors = world.bus.inbox(self.error_topic, object)
        return Control(self, world, body, commands, errors)


class Control(Measure):
    """The effort and variation of the commands, and the shape of an error over time.

    *Commands.* `uwsim.benchmark.metrics.held_commands` has the formulas. A command is in force
    until the next one arrives. The command in force when the measure starts adds to effort and
    largest value, but not to the variation. Details: ``variation``, ``effort`` and ``max`` over all
    selected axes and for each of these axes, and ``n``, the number of messages since the measure
    started. Totals over axes with different units add numbers of different units; select axes
    of one unit with ``axes``.

    *Error.* Either the position error of a body, which is ``position`` minus the body's origin in L
    at every step, or the error that the algorithm publishes, held from message to message. Details:
    the quantities of `uwsim.benchmark.metrics.step_response`. Their time begins at the first error.

    The time while the measure is inactive does not count. A message is ignored, with a note, if it
    has a number that is not finite, or if its type or size differs from earlier messages.
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
            self._commands.expect(KNOWN_AXES.get(world.bus.message_type(spec.topic) or object, {}))
        self._response = StepResponse(
            world.timestep, band=spec.band, least_step=spec.least_step, is_constant=body is None
        )
        self._n_commands = 0  # commands since the measure started
        self._has_commands = False  # whether any command arrived
        self._has_ignored = False  # whether any message was ignored
        self._error_text = ""  # what was wrong with the type of a message
        self._was_active = False
        self._step = 0  # step of the last update
        self._integrated_step = 0  # step up to which the command in force was integrated
        self._sample_step: int | None = None  # step of the last error sample since the start
        self._error: Array | None = None  # the newest error (k,)

    # -- updates -------------------------------------------------------------------------------

    def start(self) -> None:
        """Start with the command in force; earlier commands do not count."""
        self._integrate_command()
        self._was_active = True
        self._step = self._integrated_step = self._world.step
        self._sample_step = None
        for message in self._inbox.take() if self._inbox is not None else ():
            self._apply_message(message, is_counted=False)
        self._commands.update_max()
        self._sample()

    def update(self) -> None:
        """Apply the received messages, and sample the error."""
        messages = self._inbox.take() if self._inbox is not None else ()
        self._step = self._world.step
        if messages:
            self._integrate_command()
            for message in messages:
                self._apply_message(message, is_counted=True)
        self._sample()

    def _integrate_command(self) -> None:
        self._commands.integrate((self._step - self._integrated_step) * self._world.timestep)
        self._integrated_step = self._step

    def _apply_message(self, message: object, *, is_counted: bool) -> None:
        reader = READERS.get(type(message))
        if reader is None:
            self._report_type(self._spec.topic, message, tuple(READERS))
            return
        command = reader(message)
        self._has_commands = True
        units = {name: axis.unit for name, axis in self._commands.axes.items()}
        is_valid = all(units.get(name, unit) == unit for name, unit in command.units.items())
        if not is_valid or not all(map(math.isfinite, command.values.values())):
            self._has_ignored = True
            return
        if is_counted:
            self._n_commands += 1
            self._commands.change(command)
        else:
            self._commands.hold(command)

    def _sample(self) -> None:
        """Add a sample of the present error, if there is one."""
        if self._body is not None:
            position = self._body.world_from_body.position[None]
            self._error = self._goal - self._localized_from_world.transform(position)[0]
        for message in self._errors.take() if self._errors is not None else ():
            self._apply_error(message)
        if self._error is not None:
            steps = 0 if self._sample_step is None else self._step - self._sample_step
            self._response.add(self._error, steps)
            self._sample_step = self._step

    def _apply_error(self, message: Any) -> None:
        if not isinstance(message, ERROR_TYPES):
            self._report_type(self._spec.error_topic, message, ERROR_TYPES)
            return
        data = message.data  # type: ignore[attr-defined]  # all ERROR_TYPES have this field
        error = np.atleast_1d(np.asarray(data, dtype=np.float64))  # (k,)
        has_shape = self._error is None or error.shape == self._error.shape
        if has_shape and error.size and np.isfinite(error).all():
            self._error = error
        else:
            self._has_ignored = True

    def _report_type(self, topic: str | None, message: object, types: tuple[type, ...]) -> None:
        self._error_text = (
            f"{topic!r} carries {_type_name(type(message))}; expected {_type_names(types)}"
        )

    # -- results --------------------------------------------------------------------------

    @property
    def value(self) -> float | None:
        """The selected quantity."""
        return self._quantity(_snake_case(self._spec.selected_quantity))[0]

    @property
    def unit(self) -> str:  # type: ignore[override]  # it is that of the commands
        """The unit of the value."""
        return self._quantity(_snake_case(self._spec.selected_quantity))[1]

    @property
    def missing_reason(self) -> str | None:
        """The reason why there is no value."""
        if self.value is not None:
            return None
        return self.reasons[_snake_case(self._spec.selected_quantity)]

    @property
    def details(self) -> dict[str, float | None]:
        """All quantities."""
        return {name: value for name, (value, _) in self._quantities().items()}

    @property
    def detail_units(self) -> dict[str, str]:  # type: ignore[override]  # those of the commands
        """The units of all quantities."""
        return {name: unit for name, (_, unit) in self._quantities().items()}

    @property
    def reasons(self) -> dict[str, str]:
        """The reasons why quantities are None."""
        shape = self._response.shape()[1]
        absence_reason = self._missing_error_reason() if self._response.n == 0 else ""
        reasons = {}
        for name, (value, _) in self._quantities().items():
            if value is not None:
                continue
            if not self._was_active:
                reasons[name] = "it was never on"
            elif name in UNITS:
                reasons[name] = absence_reason or shape[name]
            else:
                reasons[name] = self._missing_command_reason()
        return reasons

    @property
    def notes(self) -> tuple[str, ...]:
        """The notes on ignored messages and on axes without a command."""
        notes = []
        if self._error_text:
            notes.append(self._error_text)
        if self._has_ignored:
            notes.append("messages were passed over: not finite, or not of the kind before")
        axis_names = [axis for axis in self._commands.selection if axis not in self._commands.axes]
        if axis_names and self._commands.is_known:
            notes.append(f"no command had the axis {', '.join(axis_names)}")
        return tuple(notes)

    @property
    def log_header(self) -> tuple[str, ...]:
        """The columns of the commands, if there is a topic, and of the error, if there is one."""
        has_error = self._spec.has_error
        error = "error" if self._body is None else f"error [{self._error_unit('step')}]"
        return (
            *(("variation", "effort", "n") if self._inbox is not None else ()),
            *((error, "iae") if has_error else ()),
        )

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present quantities."""
        values: list[float | None] = []
        if self._inbox is not None:
            self._integrate_command()
            values += [self._commands.variation, self._commands.effort, float(self._n_commands)]
        if self._spec.has_error:
            values += [self._response.size, self._response.iae if self._response.n else None]
        return tuple(values)

    def close(self) -> None:
        """Unsubscribe."""
        for inbox in (self._inbox, self._errors):
            if inbox is not None:
                inbox.close()

    def _quantity(self, name: str) -> Quantity:
        """Return one quantity, which computes the step response only if it depends on it."""
        if name in COMMAND_QUANTITIES:
            self._integrate_command()
            return self._commands.total(name)
        if name in INTEGRALS:
            return self._integrals()[name]
        return self._shape()[name]

    def _quantities(self) -> dict[str, Quantity]:
        quantities: dict[str, Quantity] = {}
        if self._inbox is not None:
            self._integrate_command()
            quantities |= self._commands.quantities()
            quantities["n"] = (float(self._n_commands), "1")
        if self._spec.has_error:
            quantities |= {**self._integrals(), **self._shape()}
        return quantities

    def _integrals(self) -> dict[str, Quantity]:
        response = self._response
        values = (response.ise, response.iae, response.itae)
        return {
            name: (value if response.n else None, self._error_unit(name))
            for name, value in zip(INTEGRALS, values, strict=True)
        }

    def _shape(self) -> dict[str, Quantity]:
        shape, _ = self._response.shape()
        return {name: (value, self._error_unit(name)) for name, value in shape.items()}

    def _error_unit(self, name: str) -> str:
        body_unit, topic_unit = UNITS[name]
        return topic_unit if self._body is None else body_unit

    def _missing_command_reason(self) -> str:
        has_known_axis = self._commands.is_known
        axes = ", ".join(self._commands.selection)
        if not has_known_axis and self._has_commands and axes:
            return f"the commands on {self._spec.topic!r} have no axis {axes}"
        return self._error_text or f"no command on {self._spec.topic!r}"

    def _missing_error_reason(self) -> str:
        return self._error_text or f"no error on {self._spec.error_topic!r}"


def _check_type(world: World, topic: str, types: tuple[type, ...]) -> type:
    """Return the type of a topic, or `object` if it has none yet.

    Raises:
        BadSetting: the topic has none of the types ``types``.
    """
    known_type = world.bus.message_type(topic)
    if known_type is not None and known_type not in types:
        raise BadSetting(
            f"{topic!r} carries {_type_name(known_type)}; expected {_type_names(types)}."
        )
    return known_type or object


def _type_name(type: type) -> str:
    return str(getattr(type, "__msgtype__", type.__name__))


def _type_names(types: tuple[type, ...]) -> str:
    return "one of " + ", ".join(sorted(_type_name(type).rpartition("/")[2] for type in types))


def _snake_case(name: str) -> str:
    return "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name)
