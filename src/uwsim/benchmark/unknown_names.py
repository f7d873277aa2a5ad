"""Lookup of all names of a benchmark in its scene, each error with its line."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ..errors import Diagnostic, UnknownName, UwsimError
from ..schema import Diagnostics, Spec, fields_of, line_of
from ..world import Stage
from .bind_part import Part, bind_part
from .spec import BenchmarkSpec
from .updaters import chain


def unknown_names(
    benchmark: BenchmarkSpec, stage: Stage, *, is_whole: bool = True
) -> list[Diagnostic]:
    """Look up every name of a benchmark file; reports all errors of binding it to the scene.

    Args:
        benchmark: what was read from the file.
        stage: the scene.
        is_whole: whether it was read without an error; else its parts are not bound.
    """
    diagnostics = Diagnostics(benchmark.path)
    errors_of = _wrong if is_whole else _unknown
    for line, message in dict.fromkeys(
        wrong for part in _parts(benchmark) for wrong in errors_of(part, stage)
    ):
        diagnostics.error(line, message)
    return diagnostics.to_list()


def _parts(benchmark: BenchmarkSpec) -> Iterator[Part]:
    """Every part of a benchmark, in the file's order."""
    for spec in benchmark.measures:
        yield from (spec, spec.start_on, spec.stop_on)
    yield from (benchmark.start_on, benchmark.stop_on)
    yield from chain(benchmark.scene_updater)


def _line(spec: object, name: str) -> int | None:
    """Line of the field within a spec that has the value ``name``; else of the spec."""
    return next(_lines(spec, name), line_of(spec)) if name else line_of(spec)


def _lines(spec: object, name: str) -> Iterator[int | None]:
    for field in fields_of(type(spec)):
        value = field.value_in(spec)
        if value == name or (isinstance(value, str) and name in value.split()):
            yield line_of(spec, field.tag)
        elif isinstance(value, Spec) and not isinstance(value, Part):
            yield from _lines(value, name)


def _wrong(part: Part, stage: Stage) -> Iterator[tuple[int | None, str]]:
    """What keeps a part from being bound, and where: its unknown names; else what it raises."""
    unknown = [*_unknown(part, stage)]
    if unknown:
        yield from unknown
        return
    try:
        bind_part(part, stage).close()
    except UwsimError as error:
        yield _line(part, error.name), str(error)


def _unknown(spec: object, stage: Stage) -> Iterator[tuple[int | None, str]]:
    """Look up what the fields of a spec, and of the specs in it, refer to."""
    for field in fields_of(type(spec)):
        value = field.value_in(spec)
        if value is None or isinstance(value, Part):
            continue
        if field.xml.refers_to is not None:
            try:
                LOOK_UP[field.xml.refers_to](stage, value)
            except UnknownName as error:
                yield line_of(spec, field.tag), str(error)
        elif isinstance(value, Spec):
            yield from _unknown(value, stage)


def _vehicle(stage: Stage, name: str) -> None:
    if name not in stage.vehicles:
        raise UnknownName("vehicle", name, stage.vehicles)


LOOK_UP: dict[str, Callable[[Stage, str], object]] = {
    "actuators": lambda stage, name: stage.world.actuators(name),
    "body": lambda stage, name: stage.world.body(name),
    "camera": lambda stage, name: stage.world.camera(name),
    "contacts": lambda stage, name: stage.world.contacts(name),
    "vehicle": _vehicle,
}
"""What a field refers to (`element`) -> the look-up, which raises UnknownName."""
