"""Thorp's absorption and the noise of the sea against published values."""

from __future__ import annotations

import pytest

from uwsim.acoustics import ambient_noise, power_sum, thorp_absorption


@pytest.mark.parametrize(
    ("khz", "db_per_km"),
    [(1, 0.069), (5, 0.382), (10, 1.187), (20, 4.134), (25, 6.105), (30, 8.280), (50, 17.467)],
)
def test_absorption_after_thorp(khz: float, db_per_km: float) -> None:
    assert 1000.0 * thorp_absorption(1000.0 * khz) == pytest.approx(db_per_km, abs=5.1e-4)


def test_noise_at_25_khz_with_moderate_shipping_and_5_m_s_of_wind_is_38_5_db() -> None:
    level = ambient_noise(25e3, shipping=0.5, wind_speed=5.0)
    assert level == pytest.approx(38.5, abs=0.05)


def test_two_sources_of_one_level_are_3_db_louder() -> None:
    assert power_sum((50.0, 50.0)) == pytest.approx(53.0103, abs=1e-4)
