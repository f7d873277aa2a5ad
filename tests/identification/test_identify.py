"""Identification of a BlueROV2 from a log of the full engine, with noise at real levels."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from tests.identification.vehicles import NO_YAW, bluerov2, log_of, spoil_guess
from uwsim.identification import Identification, IdentifySettings, WindowSettings, identify
from uwsim.identification.hydrodynamics_file import write_hydrodynamics
from uwsim.identification.report.document import json_text
from uwsim.identification.report.tables import list_warnings
from uwsim.logs import VehicleLog
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle

FACTORS = {
    "added_mass[surge]": 1.8,
    "added_mass[yaw]": 0.6,
    "quadratic_damping[surge]": 0.5,
    "quadratic_damping[sway]": 1.6,
    "thrust": 0.8,
}
QUICK = IdentifySettings(
    free_names=tuple(FACTORS), windows=WindowSettings(step=0.01), n_starts=2, n_folds=2
)


def fit(log: VehicleLog, **changes: object) -> Identification:
    return identify([log], spoil_guess(FACTORS), replace(QUICK, **changes))


@cache
def usual_fit() -> Identification:
    return fit(log_of())


def true_values(result: Identification) -> np.ndarray:
    return np.array([p.first_guess / FACTORS[p.name] for p in result.parameters])


def test_coefficients_of_a_wrong_first_guess_are_found() -> None:
    result = usual_fit()
    np.testing.assert_allclose(result.values, true_values(result), rtol=0.02)
    assert all(estimate.is_determined for estimate in result.uncertainty.estimates)
    assert result.n_same_minimum == 2
    assert list_warnings(result) == []


def test_the_estimated_noise_is_that_of_the_log() -> None:
    expected = np.repeat([0.005, 0.0035, 0.003, 0.00175], 3)
    np.testing.assert_allclose(usual_fit().noise, expected, rtol=0.15)


def test_windows_that_were_held_out_are_predicted_better_than_by_the_first_guess() -> None:
    errors = {(e.quantity, e.horizon): e for e in usual_fit().horizons}
    position = errors["position", 5.0]
    assert position.fitted_error < 0.1 * position.first_error
    assert position.fitted_error < 0.03


def test_the_same_log_gives_the_same_bytes() -> None:
    assert json_text(fit(log_of())) == json_text(usual_fit())


def test_the_hydrodynamics_file_has_the_coefficients_and_where_they_come_from(
    tmp_path: Path,
) -> None:
    result = usual_fit()
    path = tmp_path / "fitted.xml"
    path.write_text(write_hydrodynamics(result, "fitted"))
    vehicle = read_vehicle(path)
    body = vehicle.bodies[0]
    np.testing.assert_allclose(body.added_mass[0], 6.36, rtol=0.02)
    np.testing.assert_allclose(body.added_mass[1], 7.12)
    thrust = vehicle.thrusters[0].forward[0] / bluerov2().hydrodynamics.thrusters[0].forward[0]
    np.testing.assert_allclose(thrust, 1.0 * result.values[-1], rtol=1e-5)
    assert "Identified by uwsim" in vehicle.source
    assert "von Benzon" in vehicle.source
    assert "<!-- added_mass[surge]: 6.3" in path.read_text()


def test_an_axis_that_was_never_excited_is_named_with_a_manoeuvre() -> None:
    names = ("added_mass[surge]", "quadratic_damping[yaw]")
    settings = replace(QUICK, free_names=names, n_folds=0)
    result = identify([log_of(NO_YAW)], bluerov2(), settings)
    assert [estimate.is_determined for estimate in result.uncertainty.estimates] == [True, False]
    assert any("quadratic_damping[yaw] is not determined" in text for text in list_warnings(result))
    assert any("yaw" in text and "zig-zag" in text for text in result.advice)


def test_forces_that_are_known_up_to_a_factor_are_named_together() -> None:
    names = ("mass", "inertia", "added_mass", "drag", "thrust", "buoyancy")
    result = identify(
        [log_of()], bluerov2(), replace(QUICK, free_names=names, n_starts=1, n_folds=0)
    )
    directions = result.uncertainty.weak_directions
    sums = [set(direction.names) for direction in directions if len(direction.names) == 2]
    for axis in ("roll", "pitch", "yaw"):
        assert {f"inertia[{axis}]", f"added_mass[{axis}]"} in sums
    factor = next(set(d.names) for d in directions if "thrust" in d.names)
    assert {"mass", "buoyancy", "added_mass[surge]", "quadratic_damping[surge]"} <= factor
    assert any("bollard pull" in text or "weigh" in text for text in result.advice)


def test_outliers_hardly_change_the_fit_with_the_loss_huber() -> None:
    motion = log_of().motion
    assert motion is not None
    assert motion.twists is not None
    twists = motion.twists.copy()
    twists[::23, :3] += 0.5
    log = replace(log_of(), motion=replace(motion, twists=twists))
    noise = {"position": 0.005, "attitude": 0.0035, "velocity": 0.003, "angular_velocity": 0.00175}
    result = fit(log, loss="huber", noise=noise, n_starts=1, n_folds=0)
    np.testing.assert_allclose(result.values, true_values(result), rtol=0.05)


@pytest.mark.slow
def test_intervals_cover_the_truth_in_several_runs() -> None:
    """Few runs of what ``benchmarks/identification.py`` does with fifty."""
    from benchmarks.identification import CLOSE, run

    rows = [run("bluerov2_heavy", seed, 60.0)[1] for seed in range(4)]
    errors = np.array([row.errors for row in rows])
    is_covered = np.array([row.is_covered for row in rows])
    assert ((np.abs(errors) <= CLOSE) | is_covered).mean() >= 0.9
    assert is_covered.mean() >= 0.8


def test_coefficients_of_a_vehicle_at_rest_are_not_determined() -> None:
    """Simulate one of the logs of ``benchmarks/identification.py --motion rest``."""
    from benchmarks.identification import cover_idle

    flags = cover_idle("bluerov2_heavy", 3, "rest")
    assert set(flags) <= {"buoyancy"}
    assert all(flags.values())
