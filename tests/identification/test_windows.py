"""The windows of logs: steps, commands, samples, and errors of logs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.identification.vehicles import bluerov2, log_of, small_log
from uwsim.errors import BadSetting
from uwsim.identification.residuals import Residuals
from uwsim.identification.windows import WindowSettings, cut_windows
from uwsim.logs import CommandSeries

SETTINGS = WindowSettings(length=2.0, step=0.02)


def test_commands_hold_until_the_next_and_are_averaged_over_a_step() -> None:
    windows = cut_windows([small_log()], bluerov2(), SETTINGS)
    column = windows.grids[0].commands[:, 1]
    assert column[:25].tolist() == [0.0] * 25
    np.testing.assert_allclose(column[25:62], 1.0)
    np.testing.assert_allclose(column[62], 0.25)  # half a step of each
    np.testing.assert_allclose(column[63:], -0.5)
    assert not windows.grids[0].commands[:, 0].any()
    assert "no commands of bow_starboard" in windows.remarks[0]


def test_windows_do_not_overlap_and_have_their_own_samples() -> None:
    windows = cut_windows([small_log()], bluerov2(), SETTINGS)
    assert windows.times.tolist() == [0.0, 2.0]
    assert windows.samples.shape == (2, 21, 13)
    seconds = (windows.index + windows.fraction) * SETTINGS.step
    np.testing.assert_allclose(seconds[0], np.arange(0.0, 2.01, 0.1), atol=1e-12)


def test_samples_faster_than_the_rate_are_omitted() -> None:
    settings = replace(SETTINGS, rate=5.0)
    assert cut_windows([small_log()], bluerov2(), settings).samples.shape[1] == 11


def test_all_errors_of_all_logs_are_reported_at_once() -> None:
    wrench = CommandSeries(
        kind="wrench", names=("force.x",), times=np.zeros(1), values=np.zeros((1, 1))
    )
    typing_error = replace(small_log().commands[0], names=("bow_prt",))
    logs = [
        small_log(motion=None),
        small_log(commands=(wrench,)),
        small_log(commands=(typing_error,)),
    ]
    with pytest.raises(BadSetting) as error:
        cut_windows(logs, bluerov2(), SETTINGS)
    text = str(error.value)
    assert "has no motion" in text
    assert "commands: wrench" in text
    assert "Did you mean 'bow_port'?" in text


def test_a_log_shorter_than_a_window_is_an_error_that_names_the_option() -> None:
    motion = small_log().motion
    assert motion is not None
    short = replace(
        motion, times=motion.times[:3], positions=motion.positions[:3],
        quaternions=motion.quaternions[:3], twists=None,
    )  # fmt: skip
    with pytest.raises(BadSetting, match="--window"):
        cut_windows([small_log(motion=short)], bluerov2(), SETTINGS)


def test_missing_channels_have_no_residual() -> None:
    motion = log_of().motion
    assert motion is not None
    positions = np.full_like(motion.positions, np.nan)
    log = replace(log_of(), motion=replace(motion, positions=positions))
    residuals = Residuals(bluerov2(), (), cut_windows([log], bluerov2(), WindowSettings()))
    rows = residuals.compute(residuals.start(), np.ones(12)).reshape(-1, 12)
    assert not rows[:, :3].any()
    assert rows[:, 3:].any()


def test_the_truth_leaves_the_noise_as_residuals() -> None:
    windows = cut_windows([log_of()], bluerov2(), WindowSettings(length=2.0))
    residuals = Residuals(bluerov2(), (), windows)
    rows = residuals.compute(residuals.start(), np.ones(12)).reshape(len(windows), -1, 12)
    spread = rows.std(axis=(0, 1))
    # the noise of the sample, and that of the initial state from the first sample
    assert (spread[6:9] < 3.0 * 0.003).all()
    assert (spread[:3] < 4.0 * 0.005).all()
