"""Cheating trials: what an algorithm that never looks at an image gains by each way to cheat.

Each cheat plays a short benchmark of a swaying vehicle, blind: its images are black, and all of
them get the same first quad. `Holds` gives that quad for ever, which is what can be had without
looking. What scores better has gained something; `GAINS` says which of them are known to, because
nothing is kept from code in the same process. `Holds` is played once more behind all of them: if it
does not score the same to the last digit, a cheat has falsified another algorithm.

    scripts/cheat_trials --seed 3

Exit status 1: a cheat gained that should not have, or changed what another scores.
"""

from __future__ import annotations

import argparse
import gc
import json
import os
import random
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from tests.support.short_trial import DATA, make_plan, with_algorithm
from uwsim.base.environment import set_environment
from uwsim.benchmark.measures.euclidean_norm import EuclideanNorm
from uwsim.bus import Node
from uwsim.errors import ResultError
from uwsim.messages import Empty, Float32MultiArray, GTpublish, GTpublishResponse, Image, floats
from uwsim.results.inputs import Inputs
from uwsim.results.motion import load_track
from uwsim.results.result import Result
from uwsim.runs.executors.executor import Outcome, run_each
from uwsim.runs.executors.processes import ProcessExecutor
from uwsim.runs.run import Run
from uwsim.scene.reader import read_scene

SERVICE = "<type>service</type> <target>startBench</target>"
MEASURE = """<euclideanNorm u:value="mean" u:autoInit="once"> <name>corners</name>
<groundTruth type="cornersFromCamera"> <camera>bowtech1</camera> <target>blackbox</target>
<publishOn>autoInit</publishOn> </groundTruth> <target>cornersTopic</target> </euclideanNorm>"""
LEVELS = """<sceneFogUpdater> <initialValue>0</initialValue> <finalValue>0.5</finalValue>
<step>0.5</step> <interval>LENGTH</interval> </sceneFogUpdater>"""
FUNCTION = '<function publishResult="true">corners</function>'
FOLDER = "UWSIM_CHEAT_FOLDER"
"""Variable with the folder of the results."""
WORTH = 0.97
"""A cheat that scores less than this share of what `Holds` does has gained something."""


class Holds:
    """Gives the first quad for ever."""

    def start(self, node: Node) -> None:
        self.node, self.started = node, False
        self.quad = np.zeros(8, dtype=np.float32)
        self.say = node.publisher("cornersTopic", Float32MultiArray)
        node.serve("autoInit", GTpublish, self.told)
        node.subscribe("/uwsim/camera1", Image, self.on_image)

    def told(self, request: GTpublish) -> GTpublishResponse:
        self.quad = np.array(request.groundTruth, dtype=np.float32)
        return GTpublishResponse()

    def on_image(self, image: Image) -> None:
        if not self.started:
            self.started = True
            self.node.call("startBench", Empty())
        elif self.quad.any():
            self.cheat()

    def cheat(self) -> None:
        self.say(floats(self.quad))


class HoldsAfterwards(Holds):
    """The same behind all cheats."""


class Bursts(Holds):
    """Publishes two hundred guesses at every image."""

    def cheat(self) -> None:
        for guess in self.node.rng.normal(0.0, 20.0, (200, 8)):
            self.say(floats(self.quad + guess))
        self.say(floats(self.quad))


class BurstsOnce(Holds):
    """Publishes a thousand times when it knows the truth, and then as seldom as it may."""

    def cheat(self) -> None:
        first = self.node.now < 0.5
        if first or round(self.node.now / 0.033) % 27 == 0:
            for _ in range(1000 if first else 1):
                self.say(floats(self.quad))


class Listens(Holds):
    """Reads how far it is off from the live results."""

    def start(self, node: Node) -> None:
        super().start(node)
        node.subscribe("BenchmarkResults", Float32MultiArray, self.correct)

    def correct(self, results: Float32MultiArray) -> None:
        if len(results.data) > 8:
            self.quad[0] += results.data[3]


class SaysNothingWhenUnsure(Holds):
    """Publishes NaN but now and then."""

    def cheat(self) -> None:
        sure = round(self.node.now / 0.033) % 20 == 0
        self.say(floats(self.quad if sure else np.full(8, np.nan)))


class SaysInfinity(Holds):
    """Hopes that no mean can hold it."""

    def cheat(self) -> None:
        self.say(floats(np.full(8, np.inf)))


class ChangesAfterwards(Holds):
    """Publishes one array and moves it from then on."""

    def start(self, node: Node) -> None:
        super().start(node)
        self.array: np.ndarray[Any, Any] | None = None
        node.create_timer(0.002, self.move)

    def cheat(self) -> None:
        if self.array is None:
            self.array = self.quad.copy()
        self.say(Float32MultiArray(data=self.array))

    def move(self) -> None:
        if self.array is not None:
            self.array.flags.writeable = True
            self.array += self.node.rng.normal(0.0, 1.0, 8)


class Floods(Holds):
    """Publishes without end."""

    def cheat(self) -> None:
        while True:
            self.say(floats(self.quad))


class HugeMessage(Holds):
    """Publishes half a gibibyte."""

    def cheat(self) -> None:
        self.say(Float32MultiArray(data=np.zeros(2**27, dtype=np.float32)))


class UsesThreads(Holds):
    """Publishes from a thread that outlives the level."""

    def start(self, node: Node) -> None:
        super().start(node)
        threading.Thread(target=self.publish, daemon=True).start()

    def publish(self) -> None:
        while True:
            time.sleep(0.01)
            with suppress(Exception):
                self.say(floats(self.quad))


class ChangesTime(Holds):
    """Stops the clocks and the chance of the whole process."""

    def start(self, node: Node) -> None:
        super().start(node)
        time.monotonic = time.perf_counter = time.time = lambda: 0.0
        random.random = lambda: 0.5
        np.random.default_rng = lambda seed=None: None  # type: ignore[assignment, return-value]


class Patches(Holds):
    """Makes every measure of its class a perfect one."""

    def cheat(self) -> None:
        EuclideanNorm.value = 0.0  # type: ignore[method-assign, assignment]
        super().cheat()


class FindsTheTruth(Holds):
    """Looks the truth up among the objects of the process."""

    def start(self, node: Node) -> None:
        super().start(node)
        self.truth: Any = None

    def cheat(self) -> None:
        if self.truth is None:
            found = [thing for thing in gc.get_objects() if isinstance(thing, EuclideanNorm)]
            self.truth = found[-1]._truth
        self.say(floats(self.truth.read()))


class ReadsTheFolder(Holds):
    """Looks the truth up in the rows of the run that have been written already, and in tracks."""

    def start(self, node: Node) -> None:
        super().start(node)
        self.truth: list[tuple[float, np.ndarray[Any, Any]]] | None = None

    def cheat(self) -> None:
        if self.truth is None:
            self.truth = list(self.found())
        known = [(abs(at - self.node.now), quad) for at, quad in self.truth]
        quad = min(known, key=lambda pair: pair[0])[1] if known else self.quad
        self.say(floats(quad))

    def found(self) -> Iterator[tuple[float, np.ndarray[Any, Any]]]:
        """Times in the trial and true corners, from every file that has any."""
        for path in sorted(Path(os.environ[FOLDER]).rglob("*")):
            for line in path.read_bytes().splitlines() if path.suffix == ".jsonl" else ():
                row = json.loads(line).get("row", {})
                for samples in row.get("logs", {}).values():
                    for time_in_level, _, *offsets in samples:
                        at = row["ended_at"] - row["duration"] + time_in_level
                        yield at, self.quad + np.array(offsets[:8])
            if path.suffix == ".motion":
                with suppress(ResultError):  # sealed
                    track = load_track(path)
                    truth = [k for k, each in enumerate(track.signals) if "truth/" in each.name]
                    for n, quad in enumerate(track.values[:, truth]):
                        if np.isfinite(quad).all():
                            yield n / track.rate, quad


CHEATS: tuple[type[Holds], ...] = (
    *(Bursts, BurstsOnce, Listens, SaysNothingWhenUnsure, SaysInfinity, ChangesAfterwards),
    *(Floods, HugeMessage, UsesThreads, ChangesTime, ReadsTheFolder, Patches, FindsTheTruth),
)
GAINS = (Patches, FindsTheTruth)
"""Known to gain in their own rows: they are in the process of the truth and of the measure."""


def bench_of(folder: Path, algorithm: type[Holds], *, seed: int, length: float) -> Run:
    """Return a short benchmark for one of them."""
    plan = make_plan(
        folder,
        algorithm,  # type: ignore[arg-type]
        LEVELS.replace("LENGTH", f"{length:g}"),
        measures=MEASURE,
        start=SERVICE,
        function=FUNCTION,
        scene=read_scene(DATA / "scenes" / "visibility-moving-scene.xml"),
    )
    name = algorithm.__name__
    plan = with_algorithm(replace(plan, seed=seed, is_blind=True), name=name)
    return Run(plan=plan, out=folder / name, inputs=Inputs(), renderer="none")


def trial(folder: Path, cheats: Sequence[type[Holds]], *, seed: int, length: float) -> Outcome:
    """Play them with one worker, `Holds` before and behind."""
    players = (Holds, *cheats, HoldsAfterwards)
    benches = [bench_of(folder, player, seed=seed, length=length) for player in players]
    with set_environment({FOLDER: str(folder)}):
        return run_each(benches, ProcessExecutor(1, callback_limit=60.0))


def by_name(outcome: Outcome) -> dict[str, Result]:
    """Name of an algorithm -> its result; without rows, where it never started."""
    return {str(result.run.algorithm): result for result in outcome.results}


def errors(results: dict[str, Result]) -> list[str]:
    """Say what a cheat gained that should not have, and whom it changed."""
    before, after = results["Holds"], results["HoldsAfterwards"]
    found = []
    if before.values("total") != after.values("total") or None in before.values("total"):
        found.append(f"Holds: {before.values('total')} before, {after.values('total')} behind")
    for cheat in set(results) - {"Holds", "HoldsAfterwards"} - {g.__name__ for g in GAINS}:
        totals = results[cheat].values("total")  # none, where it never started
        for row, (total, honest) in enumerate(zip(totals, before.values("total"), strict=False)):
            if total is not None and float(total) < WORTH * float(honest or 0.0):
                found.append(f"{cheat}: row {row} has {total}, Holds {honest}")
    return sorted(found)


def main() -> int:
    """Play all cheats, and print a line each."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--seed", type=int, default=1, help="of the benchmark")
    parser.add_argument("--length", type=float, default=5.0, help="of a level [s]")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        outcome = trial(Path(folder), CHEATS, seed=chosen.seed, length=chosen.length)
    for name, result in (results := by_name(outcome)).items():
        for row, (total, status) in enumerate(
            zip(result.values("total"), result.values("status"), strict=True)
        ):
            print(
                f"{name}: {status}, {total if total is not None else result.reason(row, 'total')}"
            )
    for bench, error in outcome.failures:
        print(f"{bench.plan.algorithm.name}: {error}")
    for error in (found := errors(results)):
        print("ERROR", error)
    return 1 if found else 0


if __name__ == "__main__":
    raise SystemExit(main())
