"""The page's script is what its sources give."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
PAGE = ROOT / "src" / "uwsim" / "viewer" / "page"


@pytest.mark.slow
def test_page_js_is_what_its_sources_give(tmp_path: Path) -> None:
    installed = ROOT / "build" / "page" / "node_modules" / ".installed"
    locked = (PAGE / "package-lock.json").read_bytes()
    if shutil.which("npm") is None or not installed.is_file() or installed.read_bytes() != locked:
        pytest.skip("npm's packages are not there; scripts/page installs them")
    command = [str(ROOT / "scripts" / "page"), "--check", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    for name in ("page.js", "uplot.css"):
        assert (tmp_path / name).read_bytes() == (PAGE / name).read_bytes(), "run scripts/page"


def test_sources_are_of_readable_size() -> None:
    paths = list(PAGE.glob("source/**/*.ts"))
    sizes = {str(path): len(path.read_text().splitlines()) for path in paths}
    assert {name: size for name, size in sizes.items() if size > 270} == {}
    for folder in {path.parent for path in paths}:
        assert len(list(folder.glob("*.ts"))) <= 21
