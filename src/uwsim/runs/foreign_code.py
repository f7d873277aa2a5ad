"""Python code named by files: announced before it runs, or refused."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from ..base.files.modules import find_module_file
from ..base.terminal import clean_text
from ..errors import BadSetting

if TYPE_CHECKING:
    from ..scene.spec import SceneSpec


def refuse_code(scene: SceneSpec) -> None:
    """Refuse a scene that names Python code; raises BadSetting."""
    for code in _codes(scene):
        raise refused(code, scene.path)


def announce_code(scene: SceneSpec) -> None:
    """Announce the Python code that a scene runs."""
    for code in _codes(scene):
        announce(code, scene.path)


def refused(code: str, file: str) -> BadSetting:
    """Return the error for ``module:name``, which a file names and which may not run."""
    return BadSetting(f"{file}: names the Python code {code!r}, which --no-code refuses.")


def announce(code: str, file: str, *, place: Path | None = None) -> None:
    """Announce that ``module:name``, or a plugin at a place, which a file names, will run."""
    try:
        where = place or find_module_file(code.partition(":")[0])
    except (ModuleNotFoundError, ValueError):
        return  # the import reports it
    message = (
        f"uwsim: {file} runs Python code: {code} in {where or 'Python'} (--no-code refuses it)"
    )
    print(clean_text(message), file=sys.stderr)


def _codes(scene: SceneSpec) -> list[str]:
    found = dict.fromkeys(current.code for current in scene.ocean_state.currents)
    return [code for code in found if code]
