"""The table has every rule, and a rule is applied where what it needs is there."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

import uwsim.checks.model
import uwsim.checks.scene
from tests.support.short_benchmark import write_benchmark
from uwsim.checks import benchmarks, check_file, model_warnings, robots, scene_warnings, table
from uwsim.checks.rule import Need, Rule
from uwsim.checks.subjects import CheckedScene
from uwsim.errors import Diagnostic, UwsimError
from uwsim.physics.compile_scene import compile_scene
from uwsim.scene.reader import read_scene

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>5</z> </position>
    {}<u:dynamics>bluerov2_heavy</u:dynamics> </vehicle>
</UWSimScene>"""
WRONG = "<u:lamp> <name>lamp</name> <relativeTo>nowhere</relativeTo> </u:lamp>"


def written(folder: Path, inside: str = "") -> Path:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(inside))
    return path


def function_of(rule: Rule[Any]) -> Callable[..., object]:
    return rule.find.func if isinstance(rule.find, partial) else rule.find


def rule_functions() -> Iterator[Callable[..., object]]:
    """Every public function of the package that takes a subject and gives diagnostics."""
    names = [
        f"{package.__name__}.{module.name}"
        for package in (uwsim.checks.scene, uwsim.checks.model)
        for module in pkgutil.iter_modules(package.__path__)
    ]
    for module in [*map(importlib.import_module, names), robots, benchmarks]:
        for name, function in inspect.getmembers(module, inspect.isfunction):
            if name[0] != "_" and function.__module__ == module.__name__:
                first = next(iter(inspect.signature(function).parameters.values()), None)
                if first is not None and str(first.annotation).startswith("Checked"):
                    yield function


def test_every_rule_of_the_package_is_in_the_table() -> None:
    rules = [*table.SCENE_RULES, *table.ROBOT_RULES, *table.BENCHMARK_RULES]
    functions = [function_of(rule) for rule in rules]
    assert len(set(functions)) == len(functions)
    assert set(rule_functions()) == set(functions)


def probes(monkeypatch: pytest.MonkeyPatch, *, in_runs: bool = True) -> list[Need]:
    """Put a rule for each need into the table; returns the needs of those that were applied."""
    applied: list[Need] = []

    def find(need: Need, _scene: CheckedScene) -> list[Diagnostic]:
        applied.append(need)
        return []

    rules = [Rule(partial(find, need), need, in_runs=in_runs) for need in Need]
    monkeypatch.setattr(table, "SCENE_RULES", tuple(rules))
    return applied


def test_a_rule_is_applied_where_what_it_needs_could_be_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    applied = probes(monkeypatch)
    assert check_file(written(tmp_path)) == []
    assert applied == list(Need)


def test_a_rule_that_needs_a_valid_scene_is_not_applied_to_one_with_errors(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    applied = probes(monkeypatch)
    path = written(tmp_path, "<position> <x>far</x> <y>0</y> <z>0</z> </position>")
    assert any(each.severity == "error" for each in check_file(path))
    assert applied == [Need.DOCUMENT, Need.SPEC, Need.FILES]


def test_a_rule_that_needs_the_model_is_not_applied_where_there_can_be_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    applied = probes(monkeypatch)

    def refuse(scene: CheckedScene) -> Iterator[Diagnostic]:
        yield scene.error(scene.spec, "no")

    rules = list(table.SCENE_RULES)
    rules.insert(3, Rule(refuse, Need.VALID))
    monkeypatch.setattr(table, "SCENE_RULES", tuple(rules))
    assert [each.message for each in check_file(written(tmp_path))] == ["no"]
    assert applied == [Need.DOCUMENT, Need.SPEC, Need.FILES, Need.VALID]


@pytest.mark.parametrize("in_runs", [True, False])
def test_a_run_applies_the_rules_for_runs_alone(
    in_runs: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    applied = probes(monkeypatch, in_runs=in_runs)
    scene = read_scene(written(tmp_path))
    assert scene_warnings(scene, ()) == model_warnings(compile_scene(scene)) == []
    assert applied == (2 * list(Need) if in_runs else [])


def give_text(subject: object) -> list[Any]:
    return ["a text"]


def fail(subject: object) -> list[Diagnostic]:
    raise KeyError("lost")


@pytest.mark.parametrize("find", [give_text, fail, partial(fail)])
@pytest.mark.parametrize("kind", ["SCENE_RULES", "ROBOT_RULES", "BENCHMARK_RULES"])
@pytest.mark.parametrize("need", [Need.SPEC, Need.FILES])
def test_a_rule_that_fails_is_named_in_a_line(
    find: Any, kind: str, need: Need, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = written(tmp_path)
    if kind == "BENCHMARK_RULES":
        need, path = Need.SPEC, write_benchmark(tmp_path, "0.2")
    elif kind == "ROBOT_RULES":
        path = tmp_path / "robot.urdf"
        path.write_text('<robot name="rov"> <link name="base_link"/> </robot>')
    monkeypatch.setattr(table, kind, (Rule(find, need, in_runs=True),))
    said = r"yields 'a text'; expected a Diagnostic|raised KeyError: 'lost'"
    named = r"The rule tests\.checks\.test_table\.(give_text|fail)"
    with pytest.raises(UwsimError, match=rf"^{named} ({said})\.$"):
        check_file(path)
    if kind == "SCENE_RULES":
        with pytest.raises(UwsimError, match=named):
            scene_warnings(read_scene(path), ())


def test_a_run_and_check_report_the_same_warning_of_a_rule(tmp_path: Path) -> None:
    path = written(tmp_path)
    (found,) = [each for each in check_file(path) if "above the water" in each.message]
    scene = read_scene(path)
    assert found in scene_warnings(scene, ())
    assert found in model_warnings(compile_scene(scene))
