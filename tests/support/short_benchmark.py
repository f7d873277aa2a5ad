"""A short benchmark: a tracker of a black box at three levels of fog."""

import hashlib
from pathlib import Path
from typing import Any

from uwsim.cli.options.levels import read_level
from uwsim.results.result import Result
from uwsim.runs.executors.executor import run_all
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.prepare import hash_inputs
from uwsim.runs.run import Run

BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml" u:algorithm="esm">
  <measures>
    <euclideanNorm u:value="mean">
      <name>corners</name>
      <groundTruth type="cornersFromCamera">
        <camera>bowtech1</camera> <target>blackbox</target> <publishOn>autoInit</publishOn>
      </groundTruth>
      <target>cornersTopic</target>
      <log>0.05</log>
      <startOn><type>onInit</type></startOn> <stopOn><type>never</type></stopOn>
    </euclideanNorm>
    <time>
      <name>taskTime</name>
      <startOn><type>onInit</type></startOn> <stopOn><type>never</type></stopOn>
    </time>
  </measures>
  <startOn><type>service</type><target>startBench</target></startOn>
  <stopOn><type>never</type></stopOn>
  <function>corners*2</function>
  <sceneUpdater>
    <sceneFogUpdater>
      <initialValue>0</initialValue> <finalValue>1.0</finalValue> <step>0.4</step>
      <interval>LENGTH</interval>
    </sceneFogUpdater>
  </sceneUpdater>
</benchmark>
"""


def write_benchmark(folder: Path, length: str) -> Path:
    path = folder / "short.xml"
    path.write_text(BENCHMARK.replace("LENGTH", length))
    return path


def bench_of(
    benchmark: Path,
    out: Path,
    *,
    algorithm: str | None = None,
    seed: int = 1,
    repeat: int = 1,
    mode: str | None = None,
    levels: list[str] | None = None,
    settings: list[str] | None = None,
    compat: list[str] | None = None,
    in_process: bool = False,
) -> Run:
    plan = make_plan(
        PlanRequest(
            benchmark=str(benchmark),
            algorithm=algorithm,
            seed=seed,
            repeat=repeat,
            mode=mode,
            levels=[read_level(text) for text in levels or ()],
            settings=settings or [],
            compat=compat or [],
            in_process=in_process,
        )
    )
    inputs, renderer = hash_inputs(plan)
    return Run(plan=plan, out=out, inputs=inputs, renderer=renderer)


def run(benchmark: Path, out: Path, **options: Any) -> Result:
    return run_all([bench_of(benchmark, out, **options)])[0]


def fingerprint(out: Path) -> dict[str, str]:
    return {
        str(path.relative_to(out)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(out.rglob("*"))
        if path.is_file()
        and path.name not in ("provenance.json", "report.html")
        and "plots" not in path.parts
    }
