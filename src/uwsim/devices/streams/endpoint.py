"""The errors of streams: their times and addresses."""

from __future__ import annotations

from collections.abc import Sequence

from ...autopilots.instruments.utc import parse_epoch
from ...errors import BadMessage, SceneError, UwsimError
from ...schema import diagnostic_at
from ...world.addresses import parse_address


def describe_endpoint_errors(epoch: str, address: str) -> list[str]:
    """Return the errors of the time at the start, and of the address of a stream."""
    errors = []
    try:
        parse_epoch(epoch)
    except BadMessage as error:
        errors.append(f"<epoch>: {error}")
    try:
        parse_address(address)
    except UwsimError as error:
        errors.append(f"<address>: {error}")
    return errors


def raise_stream_errors(spec: object, element: str, errors: Sequence[str]) -> None:
    """Raise SceneError with all errors of a stream, at its line, if there are any."""
    if errors:
        raise SceneError([diagnostic_at(spec, f"<{element}>: {text}") for text in errors])
