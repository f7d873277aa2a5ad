"""Finding the names in a benchmark file that its scene does not have."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ..errors import BadSetting, Diagnostic, UnknownName, UwsimError
from ..schema import Diagnostics, Spec, fields_of, line_of
from ..world import Stage
from .bind_part import Part, bind_part
from .environment import Actuator, EnvironmentSpec, Observer, bind_images
from .measures import connect_outcomes, find_outcome_spec
from .spec import BenchmarkSpec
from .updaters import chain


def find_unknown_names(
    benchmark: BenchmarkSpec, stage: Stage, *, is_whole: bool = True
) -> list[Diagnostic]:
    """Return the errors of all parts of a benchmark whose names the scene does not have.

    Args:
        benchmark: the contents of the benchmark file.
        stage: the scene.
        is_whole: True if the file was read without an error. Only then are the parts bound, which
            finds further errors.
    """
    diagnostics = Diagnostics(benchmark.path)
    errors_of = _binding_errors if is_whole else _reference_errors
    part_errors = [error for part in _parts(benchmark) for error in errors_of(part, stage)]
    for line, message in dict.fromkeys([*part_errors, *_environment_errors(benchmark, stage)]):
        diagnostics.error(line, message)
    if is_whole and not diagnostics.has_errors:
        for line, message in _outcome_errors(benchmark, stage):
            diagnostics.error(line, message)
    return diagnostics.to_list()


def _parts(benchmark: BenchmarkSpec) -> Iterator[Part]:
    for spec in benchmark.measures:
        yield from (spec, spec.start_on, spec.stop_on)
    yield from (benchmark.start_on, benchmark.stop_on)
    yield from chain(benchmark.scene_updater)


def _name_line(spec: object, name: str) -> int | None:
    """Return the line of the field that has the value ``name``, or else the line of the spec."""
    return next(_name_lines(spec, name), line_of(spec)) if name else line_of(spec)


def _name_lines(spec: object, name: str) -> Iterator[int | None]:
    for field in fields_of(type(spec)):
        value = field.value_in(spec)
        if value == name or (isinstance(value, str) and name in value.split()):
            yield line_of(spec, field.tag)
        elif isinstance(value, Spec) and not isinstance(value, Part):
            yield from _name_lines(value, name)


def _binding_errors(part: Part, stage: Stage) -> Iterator[tuple[int | None, str]]:
    """Yield the unknown names in a part, or else the error of binding it; each with its line."""
    reference_errors = [*_reference_errors(part, stage)]
    if reference_errors:
        yield from reference_errors
        return
    try:
        bind_part(part, stage).close()
    except UwsimError as error:
        yield _name_line(part, error.name), str(error)


def _reference_errors(spec: object, stage: Stage) -> Iterator[tuple[int | None, str]]:
    for field in fields_of(type(spec)):
        value = field.value_in(spec)
        if value is None or isinstance(value, Part):
            continue
        if field.xml.refers_to is not None:
            try:
                RESOLVERS[field.xml.refers_to](stage, value)
            except UnknownName as error:
                yield line_of(spec, field.tag), str(error)
        elif isinstance(value, Spec):
            yield from _reference_errors(value, stage)
        elif isinstance(value, tuple):
            for child in value:
                if isinstance(child, Spec) and not isinstance(child, Part):
                    yield from _reference_errors(child, stage)


def _outcome_errors(benchmark: BenchmarkSpec, stage: Stage) -> Iterator[tuple[int | None, str]]:
    """Yield the names in outcomes that are no values or details of measures."""
    outcome = find_outcome_spec(benchmark.measures)
    if outcome is None:
        return
    measures = [(spec.name, spec.bind(stage.world)) for spec in benchmark.measures]
    try:
        connect_outcomes(measures)
    except BadSetting as error:
        yield line_of(outcome), str(error)
    for _, measure in measures:
        measure.close()


def _environment_errors(benchmark: BenchmarkSpec, stage: Stage) -> Iterator[tuple[int | None, str]]:
    """Yield the unknown names in each ``<u:environment>``, or else the error of binding it."""
    for spec in benchmark.environments:
        yield from _errors_of_environment(spec, benchmark, stage)


def _errors_of_environment(
    spec: EnvironmentSpec, benchmark: BenchmarkSpec, stage: Stage
) -> Iterator[tuple[int | None, str]]:
    reference_errors = [*_reference_errors(spec, stage)]
    yield from reference_errors
    if reference_errors:
        return
    for part, bind in (
        (spec.action, lambda: Actuator(spec, stage.world)),
        (spec.image, lambda: bind_images(spec, stage.world)),
        (spec.topic_field, lambda: Observer(spec, benchmark.measures, stage.world, 1).close()),
    ):
        try:
            bind()
        except UwsimError as error:
            lines = (line_of(child) for child in part)
            yield next(lines, line_of(spec)), str(error)


def _find_vehicle(stage: Stage, name: str) -> None:
    if name not in stage.vehicles:
        raise UnknownName("vehicle", name, stage.vehicles)


RESOLVERS: dict[str, Callable[[Stage, str], object]] = {
    "actuators": lambda stage, name: stage.world.actuators(name),
    "body": lambda stage, name: stage.world.body(name),
    "camera": lambda stage, name: stage.world.camera(name),
    "contacts": lambda stage, name: stage.world.contacts(name),
    "course": lambda stage, name: stage.world.surroundings.course(name),
    "joint": lambda stage, name: stage.world.joint_position(name),
    "vehicle": _find_vehicle,
}
"""The function that resolves each kind of reference (``refers_to``); it raises UnknownName."""
