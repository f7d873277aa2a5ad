"""What a step costs of a vehicle at work: current, commanded arm, publishing sensors, obstacles.

Run ``python benchmarks/at_work.py [PART ...]``; the parts are ``scenes influences samples growth``,
all of them without one. ``--plot FILE.svg`` draws the growth too. The vehicle is a Girona 500 with
its ARM5E; its five thrusters and five joints are commanded at 100 Hz, the water moves with
0.16 m/s, the step is 2 ms.

scenes
    whole steps beside MuJoCo's own step of the same model without water (``engine_us``): over a
    flat floor, relief and in the tank; with an IMU at 100 Hz and pressure, DVL, range and odometry
    at 10 Hz that somebody reads; eight vehicles; beside loose and fixed boxes.
influences
    what a step costs more than one in still water without sensors: by each current, each sensor
    at 100 Hz with and without a reader, an observer of every step, a vehicle that drifts.
samples
    CPU time of one sample of each sensor, over relief and beside 1000 loose boxes.
growth
    a step with more and more vehicles, sensors and loose boxes.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from statistics import median

import numpy as np
import steps
from measure import main

import uwsim
from uwsim.messages import Float64MultiArray, JointState, MultiArrayLayout, header
from uwsim.simulation import Simulation

BATCHES, CPU_S = 5, 0.4
VELOCITY = "<u:velocity> <x>0.15</x> <y>0.05</y> <z>0</z> </u:velocity>"
CURRENTS = {
    "still": "",
    "constant": f"<u:constant> {VELOCITY} </u:constant>",
    "powerProfile": f"<u:powerProfile> {VELOCITY} <u:depth>20</u:depth> </u:powerProfile>",
    "tidal": "<u:tidal> <u:constituent> <u:name>M2</u:name> <u:semiMajor>0.15</u:semiMajor> "
    "</u:constituent> </u:tidal>",
    "gaussMarkov": "<u:gaussMarkov> <u:mean> <x>0.15</x> <y>0</y> <z>0</z> </u:mean> <u:deviation> "
    "<x>0.03</x> <y>0.03</y> <z>0</z> </u:deviation> <u:mu>0.02</u:mu> </u:gaussMarkov>",
    "uwsimSinusoid": "<u:uwsimSinusoid> <u:speed>0.15</u:speed> "
    "<u:speedVariation>0.02</u:speedVariation> <u:speedPeriod>4</u:speedPeriod> "
    "<u:random>0.01</u:random> </u:uwsimSinusoid>",
    "pythonFunction": "<u:pythonFunction> <u:function>at_work:eddy</u:function> "
    "</u:pythonFunction>",
}
"""Currents by what they are called in a scene."""
BELOW = "<position> <x>0.4</x> <y>0</y> <z>-0.7</z> </position>"
SENSORS = {
    "imu": ("imu", "<std>0.001</std>"),
    "pressure": ("pressureSensor", "<std>0.01</std>"),
    "gps": ("gpsSensor", "<std>0.01</std>"),
    "dvl": ("dvlSensor", f"{BELOW} <std>0.003</std>"),
    "range": (
        "rangeSensor",
        f"<range>50</range> {BELOW} <orientation> <r>0</r> <p>M_PI_2</p> <y>0</y> </orientation>",
    ),
    "multibeam": (
        "multibeamSensor",
        f"{BELOW} <initAngle>-60</initAngle> <finalAngle>60</finalAngle> "
        "<angleIncr>0.2345</angleIncr> <range>50</range>",
    ),
    "imaging sonar": (
        "u:imagingSonar",
        "<position> <x>0.8</x> <y>0</y> <z>-0.4</z> </position> <orientation> <r>0</r> <p>0.5</p> "
        "<y>0</y> </orientation> <range>20</range> <bins>500</bins> "
        "<verticalAperture>25</verticalAperture> <rows>32</rows> "
        "<horizontalAperture>90</horizontalAperture> <beams>512</beams>",
    ),
}
"""Element and children of each sensor; on the base, below it or ahead."""
USUAL = {"imu": 100, "pressure": 10, "dvl": 10, "range": 10, "odometry": 10}
"""Rates of what a working vehicle publishes [Hz]."""
SAMPLED = {"imu": 500, "pressure": 500, "range": 200, "dvl": 100, "multibeam": 50,
           "imaging sonar": 5}  # fmt: skip
"""Samples of a batch."""


def eddy(point: np.ndarray, time: float, vehicle: str) -> tuple[float, float, float]:
    """Turn the water about the origin."""
    x, y, _ = point
    return -0.01 * y, 0.01 * x, 0.0


def floor(n_loose: int) -> Callable[[Path], str]:
    """A flat floor with some loose boxes on it."""
    return lambda folder: steps.loose(folder, n_loose) if n_loose else steps.floor(folder)


def scene(
    folder: Path,
    things: Callable[[Path], str] = steps.floor,
    *,
    current: str = "constant",
    n_vehicles: int = 1,
    sensors: Mapping[str, int] | None = None,
    copies: int = 1,
    drifts: bool = False,
) -> Path:
    """Write a scene, z up; the first vehicle has the sensors."""
    vehicles, topics = [], []
    for i in range(n_vehicles):
        text = steps.VEHICLE.format(i=i, x=3.0 * (i % 4), y=3.0 * (i // 4), z=-1.2)
        if i == 0:
            mounted, published = fitted(sensors or {}, copies)
            text = text.replace("<u:dynamics>", f"{mounted}<u:dynamics>")
            topics.append(published)
        vehicles.append(text)
        topics.append(
            f"<u:ROSThrustersToPAT> <u:topic>/t{i}</u:topic> <u:vehicleName>v{i}</u:vehicleName> "
            f"</u:ROSThrustersToPAT> <ROSJointStateToArm> <topic>/a{i}</topic> "
            f"<vehicleName>v{i}</vehicleName> </ROSJointStateToArm>"
        )
    if drifts:
        still = steps.VEHICLE.format(i="drifting", x=0.0, y=-8.0, z=-1.2)
        vehicles.append(still.replace("<u:dynamics>g500_physical</u:dynamics>", ""))
    path = folder / "scene.xml"
    path.write_text(
        '<?xml version="1.0"?>\n<UWSimScene xmlns:u="urn:uwsim:1"> <oceanState> <u:current> '
        f"{CURRENTS[current]} </u:current> </oceanState> {''.join(vehicles)} {things(folder)} "
        f"<rosInterfaces> {''.join(topics)} </rosInterfaces> </UWSimScene>\n"
        .replace("<u:current>  </u:current>", "")
    )  # fmt: skip
    return path


def fitted(sensors: Mapping[str, int], copies: int) -> tuple[str, str]:
    """Sensors on the base, and what publishes them at their rates, some of each."""
    mounted, published = "", ""
    for kind, rate in sensors.items():
        for k in range(copies):
            name = f"{kind.replace(' ', '_')}{k}"
            what = f"<topic>/{name}</topic> <rate>{rate}</rate>"
            if kind == "odometry":
                published += f"<PATToROSOdom> <vehicleName>v0</vehicleName> {what} </PATToROSOdom>"
                continue
            element, children = SENSORS[kind]
            mounted += (
                f"<{element}> <name>{name}</name> <relativeTo>base_link</relativeTo> {children} "
                f"</{element}>"
            )
            published += f"<u:sensorToROS> <name>{name}</name> {what} </u:sensorToROS>"
    return mounted, published


def drive(simulation: Simulation, n_vehicles: int, periods: int) -> float:
    """Step with commands to thrusters and joints on the bus; returns CPU seconds."""
    names = list(simulation.world.vehicles.find("v0").joint_names)
    layout, none, phases = MultiArrayLayout(dim=[], data_offset=0), np.zeros(0), np.arange(5)
    middle, swing = np.array([-0.5, 0.8, 1.1, 0.0, 0.3]), np.array([0.5, 0.5, 0.5, 0.5, 0.3])
    began = time.thread_time()
    for _ in range(periods):
        now = simulation.time
        thrust = 0.2 * np.sin(1.3 * now + phases)
        joints = middle + swing * np.sin(0.9 * now + phases)
        for i in range(n_vehicles):
            simulation.publish(f"/t{i}", Float64MultiArray(layout=layout, data=thrust))
            simulation.publish(
                f"/a{i}",
                JointState(
                    header=header(now), name=names, position=joints, velocity=none, effort=none
                ),
            )
        simulation.advance(steps.PERIOD)
    return time.thread_time() - began


def opened(folder: Path, *, is_read: bool, watches: bool = False, **of_scene: object) -> Simulation:
    """Open a scene; whether its topics are read, and somebody looks at every step."""
    simulation = uwsim.load(scene(folder, **of_scene))  # type: ignore[arg-type]
    if is_read:
        for topic in list(simulation.topics):
            if simulation.bus.describe_missing_publisher(topic) is None:
                simulation.bus.subscribe(topic, object, lambda _: None)
    if watches:
        simulation.watch(lambda: None)
    return simulation


def step_us(*simulations: tuple[Simulation, int]) -> list[list[float]]:
    """CPU microseconds of a step of each simulation with so many vehicles, batch by batch.

    The batches of several simulations alternate, so that they meet the same load.
    """
    n_periods = []
    for simulation, n_vehicles in simulations:
        drive(simulation, n_vehicles, 2)
        spent, n = 0.0, 5
        while spent < 0.2 * CPU_S:
            n *= 2
            spent = drive(simulation, n_vehicles, n)
        n_periods.append(max(2, round(n * CPU_S / spent)))
    found: list[list[float]] = [[] for _ in simulations]
    for _ in range(BATCHES):
        for costs, (simulation, n_vehicles), n in zip(found, simulations, n_periods, strict=True):
            n_steps = n * round(steps.PERIOD / simulation.timestep)
            costs.append(1e6 * drive(simulation, n_vehicles, n) / n_steps)
    return found


def measured(n_vehicles: int = 1, **options: object) -> dict[str, float]:
    """A step of a scene beside the engine's own."""
    print("a step with", n_vehicles, "vehicles and", options, file=sys.stderr, flush=True)
    with tempfile.TemporaryDirectory() as folder:
        of_scene = {"n_vehicles": n_vehicles, "is_read": True, **options}
        with opened(Path(folder), **of_scene) as simulation:  # type: ignore[arg-type]
            (costs,) = step_us((simulation, n_vehicles))
            engine = steps.bare(simulation, CPU_S)
    middle = median(costs)
    return {
        "step_us": round(middle, 2),
        "step_us_best": round(min(costs), 2),
        "engine_us": round(engine, 2),
        "ratio": round(middle / engine, 3),
        "steps_per_s": round(1e6 / middle),
    }


def scenes() -> dict[str, object]:
    """Whole steps in several surroundings."""
    return {
        "flat": measured(),
        "relief": measured(things=steps.relief),
        "tank": measured(things=steps.tank),
        "flat, five sensors": measured(sensors=USUAL),
        "relief, five sensors": measured(things=steps.relief, sensors=USUAL),
        "8 vehicles": measured(8),
        "100 loose boxes": measured(things=floor(100)),
        "1000 fixed boxes": measured(things=steps.standing),
    }


def influences() -> dict[str, object]:
    """What each thing adds to a step [us], and that in the steps of a plain scene."""
    found: dict[str, object] = {}
    for name in CURRENTS:
        if name != "still":
            found[f"current {name}"] = added(current=name)
    for name in SENSORS:
        if name == "imaging sonar":
            continue
        for is_read in (False, True):
            row = added(sensors={name: 100}, is_read=is_read)
            found[f"{name} at 100 Hz, {'read' if is_read else 'unread'}"] = row
    found["odometry at 100 Hz, read"] = added(sensors={"odometry": 100}, is_read=True)
    found["observer of every step"] = added(watches=True)
    found["drifting vehicle in a constant current"] = added(current="constant", drifts=True)
    return found


def added(**options: object) -> dict[str, float]:
    """The cost of a step beside one in still water without sensors."""
    chosen = {"current": "still", "is_read": False, **options}
    print("what is added by", options, file=sys.stderr, flush=True)
    with (
        tempfile.TemporaryDirectory() as folder,
        opened(Path(folder), is_read=False, current="still") as plain,
        opened(Path(folder), **chosen) as other,  # type: ignore[arg-type]
    ):
        before, after = (median(costs) for costs in step_us((plain, 1), (other, 1)))
    return {
        "plain_us": round(before, 2),
        "added_us": round(after - before, 2),
        "ratio": round(after / before, 3),
    }


def samples() -> dict[str, object]:
    """CPU microseconds of one sample of each sensor, a step after the one before."""
    found: dict[str, object] = {}
    surroundings = {"relief": steps.relief, "1000 loose boxes": floor(1000)}
    for place, things in surroundings.items():
        rows = {}
        with tempfile.TemporaryDirectory() as folder:
            path = scene(Path(folder), things, sensors=dict.fromkeys(SAMPLED, 1))
            with uwsim.load(path) as simulation:
                simulation.advance(0.1)
                for kind, n in SAMPLED.items():
                    name = f"{kind.replace(' ', '_')}0"
                    sensor = simulation.world.sensors.sensor(name, (SENSORS[kind][0],))
                    rows[kind] = sample_us(simulation, sensor.sample, max(3, n // 10))
        found[place] = rows
    return found


def sample_us(
    simulation: Simulation, sample: Callable[[float], object], n: int
) -> dict[str, float]:
    """Median and least over batches of the CPU microseconds of a sample."""
    sample(simulation.time)
    batches = []
    for _ in range(BATCHES):
        spent = 0.0
        for _ in range(n):
            simulation.advance()
            began = time.thread_time()
            sample(simulation.time)
            spent += time.thread_time() - began
        batches.append(1e6 * spent / n)
    return {"us": round(median(batches), 1), "us_best": round(min(batches), 1)}


def growth() -> dict[str, object]:
    """Steps with more of everything: CPU microseconds of a step by number."""
    return {
        "vehicles": {n: measured(n)["step_us"] for n in (1, 2, 4, 8)},
        "sets of five sensors": {
            n: measured(sensors=USUAL, copies=n)["step_us"] for n in (1, 2, 4, 8)
        },
        "loose boxes": {n: measured(things=floor(n))["step_us"] for n in (1, 10, 100, 1000)},
    }


def plot(curves: Mapping[str, Mapping[int, float]], file: Path) -> None:
    """Draw how a step grows."""
    import matplotlib as mpl

    mpl.use("Agg")
    mpl.rcParams |= {"svg.hashsalt": "growth", "svg.fonttype": "none"}
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(6.4, 4.0), layout="constrained")
    for (name, points), marker in zip(curves.items(), "os^", strict=True):
        numbers, costs = zip(*points.items(), strict=True)
        axes.loglog(numbers, costs, marker=marker, label=name)
    axes.set_xlabel("number")
    axes.set_ylabel("CPU time of a 2 ms step [µs]")
    axes.axhline(2000.0, color="0.6", linewidth=0.8)
    axes.annotate("real time", (1.0, 2000.0), color="0.4", va="bottom")
    axes.grid(which="major", alpha=0.3)
    axes.legend(frameon=False)
    figure.savefig(file, metadata={"Date": None})


PARTS = {"scenes": scenes, "influences": influences, "samples": samples, "growth": growth}

if __name__ == "__main__":
    CHOSEN = [argument for argument in sys.argv[1:] if argument in PARTS] or list(PARTS)
    FILE: Path | None = None
    if "--plot" in sys.argv:
        AT = sys.argv.index("--plot")
        FILE = Path(sys.argv[AT + 1])
        del sys.argv[AT : AT + 2]
    sys.argv[1:] = [argument for argument in sys.argv[1:] if argument not in PARTS]

    def measure() -> dict[str, object]:
        """Measure the chosen parts, and draw."""
        found = {name: PARTS[name]() for name in CHOSEN}
        if FILE is not None and "growth" in found:
            plot(found["growth"], FILE)  # type: ignore[arg-type]
        return found

    main(measure)
