"""Measure the gain of each way to cheat, for algorithms that read no image.

Each cheat runs a short benchmark of a swaying vehicle with black images; all have the same first
quad. `FirstQuadTracker`, the baseline, publishes this quad at every image. A cheat with a better
score has a gain; `GAINS` lists the cheats with a known gain, because code in the same process can
read everything. The baseline runs again after all cheats: if its score is not the same to the last
digit, a cheat has changed the result of another algorithm.

    scripts/cheat_trials --seed 3

Exit status 1: a cheat has an unexpected gain, or changes the score of another algorithm.
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
"""The environment variable of the results' folder."""
GAIN_THRESHOLD = 0.97
"""A cheat gains if its score is less than this fraction of the score of `FirstQuadTracker`."""


class FirstQuadTracker:
    """The baseline: it publishes the first quad at every image."""

    def start(self, node: Node) -> None:
        self.node, self.has_started = node, False
        self.quad = np.zeros(8, dtype=np.float32)
        self.publish = node.publisher("cornersTopic", Float32MultiArray)
        node.serve("autoInit", GTpublish, self.store_quad)
        node.subscribe("/uwsim/camera1", Image, self.on_image)

    def store_quad(self, request: GTpublish) -> GTpublishResponse:
        self.quad = np.array(request.groundTruth, dtype=np.float32)
        return GTpublishResponse()

    def on_image(self, image: Image) -> None:
        if not self.has_started:
            self.has_started = True
            self.node.call("startBench", Empty())
        elif self.quad.any():
            self.cheat()

    def cheat(self) -> None:
        self.publish(floats(self.quad))


class FirstQuadTrackerAfterwards(FirstQuadTracker):
    """The baseline after all cheats."""


class Bursts(FirstQuadTracker):
    """A cheat that publishes two hundred guesses at every image."""

    def cheat(self) -> None:
        for guess in self.node.rng.normal(0.0, 20.0, (200, 8)):
            self.publish(floats(self.quad + guess))
        self.publish(floats(self.quad))


class BurstsOnce(FirstQuadTracker):
    """A cheat that publishes a thousand times at the start, and then as rarely as allowed."""

    def cheat(self) -> None:
        is_start = self.node.now < 0.5
        if is_start or round(self.node.now / 0.033) % 27 == 0:
            for _ in range(1000 if is_start else 1):
                self.publish(floats(self.quad))


class CorrectsFromResults(FirstQuadTracker):
    """A cheat that corrects its estimate by the live results."""

    def start(self, node: Node) -> None:
        super().start(node)
        node.subscribe("BenchmarkResults", Float32MultiArray, self.correct)

    def correct(self, results: Float32MultiArray) -> None:
        if len(results.data) > 8:
            self.quad[0] += results.data[3]


class PublishesNanWhenUnsure(FirstQuadTracker):
    """A cheat that publishes NaN in most cases."""

    def cheat(self) -> None:
        is_sure = round(self.node.now / 0.033) % 20 == 0
        self.publish(floats(self.quad if is_sure else np.full(8, np.nan)))


class PublishesInfinity(FirstQuadTracker):
    """A cheat that publishes infinite values."""

    def cheat(self) -> None:
        self.publish(floats(np.full(8, np.inf)))


class ChangesAfterwards(FirstQuadTracker):
    """A cheat that publishes an array, and changes it afterwards."""

    def start(self, node: Node) -> None:
        super().start(node)
        self.array: np.ndarray[Any, Any] | None = None
        node.create_timer(0.002, self.move)

    def cheat(self) -> None:
        if self.array is None:
            self.array = self.quad.copy()
        self.publish(Float32MultiArray(data=self.array))

    def move(self) -> None:
        if self.array is not None:
            self.array.flags.writeable = True
            self.array += self.node.rng.normal(0.0, 1.0, 8)


class Floods(FirstQuadTracker):
    """A cheat that publishes endlessly."""

    def cheat(self) -> None:
        while True:
            self.publish(floats(self.quad))


class HugeMessage(FirstQuadTracker):
    """A cheat that publishes half a gibibyte."""

    def cheat(self) -> None:
        self.publish(Float32MultiArray(data=np.zeros(2**27, dtype=np.float32)))


class UsesThreads(FirstQuadTracker):
    """A cheat that publishes from a thread, also after the level."""

    def start(self, node: Node) -> None:
        super().start(node)
        threading.Thread(target=self.publish_forever, daemon=True).start()

    def publish_forever(self) -> None:
        while True:
            time.sleep(0.01)
            with suppress(Exception):
                self.publish(floats(self.quad))


class ChangesTime(FirstQuadTracker):
    """A cheat that replaces clocks and random numbers of the process."""

    def start(self, node: Node) -> None:
        super().start(node)
        time.monotonic = time.perf_counter = time.time = lambda: 0.0
        random.random = lambda: 0.5
        np.random.default_rng = lambda seed=None: None  # type: ignore[assignment, return-value]


class Patches(FirstQuadTracker):
    """A cheat that replaces the value of all measures of a class."""

    def cheat(self) -> None:
        EuclideanNorm.value = 0.0  # type: ignore[method-assign, assignment]
        super().cheat()


class FindsTheTruth(FirstQuadTracker):
    """A cheat that reads the ground truth from the objects of the process."""

    def start(self, node: Node) -> None:
        super().start(node)
        self.truth: Any = None

    def cheat(self) -> None:
        if self.truth is None:
            measures = [
                instance for instance in gc.get_objects() if isinstance(instance, EuclideanNorm)
            ]
            self.truth = measures[-1]._truth
        self.publish(floats(self.truth.read()))


class ReadsTheFolder(FirstQuadTracker):
    """A cheat that reads the ground truth from rows and tracks in the folder of the run."""

    def start(self, node: Node) -> None:
        super().start(node)
        self.truth: list[tuple[float, np.ndarray[Any, Any]]] | None = None

    def cheat(self) -> None:
        if self.truth is None:
            self.truth = list(self.read_corners())
        candidates = [
            (abs(time_in_trial - self.node.now), quad) for time_in_trial, quad in self.truth
        ]
        quad = min(candidates, key=lambda pair: pair[0])[1] if candidates else self.quad
        self.publish(floats(quad))

    def read_corners(self) -> Iterator[tuple[float, np.ndarray[Any, Any]]]:
        """Yield times in the trial and true corners from all files."""
        for path in sorted(Path(os.environ[FOLDER]).rglob("*")):
            for line in path.read_bytes().splitlines() if path.suffix == ".jsonl" else ():
                row = json.loads(line).get("row", {})
                for samples in row.get("logs", {}).values():
                    for time_in_level, _, *offsets in samples:
                        time_in_trial = row["ended_at"] - row["duration"] + time_in_level
                        yield time_in_trial, self.quad + np.array(offsets[:8])
            if path.suffix == ".motion":
                with suppress(ResultError):  # sealed
                    track = load_track(path)
                    truth_columns = [
                        k for k, signal in enumerate(track.signals) if "truth/" in signal.name
                    ]
                    for n, quad in enumerate(track.values[:, truth_columns]):
                        if np.isfinite(quad).all():
                            yield n / track.rate, quad


BASELINE, REPEATED_BASELINE = FirstQuadTracker.__name__, FirstQuadTrackerAfterwards.__name__
CHEATS: tuple[type[FirstQuadTracker], ...] = (
    *(
        Bursts,
        BurstsOnce,
        CorrectsFromResults,
        PublishesNanWhenUnsure,
        PublishesInfinity,
        ChangesAfterwards,
    ),
    *(Floods, HugeMessage, UsesThreads, ChangesTime, ReadsTheFolder, Patches, FindsTheTruth),
)
GAINS = (Patches, FindsTheTruth)
"""The cheats that gain in their own rows: they run in the process of ground truth and measure."""


def bench_of(folder: Path, algorithm: type[FirstQuadTracker], *, seed: int, length: float) -> Run:
    """Return a short benchmark for a cheat."""
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


def trial(
    folder: Path, cheats: Sequence[type[FirstQuadTracker]], *, seed: int, length: float
) -> Outcome:
    """Run cheats with one worker, with the baseline before and after them."""
    algorithms = (FirstQuadTracker, *cheats, FirstQuadTrackerAfterwards)
    benches = [bench_of(folder, cls, seed=seed, length=length) for cls in algorithms]
    with set_environment({FOLDER: str(folder)}):
        return run_each(benches, ProcessExecutor(1, callback_limit=60.0))


def results_by_name(outcome: Outcome) -> dict[str, Result]:
    """Return the result of each algorithm, by name; a result without a start has no rows."""
    return {str(result.run.algorithm): result for result in outcome.results}


def find_errors(results: dict[str, Result]) -> list[str]:
    """Describe unexpected gains, and changes of the baseline."""
    baseline, repeated_baseline = results[BASELINE], results[REPEATED_BASELINE]
    messages = []
    if baseline.values("total") != repeated_baseline.values("total") or None in baseline.values(
        "total"
    ):
        messages.append(
            f"baseline: {baseline.values('total')} first, {repeated_baseline.values('total')} last"
        )
    for cheat in set(results) - {BASELINE, REPEATED_BASELINE} - {g.__name__ for g in GAINS}:
        totals = results[cheat].values("total")  # none, where it never started
        for row, (total, baseline_total) in enumerate(
            zip(totals, baseline.values("total"), strict=False)
        ):
            if total is not None and float(total) < GAIN_THRESHOLD * float(baseline_total or 0.0):
                messages.append(f"{cheat}: row {row} has {total}, the baseline {baseline_total}")
    return sorted(messages)


def main() -> int:
    """Run all cheats, and print a line for each row."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--seed", type=int, default=1, help="seed of the benchmark")
    parser.add_argument("--length", type=float, default=5.0, help="length of a level [s]")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        outcome = trial(Path(folder), CHEATS, seed=options.seed, length=options.length)
    for name, result in (results := results_by_name(outcome)).items():
        for row, (total, status) in enumerate(
            zip(result.values("total"), result.values("status"), strict=True)
        ):
            print(
                f"{name}: {status}, {total if total is not None else result.reason(row, 'total')}"
            )
    for bench, error in outcome.failures:
        print(f"{bench.plan.algorithm.name}: {error}")
    for error in (errors := find_errors(results)):
        print("ERROR", error)
    return 1 if errors else 0


if __name__ == "__main__":
    raise SystemExit(main())
