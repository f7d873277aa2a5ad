"""Rows of the bundled BlueROV2 heavy that hold a station, for the tests of this folder."""

from __future__ import annotations

from functools import cache

from tests.physics.water_models import bundled
from uwsim.envs.batch.rows import Rows
from uwsim.envs.batch.task import Channel, RowTask, Term, Trajectory
from uwsim.physics.hydrodynamics.free_vehicle import free_vehicle
from uwsim.physics.hydrodynamics.kernel.free_step import FreeVehicle

LEVEL = (0.0, 1.0, 0.0, 0.0)  # the z axis of the base points down
RANGES = {
    "start_x": (-1.0, 1.0),
    "start_yaw": (-0.5, 0.5),
    "current_speed": (0.0, 0.3),
    "current_heading": (-3.0, 3.0),
}
FACTORS = {"mass": (0.9, 1.1), "drag": (0.7, 1.3), "thrust": (0.8, 1.1), "delay": (0.0, 3.0)}


@cache
def bluerov2() -> FreeVehicle:
    model, _ = bundled("bluerov2_heavy", z_down=True)
    return free_vehicle(model, 1)


def station_task(**changes: object) -> RowTask:
    """Return a task of holding a point 10 m below the surface."""
    settings: dict[str, object] = {
        "channels": (
            Channel(name="position_error"),
            Channel(name="attitude_error"),
            Channel(name="linear_velocity"),
            Channel(name="angular_velocity"),
            Channel(name="last_action"),
        ),
        "terms": (
            Term(name="constant"),
            Term(name="capped_distance", weight=-1.0),
            Term(name="change", weight=-0.01),
        ),
        "trajectory": Trajectory(centre=(1.0, 2.0, -10.0), level=LEVEL),
        "ranges": RANGES,
        **changes,
    }
    return RowTask(**settings)  # type: ignore[arg-type]


def station_rows(n: int, threads: int = 1, **changes: object) -> Rows:
    return Rows(bluerov2(), station_task(**changes), n, threads=threads)
