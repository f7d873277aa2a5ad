"""Draw packet delivery over distance, as in docs/communication.md.

    python examples/communication_figure.py docs/images/packet-delivery.png       20 s

Lines are the formulas. Each point is the fraction of 400 packets that a simulated receiver gets,
with its 95 % interval (Wilson). There is one sender, so there are no collisions.
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
"""The packet sizes [byte] and wind speeds [m/s] of the curves."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw packet delivery over distance.")
    parser.add_argument("file", type=Path)
    options = parser.parse_args()
    with styled_figure() as figure:
        axes = figure.add_subplot()
        for (size, wind), colour, marker in zip(CASES, PALETTE, MARKERS, strict=False):
            distances = np.linspace(50.0, 3050.0, 401)
            label = f"{size} byte, wind {wind:g} m/s"
            axes.plot(
                distances / 1000.0,
                [1.0 - loss_probability(size, wind, d) for d in distances],
                color=colour,
            )
            points = distances[10::10]
            shares = [simulate_delivery(size, wind, d) for d in points]
            bounds = np.array([wilson_interval(share) for share in shares])
            axes.errorbar(
                points / 1000.0, shares, yerr=np.abs(bounds.T - shares), fmt=marker, ms=3.2, lw=0.8,
                color=colour, label=label,
            )  # fmt: skip
        axes.set_xlabel("distance [km]")
        axes.set_ylabel("packets delivered [1]")
        axes.set_ylim(-0.03, 1.05)
        axes.legend(loc="upper right")
        save_plot(figure, options.file)


def bit_errors(wind: float) -> BitErrors:
    """Return the bit errors by noise: 25 kHz, 140 dB, practical spreading, moderate shipping."""
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


def loss_probability(size: int, wind: float, distance: float) -> float:
    """Compute the probability that a packet is lost, by the formulas."""
    return bit_errors(wind).probability(Line(distance=distance, depth=DEPTH), size)


def simulate_delivery(size: int, wind: float, distance: float) -> float:
    """Simulate a link; return the fraction of packets that the receiver gets."""
    network = Network(lambda name: stream(1, f"{size}/{wind}/{distance}/{name}"))
    packet_numbers: list[int] = []
    send = network.join(modem("sender", wind, 0.0, []))
    network.join(modem("receiver", wind, distance, packet_numbers))
    for i in range(N_PACKETS):
        network.advance(nanoseconds(i * 8.0 * size / BIT_RATE))
        send(bytes(size), BROADCAST_ADDRESS)
    network.advance(nanoseconds((N_PACKETS + 1) * 8.0 * size / BIT_RATE + 10.0))
    return len(packet_numbers) / N_PACKETS


def modem(name: str, wind: float, x: float, packet_numbers: list[int]) -> Modem:
    """Return a half-duplex modem at x [m]."""
    settings = ModemSettings(
        name=name,
        address=0,
        sends_on="sea",
        listens_to="sea",
        channel=SEA,
        errors=bit_errors(wind),
        bit_rate=BIT_RATE,
    )
    return Modem(
        settings,
        lambda: np.array([x, 0.0, -DEPTH]),
        lambda packet, _: packet_numbers.append(packet.number),
    )


def wilson_interval(share: float) -> tuple[float, float]:
    """Compute the 95 % confidence interval of a share."""
    n, z = N_PACKETS, 1.96
    middle = (share + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(share * (1 - share) / n + z * z / (4 * n * n))
    return middle - half, middle + half


if __name__ == "__main__":
    main()
