"""The share of scattered light that keeps the contrast of a checker."""

from __future__ import annotations

import math

import pytest

from tests.calibration.traced_signals import (
    LAMP_HALF_ANGLE,
    LAMP_OFFSET,
    SIDES,
    Water,
    trace_board_signals,
)
from uwsim.calibration import BoardReading, WaterNumbers
from uwsim.calibration.checker import compute_checker_share
from uwsim.calibration.forward_model import ForwardModel
from uwsim.calibration.pure_water import compute_pure_absorption, compute_pure_scattering
from uwsim.optics import FournierForand, HenyeyGreenstein, PhaseFunction


@pytest.mark.parametrize(
    ("phase", "shares"),
    [(FournierForand(), (0.680, 0.421, 0.219)), (HenyeyGreenstein(0.9), (0.453, 0.137, 0.034))],
    ids=("FF", "HG"),
)
def test_the_shares_at_the_centre_of_squares_are_those_of_the_reference(
    phase: PhaseFunction, shares: tuple[float, ...]
) -> None:
    for side, share in zip((0.15, 0.04, 0.01), shares, strict=True):
        assert compute_checker_share(phase, side, 1.0, 0.0) == pytest.approx(share, abs=6e-4)


def test_the_share_depends_on_the_angle_of_a_square_alone() -> None:
    phase = FournierForand()
    near = compute_checker_share(phase, 0.02, 0.5)
    assert near == pytest.approx(compute_checker_share(phase, 0.04, 1.0), rel=1e-9)


def test_a_very_large_checker_keeps_almost_all_forward_light() -> None:
    phase = FournierForand()
    assert compute_checker_share(phase, 100.0, 1.0) > 0.97
    assert compute_checker_share(phase, 1e-6, 1.0) < 0.05


@pytest.mark.parametrize("phase", [FournierForand(), HenyeyGreenstein(0.9)], ids=("FF", "HG"))
def test_the_loss_of_a_board_is_that_of_the_path_tracer(phase: PhaseFunction) -> None:
    """The reference states 1.4 to 2.6 % rms of the signal for optical depths to 1."""
    readings = [
        BoardReading(
            channel="red",
            source="board",
            distance=1.0,
            side=side,
            lamp_distance=math.hypot(1.0, LAMP_OFFSET),
            lamp_half_angle=LAMP_HALF_ANGLE,
            signal=1.0,
        )
        for side in SIDES
    ]
    model = ForwardModel.from_readings(readings)
    shape = 1.0 if isinstance(phase, FournierForand) else 0.0
    clear = trace_board_signals(Water(phase, 0.06, 0.02), 1.0, 100_000, 1)
    signals = trace_board_signals(Water(phase, 1.0, 0.85), 1.0, 100_000, 2)
    losses = model.compute_losses(WaterNumbers(0.15, 0.85, shape))
    losses -= model.compute_losses(WaterNumbers(0.04, 0.02, shape))
    for side, loss, ratio in zip(SIDES, losses, signals / clear, strict=True):
        assert loss == pytest.approx(-math.log(ratio), abs=0.03), side


def test_pure_water_has_published_coefficients() -> None:
    """Pope and Fry: 0.2916 at 630 nm and the least, 0.00454, at 420 nm."""
    assert compute_pure_absorption(630.0) == 0.2916
    assert compute_pure_absorption(625.0) == pytest.approx(0.28355)
    assert min(map(compute_pure_absorption, range(400, 701))) == 0.00454
    assert compute_pure_scattering(440.0) == pytest.approx(0.0050, rel=0.02)
