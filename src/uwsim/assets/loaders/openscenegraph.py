"""Conversion of OpenSceneGraph and 3DS files by the program `osgconv`."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...base.files.scratch import scratch_folder
from ...errors import AssetError

OSGCONV_FORMATS = (".osg", ".osgt", ".osgb", ".ive", ".3ds")
"""The formats that need `osgconv`."""

TIMEOUT = 120.0
"""The greatest time of one conversion [s]."""


def has_osgconv() -> bool:
    """Return whether the program is installed."""
    return shutil.which("osgconv") is not None


def osgconv_error(path: Path) -> str:
    """Return the message that states what to install."""
    return (
        f"{path}: {path.suffix} files need the program osgconv, which is not installed. "
        "Install it with: sudo apt-get install openscenegraph"
    )


@contextmanager
def convert_to_obj(path: Path) -> Iterator[Path]:
    """Convert a file to OBJ in a temporary folder.

    Images inside the file are written out first; images next to it are found by their name.

    Raises:
        AssetError: `osgconv` is not installed or cannot read the file.
    """
    program = shutil.which("osgconv")
    if program is None:
        raise AssetError(osgconv_error(path))
    with scratch_folder("uwsim-osg-") as folder:
        osgt, obj_file = folder / "model.osgt", folder / "model.obj"
        options = ["-O", "OutputTextureFiles"]
        _run([program, *options, str(path.absolute()), str(osgt)], path, folder)
        _run([program, str(osgt), str(obj_file)], path, folder)
        if not obj_file.is_file():
            raise AssetError(f"{path}: osgconv wrote no file.")
        yield obj_file


def _run(command: list[str], path: Path, folder: Path) -> None:
    environment = dict(os.environ, OSG_FILE_PATH=str(path.absolute().parent))
    try:
        process = subprocess.run(
            command, cwd=folder, env=environment, timeout=TIMEOUT, capture_output=True, check=False
        )
    except subprocess.TimeoutExpired as error:
        raise AssetError(f"{path}: osgconv took longer than {TIMEOUT:g} s.") from error
    except OSError as error:
        raise AssetError(f"{path}: osgconv could not be run ({error.strerror}).") from error
    if process.returncode != 0:
        messages = process.stderr.decode(errors="replace").strip().splitlines()
        raise AssetError(
            f"{path}: osgconv cannot read it{': ' + messages[-1] if messages else '.'}"
        )
