"""The page docs/code-map.md has a row for each package, and names each package inside one."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "src" / "uwsim"
PAGE = (ROOT / "docs" / "code-map.md").read_text()
TABLE = PAGE.split("\n## Packages\n")[1].split("\n## ")[0]
ROWS = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", TABLE, re.MULTILINE))
PACKAGES = sorted(path.parent for path in PACKAGE.rglob("__init__.py") if path.parent != PACKAGE)
TOP_LEVEL = [path.name for path in PACKAGES if path.parent == PACKAGE]


def test_the_rows_of_the_code_map_are_the_packages() -> None:
    assert sorted(ROWS) == TOP_LEVEL


@pytest.mark.parametrize("package", TOP_LEVEL)
def test_a_row_names_the_packages_inside_its_package(package: str) -> None:
    inside = [path.relative_to(PACKAGE).as_posix() for path in PACKAGE.glob(f"{package}/*/")]
    packages = [name for name in inside if (PACKAGE / name / "__init__.py").is_file()]
    assert [name for name in packages if f"`{name}/`" not in ROWS[package]] == []


def test_the_code_map_names_each_module_next_to_the_packages() -> None:
    modules = {path.name for path in PACKAGE.glob("*.py")} - {"__init__.py", "__main__.py"}
    assert [name for name in sorted(modules) if f"`{name}`" not in PAGE] == []
