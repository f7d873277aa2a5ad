"""The sdist and the wheel of a release: complete, without other files, and usable when installed.

The wheel is built from the unpacked sdist, as a packager does it. Nothing needs the network: the
build backend and the libraries are those of this environment.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import venv
import zipfile
from email import message_from_bytes
from email.message import Message
from pathlib import Path

import pytest

import uwsim

ROOT = Path(__file__).parent.parent
NAME = f"uwsim-{uwsim.__version__}"
CI_FILES = {".ci/run"}
"""The files of the repository that only continuous integration needs."""
PROGRAM = '''"""A program of a user; an unused `type: ignore` would be an error, too."""

from typing import assert_type

import uwsim
from uwsim.messages import Odometry, TwistStamped


class KeepStill:
    """Publish a twist of zero at each odometry message."""

    def start(self, node: uwsim.Node) -> None:
        publish = node.publisher("/g500/twist", TwistStamped)
        node.subscribe("/odom", Odometry, lambda message: publish(TwistStamped()))


def depth(scene: str) -> float:
    with uwsim.load(scene, seed=1) as simulation:
        simulation.attach(KeepStill())
        simulation.advance(1.0)
        assert_type(simulation, uwsim.Simulation)
        return float(simulation.pose("girona500").position[2])


def algorithm() -> uwsim.Algorithm:
    return KeepStill()


assert_type(uwsim.read_result("x.result"), uwsim.Result)
uwsim.load(3)  # type: ignore[arg-type]
uwsim.lod  # type: ignore[attr-defined]
'''


def environment() -> dict[str, str]:
    """Return the environment variables without the paths of this checkout."""
    return {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "MYPYPATH")}


def run(*command: str | Path, folder: Path) -> str:
    """Run a command that must succeed; return its output."""
    result = subprocess.run(command, cwd=folder, env=environment(), capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


@pytest.fixture(scope="module")
def sdist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sdist."""
    folder = tmp_path_factory.mktemp("sdist")
    run(sys.executable, "-m", "hatchling", "build", "-t", "sdist", "-d", folder, folder=ROOT)
    return folder / f"{NAME}.tar.gz"


@pytest.fixture(scope="module")
def source(sdist: Path) -> Path:
    """The folder of the unpacked sdist."""
    with tarfile.open(sdist) as archive:
        if hasattr(tarfile, "data_filter"):  # Python 3.11.4
            archive.extractall(sdist.parent, filter="data")
        else:
            archive.extractall(sdist.parent)  # the project's own archive
    return sdist.parent / NAME


@pytest.fixture(scope="module")
def wheel(source: Path) -> Path:
    """The wheel, built from the unpacked sdist."""
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-index"]
    run(*command, "--no-build-isolation", "-w", source.parent, source, folder=source.parent)
    return source.parent / f"{NAME}-py3-none-any.whl"


@pytest.fixture(scope="module")
def programs(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The ``bin`` of an empty environment in which the wheel is installed."""
    home = tmp_path_factory.mktemp("environment")
    venv.create(home, with_pip=False)
    pip = [sys.executable, "-m", "pip", "--python", home / "bin" / "python", "install", "--quiet"]
    run(*pip, "--no-deps", "--no-index", wheel, folder=home)
    # the libraries that uwsim needs, but not this checkout: a path file in a path is not read
    site = home / "lib" / f"python{sys.version_info[0]}.{sys.version_info[1]}" / "site-packages"
    (site / "libraries.pth").write_text(sysconfig.get_path("purelib") + "\n")
    return home / "bin"


@pytest.fixture(scope="module")
def metadata(wheel: Path) -> Message:
    """The metadata of the wheel."""
    with zipfile.ZipFile(wheel) as archive:
        return message_from_bytes(archive.read(f"{NAME}.dist-info/METADATA"))


@pytest.mark.slow
def test_the_sdist_holds_the_files_of_the_repository_and_no_other(sdist: Path) -> None:
    if not (ROOT / ".git").exists():
        pytest.skip("not a checkout: git lists the files of the repository")
    names = run("git", "ls-files", "--cached", "--others", "--exclude-standard", folder=ROOT)
    files = {name for name in names.splitlines() if (ROOT / name).exists()}
    with tarfile.open(sdist) as archive:
        members = {member.name.removeprefix(f"{NAME}/") for member in archive}
    assert members == files - CI_FILES | {"PKG-INFO"}


@pytest.mark.slow
def test_the_tests_of_the_sdist_run(source: Path) -> None:
    names = ("changelog", "docs_python", "schema", "setup")
    tests = [f"tests/test_{name}.py" for name in names]
    options = ["-q", "-m", "not slow", "-p", "no:cacheprovider", "-p", "no:xdist"]
    command = [sys.executable, "-m", "pytest", *options, *tests]
    variables = {**environment(), "PYTHONPATH": str(source / "src")}
    result = subprocess.run(command, cwd=source, env=variables, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout


@pytest.mark.slow
def test_the_wheel_holds_the_files_of_the_package_and_no_other(wheel: Path) -> None:
    package = ROOT / "src" / "uwsim"
    files = {
        f"uwsim/{path.relative_to(package).as_posix()}"
        for path in package.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    metadata_names = {"METADATA", "RECORD", "WHEEL", "entry_points.txt", "licenses/LICENSE"}
    with zipfile.ZipFile(wheel) as archive:
        assert {*archive.namelist()} == files | {
            f"{NAME}.dist-info/{name}" for name in metadata_names
        }


@pytest.mark.slow
def test_the_metadata_of_the_wheel_describe_the_release(metadata: Message) -> None:
    assert metadata["Version"] == uwsim.__version__
    assert metadata["License-Expression"] == "Apache-2.0"
    classifiers = metadata.get_all("Classifier", [])
    assert "Development Status :: 4 - Beta" in classifiers
    assert "Typing :: Typed" in classifiers
    assert str(metadata.get_payload()).startswith("# uwsim\n")


def test_the_readme_names_the_wheel() -> None:
    names = re.findall(r"uwsim-\S+\.whl", (ROOT / "README.md").read_text())
    assert names == [f"{NAME}-py3-none-any.whl"]


@pytest.mark.slow
def test_the_installed_command_lists_renders_and_scores(programs: Path, tmp_path: Path) -> None:
    def command(*arguments: str) -> str:
        return run(programs / "uwsim", *arguments, folder=tmp_path)

    code = "import uwsim; print(uwsim.__version__, uwsim.__file__)"
    version, file = run(programs / "python", "-c", code, folder=tmp_path).split()
    assert version == uwsim.__version__
    assert Path(file).is_relative_to(programs.parent)
    assert command("--version").strip() == f"uwsim {uwsim.__version__}"
    assert "currents-scene" in command("list", "scenes")
    command("render", "visibility-scene", "-o", "water.png")
    assert (tmp_path / "water.png").stat().st_size > 10_000
    command("bench", "visibility", "--level", "fog=0.5", "--out", "x.result")
    assert (tmp_path / "x.result" / "report.html").is_file()


@pytest.mark.slow
def test_a_program_is_checked_with_the_types_of_the_installed_package(
    programs: Path, tmp_path: Path
) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    options = ["--strict", "--config-file=", "--python-executable", programs / "python"]
    run(sys.executable, "-m", "mypy", *options, program, folder=tmp_path)
