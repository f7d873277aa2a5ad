"""The comparison of trackers: what `visibility-moving` is for."""

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from uwsim.benchmark.metrics.min_area_rectangle import rectangle
from uwsim.bus import Node
from uwsim.messages import (
    Empty,
    Float32MultiArray,
    GTpublish,
    GTpublishResponse,
    Image,
    floats,
    pixels_of,
)
from uwsim.runs.executors.executor import run_all
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan import Plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.prepare import hash_inputs
from uwsim.runs.run import Run
from uwsim.runs.trial.level_row import LevelRow
from uwsim.runs.trial.trial import execute

TRACKERS = ("ecc", "esm", "ic", "orb", "ssd-esm")


class Guesses:
    """Looks at no image: repeats what it was told, above all when it happens to be near."""

    def start(self, node: Node) -> None:
        self.node, self.told = node, np.zeros(8)
        self.corners = node.publisher("cornersTopic", Float32MultiArray)
        self.centroid = node.publisher("centroidTopic", Float32MultiArray)
        node.serve("autoInit", GTpublish, self.listen)
        node.every(0.002, self.guess)
        node.call("startBench", Empty())

    def listen(self, request: GTpublish) -> GTpublishResponse:
        self.told = np.asarray(request.groundTruth, dtype=float)
        return GTpublishResponse()

    def guess(self) -> None:
        is_near = 2.0 < self.node.now < 2.1
        is_owed = round(self.node.now / 0.002) % 250 == 0
        for _ in range(20 if is_near else int(is_owed)):
            self.corners(floats(self.told))
            self.centroid(floats(self.told.reshape(4, 2).mean(axis=0)))


def test_guesses_published_in_a_burst_score_what_they_are_worth(tmp_path: Path) -> None:
    guesses, frozen = (
        blind(name, tmp_path / name[:4])["corners"]
        for name in ("tests.runs.trial.test_moving_target:Guesses", "frozen")
    )
    assert guesses > 0.95 * frozen


def blind(algorithm: str, out: Path) -> dict[str, float]:
    """Play the clear level without drawing anything; returns the measures."""
    plan = replace(plan_of(algorithm, ["fog=0"]), is_blind=True)
    [row] = [row for row in execute(plan, plan.trials()[0]) if isinstance(row, LevelRow)]
    assert row.status == "ok"
    return {name: value for name, (value, _) in row.measures.items() if value is not None}


class Blob:
    """The smallest rectangle round whatever is orange: it knows no pattern and follows no face."""

    def start(self, node: Node) -> None:
        self.corners = node.publisher("cornersTopic", Float32MultiArray)
        self.centroid = node.publisher("centroidTopic", Float32MultiArray)
        node.serve("autoInit", GTpublish, lambda request: GTpublishResponse())
        node.subscribe("/uwsim/camera1", Image, self.look)
        node.call("startBench", Empty())

    def look(self, message: Image) -> None:
        red, green, blue = np.moveaxis(pixels_of(message).astype(int), 2, 0)
        orange = ((red > 100) & (red - blue > 60) & (red > green)).astype(np.uint8)
        orange = cv2.morphologyEx(orange, cv2.MORPH_CLOSE, np.ones((9, 9), np.uint8))
        outlines, _ = cv2.findContours(orange, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        if outlines:
            points = max(outlines, key=cv2.contourArea).reshape(-1, 2)
            quad = rectangle(points.astype(np.float64))
            self.corners(floats(quad.reshape(-1)))
            self.centroid(floats(quad.mean(axis=0)))


@pytest.mark.slow
def test_in_clear_water_a_tracker_beats_a_blob_of_colour(tmp_path: Path) -> None:
    blob = totals("tests.runs.trial.test_moving_target:Blob", tmp_path / "blob")[0.0]
    esm = totals("esm", tmp_path / "esm")[0.0]
    assert esm is not None
    assert blob is not None
    assert esm < 1.0  # of a tracker without error it is 0
    assert blob > 3.0 * esm


def totals(algorithm: str, out: Path) -> dict[float, float | None]:
    plan = plan_of(algorithm, ["fog=0", "fog=0.9"])
    inputs, renderer = hash_inputs(plan)
    [result] = run_all([Run(plan=plan, out=out, inputs=inputs, renderer=renderer)])
    fogs = [value for value in result.numbers("fog") if value is not None]
    return dict(zip(fogs, result.numbers("total"), strict=True))


def plan_of(algorithm: str, levels: list[str]) -> Plan:
    return make_plan(
        PlanRequest(
            benchmark="visibility-moving", algorithm=algorithm, seed=1, repeat=1, levels=levels
        )
    )


@pytest.mark.slow
def test_where_something_moves_frozen_is_worst_until_the_others_are_lost(tmp_path: Path) -> None:
    frozen = totals("frozen", tmp_path / "frozen")
    tracked = 0
    for name in TRACKERS:
        for fog, total in totals(name, tmp_path / name).items():
            worst = frozen[fog]
            assert worst is not None
            if total is not None:
                tracked += 1
                assert total < worst / 2, f"{name} at fog {fog}"
    assert tracked >= len(TRACKERS)  # at fog 0 every one of them tracks
