"""Names in a benchmark that its scene does not have: all of them at once, each with its line."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lxml import etree

from ..errors import Diagnostic, UnknownName, UwsimError
from ..schema import Diagnostics, parse
from ..world import Stage
from .measures import MeasureSpec
from .spec import BenchmarkSpec
from .triggers import TriggerSpec
from .updaters import SceneUpdaterSpec

MAX_NAMES = 10
"""Wrong names of one element that are said."""

Part = MeasureSpec | TriggerSpec | SceneUpdaterSpec


def unknown_names(benchmark: BenchmarkSpec, stage: Stage) -> list[Diagnostic]:
    """Look up every name of a benchmark file; also say what else keeps a part of it from running.

    Args:
        benchmark: what was read from the file without an error.
        stage: the scene.
    """
    root = parse(Path(benchmark.path)).root
    diagnostics = Diagnostics(benchmark.path)
    seen: set[tuple[int, str]] = set()
    for part, node in _places(benchmark, root):
        for error in _wrong(part, stage):
            place = _place(node, error.name)
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
    """The element within ``node`` that says ``name``, alone or among others; else ``node``."""
    among = None
    for child in node.iter("*") if name else ():
        text = (child.text or "").strip()
        if text == name or name in map(str, child.attrib.values()):
            return child
        if among is None and name in text.split():
            among = child
    return node if among is None else among


def _wrong(part: Part, stage: Stage) -> Iterator[UwsimError]:
    """What keeps a part from being bound: one error for each of its names that nothing has."""
    spec: Any = part
    for n in range(MAX_NAMES):
        try:
            live = spec.bind(stage)
        except UnknownName as error:
            yield error
            if not error.known:
                return
            changed = _with(spec, error.name, error.known[0])
            if changed == spec:
                return
            spec = changed
        except UwsimError as error:
            if n == 0:  # else it may be about what was put in the place of a wrong name
                yield error
            return
        else:
            live.close()
            return


def _with(spec: Any, name: str, other: str) -> Any:
    """Return a spec, and the specs in it, with ``other`` where it says ``name``."""
    changes: dict[str, object] = {}
    for field in dataclasses.fields(spec):
        value = getattr(spec, field.name)
        if value == name and field.name != "name":
            changes[field.name] = other
        elif dataclasses.is_dataclass(value) and not isinstance(value, Part):
            changes[field.name] = _with(value, name, other)
    return dataclasses.replace(spec, **changes)
