"""The announcement, or refusal, of Python code that scene and benchmark files name."""

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
    """Refuse a scene that names Python code; raise BadSetting."""
    for code in _codes(scene):
        raise code_refusal(code, scene.path)


def announce_code(scene: SceneSpec) -> None:
    """Announce the Python code that a scene runs."""
    for code in _codes(scene):
        announce(code, scene.path)


def code_refusal(code: str, file: str) -> BadSetting:
    """Return the error for the code ``module:name`` that a file names and ``--no-code`` refuses."""
    return BadSetting(f"{file}: names the Python code {code!r}, which --no-code refuses.")


def announce(code: str, file: str, *, path: Path | None = None) -> None:
    """Announce the code that a file names: ``module:name``, or a plugin with its path."""
    try:
        location = path or find_module_file(code.partition(":")[0])
    except (ModuleNotFoundError, ValueError):
        return  # the import reports it
    message = (
        f"uwsim: {file} runs Python code: {code} in {location or 'Python'} (--no-code refuses it)"
    )
    print(clean_text(message), file=sys.stderr)


def _codes(scene: SceneSpec) -> list[str]:
    codes = dict.fromkeys(current.code for current in scene.ocean_state.currents)
    return [code for code in codes if code]
