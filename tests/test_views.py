"""No class has too many public names; views of the world are their Protocols and no more."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import uwsim

PACKAGE = Path(uwsim.__file__).parent
LIMIT, LIMIT_OF_A_VIEW = 25, 16
"""Public names of a class, inherited ones included."""
VIEWS = {
    "MeasureView": "World",
    "SurroundingsView": "Surroundings",
    "StageView": "Stage",
    "AdjustedWater": "StageWater",
    "DeviceView": "DeviceWorld",
    "SensorView": "SensorWorld",
    "ForceView": "ForceWorld",
    "TopicView": "TopicWorld",
}
"""View of a scene -> the Protocol that it implements."""
Function = ast.FunctionDef | ast.AsyncFunctionDef


@cache
def classes() -> dict[str, list[tuple[Path, ast.ClassDef]]]:
    """Return the classes of the package by name, with their modules."""
    found: dict[str, list[tuple[Path, ast.ClassDef]]] = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ClassDef):
                found.setdefault(node.name, []).append((path, node))
    return found


def own_names(node: ast.ClassDef) -> Iterator[str]:
    """Names of methods, properties and attributes.

    Fields do not count: those of a dataclass, and those of a spec that a document has as
    attributes (`tests/editing/test_attributes.py` compares them).
    """
    is_dataclass = any("dataclass" in ast.unparse(each) for each in node.decorator_list)
    is_document = any(ast.unparse(base).startswith("Document[") for base in node.bases)
    for member in node.body:
        if isinstance(member, Function):
            yield member.name
            if member.name == "__init__":
                yield from assigned_names(member)
        elif isinstance(member, ast.AnnAssign) and not (is_dataclass or is_document):
            yield ast.unparse(member.target)
        elif isinstance(member, ast.Assign) and not is_dataclass:
            yield from map(ast.unparse, member.targets)


def assigned_names(method: Function) -> Iterator[str]:
    """Names of the attributes that a method sets in its object."""
    for node in ast.walk(method):
        if (
            isinstance(node, ast.Attribute)
            and isinstance(node.ctx, ast.Store)
            and ast.unparse(node.value) == "self"
        ):
            yield node.attr


def public_names(path: Path, node: ast.ClassDef) -> set[str]:
    """Public names of a class with those that it inherits from other classes of the package."""
    names = {name for name in own_names(node) if not name.startswith("_")}
    for base in node.bases:
        name = ast.unparse(base).split("[")[0].split(".")[-1]
        known = [each for each in classes().get(name, []) if each[1] is not node]
        if known:  # of several of one name the nearest
            names |= public_names(*max(known, key=lambda each: nearness(path, each[0])))
    return names


def nearness(path: Path, other: Path) -> int:
    """How many folders two modules share, and one more if they are the same module."""
    return len(set(path.parents) & set(other.parents)) + (path == other)


def test_no_class_has_too_many_public_names() -> None:
    sizes = {
        name: max(len(public_names(*each)) for each in nodes) for name, nodes in classes().items()
    }
    large = {name: size for name, size in sizes.items() if size > LIMIT}
    assert large == {}


@pytest.mark.parametrize(("view", "protocol"), VIEWS.items())
def test_a_view_of_the_world_has_the_names_of_its_protocol_and_no_more(
    view: str, protocol: str
) -> None:
    (implementation,), (declared,) = classes()[view], classes()[protocol]
    names = public_names(*declared)
    assert public_names(*implementation) == names
    assert 0 < len(names) <= LIMIT_OF_A_VIEW


def test_every_view_is_tested() -> None:
    folder = PACKAGE / "simulation" / "world_views"
    found = {name for name, ((path, _), *_) in classes().items() if path.parent == folder}
    assert found - set(VIEWS) == {"SceneView", "SceneAttachment", "_Mount"}


def test_no_public_constructor_takes_options_of_any_type() -> None:
    wrong = [
        f"{path.relative_to(PACKAGE)}:{member.lineno} {name}"
        for name, nodes in classes().items()
        for path, node in nodes
        for member in node.body
        if isinstance(member, Function) and member.name == "__init__" and not name.startswith("_")
        if member.args.kwarg is not None
    ]
    assert wrong == []


def test_what_belongs_together_is_passed_as_one() -> None:
    """Scene, robots, dynamics ... are a `ResolvedScene`, `SimulatedScene` or `SceneModel`."""
    parts = {"scene", "robots", "dynamics", "shapes", "data_path", "timestep", "compatibility"}
    found = {
        node.name
        for path in sorted(PACKAGE.rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, Function)
        if len(parts & {each.arg for each in node.args.args + node.args.kwonlyargs}) > 2
    }
    # these make one of the scene of a file
    assert found == {"load", "compile_scene", "scene_warnings"}


def private_uses(path: Path) -> Iterator[str]:
    """Yield where a module uses a private attribute of another object than ``self``."""
    for node in ast.walk(ast.parse(path.read_text())):
        if not isinstance(node, ast.Attribute) or not node.attr.startswith("_"):
            continue
        if node.attr.startswith("__") or ast.unparse(node.value) in {"self", "cls", "super()"}:
            continue
        yield f"{path.name}:{node.lineno} {ast.unparse(node)}"


@pytest.mark.parametrize("folder", ["viewer", "simulation", "benchmark/updaters", "runs/trial"])
def test_no_private_attribute_of_another_object_is_used(folder: str) -> None:
    modules = sorted((PACKAGE / folder).rglob("*.py"))
    assert len(modules) > 5
    assert [use for path in modules for use in private_uses(path)] == []


def test_a_private_attribute_of_another_object_is_seen(tmp_path: Path) -> None:
    module = tmp_path / "module.py"
    module.write_text("self._own = other._theirs\nself._part._inner()\n")
    assert list(private_uses(module)) == [
        "module.py:1 other._theirs",
        "module.py:2 self._part._inner",
    ]
