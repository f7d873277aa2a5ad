"""Synthetic results like those of the bundled benchmarks (no module under test)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from uwsim.results.inputs import Inputs
from uwsim.results.result import Cell, Column, ImageStream, MissingValue, Result
from uwsim.results.run_info import RunInfo

S, SIGMA, D, ZNCC = 30.8, 5.1, 1.304, 0.5
F_STAR = math.sqrt(math.log(S * math.sqrt(1 / ZNCC**2 - 1) / SIGMA)) / D
LOSS_REASON = "tracker lost at 47.83 s: ZNCC 0.48 on 5 frames in a row"


def visibility_result(
    algorithm: str = "esm",
    *,
    seeds: tuple[int, ...] = (1,),
    lost_at: float = 1.2,
    gain: float = 1.0,
) -> Result:
    """Return a sweep of fog whose error grows as 1/T with the transmission T, until a loss."""
    columns = [
        Column(name="fog", kind="level", unit="1/m"),
        Column(name="corners", kind="measure", unit="px"),
        Column(name="corners.mean", kind="detail", unit="px"),
        Column(name="corners.max", kind="detail", unit="px"),
        Column(name="corners.n", kind="detail"),
        Column(name="centroid", kind="measure", unit="px"),
        Column(name="total", kind="score", expression="corners+centroid"),
        Column(name="status", kind="status"),
        Column(name="ended_at", kind="time", unit="s"),
    ]
    is_repeated = len(seeds) > 1
    if is_repeated:
        columns = [Column(name="repeat", kind="run"), Column(name="seed", kind="run"), *columns]
    rows: list[tuple[Cell, ...]] = []
    missing_values: list[MissingValue] = []
    for repeat, seed in enumerate(seeds):
        rng = np.random.Generator(np.random.Philox(seed))
        loss = lost_at + 0.05 * int(rng.integers(-1, 2)) * is_repeated
        for i in range(27):
            fog = i * 0.05
            lead = (repeat, seed) if is_repeated else ()
            if fog > loss - 1e-9:
                missing_values += [
                    MissingValue(row=len(rows), column=name, reason=LOSS_REASON)
                    for name in ("corners", "centroid", "total")
                ]
                rows.append((*lead, fog, *(None,) * 6, "lost", 2.0 * (i + 1)))
                continue
            noise = math.exp((fog * D) ** 2) * gain
            corners = 1.05 + 0.16 * noise * float(1 + 0.25 * rng.standard_normal())
            centroid = 0.35 + 0.05 * noise * float(1 + 0.25 * rng.standard_normal())
            measured_values = (corners, corners, corners * 1.6, 60, centroid, corners + centroid)
            rows.append((*lead, fog, *measured_values, "ok", 2.0 * (i + 1)))
    return Result(
        inputs=Inputs(
            benchmark=("visibility.xml", "sha256:" + "3f" * 32),
            scene=("visibility-scene.xml", "sha256:" + "a0" * 32),
            assets={"objects/blackbox_uib_trimesh.osg": "sha256:" + "77" * 32},
        ),
        run=RunInfo(
            seed=seeds[0],
            repeats=len(seeds),
            mode="sequential",
            algorithm=algorithm,
            parameters={"threshold": 0.5, "levels": 3},
            timestep=(0.002, "s"),
            version="0.1.0",
            physics="mujoco 4.0.0",
            renderer="moderngl 5.12, llvmpipe (LLVM 15.0.6, 256 bits)",
        ),
        columns=tuple(columns),
        rows=tuple(rows),
        missing_values=tuple(missing_values),
        facts={
            "S": (S, "grey level"),
            "sigma": (SIGMA, "grey level"),
            "d": (D, "m"),
            "f_star": (F_STAR, "1/m"),
            "shift": (0.0, "px"),
        },
        image_streams=tuple(
            ImageStream(seed=s, level=None, topic="/uwsim/camera1", frames=1621, sha256="c4" * 32)
            for s in seeds
        ),
    )


def frozen_result() -> Result:
    """Return the result of an algorithm that repeats its initial estimate, and is never lost."""
    result = visibility_result("frozen")
    rows = tuple((row[0], 0.0, 0.0, 0.0, 60, 0.4, 0.4, "ok", row[-1]) for row in result.rows)
    return replace(result, rows=rows, missing_values=())


def lost_result() -> Result:
    """Return a result whose levels are all lost."""
    return visibility_result(lost_at=0.0)


def one_level_result() -> Result:
    """Return the result of a benchmark without an updater: one row."""
    result = visibility_result()
    return replace(
        result,
        columns=(Column(name="none", kind="level"), *result.columns[1:]),
        rows=((1.0, *result.rows[0][1:]),),
        missing_values=(),
        facts={},
    )


def nested_result() -> Result:
    """Return a result of fog within current: two level columns."""
    result = visibility_result()
    rows, missing_values = [], []
    for current in (0.0, 0.1, 0.2):
        for note in result.missing_values:
            missing_values.append(replace(note, row=note.row + len(rows)))
        for row in result.rows:
            scaled_values = [v * (1 + 4 * current) if isinstance(v, float) else v for v in row[1:7]]
            rows.append((current, row[0], *scaled_values, *row[7:]))
    return replace(
        result,
        columns=(Column(name="current", kind="level", unit="m/s"), *result.columns),
        rows=tuple(rows),
        missing_values=tuple(missing_values),
        facts={},
    )
