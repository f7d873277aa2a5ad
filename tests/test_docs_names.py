"""Files, modules, members and options that the documentation and docstrings name exist."""

from __future__ import annotations

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.support.documented import read_commands

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "src" / "uwsim"
ARCHITECTURE = ROOT / "docs" / "architecture.md"
PAGES = [*sorted(ROOT.glob("docs/*.md")), ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
PAGES += [ROOT / "benchmarks" / "README.md", *sorted(ROOT.glob("examples/**/*.md"))]
SOURCES = sorted(PACKAGE.rglob("*.py"))

FOLDERS = ("src", "tests", "scripts", "docs", "examples", "benchmarks")
PACKAGES = tuple(sorted(path.name for path in PACKAGE.iterdir() if (path / "__init__.py").exists()))
FILES_TO_WRITE = (
    "src/uwsim/devices/scanner.py",
    "src/uwsim/forces/elastic_line.py",
    "src/uwsim/sensors/compass.py",
    "src/uwsim/benchmark/measures/top_speed.py",
    "src/uwsim/messages/uwsim_msgs/msg/Heading.msg",
    "test_top_speed.py",
    "resonant.py",
    "sim_vehicle.py",
)
"""The files that a reader of a page writes."""

NAMES_OF_OTHERS = ("osgconv", "applyDamping")
"""What docstrings name that is not of the package: a program, a function of the original."""

FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
TEXT_FENCE = re.compile(r"^```text\n(.*?)^```", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"(?<![`:\w])`([^`\n]+)`(?!`)")
IN_A_FOLDER = re.compile(rf"(?:{'|'.join(FOLDERS)})/[\w./*-]*")
IN_A_PACKAGE = re.compile(rf"(?:{'|'.join(PACKAGES)})/(?:[\w/-]+\.(?:py|glsl)|(?:[\w-]+/)*)")
PROGRAM = re.compile(r"[\w-]+\.(?:py|glsl)")
LISTED = re.compile(
    r"(?<![\w./])(?:[a-z_0-9]+/)*[a-z_0-9.]+\.(?:py|glsl)|(?<![\w./])(?:\w+/)+(?!\w)"
)
DOTTED = re.compile(r"(?<![\w./<-])uwsim(?:\.[A-Za-z_]\w*)+")
MEMBER = re.compile(r"([A-Z]\w*)\.([a-z_A-Z]\w*)(?:\(.*\))?")
OF_A_MODULE = re.compile(r"([a-z]\w*)\.(\w+)(?:\(.*\))?")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
PROGRAM_OF_A_SCRIPT = re.compile(r"-m (tests\.[\w.]+|scripts\.[\w.]+)")


def ids(path: Path) -> str:
    return str(path.relative_to(ROOT))


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text())


def assigned(node: ast.AST) -> Iterator[str]:
    """Every name that a statement of a module or class defines."""
    if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
        yield node.name
    elif isinstance(node, ast.Import | ast.ImportFrom):
        yield from (alias.asname or alias.name.split(".")[0] for alias in node.names)
    elif isinstance(node, ast.Assign | ast.AnnAssign | ast.AugAssign | ast.For | ast.With | ast.If):
        yield from (each.id for each in ast.walk(node) if isinstance(each, ast.Name))


def own_attributes(node: ast.ClassDef) -> Iterator[str]:
    """Every attribute that a class's methods set or read of ``self``."""
    for each in ast.walk(node):
        match each:
            case ast.Attribute(value=ast.Name(id="self" | "cls")):
                yield each.attr


@cache
def members() -> dict[str, set[str]]:
    """The members of each class of the package, with those of its bases, by its name."""
    found: dict[str, set[str]] = defaultdict(set)
    bases: dict[str, set[str]] = defaultdict(set)
    for path in SOURCES:
        for node in ast.walk(tree(path)):
            if isinstance(node, ast.ClassDef):
                found[node.name].update(name for line in node.body for name in assigned(line))
                found[node.name].update(own_attributes(node))
                bases[node.name].update(ast.unparse(base).split(".")[-1] for base in node.bases)
    for _ in range(4):  # levels of inheritance
        for name in [*found]:
            for base in bases[name]:
                found[name] |= found.get(base, set())
    return found


@cache
def names_of_modules() -> dict[str, set[str]]:
    """What the modules of the package define, by the module's last name."""
    found: dict[str, set[str]] = defaultdict(set)
    for path in SOURCES:
        module = path.parent if path.stem == "__init__" else path
        found[module.stem].update(name for line in tree(path).body for name in assigned(line))
        found[module.stem].update(each.stem for each in path.parent.iterdir())
    return found


@cache
def words() -> set[str]:
    """Every name and every string that is one word in the package."""
    found = {*NAMES_OF_OTHERS, *names_of_modules()}
    for path in SOURCES:
        for node in ast.walk(tree(path)):
            values = (getattr(node, key, None) for key in ("id", "attr", "name", "arg", "value"))
            found.update(value for value in values if isinstance(value, str))
    return found


@cache
def files() -> set[str]:
    """The names of all files of the repository's folders."""
    return {path.name for folder in FOLDERS for path in (ROOT / folder).rglob("*")}


def is_there(dotted: str) -> bool:
    """Whether a dotted name is that of a module, or of an attribute of one or of a class."""
    parts = dotted.split(".")
    value: object = import_module(parts[0])
    for n, part in enumerate(parts[1:], start=2):
        if not hasattr(value, part):
            if isinstance(value, type):
                return part in members()[value.__name__]
            module = ".".join(parts[:n])
            if find_spec(module) is None:
                return False
            if n == len(parts):
                return True  # one may need what is not installed, as rclpy
            value = import_module(module)
        else:
            value = getattr(value, part)
    return True


def missing_files(page: str) -> list[str]:
    """The files of the repository that a page names and that do not exist."""
    found = []
    for name in CODE.findall(FENCE.sub("", page)):
        if name in FILES_TO_WRITE or "NAME" in name:
            continue
        if IN_A_FOLDER.fullmatch(name):
            there = any(ROOT.glob(name.rstrip("/")))
        elif IN_A_PACKAGE.fullmatch(name):
            there = any(PACKAGE.rglob(name.rstrip("/")))
        elif PROGRAM.fullmatch(name):
            there = name in files() or page.count(name) > 1  # a file that the reader writes
        else:
            continue
        if not there:
            found.append(name)
    return found


def missing_names(text: str) -> list[str]:
    """The dotted names and members of classes in a text that do not exist."""
    dotted = [name for name in sorted({*DOTTED.findall(text)}) if not is_there(name)]
    codes = [MEMBER.fullmatch(code) for code in CODE.findall(text)]
    classes = [match for match in codes if match and match[1] in members()]
    return dotted + [match[0] for match in classes if match[2] not in members()[match[1]]]


def docstrings(source: ast.Module) -> Iterator[str]:
    """Every string that is a statement: of a module, class, function, attribute or constant."""
    for node in ast.walk(source):
        match node:
            case ast.Expr(value=ast.Constant(value=str(text))):
                yield text


def missing_in_docstring(text: str) -> list[str]:
    """The names in a docstring that do not exist: also words, and members of modules."""
    found = missing_names(text)
    for code in CODE.findall(text):
        match = OF_A_MODULE.fullmatch(code)
        if code.isidentifier():
            exists = code in words()
        elif match and match[1] in names_of_modules().keys() - {"uwsim"}:
            exists = match[2] in names_of_modules()[match[1]] | {"py"}
        else:
            continue
        if not exists:
            found.append(code)
    return found


def missing_options(page: str) -> list[str]:
    """The scripts, and their options, that a page names and that do not exist."""
    calls = [command.words for command in read_commands(page)]
    calls += [tuple(code.split()) for code in CODE.findall(FENCE.sub("", page))]
    found = []
    for script, *options in calls:
        if script.startswith("scripts/"):
            path = ROOT / script
            if not path.is_file():
                found.append(script)
                continue
            text = path.read_text()
            for module in PROGRAM_OF_A_SCRIPT.findall(text):
                path = ROOT / module.replace(".", "/")
                path = path / "__main__.py" if path.is_dir() else path.with_suffix(".py")
                text += path.read_text()
            known = OPTION.findall(text)
            found += [each for each in options if OPTION.match(each) and each not in known]
    return found


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_file_that_a_page_names_exists(page: Path) -> None:
    assert missing_files(page.read_text()) == []


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_name_of_the_package_on_a_page_exists(page: Path) -> None:
    assert missing_names(page.read_text()) == []


def test_every_file_in_the_listings_of_the_architecture_exists() -> None:
    text = "\n".join(TEXT_FENCE.findall(ARCHITECTURE.read_text()))
    names = LISTED.findall(text)
    assert len(names) > 40
    assert [name for name in names if not any(PACKAGE.rglob(name.rstrip("/")))] == []


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_every_option_of_a_script_is_one_that_it_reads(page: Path) -> None:
    assert missing_options(page.read_text()) == []


def test_every_name_in_a_docstring_exists() -> None:
    found = {
        ids(path): wrong
        for path in SOURCES
        if (
            wrong := [
                name for text in docstrings(tree(path)) for name in missing_in_docstring(text)
            ]
        )
    }
    assert found == {}


def test_a_stale_name_is_found() -> None:
    assert missing_files("`src/uwsim/no.py`, `tests/` and `physics/no_engine.py`") == [
        "src/uwsim/no.py",
        "physics/no_engine.py",
    ]
    assert missing_files("`no_such.py` but `grey.py`") == ["no_such.py"]
    assert missing_names("uwsim.Image, `uwsim.load`, `Simulation.fly()`, `Simulation.save`") == [
        "uwsim.Image",
        "Simulation.fly()",
    ]
    assert missing_options("`scripts/no` `scripts/fuzz obj --seed 3 --sed 3`") == [
        "scripts/no",
        "--sed",
    ]
    assert missing_in_docstring("`NO_SUCH_CONSTANT` and `parts.no_such`, `MAX_ANGLE`") == [
        "NO_SUCH_CONSTANT",
        "parts.no_such",
    ]
