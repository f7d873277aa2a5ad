"""u:settingUpdater: a number of the scene file, level by level."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.support.short_trial import make_plan, tank
from uwsim.benchmark.updater_settings import check_scene_settings, scene_of_level
from uwsim.benchmark.updaters import SettingUpdaterSpec, levels
from uwsim.bus import Node
from uwsim.checks.check import check_file
from uwsim.errors import BadSetting
from uwsim.runs.planning.plan import Plan
from uwsim.runs.trial.level_row import LevelRow
from uwsim.runs.trial.trial import open_trial
from uwsim.scene.variation import UniformSpec

PATH = "vehicle[girona500].position.x"
UPDATER = f"""<u:settingUpdater u:column="x" u:unit="m"> <path>{PATH}</path>
<initialValue>0.5</initialValue> <finalValue>1.1</finalValue> <step>0.3</step>
<interval>0.02</interval> </u:settingUpdater>"""
SPEC = SettingUpdaterSpec(path=PATH, initial_value=0.5, final_value=1.1, step=0.3, interval=1.0)


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


def independent_plan(folder: Path) -> Plan:
    return make_plan(folder, Idle, UPDATER, mode="independent")


def test_each_level_opens_the_scene_with_its_value(tmp_path: Path) -> None:
    plan, positions, rows = independent_plan(tmp_path), [], list[LevelRow]()
    for trial in plan.trials():
        with open_trial(plan, trial) as execution:
            scene = execution.simulation.world.model.source
            positions.append(scene.vehicles[0].position[0])
            rows += [row for row in execution.rows() if isinstance(row, LevelRow)]
    assert positions == pytest.approx([0.5, 0.8, 1.1])
    assert [row.values[0] for row in rows] == [("x", pytest.approx(x)) for x in (0.5, 0.8, 1.1)]


def test_the_column_is_the_last_name_of_the_path_unless_it_is_named() -> None:
    assert (SPEC.parameter, SPEC.parameter_unit) == ("x", "1")
    share = replace(SPEC, path="object[pipe].course.buriedShare")
    assert share.parameter == "buriedShare"
    assert replace(share, column="depth", column_unit="m").parameter == "depth"


def test_other_values_of_the_scene_remain() -> None:
    scene = tank()
    level = levels(SPEC)[-1]
    changed = scene_of_level(scene, SPEC, level)
    vehicle = replace(scene.vehicles[0], position=changed.vehicles[0].position)
    assert changed == replace(scene, vehicles=(vehicle, *scene.vehicles[1:]))


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("vehicle[girona].position.x", "Did you mean 'girona500'"),
        ("vehicle[girona500].position", "three numbers; choose one, .x"),
        ("oceanState.fog.colour.x", "there is no <colour>"),
    ],
)
def test_a_wrong_path_is_an_error_with_its_line(tmp_path: Path, path: str, message: str) -> None:
    plan = make_plan(tmp_path, Idle, UPDATER.replace(PATH, path), mode="independent")
    (error,) = check_scene_settings(plan.benchmark, plan.scene, is_independent=True)
    assert (error.line, error.severity) == (3, "error")
    assert message in error.message


def test_levels_that_depend_on_one_another_are_an_error(tmp_path: Path) -> None:
    plan = independent_plan(tmp_path)
    (error,) = check_scene_settings(plan.benchmark, plan.scene, is_independent=False)
    assert 'expected <benchmark u:mode="independent">' in error.message
    scene = Path(str(plan.scene.path))
    found = [item.message for item in check_file(tmp_path / "benchmark.xml", scene=scene)]
    assert any('expected <benchmark u:mode="independent">' in message for message in found)


def test_a_value_that_the_scene_draws_cannot_be_set() -> None:
    scene = replace(tank(), vary=(UniformSpec(path=PATH, low=0.0, high=1.0),))
    with pytest.raises(BadSetting, match="<u:vary> of the scene draws it"):
        scene_of_level(scene, SPEC, levels(SPEC)[0])
