"""A benchmark played in memory: an empty tank, no camera, a step costs nearly nothing."""

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
INIT = "<type>onInit</type>"
NEVER = "<type>never</type>"


def tank() -> SceneSpec:
    """The bundled scene of `visibility` without objects, and nothing published."""
    scene = read_scene(DATA / "scenes" / "visibility-scene.xml")
    return replace(scene, objects=(), ros_interfaces=())


def make_plan(
    folder: Path,
    algorithm: type[Algorithm],
    updater: str,
    *,
    measures: str = TIME,
    start: str = INIT,
    stop: str = NEVER,
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


def with_algorithm(plan: Plan, **changed: object) -> Plan:
    """The plan with its algorithm's fields changed."""
    return replace(plan, algorithm=replace(plan.algorithm, **changed))  # type: ignore[arg-type]


def rows_of(plan: Plan) -> list[LevelRow]:
    """Play every unit of a plan."""
    return [
        row for trial in plan.trials() for row in execute(plan, trial) if isinstance(row, LevelRow)
    ]
