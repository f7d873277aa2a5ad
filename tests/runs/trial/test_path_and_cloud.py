"""A path and point clouds on the bus of a whole run: what stands in the result at the end."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from tests.support.short_trial import DATA, make_plan, rows_of
from uwsim.base.geometry import Pose
from uwsim.bus import Node
from uwsim.messages import Path as PathMessage
from uwsim.messages import (
    Point,
    PointCloud2,
    PoseStamped,
    Quaternion,
    String,
    header,
    point_cloud,
)
from uwsim.messages import Pose as PoseMessage
from uwsim.results.inputs import Inputs
from uwsim.runs.executors.executor import run_all
from uwsim.runs.run import Run
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec

MEASURES = """
<positionError> <name>goal</name> <target>girona500</target>
  <position> <x>0</x> <y>0</y> <z>0</z> </position> <topic>goal</topic> </positionError>
<reconstruction3D detailedResultsToGlobals="true"> <name>cloud</name> <target>blackbox</target>
  <topic>/points</topic> <from>girona500</from> <levelOfDetail>0.05</levelOfDetail>
  <log>0.1</log> </reconstruction3D>
<pathFollowing> <name>path</name> <target>girona500</target> <topic>path</topic>
  <from>localizedWorld</from> <log>0.1</log> </pathFollowing>
"""
TWICE = "<repeat> <iterations>2</iterations> <interval>0.4</interval> </repeat>"


def scene() -> SceneSpec:
    whole = read_scene(DATA / "scenes" / "visibility-scene.xml")
    box = [thing for thing in whole.objects if thing.name == "blackbox"]
    return replace(whole, objects=tuple(box), ros_interfaces=())


def stamped(x: float, y: float, z: float) -> PoseStamped:
    turn = Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    return PoseStamped(
        header=header(0.0), pose=PoseMessage(position=Point(x=x, y=y, z=z), orientation=turn)
    )


def above_the_box() -> np.ndarray:
    """Points 2 cm and 4 cm over its top, in the frame of the vehicle, (2, 3) [m]."""
    simulation = open_scene(scene(), is_blind=True)
    box, vehicle = (
        simulation.world.bodies.find("blackbox"),
        simulation.world.bodies.find("girona500"),
    )
    assert box.box is not None
    stands = box.world_from_body
    up = 1.0 if stands.rotation[2, 2] > 0.0 else -1.0
    top = box.box.upper[2] if up > 0.0 else box.box.lower[2]
    points = np.array([[0.0, 0.0, top + up * 0.02], [0.01, 0.0, top + up * 0.04]])
    vehicle_from_box: Pose = vehicle.world_from_body.inverse() @ stands
    simulation.close()
    return vehicle_from_box.transform(points)


class Guides:
    """Says once, when it starts, where the path and the goal are; sends clouds all the time."""

    def start(self, node: Node) -> None:
        # the vehicle stands at L (2, 0, 2.515)
        poses = [stamped(0.0, 0.3, 2.115), stamped(8.0, 0.3, 2.115)]
        node.publisher("path", PathMessage)(PathMessage(header=header(0.0), poses=poses))
        node.publisher("goal", PoseStamped)(stamped(2.0, 3.0, 2.515))
        self.send = node.publisher("points", PointCloud2)
        self.points = above_the_box()
        node.create_timer(0.1, lambda: self.send(point_cloud(self.points)))


class IsLost(Guides):
    def start(self, node: Node) -> None:
        super().start(node)
        node.publisher("algorithmStatus", String)(String(data="lost: in the dark"))


def test_the_status_an_algorithm_published_at_its_start_holds_for_every_level(
    tmp_path: Path,
) -> None:
    plan = make_plan(
        tmp_path, Guides, TWICE, measures=MEASURES, function="<function>path</function>",
        scene=scene(),
    )  # fmt: skip
    [result] = run_all([Run(plan=plan, out=tmp_path / "out", inputs=Inputs(), renderer="none")])
    assert result.values("status") == ("ok", "ok")
    for level in range(2):
        assert result.numbers("goal")[level] == pytest.approx(3.0)
        assert result.numbers("path")[level] == pytest.approx(0.5 * 0.4)
        assert result.numbers("path.ise")[level] == pytest.approx(0.25 * 0.4)
        assert result.numbers("path.share")[level] == pytest.approx(0.25)
        assert result.numbers("cloud")[level] == pytest.approx(0.03, abs=1e-6)
        assert result.numbers("cloud.n_clouds")[level] == 4.0
    units = {column.name: column.unit for column in result.columns}
    assert units["path"] == "m s"
    assert units["path.ise"] == "m^2 s"
    assert units["cloud.error_variance"] == "m^2"
    assert units["cloud.coverage"] is None
    dat = (tmp_path / "out" / "result.dat").read_text().split("\n")
    four = "mean error\terror variance\tcoverage %\toutliers %"
    assert dat[0] == f"Iteration\tgoal\t{four}\tpath\tTOTAL\tSimTime\t"
    assert dat[1].split("\t")[:3] == ["0", "3", "0.03"]
    log = (tmp_path / "out" / "measure-path.csv").read_text().split("\n")
    assert log[0] == "iteration,time [s],iae [m s],distance [m],waypoint,ise [m^2 s],share"
    original = (tmp_path / "out" / "benchmark-path.data").read_text().split("\n")
    assert original[0] == "Iteration\tISE\tdistanceToPath\twaypoint\t"
    assert original[2] == "0.1\t0.05\t0.5\t0\t"


def test_who_is_lost_has_no_reconstruction_but_the_path_is_the_worlds(tmp_path: Path) -> None:
    plan = make_plan(
        tmp_path, IsLost, TWICE, measures=MEASURES, function="<function>path</function>",
        scene=scene(),
    )  # fmt: skip
    row = rows_of(plan)[0]
    assert row.status == "lost"
    assert row.measures["path"][0] == pytest.approx(0.2)
    assert row.measures["cloud"][0] is None
    assert "in the dark" in row.missing_reasons["cloud"]
    assert row.details["cloud.coverage"][0] is None
    assert row.total is None
