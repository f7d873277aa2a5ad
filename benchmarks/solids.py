"""Measure a scene of large solid meshes: its first and further openings, and its step.

Terrain of 84 050 triangles, nine rocks of 5 120, a pipe of 16 640, all solid, and a Girona 500 with
its arm, as in `steps.py`. Each opening is in a process of its own, after one that compiled uwsim's
code and read no file of the scene; ``first`` begins with an empty cache of meshes and models.
Targets, CPU time: 3 s the first time, 0.5 s again, a step of at most 1.5 times that over a flat
floor. One JSON on stdout.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median

import numpy as np
import numpy.typing as npt
from measure import main, upper_target_figure
from steps import LISTENER, VEHICLE, write_scene

FIRST_S, AGAIN_S, STEP_RATIO = 3.0, 0.5, 1.5
RUNS = 5
SCENE_CACHES = ("meshes", "fixed-meshes", "polygons", "compiled")
"""The caches on disk of data computed from the files of a scene."""
CELLS = 205
"""The number of cells of the terrain along each side."""
OBJECT = """
  <object> <name>{name}</name> <file>{name}.stl</file>
    <position> <x>{x}</x> <y>{y}</y> <z>{z}</z> </position> <u:solid>1</u:solid> </object>"""
OPEN_PROGRAM = """
import json, sys, time
sys.path.insert(0, sys.argv[2])
import steps
import uwsim
from uwsim.scene.reader import read_scene
uwsim.load
began = time.process_time()
simulation = uwsim.load(read_scene(sys.argv[1]).nominal_scene)
opened = time.process_time() - began
steps.drive(simulation, 1, 50)
batches = sorted(steps.drive(simulation, 1, 40) for _ in range(9))
print(json.dumps({"open_s": opened, "step_us": 1e6 * batches[4] / 200,
                  "shapes": simulation.world.engine._model.ngeom}))
"""

Array = npt.NDArray[np.float64]


def terrain(rng: np.random.Generator) -> Array:
    """Return dunes and grit over 60 x 60 m, (n, 3, 3) [m]."""
    x = np.linspace(-30.0, 30.0, CELLS + 1)
    heights = 0.6 * np.sin(0.3 * x)[None, :] * np.cos(0.2 * x)[:, None]
    heights = heights + 0.05 * rng.uniform(-1.0, 1.0, heights.shape)
    points = np.stack([*np.meshgrid(x, x), heights], axis=2)
    return quads(points)


def quads(points: Array) -> Array:
    """Return two triangles for each cell of a grid of points, (n, 3, 3)."""
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]
    triangles = np.stack([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)], axis=2)
    return triangles.reshape(-1, 3, 3)


def rock(rng: np.random.Generator) -> Array:
    """Return a ball of 5120 triangles, about 1 m in radius, with bumps and hollows."""
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=4)
    radii = np.ones(len(ball.vertices))
    for _ in range(12):
        wave = 2.0 * rng.normal(size=3)
        radii += 0.08 * np.sin((ball.vertices * wave).sum(axis=1) + rng.uniform(0.0, 6.0))
    corners = ball.vertices * radii[:, None] * np.array([1.0, 0.8, 0.6])
    return np.asarray(corners[ball.faces])


def pipe(rng: np.random.Generator) -> Array:
    """Return a pipe of 8 m along x, 0.5 m in radius, with a wall of 0.1 m."""
    angles, positions = np.linspace(0.0, 2.0 * np.pi, 65), np.linspace(-4.0, 4.0, 65)

    def ring(radius: float, x: float) -> Array:
        return np.column_stack([np.full(65, x), radius * np.cos(angles), radius * np.sin(angles)])

    outer_surface = np.stack([ring(0.5, x) for x in positions])
    inner_surface = np.stack([ring(0.4, x) for x in positions[::-1]])
    ends = [
        np.stack([inner_surface[-1], outer_surface[0]]),
        np.stack([outer_surface[-1], inner_surface[0]]),
    ]
    return np.concatenate([quads(part)[:, ::-1] for part in (outer_surface, inner_surface, *ends)])


def write_stl(path: Path, triangles: Array) -> None:
    """Write triangles (n, 3, 3) [m] as a binary STL file."""
    record = np.zeros(
        len(triangles), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("", "V2")]
    )
    record["corners"] = triangles
    path.write_bytes(bytes(80) + len(triangles).to_bytes(4, "little") + record.tobytes())


def write_solid_scene(folder: Path) -> Path:
    """Write the scene and its meshes; the same bytes each time."""
    rng = np.random.Generator(np.random.Philox(26))
    makers: dict[str, tuple[Callable[[np.random.Generator], Array], tuple[float, float, float]]]
    makers = {"terrain": (terrain, (0.0, 0.0, -4.0))}
    for k in range(9):
        makers[f"rock{k}"] = (rock, (6.0 * (k % 3) - 9.0, 6.0 * (k // 3) - 10.0, -4.0))
    makers["pipe"] = (pipe, (6.0, 5.0, -3.5))
    objects = ""
    for name, (make, (x, y, z)) in makers.items():
        write_stl(folder / f"{name}.stl", make(rng))
        objects += OBJECT.format(name=name, x=x, y=y, z=z)
    path = folder / "solids.xml"
    path.write_text(
        '<?xml version="1.0"?>\n<UWSimScene xmlns:u="urn:uwsim:1">'
        + VEHICLE.format(i=0, x=0, y=0, z=-1.2)
        + objects
        + f"<rosInterfaces>{LISTENER.format(i=0)}</rosInterfaces></UWSimScene>\n"
    )
    return path


def open_in_process(scene: Path, home: Path, *, is_first: bool) -> dict[str, float]:
    """Open the scene in a new process."""
    if is_first:
        for kind in SCENE_CACHES:
            shutil.rmtree(home / "uwsim" / kind, ignore_errors=True)
    variables = os.environ | {"XDG_CACHE_HOME": str(home)}
    command = [sys.executable, "-c", OPEN_PROGRAM, str(scene), str(Path(__file__).parent)]
    process = subprocess.run(command, env=variables, check=True, capture_output=True, text=True)
    return dict(json.loads(process.stdout.splitlines()[-1]))


def measure() -> dict[str, object]:
    """Measure openings and steps; each figure is a median."""
    with tempfile.TemporaryDirectory() as name:
        folder, home = Path(name), Path(name) / "cache"
        scene, flat_scene = write_solid_scene(folder), write_scene("flat floor", folder)
        open_in_process(scene, home, is_first=True)
        first_runs = [open_in_process(scene, home, is_first=True) for _ in range(RUNS)]
        further_runs = [open_in_process(scene, home, is_first=False) for _ in range(RUNS)]
        floor_runs = [open_in_process(flat_scene, home, is_first=False) for _ in range(RUNS)]
    steps = [median(figures["step_us"] for figures in runs) for runs in (further_runs, floor_runs)]
    return {
        "open the first time [s]": upper_target_figure(
            median(figures["open_s"] for figures in first_runs), FIRST_S
        ),
        "open again [s]": upper_target_figure(
            median(figures["open_s"] for figures in further_runs), AGAIN_S
        ),
        "step by that over a flat floor": upper_target_figure(steps[0] / steps[1], STEP_RATIO),
        "step [us]": round(steps[0], 2),
        "shapes": further_runs[0]["shapes"],
    }


if __name__ == "__main__":
    main(measure)
