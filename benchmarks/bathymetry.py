"""Measure a scene with a large chart: opening, memory, steps, and the rays of a multibeam.

Run ``python benchmarks/bathymetry.py``. A synthetic chart of 10 x 10 km at 5 m (4 million nodes) is
the sea floor of the scene `survey-scene`, without its objects. The scene is opened in processes of
their own: the first fills the caches, the next is measured. Steps are compared with a chart of the
same size and two nodes along each side, a flat floor; runs take turns, and the least counts.

Targets: opening within 5 s of CPU and 1 GB, 1.3 times the steps of the flat floor, 0.2 ms for the
512 rays of a ping. One JSON on stdout.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from measure import main, milliseconds, upper_target_figure

from uwsim.assets.bundled import scene_file
from uwsim.base.geometry import Pose
from uwsim.bathymetry.chart import Chart
from uwsim.bathymetry.chart_files import write_chart
from uwsim.bathymetry.height_grid import HeightGrid
from uwsim.bathymetry.synthetic import SyntheticFloor, make_floor
from uwsim.model.terrain import height_rays
from uwsim.rays import RayScene

FLOOR = SyntheticFloor(
    width=10_000.0, height=10_000.0, spacing=5.0, depth=40.0, roughness=5.0, corner=1500.0, seed=2
)
N_BEAMS, FAN = 512, 65.0
"""The number of beams of a ping, and the greatest angle of a beam from the vertical [deg]."""
OPENING_PROGRAM = """
import json, resource, sys, time
wall, cpu = time.perf_counter(), time.process_time()
import uwsim
with uwsim.load(sys.argv[1]) as simulation:
    figures = {"cpu_s": time.process_time() - cpu, "wall_s": time.perf_counter() - wall}
    simulation.advance(1.0)
    times = []
    for _ in range(7):
        cpu = time.process_time()
        simulation.advance(5.0)
        times.append(time.process_time() - cpu)
    figures["step_us"] = min(times) / 5.0 * simulation.timestep * 1e6
    figures["gigabytes"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
print(json.dumps(figures))
"""


def open_scene(file: Path) -> dict[str, float]:
    """Open a scene in a process of its own; return CPU and wall time, steps and memory."""
    process = subprocess.run(
        [sys.executable, "-c", OPENING_PROGRAM, str(file)],
        capture_output=True,
        text=True,
        check=True,
    )
    figures: dict[str, float] = json.loads(process.stdout)
    return figures


def write_scene(folder: Path, name: str, chart: Chart) -> Path:
    """Write a chart, and the scene with it as sea floor."""
    write_chart(folder / f"{name}.tif", chart)
    text = scene_file("survey-scene").read_text(encoding="utf-8")
    text = re.sub(r"<object>.*</rosInterfaces>", "", text, flags=re.DOTALL)
    zeros = "<x>0</x> <y>0</y> <z>0</z>"
    floor = (
        f"<object> <name>terrain</name> <file>{name}.tif</file> <position> {zeros} </position> "
        "<orientation> <r>0</r> <p>0</p> <y>0</y> </orientation> <u:bathymetry/> </object>"
    )
    file = folder / f"{name}.xml"
    file.write_text(text.replace("</UWSimScene>", f"{floor}</UWSimScene>"), encoding="utf-8")
    return file


def measure() -> dict[str, object]:
    """Return the figures."""
    chart = make_floor(FLOOR)
    flat_heights = np.full((2, 2), -FLOOR.depth, np.float32)
    corners = Chart(x=chart.x, y=chart.y, step_x=10_000.0, step_y=10_000.0, heights=flat_heights)
    with tempfile.TemporaryDirectory() as folder:
        charts = {"large": chart, "flat": corners}
        files = [write_scene(Path(folder), name, heights) for name, heights in charts.items()]
        runs = [[open_scene(file) for file in files] for _ in range(4)][1:]
    figures = {key: min(run[0][key] for run in runs) for key in runs[0][0]}
    flat_step = min(run[1]["step_us"] for run in runs)
    grid = HeightGrid(west=chart.x, south=chart.y, spacing=chart.step_x, heights=chart.heights)
    scene = RayScene([], [height_rays(grid, 0)])
    angles = np.radians(np.linspace(-FAN, FAN, N_BEAMS))
    beams = np.stack([np.zeros(N_BEAMS), np.sin(angles), -np.cos(angles)], axis=1)
    sonar = Pose(np.array([3.0, 700.0, -10.0]), np.eye(3))
    return {
        "open_cpu_s": upper_target_figure(figures["cpu_s"], 5.0),
        "open_wall_s": figures["wall_s"],
        "memory_gigabytes": upper_target_figure(figures["gigabytes"], 1.0),
        "step_us": figures["step_us"],
        "step_us_flat": flat_step,
        "step_ratio": upper_target_figure(figures["step_us"] / flat_step, 1.3),
        "ping_ms": milliseconds(lambda: scene.cast(sonar, beams, 200.0), target=0.2),
    }


if __name__ == "__main__":
    main(measure)
