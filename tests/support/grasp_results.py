"""Synthetic results of a grasping benchmark over fog and current (no module under test)."""

from __future__ import annotations

from uwsim.results.inputs import Inputs
from uwsim.results.result import Cell, Column, MissingValue, Result
from uwsim.results.run_info import RunInfo

FOGS, CURRENTS = (0.0, 0.5, 1.0), (0.0, 0.1, 0.2, 0.3)


def is_successful(fog: float, current: float, seed: int) -> bool:
    """Return whether a seed succeeds; the fraction of seeds falls with fog and current."""
    return seed < 4.5 - 3.0 * fog - 10.0 * current


def grasping_result(n_seeds: int = 4) -> Result:
    columns = [
        Column(name="repeat", kind="run"),
        Column(name="seed", kind="run"),
        Column(name="fog", kind="level", unit="1/m"),
        Column(name="current", kind="level", unit="m/s"),
        Column(name="success", kind="measure", unit="1"),
        Column(name="success.slip", kind="detail", unit="m"),
        Column(name="success.time_done", kind="detail", unit="s"),
        Column(name="success.phase", kind="detail", unit="1"),
        Column(name="success.time.search", kind="detail", unit="s"),
        Column(name="success.time.lift", kind="detail", unit="s"),
        Column(name="time", kind="measure", unit="s"),
        Column(name="total", kind="score", expression="time"),
        Column(name="status", kind="status"),
        Column(name="ended_at", kind="time", unit="s"),
    ]
    rows: list[tuple[Cell, ...]] = []
    missing_values: list[MissingValue] = []
    for seed in range(n_seeds):
        for fog in FOGS:
            for current in CURRENTS:
                level = (seed, seed, fog, current)
                if is_successful(fog, current, seed):
                    duration = 40.0 + 10.0 * seed
                    details = (0.001 + 0.001 * seed, duration, 6.0, 10.0 + 40.0 * fog, 15.0)
                    rows.append((*level, 1.0, *details, duration, duration, "ok", duration))
                    continue
                names = ("success.slip", "success.time_done", "total")
                missing_values += [
                    MissingValue(row=len(rows), column=n, reason="not held") for n in names
                ]
                status = "not found" if fog == 1.0 else "dropped"
                details = (None, None, 1.0, 100.0, 0.0)
                rows.append((*level, 0.0, *details, 240.0, None, status, 240.0))
    return Result(
        run=RunInfo(
            version="0.2.0", seed=0, repeats=n_seeds, mode="independent", algorithm="grasp"
        ),
        inputs=Inputs(
            benchmark=("grasp.xml", "sha256:" + "3f" * 32),
            scene=("grasp-scene.xml", "sha256:" + "a0" * 32),
            assets={},
        ),
        columns=tuple(columns),
        rows=tuple(rows),
        missing_values=tuple(missing_values),
    )
