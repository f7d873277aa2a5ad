"""Measure a step of a vehicle at work: current, commanded arm, sensors, obstacles.

Run ``python benchmarks/at_work.py [PART ...]``; the parts are ``scenes influences samples growth``,
all of them without one. ``--plot FILE.svg`` draws the growth too. The vehicle is a Girona 500 with
its ARM5E; its five thrusters and five joints are commanded at 100 Hz, the water moves with
0.16 m/s, the step is 2 ms.

scenes
    whole steps beside MuJoCo's own step of the same model without water (``engine_us``): over a
    flat floor, a sea floor and in the tank; with an IMU at 100 Hz and pressure, DVL, range and
    odometry at 10 Hz with subscribers; eight vehicles; beside loose and fixed boxes.
influences
    the additional cost of a step over still water without sensors: of each current, of waves, of
    each sensor at 100 Hz with and without a subscriber, of an observer of every step, and of a
    vehicle that drifts.
samples
    CPU time of one sample of each sensor, over a sea floor and beside 1000 loose boxes.
growth
    a step with increasing numbers of vehicles, sensors and loose boxes.
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
"""The elements of currents, by name."""
WAVES = (
    "<u:waves> <u:jonswap> <u:significantHeight>0.5</u:significantHeight> "
    "<u:peakPeriod>5</u:peakPeriod> <u:components>{}</u:components> </u:jonswap> </u:waves>"
)
"""The waves of a scene, with a number of components."""
POSITION_BELOW = "<position> <x>0.4</x> <y>0</y> <z>-0.7</z> </position>"
SENSORS = {
    "imu": ("imu", "<std>0.001</std>"),
    "pressure": ("pressureSensor", "<std>0.01</std>"),
    "gps": ("gpsSensor", "<std>0.01</std>"),
    "dvl": ("dvlSensor", f"{POSITION_BELOW} <std>0.003</std>"),
    "range": (
        "rangeSensor",
        f"<range>50</range> {POSITION_BELOW} "
        "<orientation> <r>0</r> <p>M_PI_2</p> <y>0</y> </orientation>",
    ),
    "multibeam": (
        "multibeamSensor",
        f"{POSITION_BELOW} <initAngle>-60</initAngle> <finalAngle>60</finalAngle> "
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
"""The element and the children of each sensor; on the base, below it or ahead."""
USUAL_RATES = {"imu": 100, "pressure": 10, "dvl": 10, "range": 10, "odometry": 10}
"""The rates of the topics of a working vehicle [Hz]."""
N_SAMPLES = {"imu": 500, "pressure": 500, "range": 200, "dvl": 100, "multibeam": 50,
           "imaging sonar": 5}  # fmt: skip
"""The number of samples of a batch."""


def eddy(point: np.ndarray, time: float, vehicle: str) -> tuple[float, float, float]:
    """Return the velocity of an eddy about the origin [m/s]."""
    x, y, _ = point
    return -0.01 * y, 0.01 * x, 0.0


def floor(n_loose: int) -> Callable[[Path], str]:
    """Return a writer of a flat floor with loose boxes on it."""
    return lambda folder: steps.loose_boxes(folder, n_loose) if n_loose else steps.floor(folder)


def write_scene(
    folder: Path,
    ground: Callable[[Path], str] = steps.floor,
    *,
    current: str = "constant",
    n_waves: int = 0,
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
            elements, interfaces = sensor_elements(sensors or {}, copies)
            text = text.replace("<u:dynamics>", f"{elements}<u:dynamics>")
            topics.append(interfaces)
        vehicles.append(text)
        topics.append(
            f"<u:ROSThrustersToPAT> <u:topic>/t{i}</u:topic> <u:vehicleName>v{i}</u:vehicleName> "
            f"</u:ROSThrustersToPAT> <ROSJointStateToArm> <topic>/a{i}</topic> "
            f"<vehicleName>v{i}</vehicleName> </ROSJointStateToArm>"
        )
    if drifts:
        drifting_vehicle = steps.VEHICLE.format(i="drifting", x=0.0, y=-8.0, z=-1.2)
        vehicles.append(drifting_vehicle.replace("<u:dynamics>g500_physical</u:dynamics>", ""))
    path = folder / "scene.xml"
    waves = WAVES.format(n_waves) if n_waves else ""
    path.write_text(
        '<?xml version="1.0"?>\n<UWSimScene xmlns:u="urn:uwsim:1"> <oceanState> <u:current> '
        f"{CURRENTS[current]} </u:current> {waves} </oceanState> {''.join(vehicles)} "
        f"{ground(folder)} "
        f"<rosInterfaces> {''.join(topics)} </rosInterfaces> </UWSimScene>\n"
        .replace("<u:current>  </u:current>", "")
    )  # fmt: skip
    return path


def sensor_elements(sensors: Mapping[str, int], copies: int) -> tuple[str, str]:
    """Return the elements of sensors on the base, and of their topics, several of each."""
    elements, interfaces = "", ""
    for kind, rate in sensors.items():
        for k in range(copies):
            name = f"{kind.replace(' ', '_')}{k}"
            topic_and_rate = f"<topic>/{name}</topic> <rate>{rate}</rate>"
            if kind == "odometry":
                interfaces += (
                    f"<PATToROSOdom> <vehicleName>v0</vehicleName> {topic_and_rate} </PATToROSOdom>"
                )
                continue
            element, children = SENSORS[kind]
            elements += (
                f"<{element}> <name>{name}</name> <relativeTo>base_link</relativeTo> {children} "
                f"</{element}>"
            )
            interfaces += f"<u:sensorToROS> <name>{name}</name> {topic_and_rate} </u:sensorToROS>"
    return elements, interfaces


def drive(simulation: Simulation, n_vehicles: int, periods: int) -> float:
    """Step with commands to thrusters and joints on the bus; return CPU seconds."""
    names = list(simulation.world.vehicles.find("v0").joint_names)
    layout, no_values, phases = MultiArrayLayout(dim=[], data_offset=0), np.zeros(0), np.arange(5)
    middle, swing = np.array([-0.5, 0.8, 1.1, 0.0, 0.3]), np.array([0.5, 0.5, 0.5, 0.5, 0.3])
    start_time = time.thread_time()
    for _ in range(periods):
        now = simulation.time
        thrust = 0.2 * np.sin(1.3 * now + phases)
        joints = middle + swing * np.sin(0.9 * now + phases)
        for i in range(n_vehicles):
            simulation.publish(f"/t{i}", Float64MultiArray(layout=layout, data=thrust))
            simulation.publish(
                f"/a{i}",
                JointState(
                    header=header(now),
                    name=names,
                    position=joints,
                    velocity=no_values,
                    effort=no_values,
                ),
            )
        simulation.advance(steps.PERIOD)
    return time.thread_time() - start_time


def open_scene(
    folder: Path, *, is_read: bool, has_observer: bool = False, **scene_options: object
) -> Simulation:
    """Open a scene, optionally with subscribers of its topics and an observer of each step."""
    simulation = uwsim.load(write_scene(folder, **scene_options))  # type: ignore[arg-type]
    if is_read:
        for topic in list(simulation.topics):
            if simulation.bus.describe_missing_publisher(topic) is None:
                simulation.bus.subscribe(topic, object, lambda _: None)
    if has_observer:
        simulation.watch(lambda: None)
    return simulation


def measure_step_costs(*simulations: tuple[Simulation, int]) -> list[list[float]]:
    """Measure CPU microseconds of a step of each simulation and number of vehicles, by batch.

    The batches of several simulations alternate, so that they have the same load.
    """
    n_periods = []
    for simulation, n_vehicles in simulations:
        drive(simulation, n_vehicles, 2)
        cpu_time, n = 0.0, 5
        while cpu_time < 0.2 * CPU_S:
            n *= 2
            cpu_time = drive(simulation, n_vehicles, n)
        n_periods.append(max(2, round(n * CPU_S / cpu_time)))
    costs_by_simulation: list[list[float]] = [[] for _ in simulations]
    for _ in range(BATCHES):
        for costs, (simulation, n_vehicles), n in zip(
            costs_by_simulation, simulations, n_periods, strict=True
        ):
            n_steps = n * round(steps.PERIOD / simulation.timestep)
            costs.append(1e6 * drive(simulation, n_vehicles, n) / n_steps)
    return costs_by_simulation


def measure_step(n_vehicles: int = 1, **options: object) -> dict[str, float]:
    """Measure a step of a scene, and the engine's own step."""
    print("a step with", n_vehicles, "vehicles and", options, file=sys.stderr, flush=True)
    with tempfile.TemporaryDirectory() as folder:
        scene_options = {"n_vehicles": n_vehicles, "is_read": True, **options}
        with open_scene(Path(folder), **scene_options) as simulation:  # type: ignore[arg-type]
            (costs,) = measure_step_costs((simulation, n_vehicles))
            engine = steps.measure_engine_us(simulation, CPU_S)
    middle = median(costs)
    return {
        "step_us": round(middle, 2),
        "step_us_best": round(min(costs), 2),
        "engine_us": round(engine, 2),
        "ratio": round(middle / engine, 3),
        "steps_per_s": round(1e6 / middle),
    }


def scenes() -> dict[str, object]:
    """Measure whole steps in several scenes."""
    return {
        "flat": measure_step(),
        "sea floor": measure_step(ground=steps.sea_floor),
        "tank": measure_step(ground=steps.tank),
        "flat, five sensors": measure_step(sensors=USUAL_RATES),
        "sea floor, five sensors": measure_step(ground=steps.sea_floor, sensors=USUAL_RATES),
        "8 vehicles": measure_step(8),
        "100 loose boxes": measure_step(ground=floor(100)),
        "1000 fixed boxes": measure_step(ground=steps.fixed_boxes),
    }


def influences() -> dict[str, object]:
    """Measure the additional cost of a step by each part [us], and its ratio to a plain step."""
    figures: dict[str, object] = {}
    for name in CURRENTS:
        if name != "still":
            figures[f"current {name}"] = measure_added_cost(current=name)
    for n in (1, 20, 200, 1000):
        figures[f"waves of {n} components"] = measure_added_cost(n_waves=n)
    for name in SENSORS:
        if name == "imaging sonar":
            continue
        for is_read in (False, True):
            row = measure_added_cost(sensors={name: 100}, is_read=is_read)
            figures[f"{name} at 100 Hz, {'read' if is_read else 'unread'}"] = row
    figures["odometry at 100 Hz, read"] = measure_added_cost(
        sensors={"odometry": 100}, is_read=True
    )
    figures["observer of every step"] = measure_added_cost(has_observer=True)
    figures["drifting vehicle in a constant current"] = measure_added_cost(
        current="constant", drifts=True
    )
    return figures


def measure_added_cost(**options: object) -> dict[str, float]:
    """Measure the additional cost of a step over still water without sensors."""
    scene_options = {"current": "still", "is_read": False, **options}
    print("additional cost of", options, file=sys.stderr, flush=True)
    with (
        tempfile.TemporaryDirectory() as folder,
        open_scene(Path(folder), is_read=False, current="still") as reference,
        open_scene(Path(folder), **scene_options) as simulation,  # type: ignore[arg-type]
    ):
        reference_us, total_us = (
            median(costs) for costs in measure_step_costs((reference, 1), (simulation, 1))
        )
    return {
        "plain_us": round(reference_us, 2),
        "added_us": round(total_us - reference_us, 2),
        "ratio": round(total_us / reference_us, 3),
    }


def samples() -> dict[str, object]:
    """Measure CPU microseconds of a sample of each sensor, one a step."""
    figures: dict[str, object] = {}
    surroundings = {"sea floor": steps.sea_floor, "1000 loose boxes": floor(1000)}
    for place, ground in surroundings.items():
        rows = {}
        with tempfile.TemporaryDirectory() as folder:
            path = write_scene(Path(folder), ground, sensors=dict.fromkeys(N_SAMPLES, 1))
            with uwsim.load(path) as simulation:
                simulation.advance(0.1)
                for kind, n in N_SAMPLES.items():
                    name = f"{kind.replace(' ', '_')}0"
                    sensor = simulation.world.sensors.sensor(name, (SENSORS[kind][0],))
                    rows[kind] = sample_us(simulation, sensor.sample, max(3, n // 10))
        figures[place] = rows
    return figures


def sample_us(
    simulation: Simulation, sample: Callable[[float], object], n: int
) -> dict[str, float]:
    """Measure median and minimum over batches of the CPU microseconds of a sample."""
    sample(simulation.time)
    batches = []
    for _ in range(BATCHES):
        cpu_time = 0.0
        for _ in range(n):
            simulation.advance()
            start_time = time.thread_time()
            sample(simulation.time)
            cpu_time += time.thread_time() - start_time
        batches.append(1e6 * cpu_time / n)
    return {"us": round(median(batches), 1), "us_best": round(min(batches), 1)}


def growth() -> dict[str, object]:
    """Measure CPU microseconds of a step over numbers of vehicles, sensors and boxes."""
    return {
        "vehicles": {n: measure_step(n)["step_us"] for n in (1, 2, 4, 8)},
        "sets of five sensors": {
            n: measure_step(sensors=USUAL_RATES, copies=n)["step_us"] for n in (1, 2, 4, 8)
        },
        "loose boxes": {n: measure_step(ground=floor(n))["step_us"] for n in (1, 10, 100, 1000)},
    }


def plot(curves: Mapping[str, Mapping[int, float]], file: Path) -> None:
    """Draw the growth of a step."""
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
    CHOSEN_PARTS = [argument for argument in sys.argv[1:] if argument in PARTS] or list(PARTS)
    PLOT_FILE: Path | None = None
    if "--plot" in sys.argv:
        OPTION_INDEX = sys.argv.index("--plot")
        PLOT_FILE = Path(sys.argv[OPTION_INDEX + 1])
        del sys.argv[OPTION_INDEX : OPTION_INDEX + 2]
    sys.argv[1:] = [argument for argument in sys.argv[1:] if argument not in PARTS]

    def measure() -> dict[str, object]:
        """Measure the chosen parts, and draw the growth."""
        figures = {name: PARTS[name]() for name in CHOSEN_PARTS}
        if PLOT_FILE is not None and "growth" in figures:
            plot(figures["growth"], PLOT_FILE)  # type: ignore[arg-type]
        return figures

    main(measure)
