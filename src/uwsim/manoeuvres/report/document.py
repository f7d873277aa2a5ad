"""The numbers of a report as JSON, and its tracks as CSV."""

from __future__ import annotations

import dataclasses
import json
import math
from typing import Any

import numpy as np

from ...benchmark.metrics.manoeuvres import ManoeuvreTrack
from ...version import __version__
from ..experiment import Experiment
from ..tank import TankResults
from ..trials import TrialResults

FORMAT = 1
"""The version of the format."""
TRACK_COLUMNS = (
    "time_s", "north_m", "east_m", "depth_m", "heading_rad", "surge_m_s", "sway_m_s",
    "yaw_rate_rad_s", "rudder_rad",
)  # fmt: skip
"""The columns of a track's file."""


def json_text(
    experiment: Experiment, trials: TrialResults, tank: TankResults | None, source: str
) -> str:
    """Return ``manoeuvres.json``: the same scene gives the same bytes."""
    document: dict[str, Any] = {
        "uwsim_manoeuvres": FORMAT,
        "version": __version__,
        "scene": source,
        "vehicle": experiment.vehicle,
        "length": experiment.length,
        "steering": dict(experiment.parameters),
        "turning_circles": [simplify(turn) for turn in trials.turns],
        "zigzags": [simplify(zigzag) for zigzag in trials.zigzags],
        "spiral": simplify(trials.spiral),
        "pull_out": {
            **simplify(trials.pull_out),
            "residual_rate": trials.pull_out.residual_rate,
        },
        "crash_stop": simplify(trials.stop),
        "criteria": [
            {**simplify(criterion), "is_met": criterion.is_met} for criterion in trials.criteria
        ],
    }
    if tank is not None:
        document["tank"] = {
            "tows": [simplify(tow) for tow in tank.tows],
            "bollard_pull": {
                "commands": tank.commands.tolist(),
                "pulls": tank.pulls.tolist(),
            },
            "decays": [
                {
                    "axis": record.axis,
                    "file_period": record.file_period,
                    "decay": None if record.decay is None else simplify(record.decay),
                }
                for record in tank.decays
            ],
        }
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def simplify(value: Any) -> Any:
    """Return a dataclass or an array as dictionaries, lists and numbers; None for infinity."""
    if dataclasses.is_dataclass(value):
        return {
            field.name: simplify(getattr(value, field.name)) for field in dataclasses.fields(value)
        }
    if isinstance(value, np.ndarray):
        return [simplify(item) for item in value.tolist()]
    if isinstance(value, tuple | list):
        return [simplify(item) for item in value]
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    return value


def track_text(track: ManoeuvreTrack) -> str:
    """Return a track as CSV; the manoeuvre begins at time 0."""
    columns = (
        track.times, track.positions[:, 0], track.positions[:, 1], track.depths, track.headings,
        track.surge, track.sway, track.yaw_rates, track.rudders,
    )  # fmt: skip
    lines = [",".join(f"{value:.6f}" for value in row) for row in zip(*columns, strict=True)]
    return "\n".join([",".join(TRACK_COLUMNS), *lines]) + "\n"
