"""The addresses of streams of bytes to programs and instruments outside."""

from __future__ import annotations

from ..errors import UwsimError, did_you_mean

KINDS = ("tcp", "tcpin", "udpin", "udpout", "serial", "pty")
"""The kinds of addresses (`uwsim.world.Connections.open`)."""

MAX_BIT_RATE = 10_000_000
"""The greatest bit rate of a serial line [bit/s]."""


def parse_address(address: str) -> tuple[str, str, int]:
    """Return the parts of an address; raise UwsimError if it is invalid.

    Returns:
        The kind, the host or path, and the port or the bit rate [bit/s].
    """
    kind, _, rest = address.partition(":")
    if kind not in KINDS:
        raise UwsimError(
            f"{address[:80]!r} is not an address: its kind is {kind[:40]!r}; expected "
            f"{', '.join(KINDS)}.{did_you_mean(kind, KINDS)}"
        )
    if kind == "pty":
        return kind, rest, 0
    host, _, number = rest.rpartition(":")
    max_number = MAX_BIT_RATE if kind == "serial" else 65535
    is_number = number.isascii() and number.isdigit()
    if not host or not is_number or not 0 < int(number[:9]) <= max_number:
        form = "serial:PATH:BIT_RATE" if kind == "serial" else f"{kind}:HOST:PORT"
        raise UwsimError(f"{address[:80]!r} is not an address; expected {form}.")
    return kind, host.strip("[]"), int(number)
