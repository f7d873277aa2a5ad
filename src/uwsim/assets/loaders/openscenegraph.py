"""OpenSceneGraph, VRML and 3DS files, by way of the program `osgconv`."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...base.files.scratch import scratch_folder
from ...errors import AssetError

BY_OSGCONV = (".osg", ".osgt", ".osgb", ".ive", ".wrl", ".3ds")
"""Formats that need `osgconv`."""

PATIENCE = 120.0
"""Longest time one conversion may take [s]."""


def has_osgconv() -> bool:
    """Whether the program is installed."""
    return shutil.which("osgconv") is not None


def without_osgconv(path: Path) -> str:
    """Return an error message that names what to install."""
    return (
        f"{path}: {path.suffix} files are read through osgconv, which is not installed. "
        "Install it with: sudo apt-get install openscenegraph"
    )


@contextmanager
def converted(path: Path) -> Iterator[Path]:
    """Convert a file to OBJ in a temporary folder.

    Images inside the file are written out first; images next to it are found by their name.

    Raises:
        AssetError: `osgconv` is not installed or cannot read the file.
    """
    program = shutil.which("osgconv")
    if program is None:
        raise AssetError(without_osgconv(path))
    with scratch_folder("uwsim-osg-") as folder:
        unpacked, obj = folder / "model.osgt", folder / "model.obj"
        _run(
            [program, "-O", "OutputTextureFiles", str(path.absolute()), str(unpacked)], path, folder
        )
        _run([program, str(unpacked), str(obj)], path, folder)
        if not obj.is_file():
            raise AssetError(f"{path}: osgconv made nothing of it.")
        yield obj


def _run(command: list[str], path: Path, folder: Path) -> None:
    environment = dict(os.environ, OSG_FILE_PATH=str(path.absolute().parent))
    try:
        done = subprocess.run(
            command, cwd=folder, env=environment, timeout=PATIENCE, capture_output=True, check=False
        )
    except subprocess.TimeoutExpired as error:
        raise AssetError(f"{path}: osgconv took longer than {PATIENCE:g} s.") from error
    except OSError as error:
        raise AssetError(f"{path}: osgconv could not be run ({error.strerror}).") from error
    if done.returncode != 0:
        messages = done.stderr.decode(errors="replace").strip().splitlines()
        raise AssetError(
            f"{path}: osgconv cannot read it{': ' + messages[-1] if messages else '.'}"
        )
