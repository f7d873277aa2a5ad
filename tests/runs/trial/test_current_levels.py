"""Levels of a current: what the original measures, and what a file adds with u:settlingTime."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.short_trial import DATA, make_plan, rows_of
from uwsim.bus import Node
from uwsim.messages import GTpublish, GTpublishResponse
from uwsim.runs.trial.level_row import LevelRow
from uwsim.runs.trial.trial import execute
from uwsim.scene.reader import read_scene

CURRENT = """<currentForceUpdater EXTRA>
  <initialValue>0.1</initialValue> <finalValue>0.25</finalValue>
  <sphericalDirection> <theta>M_PI_2</theta> <phi>0</phi> </sphericalDirection>
  <forceVariation>0</forceVariation> <forcePeriod>4</forcePeriod>
  <directionVariation> <theta>0</theta> <phi>0</phi> </directionVariation>
  <directionPeriod> <theta>4</theta> <phi>30</phi> </directionPeriod>
  <random>0</random> <step>0.1</step> <interval>3</interval> <target>girona500</target>
</currentForceUpdater>"""
WAY = "<distance> <name>way</name> <target>girona500</target> </distance>"
SUM = "<function>way</function>"


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


def ways(folder: Path, extra: str = "", mode: str = "sequential") -> list[tuple[float, float]]:
    """How far the vehicle was carried in each level [m], and how long that was measured [s]."""
    plan = make_plan(
        folder, Idle, CURRENT.replace("EXTRA", extra), measures=WAY, function=SUM, mode=mode
    )  # type: ignore[arg-type]
    return [(row.measures["way"][0] or 0.0, row.duration) for row in rows_of(plan)]


def test_an_original_sweep_of_currents_is_measured_from_each_levels_first_step(
    tmp_path: Path,
) -> None:
    found = ways(tmp_path)
    assert [duration for _, duration in found] == pytest.approx([3.0, 3.0])
    # no still water before the first level, 2 s of it behind the change to the second
    assert [way for way, _ in found] == pytest.approx([0.3, 0.2], abs=1e-3)


def test_every_independent_level_of_a_current_begins_with_2_s_of_still_water(
    tmp_path: Path,
) -> None:
    found = ways(tmp_path, mode="independent")
    assert found == [pytest.approx((0.1, 3.0), abs=1e-3), pytest.approx((0.2, 3.0), abs=1e-3)]


@pytest.mark.parametrize("mode", ["sequential", "independent"])
def test_a_settling_time_comes_before_the_interval_and_is_not_measured(
    tmp_path: Path, mode: str
) -> None:
    found = ways(tmp_path, 'u:settlingTime="2"', mode)
    assert found == [pytest.approx((0.3, 3.0), abs=1e-3), pytest.approx((0.6, 3.0), abs=1e-3)]


class Asked(Idle):
    """Keeps what autoInit is told, and when."""

    told: list[tuple[float, list[float]]]

    def start(self, node: Node) -> None:
        type(self).told = []

        def keep(request: GTpublish) -> GTpublishResponse:
            self.told.append((node.now, np.asarray(request.groundTruth).tolist()))
            return GTpublishResponse()

        node.serve("autoInit", GTpublish, keep)


CORNERS = """<euclideanNorm EXTRA> <name>corners</name>
  <groundTruth type="cornersFromCamera"> <camera>bowtech1</camera> <target>blackbox</target>
    <publishOn>autoInit</publishOn> </groundTruth>
  <target>cornersTopic</target> </euclideanNorm>"""


def told(
    folder: Path, extra: str = "", settling: str = "", mode: str = "sequential"
) -> list[tuple[float, list[float]]]:
    """When autoInit was called [s], and with which corners [px]."""
    scene = read_scene(DATA / "scenes" / "visibility-scene.xml")
    plan = make_plan(
        folder,
        Asked,
        CURRENT.replace("EXTRA", settling),
        measures=CORNERS.replace("EXTRA", extra) + WAY,
        function=SUM,
        scene=replace(scene, ros_interfaces=()),
        mode=mode,  # type: ignore[arg-type]
    )
    found = []
    for trial in plan.trials():
        assert [row for row in execute(plan, trial) if isinstance(row, LevelRow)]
        found += Asked.told
    return found


def test_the_tracker_gets_the_target_at_once_when_the_vehicle_is_put_back(tmp_path: Path) -> None:
    first, second = told(tmp_path)
    assert (first[0], second[0]) == (0.0, pytest.approx(3.0))
    assert second[1] == pytest.approx(first[1])


def test_after_a_settling_time_the_tracker_gets_the_target_when_measuring_begins(
    tmp_path: Path,
) -> None:
    times = [time for time, _ in told(tmp_path, settling='u:settlingTime="1"')]
    assert times == pytest.approx([1.0, 5.0])


def test_a_file_may_ask_that_the_tracker_gets_the_target_in_the_first_level_only(
    tmp_path: Path,
) -> None:
    assert [time for time, _ in told(tmp_path, 'u:autoInit="once"')] == [0.0]


@pytest.mark.slow
def test_in_an_independent_level_once_is_in_its_prelude(tmp_path: Path) -> None:
    once = told(tmp_path, 'u:autoInit="once"', mode="independent")
    always = told(tmp_path, mode="independent")
    assert [time for time, _ in once] == [0.0, 0.0]  # a prelude for each of the two levels
    assert [time for time, _ in always] == pytest.approx([0.0, 2.0, 0.0, 2.0])
