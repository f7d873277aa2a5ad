"""Who may import whom: the drawing in docs/architecture.md, held against every import statement."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Callable
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parent.parent / "src" / "uwsim"
PAGE = PACKAGE / "viewer" / "page" / "source"

MAX_MODULES = 20

GROUND = {
    *(
        "errors",
        "version",
        "base",
        "acoustics",
        "optics",
        "cameras",
        "rays",
        "schema",
        "autopilots",
    ),
}
BASE = GROUND | {"network", "world", "vehicle", "messages", "bus"}
PARTS = BASE | {
    "bathymetry",
    "currents",
    "waves",
    "particles",
    "forces",
    "sensors",
    "devices",
    "topics",
    "scene",
    "assets",
}
ENGINES = PARTS | {"model", "physics", "rendering"}
TASKS = PARTS | {"simulation", "algorithms", "statistics", "benchmark", "results"}

MAY_IMPORT: dict[str, set[str]] = {
    **{room: GROUND for room in GROUND},
    "errors": {"errors"},
    "version": {"version"},
    "base": {"errors", "base"},
    "optics": {"errors", "base", "optics"},
    "cameras": {"errors", "base", "cameras"},
    "autopilots": {"errors", "base", "autopilots"},
    "network": GROUND | {"network"},
    "messages": BASE,
    "bus": GROUND | {"bus"},
    "world": BASE,
    "vehicle": BASE,
    "statistics": GROUND | {"statistics"},
    "middleware": BASE | {"middleware"},
    "bathymetry": GROUND | {"bathymetry"},
    "currents": BASE | {"currents"},
    "waves": BASE | {"currents", "waves"},
    "particles": BASE | {"particles"},
    "forces": BASE | {"forces"},
    "sensors": BASE | {"sensors", "devices"},
    "devices": BASE | {"sensors", "devices"},
    "topics": BASE | {"sensors", "devices", "topics"},
    "scene": PARTS,
    "assets": BASE | {"assets"},
    "model": PARTS | {"model"},
    "physics": PARTS | {"model", "physics"},
    "rendering": PARTS | {"model", "rendering"},
    "simulation": ENGINES | {"results", "simulation"},
    "algorithms": {
        *("messages", "bus", "base", "errors", "algorithms"),
    },
    "benchmark": PARTS | {"benchmark"},
    "results": GROUND | {"statistics", "results"},
    "checks": TASKS | {"model", "physics", "checks"},
    "runs": TASKS | {"checks", "middleware", "model", "physics", "runs"},
    "analysis": GROUND | {"statistics", "results", "analysis"},
    "calibration": GROUND | {"results", "analysis", "statistics", "calibration"},
    "logs": BASE | {"middleware", "logs"},
    "reality_gap": TASKS | ENGINES | {"analysis", "middleware", "logs", "reality_gap"},
    "identification": TASKS | ENGINES | {"analysis", "logs", "identification"},
    "virtual_sensors": ENGINES | {"simulation", "logs", "virtual_sensors"},
    "scenarios": (
        TASKS | ENGINES | {"checks", "runs", "middleware", "logs", "virtual_sensors", "scenarios"}
    ),
    "importing": PARTS | {"importing"},
    "editing": TASKS | ENGINES | {"checks", "editing"},
    "envs": TASKS | ENGINES | {"checks", "editing", "runs", "viewer", "envs"},
    "manoeuvres": TASKS | ENGINES | {"analysis", "manoeuvres"},
    "datasets": (
        TASKS | ENGINES | {"runs", "analysis", "middleware", "viewer", "envs", "datasets"}
    ),
    "envelope": TASKS | {"runs", "analysis", "envelope"},
    "verify": TASKS | {"runs", "verify"},
    "campaigns": TASKS | {"runs", "verify", "campaigns"},
    "suites": TASKS | {"runs", "verify", "campaigns", "analysis", "middleware", "viewer", "suites"},
    "viewer": TASKS | ENGINES | {"runs", "verify", "middleware", "viewer"},
    "__main__": {"cli", "base"},
    "cli": (
        TASKS
        | ENGINES
        | {
            "checks",
            "runs",
            "analysis",
            "calibration",
            "envelope",
            "verify",
            "campaigns",
            "suites",
            "middleware",
            "logs",
            "reality_gap",
            "identification",
            "virtual_sensors",
            "manoeuvres",
            "scenarios",
            "importing",
            "datasets",
            "editing",
            "viewer",
            "cli",
        }
    ),
}
MAY_IMPORT["api"] = MAY_IMPORT["cli"]
"""Room -> rooms it may import from."""


def modules() -> list[Path]:
    return sorted(PACKAGE.rglob("*.py"))


def may_import(room: str) -> set[str]:
    return set(MAY_IMPORT) if room == "__init__" else MAY_IMPORT.get(room, set())


def room_of(path: Path) -> str:
    first = path.relative_to(PACKAGE).parts[0]
    return first.removesuffix(".py")


@cache
def imports_of(path: Path) -> tuple[ast.Import | ast.ImportFrom, ...]:
    """Return the import statements of a module, also those in functions."""
    nodes = ast.walk(ast.parse(path.read_text()))
    return tuple(node for node in nodes if isinstance(node, ast.Import | ast.ImportFrom))


def rooms_imported(path: Path) -> list[tuple[int, str]]:
    """Return line and room of every import from inside the package."""
    package = ["uwsim", *path.relative_to(PACKAGE).parent.parts]
    found: list[tuple[int, str]] = []
    for node in imports_of(path):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package[: len(package) - node.level + 1]
            names = [*base, *(node.module or "").split(".")] if node.module else base
            whole = [names] if len(names) > 1 else [[*names, name.name] for name in node.names]
            found += [(node.lineno, target[1]) for target in whole]
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "uwsim":
            found.append((node.lineno, "uwsim, by its absolute name"))
        elif isinstance(node, ast.Import):
            found += [
                (node.lineno, "uwsim, by its absolute name")
                for name in node.names
                if name.name.split(".")[0] == "uwsim"
            ]
    return sorted(found)


def imported_by(path: Path) -> set[Path]:
    """Return the modules that a module imports, also in functions and for type checks."""
    found: set[Path] = set()
    for node in imports_of(path):
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        folder = path.parents[node.level - 1].joinpath(*(node.module or "").split("."))
        for name in node.names:
            candidates = (folder / f"{name.name}.py", folder.with_suffix(".py"))
            found |= {next((each for each in candidates if each.is_file()), folder / "__init__.py")}
    return {each for each in found if each.name != "__init__.py"} - {path}


def imported_by_source(path: Path) -> set[Path]:
    """Return the sources that a TypeScript source of the page imports, also for their types."""
    names = re.findall(r"""\bfrom\s+["'](\.[^"']*)["']""", path.read_text())
    return {(path.parent / f"{name}.ts").resolve() for name in names}


def cycle_among(
    paths: list[Path], imported: Callable[[Path], set[Path]] = imported_by
) -> list[str]:
    """Return modules that import each other in a circle; none if there is no such circle."""
    try:
        TopologicalSorter({path: imported(path) for path in paths}).prepare()
    except CycleError as error:
        return [path.relative_to(PACKAGE).as_posix() for path in error.args[1]]
    return []


def test_a_module_imports_only_from_its_own_room_and_from_those_above_it() -> None:
    wrong = [
        f"{path.relative_to(PACKAGE)}:{line} imports {target}"
        for path in modules()
        for line, target in rooms_imported(path)
        if target not in may_import(room_of(path))
    ]
    assert wrong == []


def test_every_room_stands_in_the_drawing() -> None:
    rooms = {room_of(path) for path in modules()} - {"__init__"}
    assert rooms <= set(MAY_IMPORT)


def test_no_modules_import_each_other() -> None:
    assert cycle_among(modules()) == []


@pytest.mark.parametrize("how", ["from .{} import x", "def f():\n    from . import {}"])
def test_a_circle_of_imports_is_seen(
    how: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(f"{__name__}.PACKAGE", tmp_path)
    for name, imported in [("a", "b"), ("b", "c"), ("c", "a")]:
        (tmp_path / f"{name}.py").write_text(how.format(imported))
    assert set(cycle_among(modules())) == {"a.py", "b.py", "c.py"}


def test_no_sources_of_the_page_import_each_other() -> None:
    sources = [path for path in PAGE.rglob("*.ts") if not path.name.endswith(".d.ts")]
    assert len(sources) > 20
    assert cycle_among(sources, imported_by_source) == []


def test_a_circle_of_types_in_the_page_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(f"{__name__}.PACKAGE", tmp_path)
    (tmp_path / "display").mkdir()
    (tmp_path / "a.ts").write_text('import type { B } from "./display/b";\n')
    (tmp_path / "display" / "b.ts").write_text('import {\n  c, type C,\n} from "../c";\n')
    (tmp_path / "c.ts").write_text('export { a } from "./a";\n')
    sources = sorted(tmp_path.rglob("*.ts"))
    assert set(cycle_among(sources, imported_by_source)) == {"a.ts", "display/b.ts", "c.ts"}


def test_no_package_has_more_than_twenty_modules() -> None:
    folders = Counter(path.parent for path in modules() if path.stem != "__init__")
    assert {str(folder): n for folder, n in folders.items() if n > MAX_MODULES} == {}


def test_the_walk_sees_a_forbidden_import(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(f"{__name__}.PACKAGE", tmp_path)
    module = tmp_path / "scene" / "parts" / "wheel.py"
    module.parent.mkdir(parents=True)
    module.write_text(
        "from ...physics.compile import x\n"
        "def f():\n    from ... import rendering\n"
        "import uwsim.cli\nfrom ..spec import y\nfrom . import z\n"
    )
    assert [room for _, room in rooms_imported(module)] == [
        "physics",
        "rendering",
        "uwsim, by its absolute name",
        "scene",
        "scene",
    ]
    assert room_of(module) == "scene"
