"""Short benchmarks in an empty tank without cameras, whose steps take little time."""

from dataclasses import replace
from importlib import resources
from pathlib import Path

from uwsim.benchmark.reader import read_benchmark
from uwsim.bus import Algorithm
from uwsim.runs.planning.plan import AlgorithmUnderTest, Mode, Plan
from uwsim.runs.trial.level_row import LevelRow
from uwsim.runs.trial.trial import execute
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec

DATA = Path(str(resources.files("uwsim"))) / "data"
TIME = "<time> <name>t</name> </time>"
INIT_TRIGGER = "<type>onInit</type>"
NEVER_TRIGGER = "<type>never</type>"


def tank() -> SceneSpec:
    """Return the bundled scene of `visibility` without objects and topics."""
    scene = read_scene(DATA / "scenes" / "visibility-scene.xml")
    return replace(scene, objects=(), ros_interfaces=())


def make_plan(
    folder: Path,
    algorithm: type[Algorithm],
    updater: str,
    *,
    measures: str = TIME,
    start: str = INIT_TRIGGER,
    stop: str = NEVER_TRIGGER,
    function: str = "<function>t</function>",
    scene: SceneSpec | None = None,
    mode: Mode = "sequential",
    compatibility: frozenset[str] = frozenset(),
) -> Plan:
    """Write a benchmark file and read it."""
    path = folder / "benchmark.xml"
    path.write_text(
        f'<benchmark xmlns:u="urn:uwsim:1" u:patience="2"> <measures> {measures} </measures>\n'
        f"<startOn> {start} </startOn> <stopOn> {stop} </stopOn>\n"
        f"{function} <sceneUpdater> {updater} </sceneUpdater> </benchmark>"
    )
    return Plan(
        benchmark=read_benchmark(path),
        scene=tank() if scene is None else scene,
        algorithm=AlgorithmUnderTest(cls=algorithm, name="algorithm"),
        mode=mode,
        compatibility=compatibility,
    )


def with_algorithm(plan: Plan, **changes: object) -> Plan:
    """Return the plan with changed fields of its algorithm."""
    return replace(plan, algorithm=replace(plan.algorithm, **changes))  # type: ignore[arg-type]


def rows_of(plan: Plan) -> list[LevelRow]:
    """Run all trials of a plan; return their rows."""
    return [
        row for trial in plan.trials() for row in execute(plan, trial) if isinstance(row, LevelRow)
    ]
