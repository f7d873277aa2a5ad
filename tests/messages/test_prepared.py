"""`check_and_freeze` reports an invalid message, and makes the arrays of a valid one read-only."""

from __future__ import annotations

import copy
import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import uwsim.messages
from tests.support.random_messages import RandomMessages
from uwsim.base.message_fields import (
    _definition,
    are_within,
    check_and_freeze,
    copy_message,
    find_invalid_field,
)
from uwsim.messages import Float64MultiArray, JointState, MultiArrayLayout, header

CLASSES = sorted(
    (
        each
        for each in vars(uwsim.messages).values()
        if dataclasses.is_dataclass(each)
        and hasattr(each, "__msgtype__")
        and len(_definition(each)) == len([f for f in dataclasses.fields(each) if f.init])
    ),
    key=lambda each: each.__name__,
)


def arrays(value: Any) -> Iterator[np.ndarray[Any, Any]]:
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, list):
        for item in value:
            yield from arrays(item)
    elif dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            yield from arrays(getattr(value, field.name, None))


@pytest.mark.parametrize("cls", CLASSES, ids=lambda each: each.__name__)
def test_a_message_that_fits_has_arrays_that_are_read_only(cls: type) -> None:
    generator = RandomMessages(4, ["joint"])
    for _ in range(8):
        message = generator.message(cls)
        assert check_and_freeze(message) == find_invalid_field(copy_message(message)) is None
        assert not any(array.flags.writeable for array in arrays(message))


def spoil(field: str, value: object) -> JointState:
    message = JointState(
        header=header(1.0),
        name=["a"],
        position=np.zeros(1),
        velocity=np.zeros(1),
        effort=np.zeros(0),
    )
    setattr(message, field, value)
    return message


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("position", "fast"),
        ("position", np.array(["fast"])),
        ("position", np.zeros(1, complex)),
        ("name", "a"),
        ("name", ["a", 3]),
        ("header", None),
        ("header", np.zeros(3)),
    ],
)
def test_what_does_not_fit_is_reported_and_left_as_it_is(field: str, value: object) -> None:
    message = spoil(field, value)
    invalid_message = check_and_freeze(message)
    assert invalid_message is not None
    assert invalid_message == find_invalid_field(copy.copy(message))
    assert invalid_message.startswith(f"{field} is ")
    assert message.velocity.flags.writeable


@pytest.mark.parametrize("value", [[1.0], (1.0,), np.ones(1, np.float32), np.ones(1, int)])
def test_numbers_of_other_kinds_are_taken(value: object) -> None:
    message = spoil("position", value)
    assert check_and_freeze(message) is None
    assert isinstance(message.position, np.ndarray)
    assert not message.position.flags.writeable


def test_a_field_that_is_gone_is_no_reason_to_pass() -> None:
    message = Float64MultiArray(layout=MultiArrayLayout(dim=[], data_offset=0), data=np.zeros(2))
    object.__delattr__(message, "data")
    with pytest.raises(AttributeError):
        check_and_freeze(message)


@pytest.mark.parametrize("n", [0, 1, 5, 32, 33, 400])
def test_numbers_are_compared_with_a_limit_one_by_one_and_at_once(n: int) -> None:
    values = np.linspace(-2.0, 2.0, n)
    assert are_within(values, 2.0)
    assert are_within(values.reshape(1, -1), 2.0)
    for odd_values in (2.5, -2.5, np.nan, np.inf, -np.inf):
        for place in {0, n // 2, n - 1} if n else ():
            spoilt = values.copy()
            spoilt[place] = odd_values
            assert not are_within(spoilt, 2.0)
