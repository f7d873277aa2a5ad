"""Lookup of all names of a benchmark in its scene, each error with its line."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from pathlib import Path

from lxml import etree

from ..errors import Diagnostic, UnknownName, UwsimError
from ..schema import Diagnostics, fields_of, parse
from ..world import Stage
from .measures import MeasureSpec
from .spec import BenchmarkSpec
from .triggers import TriggerSpec
from .updaters import SceneUpdaterSpec

Part = MeasureSpec | TriggerSpec | SceneUpdaterSpec


def unknown_names(benchmark: BenchmarkSpec, stage: Stage) -> list[Diagnostic]:
    """Look up every name of a benchmark file; reports all errors of binding it to the scene.

    Args:
        benchmark: what was read from the file without an error.
        stage: the scene.
    """
    root = parse(Path(benchmark.path)).root
    diagnostics = Diagnostics(benchmark.path)
    seen: set[tuple[int, str]] = set()
    for part, node in _places(benchmark, root):
        for place, error in _wrong(part, node, stage):
            diagnostic = (int(str(place.sourceline)), str(error))
            if diagnostic not in seen:
                seen.add(diagnostic)
                diagnostics.error(place, str(error))
    return diagnostics.all()


def _places(
    benchmark: BenchmarkSpec, root: etree._Element
) -> Iterator[tuple[Part, etree._Element]]:
    """Every part of a benchmark, and the element that it was read from, in the file's order."""
    for spec, node in zip(benchmark.measures, root.iterfind("measures/*"), strict=True):
        yield spec, node
        yield from _gate(spec.start_on, spec.stop_on, node)
    yield from _gate(benchmark.start_on, benchmark.stop_on, root)
    updater: SceneUpdaterSpec | None = benchmark.scene_updater
    box = root.find("sceneUpdater")
    while updater is not None and box is not None:
        [node] = box.iterchildren("*")
        yield updater, node
        updater, box = updater.child, node.find("sceneUpdater")


def _gate(
    start_on: TriggerSpec, stop_on: TriggerSpec, node: etree._Element
) -> Iterator[tuple[TriggerSpec, etree._Element]]:
    for trigger, tag in ((start_on, "startOn"), (stop_on, "stopOn")):
        if (box := node.find(tag)) is not None:
            yield trigger, box


def _place(node: etree._Element, name: str) -> etree._Element:
    """The element within ``node`` that contains ``name``; else ``node``."""
    among = None
    for child in node.iter("*") if name else ():
        text = (child.text or "").strip()
        if text == name or name in map(str, child.attrib.values()):
            return child
        if among is None and name in text.split():
            among = child
    return node if among is None else among


def _wrong(
    part: Part, node: etree._Element, stage: Stage
) -> Iterator[tuple[etree._Element, UwsimError]]:
    """What keeps a part from being bound, and where: its unknown names; else what it raises."""
    unknown = [*_unknown(part, node, stage)]
    if unknown:
        yield from unknown
        return
    try:
        part.bind(stage).close()
    except UwsimError as error:
        yield _place(node, error.name), error


def _unknown(
    spec: object, node: etree._Element, stage: Stage
) -> Iterator[tuple[etree._Element, UwsimError]]:
    """Look up what the fields of a spec, and of the specs in it, refer to."""
    for field in fields_of(type(spec)):
        value, child = getattr(spec, field.name), node.find(field.tag)
        if value is None or child is None or isinstance(value, Part):
            continue
        if field.xml.refers_to is not None:
            try:
                LOOK_UP[field.xml.refers_to](stage, value)
            except UnknownName as error:
                yield child, error
        elif dataclasses.is_dataclass(value):
            yield from _unknown(value, child, stage)


def _vehicle(stage: Stage, name: str) -> None:
    if name not in stage.vehicles:
        raise UnknownName("vehicle", name, stage.vehicles)


LOOK_UP: dict[str, Callable[[Stage, str], object]] = {
    "actuators": lambda stage, name: stage.actuators(name),
    "body": lambda stage, name: stage.body(name),
    "camera": lambda stage, name: stage.camera(name),
    "contacts": lambda stage, name: stage.contacts(name),
    "vehicle": _vehicle,
}
"""What a field refers to (`element`) -> the look-up, which raises UnknownName."""
