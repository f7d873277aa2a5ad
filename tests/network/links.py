"""Modems on a line, and what they receive."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from uwsim.base.rng import stream
from uwsim.network import (
    BROADCAST_ADDRESS,
    BitErrors,
    DelayChannel,
    Modem,
    ModemSettings,
    Network,
    Packet,
)

SECOND = 1_000_000_000
SOUND = DelayChannel(per_metre=1.0 / 1500.0)


class Line:
    """A network of modems along x, 1000 bit/s unless they are made otherwise."""

    def __init__(self, seed: int = 0) -> None:
        self.network = Network(lambda name: stream(seed, name))
        self.received: list[tuple[str, float, bytes]] = []
        self.modems: dict[str, Modem] = {}
        self.places: dict[str, float] = {}
        self._send: dict[str, Callable[[bytes, int], None]] = {}

    def add(self, name: str, x: float, **settings: Any) -> Modem:
        given: dict[str, Any] = {
            "address": len(self.modems),
            "sends_on": "water",
            "listens_to": "water",
            "channel": SOUND,
            "errors": BitErrors(),
            "bit_rate": 1000.0,
        }
        self.places[name] = x
        modem = Modem(
            ModemSettings(name=name, **{**given, **settings}),
            lambda: np.array([self.places[name], 0.0, 0.0]),
            lambda packet, time: self._receive(name, packet, time),
        )
        self._send[name] = self.network.join(modem)
        self.modems[name] = modem
        return modem

    def _receive(self, name: str, packet: Packet, time: int) -> None:
        self.received.append((name, time / SECOND, packet.data))

    def send(self, name: str, data: bytes, at: float = 0.0, to: int = BROADCAST_ADDRESS) -> None:
        self.network.advance(round(at * SECOND))
        self._send[name](data, to)

    def run(self, until: float) -> list[tuple[str, float, bytes]]:
        self.network.advance(round(until * SECOND))
        return self.received
