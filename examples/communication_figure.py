"""Draw packet delivery over distance, as in docs/communication.md.

    python examples/communication_figure.py docs/images/packet-delivery.png       20 s

Lines are the formulas; each point is the share of 400 packets that a simulated receiver got, with
its 95 % interval (Wilson). One sender, so there are no collisions.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy as np

from uwsim.acoustics import ambient_noise
from uwsim.analysis.plots import MARKERS, PALETTE, save_plot, styled_figure
from uwsim.base.rng import stream
from uwsim.network import (
    BROADCAST_ADDRESS,
    BitErrors,
    LinkBudget,
    Modem,
    ModemSettings,
    Network,
    WaterChannel,
    nanoseconds,
)
from uwsim.network import Path as Line

N_PACKETS, BIT_RATE, DEPTH = 400, 4096.0, 50.0
SEA = WaterChannel(temperature=10.0, salinity=35.0, bandwidth=4096.0)
CASES = ((16, 5.0), (256, 5.0), (256, 15.0))
"""Size of the packets [byte] and speed of the wind [m/s]."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw packet delivery over distance.")
    parser.add_argument("file", type=Path)
    asked = parser.parse_args()
    with styled_figure() as figure:
        axes = figure.add_subplot()
        for (size, wind), colour, marker in zip(CASES, PALETTE, MARKERS, strict=False):
            distances = np.linspace(50.0, 3050.0, 401)
            label = f"{size} byte, wind {wind:g} m/s"
            axes.plot(
                distances / 1000.0, [1.0 - lost(size, wind, d) for d in distances], color=colour
            )
            points = distances[10::10]
            shares = [measured(size, wind, d) for d in points]
            bounds = np.array([wilson(share) for share in shares])
            axes.errorbar(
                points / 1000.0, shares, yerr=np.abs(bounds.T - shares), fmt=marker, ms=3.2, lw=0.8,
                color=colour, label=label,
            )  # fmt: skip
        axes.set_xlabel("distance [km]")
        axes.set_ylabel("packets delivered [1]")
        axes.set_ylim(-0.03, 1.05)
        axes.legend(loc="upper right")
        save_plot(figure, asked.file)


def errors(wind: float) -> BitErrors:
    """What noise does: 25 kHz, 140 dB, practical spreading, moderate shipping."""
    budget = LinkBudget(
        source_level=140.0,
        frequency=25e3,
        bandwidth=SEA.bandwidth,
        noise_level=ambient_noise(25e3, shipping=0.5, wind_speed=wind),
        spreading=1.5,
        temperature=SEA.temperature,
        salinity=SEA.salinity,
    )
    return BitErrors(budget=budget, bit_rate=BIT_RATE)


def lost(size: int, wind: float, distance: float) -> float:
    """How likely a packet is lost, by the formulas."""
    return errors(wind).probability(Line(distance=distance, depth=DEPTH), size)


def measured(size: int, wind: float, distance: float) -> float:
    """The share of packets that a simulated receiver gets."""
    network = Network(lambda name: stream(1, f"{size}/{wind}/{distance}/{name}"))
    received: list[int] = []
    send = network.join(modem("sender", wind, 0.0, []))
    network.join(modem("receiver", wind, distance, received))
    for i in range(N_PACKETS):
        network.advance(nanoseconds(i * 8.0 * size / BIT_RATE))
        send(bytes(size), BROADCAST_ADDRESS)
    network.advance(nanoseconds((N_PACKETS + 1) * 8.0 * size / BIT_RATE + 10.0))
    return len(received) / N_PACKETS


def modem(name: str, wind: float, x: float, received: list[int]) -> Modem:
    """A half-duplex modem on x."""
    settings = ModemSettings(
        name=name,
        address=0,
        sends_on="sea",
        listens_to="sea",
        channel=SEA,
        errors=errors(wind),
        bit_rate=BIT_RATE,
    )
    return Modem(
        settings,
        lambda: np.array([x, 0.0, -DEPTH]),
        lambda packet, _: received.append(packet.number),
    )


def wilson(share: float) -> tuple[float, float]:
    """The 95 % interval of a share."""
    n, z = N_PACKETS, 1.96
    middle = (share + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(share * (1 - share) / n + z * z / (4 * n * n))
    return middle - half, middle + half


if __name__ == "__main__":
    main()
