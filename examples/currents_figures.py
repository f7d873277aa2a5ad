"""Draw the figures of the UWSim benchmarking paper's second experiment: P and PI in a current.

    python examples/currents_figures.py FOLDER                      two minutes on two cores
    python examples/currents_figures.py FOLDER --quick              short levels, for CI
    python examples/currents_figures.py FOLDER --sweep DIR DIR ...  also error over current,
                                     from results of ``uwsim bench currents``, any number of seeds

2: the scene, the current as an arrow, the camera image as an inset. 12: distance to the
objective. 13, 14: its two components, right and up in the camera image. 15: the tracker's
error. The objective is the position at which the tracked centroid is in the image centre.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from paper.figures import draw_image_with_inset
from paper.station_figures import Line, draw_over_current, draw_over_time
from paper.station_keeping import (
    Loop,
    StationError,
    SwingingCurrent,
    Track,
    measure_error,
    predict_error,
    read_level_track,
    settled_error,
)
from uwsim.analysis.plots import save_plot
from uwsim.api import load as load_scene
from uwsim.assets.bundled import benchmark_file
from uwsim.assets.find import find
from uwsim.base.geometry import Array, Intrinsics, Pose
from uwsim.cli import main as uwsim
from uwsim.errors import ResultError
from uwsim.results.log import load_log
from uwsim.results.result import Result
from uwsim.results.result_file import load

BENCHMARK, SCENE, CAMERA, SEED = "currents-figures.xml", "currents-scene.xml", "bowtech1", 1
FOVY = math.radians(50.0)
LEVELS = {0.0: "no current", 0.2: "0.2 m/s"}
EYE, TARGET = (-1.4, -0.2, -1.2), (1.5, 2.9, -2.7)  # of the viewer, in W [m]
SETTLING_TIME = 2.0  # of a level, before its measures start [s]
CAMERA_SETTING = "vehicle[girona500].virtualCamera[bowtech1]"


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the figures of the currents experiment.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--quick", action="store_true", help="short levels, for CI")
    parser.add_argument("--sweep", type=Path, nargs="+", default=[], help="result directories")
    options = parser.parse_args()
    folder: Path = options.folder
    folder.mkdir(parents=True, exist_ok=True)
    draw_scene(folder)
    draw_levels(folder, is_quick=options.quick)
    if options.sweep:
        draw_sweep(folder, options.sweep)


# ------------------------------------------------------------------ 2: the scene


def draw_scene(folder: Path) -> None:
    path = find(SCENE)
    assert path is not None
    simulation = load_scene(path, seed=SEED)
    viewer = Intrinsics.from_fovy(1320, 990, math.radians(60.0), near=0.1)
    eye = camera_pose(EYE, TARGET)
    try:
        camera = simulation.world.sensors.camera(CAMERA)
        scene_image = simulation.world.scenery.render_clean(eye, viewer).colour[..., :3]
        camera_image = simulation.world.scenery.render_clean(
            camera.world_from_camera, camera.intrinsics
        ).colour[..., :3]
        # The mean current flows along y of the scene's frame, from stern to bow.
        base = simulation.world.model.scene.world_from_localized.inverse().transform(
            simulation.world.bodies.find("girona500").world_from_body.position[None]
        )[0]
        ends = base + np.array([[0.0, -0.9, -0.75], [0.0, 0.9, -0.75]])  # above the vehicle
        world = simulation.world.model.scene.world_from_localized.transform(ends)
    finally:
        simulation.close()
    figure = draw_image_with_inset(scene_image, camera_image, share=0.30)
    tail, tip = (pixel(eye, viewer, point) for point in world)
    figure.axes[0].annotate(
        "", tip, tail, arrowprops={"arrowstyle": "-|>,head_width=0.5,head_length=0.9",
                                   "color": "#E69F00", "linewidth": 3.0},
    )  # fmt: skip
    figure.axes[0].annotate(
        "current", tail, xytext=(0, 7), textcoords="offset points", color="#E69F00", ha="center"
    )
    save_plot(figure, folder / "figure-02-scene.png")


def camera_pose(eye: tuple[float, float, float], target: tuple[float, float, float]) -> Pose:
    """Return the pose in W of an upright camera at ``eye`` that points at ``target`` [m]."""
    back = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    return Pose(np.array(eye), np.stack([right, np.cross(back, right), back], axis=1))


def pixel(eye: Pose, viewer: Intrinsics, point: Array) -> tuple[float, float]:
    """Project a point of W [m] to the viewer's image [px]."""
    x, y, z = eye.inverse().transform(point[None])[0]
    return viewer.pixel(x, y, z)


# ------------------------------------------------------------------ 12-15: over time


def draw_levels(folder: Path, *, is_quick: bool) -> None:
    results = {name: run_benchmark(name, folder, is_quick=is_quick) for name in ("p", "pi")}
    runs: dict[tuple[str, float], tuple[Loop, Track]] = {}
    for name, result in results.items():
        for level in LEVELS:
            runs[name, level] = (
                read_gains(result),
                read_track(result, folder / f"{name}.result", level),
            )
    if not is_quick:
        print(
            format_table(
                {
                    key: (loop, measure_error(level_track))
                    for key, (loop, level_track) in runs.items()
                }
            )
        )
    window = {"start": 5.0, "period": 4.0} if is_quick else {}
    theory_note = "thin lines: theory, once settled"

    def draw(number: int, name: str, label: str, select: Callable[[Array], Array]) -> None:
        panels = {}
        for level, title in LEVELS.items():
            lines = []
            for controller in results:
                loop, level_track = runs[controller, level]
                error_along, error_across = settled_error(
                    loop, SwingingCurrent(speed=level), level_track.time + SETTLING_TIME
                )
                theory = select(np.stack([error_across, error_along], axis=1))
                theory = np.where(level_track.time >= 30.0, theory, np.nan)
                values = select(level_track.error(level_track.reference(**window)))
                lines.append(
                    Line(
                        name=controller.upper(), time=level_track.time, values=values, theory=theory
                    )
                )
            panels[title] = lines
        figure = draw_over_time(panels, label=label, theory=theory_note)
        save_plot(figure, folder / f"figure-{number}-{name}.png")

    draw(12, "distance", "distance to the objective [m]", lambda e: np.hypot(e[:, 0], e[:, 1]))
    draw(13, "error-x", "X error, right in the image [m]", lambda e: e[:, 0])
    draw(14, "error-y", "Y error, up in the image [m]", lambda e: e[:, 1])
    panels = {}
    for level, title in LEVELS.items():
        tracks = {name.upper(): runs[name, level][1] for name in results}
        panels[title] = [
            Line(name=name, time=level_track.time, values=level_track.tracker_error)
            for name, level_track in tracks.items()
        ]
    note = "estimate and projected origin of the box, in the image"
    figure = draw_over_time(panels, label="error of the tracked centroid [px]", note=note)
    save_plot(figure, folder / "figure-15-tracker.png")


def run_benchmark(controller: str, folder: Path, *, is_quick: bool) -> Result:
    """Run a benchmark as ``uwsim bench`` does."""
    benchmark, settings = BENCHMARK.removesuffix(".xml"), []
    if is_quick:
        text = (
            benchmark_file(benchmark, ()).read_text().replace("<interval>120<", "<interval>10.2<")
        )
        benchmark = str(folder / BENCHMARK)
        Path(benchmark).write_text(text)
        settings = ["--set", f"{CAMERA_SETTING}.resw=320", "--set", f"{CAMERA_SETTING}.resh=240"]
    out = folder / f"{controller}.result"
    command = ["bench", benchmark, "--scene", SCENE, "--algorithm", controller, *settings]
    command += ["--seed", str(SEED), "--workers", "2", "--out", str(out), "--overwrite"]
    status = uwsim(command)
    if status != 0:
        raise SystemExit(status)
    return load(out)


def read_track(result: Result, directory: Path, level: float, seed: int | None = None) -> Track:
    """Read a level of a run from the logs in its directory."""
    names = ("centroid", "objectCentered", "offset")
    logs = {name: load_log(directory / f"measure-{name}.csv") for name in names}
    height = float(dict(result.run.settings or ()).get(f"{CAMERA_SETTING}.resh", 480))
    focal = height / 2.0 / math.tan(FOVY / 2.0)
    return read_level_track(result, logs, level=level, focal=focal, seed=seed)


def read_gains(result: Result) -> Loop:
    """Read the gains from a result."""
    parameters = result.run.parameters
    return Loop(kp=float(parameters["kp"]), ki=float(parameters.get("ki", 0.0)))


def format_table(stations: dict[tuple[str, float], tuple[Loop, StationError]]) -> str:
    """Format the table of measured and theoretical values."""
    head = ("controller", "current", "along: mean", "theory", "across: amplitude", "theory")
    rows: list[Sequence[str]] = [head]
    for (name, level), (loop, station) in stations.items():
        theory = predict_error(loop, SwingingCurrent(speed=level))
        numbers = (station.along_mean, theory.along_mean)
        numbers += (station.across_amplitude, theory.across_amplitude)
        rows.append((name, f"{level:g} m/s", *(f"{number:.4f} m" for number in numbers)))
    return "\n".join("  ".join(f"{cell:>17}" for cell in row) for row in rows)


# ------------------------------------------------------------------ error over the current


def draw_sweep(folder: Path, directories: Sequence[Path]) -> None:
    """Draw the mean error along and the amplitude across of every completed level."""
    stations: dict[str, dict[float, list[StationError]]] = {}
    loops: dict[str, Loop] = {}
    known_levels = set()
    for directory in directories:
        result = load(directory)
        name = str(result.run.algorithm).upper()
        if loops.setdefault(name, read_gains(result)) != read_gains(result):
            raise SystemExit(f"{directory}: other gains than the results of {name} before it.")
        seeds = result.numbers("seed") if result.run.repeats > 1 else [None] * len(result.rows)
        for level, seed in zip(result.numbers("current"), seeds, strict=True):
            assert level is not None
            key = name, level, result.run.seed if seed is None else seed
            if key in known_levels:
                continue
            known_levels.add(key)
            try:
                level_track = read_track(
                    result, directory, level, None if seed is None else int(seed)
                )
                station = measure_error(level_track)
            except ResultError as error:
                print(f"{directory}: current {level:g}: {error}")
                continue
            stations.setdefault(name, {}).setdefault(level, []).append(station)
    save_plot(draw_over_current(stations, loops), folder / "error-over-current.png")


if __name__ == "__main__":
    main()
