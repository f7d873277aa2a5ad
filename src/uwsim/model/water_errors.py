"""The errors of physical water: its numbers, its phase function and its particles."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from pathlib import Path

from ..errors import Diagnostic, FileError, SeveralErrors, UwsimError
from ..scene.physical_water import PhysicalWaterSpec
from ..scene.spec import SceneSpec
from ..schema import NAMESPACE, Spec, diagnostic_at, fields_of
from .robots import find_file

PREFIX = f"{{{NAMESPACE}}}"
"""The prefix of the qualified names of elements that begin with ``u:``."""
NUMBERS = ("type", "file", "spectrum", "absorption", "beamAttenuation", "scattering")
"""The elements of the numbers of a water."""


def find_water_errors(
    scene: SceneSpec, data_path: tuple[Path, ...], lines: Collection[int] = ()
) -> Iterator[Diagnostic]:
    """Yield the errors of a scene's physical water, each with its line.

    Args:
        scene: the scene, perhaps with errors.
        data_path: the folders that are searched for files.
        lines: the lines of the file that have other errors: what depends on these is not reported.
    """
    water = scene.ocean_state.water
    if water is None:
        return
    invalid_names = _find_invalid_names(scene, water, lines)
    names = {field.tag.removeprefix(PREFIX) for field in fields_of(PhysicalWaterSpec)}
    if invalid_names <= names - set(NUMBERS):  # an unknown name may be that of a number
        yield from _report(
            scene,
            water,
            lambda: water.read_source(lambda name: find_file(name, scene.path, data_path)),
        )
    if "phaseFunction" not in invalid_names:
        owner = water.phase_function[0] if len(water.phase_function) == 1 else water
        yield from _report(scene, owner, water.read_phase_function)
    if water.particles is not None and "particles" not in invalid_names:
        for spec, text in water.particles.find_errors():
            yield diagnostic_at(spec, text, file=scene.path)


def _find_invalid_names(
    scene: SceneSpec, water: PhysicalWaterSpec, lines: Collection[int]
) -> set[str]:
    """Return the names of the elements of a water that begin at lines, or contain them."""
    source = water.source_line
    if source is None:
        return set()
    next_lines = [
        line
        for spec in (scene.ocean_state, scene)
        if spec.source_line is not None
        for line in spec.source_line.elements.values()
        if line > source.line
    ]
    names: set[str] = set()
    for line in lines:
        if source.line <= line < min(next_lines, default=line + 1):
            start = max((first for first in source.elements.values() if first <= line), default=0)
            names |= {tag for tag, first in source.elements.items() if first == start}
    return {name.removeprefix(PREFIX) for name in names}


def _report(scene: SceneSpec, owner: Spec, read: Callable[[], object]) -> Iterator[Diagnostic]:
    """Yield the errors of a function that reads a part of the water."""
    try:
        read()
    except SeveralErrors as error:
        errors: tuple[Exception, ...] = error.errors
    except (UwsimError, OSError) as error:
        errors = (error,)
    else:
        return
    for one_error in errors:
        if isinstance(one_error, FileError):
            yield from one_error.diagnostics
            continue
        name = one_error.name if isinstance(one_error, UwsimError) else ""
        yield diagnostic_at(owner, str(one_error), PREFIX + name, file=scene.path)
