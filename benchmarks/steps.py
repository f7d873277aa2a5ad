"""Steps per second of the public `Simulation`, with commands on the bus, in scenes that grow.

Run ``python benchmarks/steps.py [NAME ...]``; `benchmarks/physics.py` has the same rows. Every
vehicle is a Girona 500 with its arm that gets a twist on its topic a hundred times a second; the
step is 2 ms. ``engine_us`` is MuJoCo's own step of the same model from the same state without any
water; ``ratio`` is what a whole step of the simulation costs beside it.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

import mujoco
import numpy as np
from measure import main

import uwsim
from uwsim.messages import Header, Time, Twist, TwistStamped, Vector3
from uwsim.physics.hydrodynamics import callback
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

PERIOD = 0.01
"""The period of the commands of a vehicle [s]."""
BATCHES = 7
BATCH_CPU_S = 0.6
"""The approximate CPU time of a batch [s]."""
CUBE = (0.15, 0.10, 0.075)  # half edges [m]
SEA_FLOOR_CORNERS = (44, 53)  # corners of the sea floor: 43 x 52 cells of two triangles are 4472
VEHICLE = """
  <vehicle> <name>v{i}</name> <file>data/scenes/g500ARM5.urdf</file>
    <jointValues> <joint>0</joint><joint>0</joint><joint>2.2</joint><joint>0</joint>
      <joint>0.8</joint> </jointValues>
    <position> <x>{x}</x> <y>{y}</y> <z>{z}</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <u:dynamics>g500_physical</u:dynamics>
  </vehicle>"""
OBJECT = """
  <object> <name>{name}</name> <file>{file}</file>
    <position> <x>{x}</x> <y>{y}</y> <z>{z}</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <physics> <mass>{mass}</mass> <collisionShapeType>{kind}</collisionShapeType> </physics>
  </object>"""
LISTENER = """
  <ROSTwistToPAT> <topic>/v{i}</topic> <vehicleName>v{i}</vehicleName> </ROSTwistToPAT>"""


def box_file(folder: Path, name: str, half: tuple[float, float, float]) -> str:
    """Write a box about the origin as an OBJ file."""
    corners = [
        (x, y, z)
        for x in (-half[0], half[0])
        for y in (-half[1], half[1])
        for z in (-half[2], half[2])
    ]
    faces = ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += ["f " + " ".join(map(str, face)) for face in faces]
    (folder / name).write_text("\n".join(lines) + "\n")
    return name


def sea_floor_file(folder: Path) -> str:
    """Write a sea floor of dunes and stones as an OBJ file, 26 x 21.5 m, z up."""
    rng = np.random.Generator(np.random.Philox(11))
    rows, columns = SEA_FLOOR_CORNERS
    x, y = 0.5 * np.arange(columns) - 13.0, 0.5 * np.arange(rows) - 10.75
    heights = 0.25 * np.sin(0.7 * x)[None, :] * np.cos(0.5 * y)[:, None]
    heights = np.round(heights + 0.06 * rng.uniform(-1.0, 1.0, (rows, columns)), 5)
    lines = [f"v {x[j]} {y[i]} {heights[i, j]}" for i in range(rows) for j in range(columns)]
    for i in range(rows - 1):
        for j in range(columns - 1):
            a = 1 + i * columns + j
            lines += [f"f {a} {a + 1} {a + columns + 1}", f"f {a} {a + columns + 1} {a + columns}"]
    (folder / "sea-floor.obj").write_text("\n".join(lines) + "\n")
    return "sea-floor.obj"


def floor(folder: Path) -> str:
    """Return a flat floor whose top is at z = -3."""
    file = box_file(folder, "floor.obj", (60.0, 60.0, 0.5))
    return OBJECT.format(name="floor", file=file, x=0, y=0, z=-3.5, mass=0, kind="box")


def sea_floor(folder: Path) -> str:
    """Return the sea floor at about z = -3."""
    file = sea_floor_file(folder)
    return OBJECT.format(name="terrain", file=file, x=0, y=0, z=-3, mass=0, kind="trimesh")


def tank(folder: Path) -> str:
    """Return the bundled CIRS tank, with its floor at about z = -3.5."""
    file = "terrain/CIRS/cirs_trident.osg"
    return OBJECT.format(name="terrain", file=file, x=0, y=0, z=-5, mass=0, kind="trimesh")


def fixed_boxes(folder: Path) -> str:
    """Return the flat floor and 1000 fixed boxes on it."""
    file = box_file(folder, "cube.obj", CUBE)
    places = [(0.8 * (k % 32) - 12.8, 0.8 * (k // 32) - 12.8) for k in range(1000)]
    boxes = [
        OBJECT.format(name=f"b{k}", file=file, x=x, y=y, z=-2.925, mass=0, kind="box")
        for k, (x, y) in enumerate(places)
    ]
    return floor(folder) + "".join(boxes)


def loose_boxes(folder: Path, n: int) -> str:
    """Return the flat floor and n loose boxes on it."""
    file = box_file(folder, "cube.obj", CUBE)
    side = int(np.ceil(np.sqrt(n)))
    places = [(0.6 * (k % side - side / 2), 0.6 * (k // side - side / 2)) for k in range(n)]
    boxes = [
        OBJECT.format(name=f"b{k}", file=file, x=x, y=y, z=-2.925, mass=14.2, kind="box")
        for k, (x, y) in enumerate(places)
    ]
    return floor(folder) + "".join(boxes)


SCENES: dict[str, tuple[int, Callable[[Path], str], int]] = {
    "flat floor": (1, floor, 60_000),
    "tank": (1, tank, 45_000),
    "sea floor": (1, sea_floor, 45_000),
    "8 vehicles": (8, floor, 10_000),
    "1000 static boxes": (1, fixed_boxes, 40_000),
    "100 loose boxes": (1, lambda folder: loose_boxes(folder, 100), 3_000),
    "1000 loose boxes": (1, lambda folder: loose_boxes(folder, 1000), 140),
}
"""The number of vehicles, the writer of the ground, and the target of steps per second."""
BUILD_S = {"1000 loose boxes": 3.0}
"""The targets of the CPU time to build a scene [s]."""


def write_scene(name: str, folder: Path) -> Path:
    """Write a scene."""
    n_vehicles, write_ground, _ = SCENES[name]
    vehicles = [
        VEHICLE.format(i=i, x=3.0 * (i % 4) - 4.5 * (n_vehicles > 1), y=3.0 * (i // 4), z=-1.2)
        for i in range(n_vehicles)
    ]
    listeners = [LISTENER.format(i=i) for i in range(n_vehicles)]
    path = folder / "scene.xml"
    path.write_text(
        '<?xml version="1.0"?>\n<UWSimScene xmlns:u="urn:uwsim:1">'
        + "".join(vehicles)
        + write_ground(folder)
        + f"<rosInterfaces>{''.join(listeners)}</rosInterfaces></UWSimScene>\n"
    )
    return path


def twist(surge: float) -> TwistStamped:
    """Return a command of the surge [m/s]."""
    zero = Vector3(x=0.0, y=0.0, z=0.0)
    command = Twist(linear=Vector3(x=surge, y=0.0, z=0.0), angular=zero)
    return TwistStamped(header=Header(stamp=Time(sec=0, nanosec=0), frame_id=""), twist=command)


def drive(simulation: Simulation, n_vehicles: int, periods: int) -> float:
    """Step with commands on the bus; return CPU seconds."""
    start_time = time.process_time()
    for k in range(periods):
        for i in range(n_vehicles):
            simulation.publish(f"/v{i}", twist(0.1 if k % 200 < 100 else -0.1))
        simulation.advance(PERIOD)
    return time.process_time() - start_time


def measure_engine_us(simulation: Simulation, cpu_s: float) -> float:
    """Measure CPU microseconds of MuJoCo's step of this model, always from the same state."""
    engine = simulation.world.engine
    model, data = engine._model, engine._data
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_INTEGRATION))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
    callback.remove()
    cpu_time, n = 0.0, 0
    while cpu_time < cpu_s:
        mujoco.mj_setState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        start_time = time.process_time()
        mujoco.mj_step(model, data, 20)
        cpu_time += time.process_time() - start_time
        n += 20
    callback.install()
    mujoco.mj_setState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
    return cpu_time * 1e6 / n


def measure_scene(name: str) -> dict[str, object]:
    """Measure a scene."""
    n_vehicles, _, target = SCENES[name]
    with tempfile.TemporaryDirectory() as folder:
        path = write_scene(name, Path(folder))
        start_time = time.process_time()
        scene = read_scene(path).nominal_scene
        simulation = uwsim.load(scene)
        build_time = time.process_time() - start_time
        drive(simulation, n_vehicles, 2)
        cpu_time, n = 0.0, 10
        while cpu_time < 0.2 * BATCH_CPU_S:  # warms up, and determines the size of a batch
            cpu_time = drive(simulation, n_vehicles, n)
            n *= 2
        periods = max(2, round(n / 2 * BATCH_CPU_S / cpu_time))
        batch_times = [drive(simulation, n_vehicles, periods) for _ in range(BATCHES)]
        step_us = median(batch_times) * 1e6 / (periods * round(PERIOD / simulation.timestep))
        contacts = int(simulation.world.engine._data.ncon)
        engine_us = measure_engine_us(simulation, BATCH_CPU_S)
        simulation.close()
    figures: dict[str, object] = {
        "dof": int(simulation.world.engine._model.nv),
        "contacts": contacts,
        "built_s": round(build_time, 2),
        "step_us": round(step_us, 2),
        "engine_us": round(engine_us, 2),
        "ratio": round(step_us / engine_us, 3),
        "steps_per_s": round(1e6 / step_us),
        "target_steps_per_s": target,
    }
    return figures | ({"target_built_s": BUILD_S[name]} if name in BUILD_S else {})


def measure_scenes(names: list[str] | None = None) -> dict[str, object]:
    """Measure scenes by name, or all."""
    return {name: measure_scene(name) for name in names or SCENES}


if __name__ == "__main__":
    CHOSEN_SCENES = [argument for argument in sys.argv[1:] if argument in SCENES]
    sys.argv[1:] = [argument for argument in sys.argv[1:] if argument not in SCENES]
    main(lambda: measure_scenes(CHOSEN_SCENES))
