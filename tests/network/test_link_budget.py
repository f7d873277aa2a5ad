"""The sonar equation of a link against the numbers of the literature."""

from __future__ import annotations

import pytest

from uwsim.acoustics import ambient_noise
from uwsim.network import BitErrors, DelayChannel, LinkBudget, Path, WaterChannel, bpsk_error_rate
from uwsim.network.packet_errors import error_probability

BUDGET = LinkBudget(
    source_level=175.0,
    frequency=25e3,
    bandwidth=5e3,
    noise_level=ambient_noise(25e3, shipping=0.5, wind_speed=5.0),
    spreading=1.5,
    absorption="thorp",
)


def at(distance: float, depth: float = 0.0) -> Path:
    return Path(distance=distance, depth=depth)


@pytest.mark.parametrize(
    ("km", "loss", "snr"),
    [(0.1, 30.6, 68.9), (0.5, 43.5, 55.9), (1, 51.1, 48.4), (2, 61.7, 37.7), (4, 78.5, 21.0)],
)
def test_loss_and_snr_of_a_25_khz_link_of_175_db(km: float, loss: float, snr: float) -> None:
    assert BUDGET.transmission_loss(at(1000.0 * km)) == pytest.approx(loss, abs=0.051)
    assert BUDGET.snr(at(1000.0 * km)) == pytest.approx(snr, abs=0.051)


@pytest.mark.parametrize(
    ("db", "bit_errors", "packet_errors"),
    [(4, 1.25e-2, 1.0), (6, 2.39e-3, 0.993), (8, 1.91e-4, 0.324), (9.6, 9.74e-6, 0.0197)],
)
def test_bpsk_bit_errors_and_those_of_packets_of_256_bytes(
    db: float, bit_errors: float, packet_errors: float
) -> None:
    rate = bpsk_error_rate(10.0 ** (db / 10.0))
    assert rate == pytest.approx(bit_errors, rel=5e-3)
    assert error_probability(rate, 2048) == pytest.approx(packet_errors, abs=2e-3)


def test_a_channel_of_0_667_ms_per_metre_takes_0_667_s_for_a_kilometre() -> None:
    assert DelayChannel().delay(at(1000.0)) == pytest.approx(0.66667)
    assert DelayChannel(minimum=0.1).delay(at(1000.0)) == pytest.approx(0.76667)


def test_sound_takes_its_time_at_the_temperature_and_salinity_of_its_channel() -> None:
    sea = WaterChannel(temperature=25.0, salinity=35.0)
    assert sea.delay(at(1550.744, depth=1000.0)) == pytest.approx(1.0, abs=1e-6)
    assert WaterChannel(temperature=10.0, salinity=35.0).delay(at(1489.803)) == pytest.approx(
        1.0, abs=1e-6
    )


def test_fresh_water_takes_less_than_the_sea_after_francois_and_garrison() -> None:
    def loss(salinity: float) -> float:
        budget = LinkBudget(
            source_level=175.0, frequency=25e3, bandwidth=5e3, noise_level=40.0, spreading=0.0,
            temperature=10.0, salinity=salinity,
        )  # fmt: skip
        return budget.transmission_loss(at(1000.0, depth=50.0))

    assert loss(35.0) == pytest.approx(4.96, abs=0.05)
    assert loss(0.0) < 0.3


def test_noise_and_a_constant_rate_of_bit_errors_add_up() -> None:
    far = at(5400.0)
    noisy = BitErrors(budget=BUDGET, bit_rate=5e3).probability(far, 100)
    both = BitErrors(rate=1e-4, budget=BUDGET, bit_rate=5e3).probability(far, 100)
    assert BitErrors(rate=1e-4).probability(far, 100) == pytest.approx(1.0 - (1.0 - 1e-4) ** 800)
    assert 0.0 < noisy < both < 1.0
