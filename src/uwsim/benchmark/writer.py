"""Writer of a `BenchmarkSpec` as a benchmark file, from which the reader returns an equal spec."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lxml import etree

from ..errors import BadSetting
from ..schema import NAMESPACE, Field, fill_element
from ..schema.layout import lay_out
from .ground_truth import GROUND_TRUTHS, GroundTruthSpec
from .measures import MEASURES, MeasureSpec
from .spec import BenchmarkSpec
from .triggers import TRIGGERS, TriggerSpec
from .updaters import UPDATERS, SceneUpdaterSpec


def write_benchmark(
    benchmark: BenchmarkSpec,
    *,
    measures: Mapping[str, type[MeasureSpec]] = MEASURES,
    triggers: Mapping[str, type[TriggerSpec]] = TRIGGERS,
    updaters: Mapping[str, type[SceneUpdaterSpec]] = UPDATERS,
) -> str:
    """Return a benchmark as the text of a file, without values that equal their defaults.

    Args:
        benchmark: the benchmark.
        measures: the specs of measures by the names of their elements.
        triggers: the specs of triggers by the names of their types.
        updaters: the specs of scene updaters by the names of their elements.

    Raises:
        BadSetting: a measure, trigger or updater is not in its table.
    """
    tables: dict[type, Mapping[str, type]] = {
        MeasureSpec: measures,
        TriggerSpec: triggers,
        SceneUpdaterSpec: updaters,
        GroundTruthSpec: GROUND_TRUTHS,
    }
    root = etree.Element("benchmark", nsmap={"u": NAMESPACE})
    _write_fields(root, benchmark, tables)
    return lay_out(root)


def _write_fields(
    node: etree._Element, spec: object, tables: Mapping[type, Mapping[str, type]]
) -> None:
    def write_manual(parent: etree._Element, field: Field, value: Any) -> None:
        child = etree.SubElement(parent, field.tag)
        for item in value if field.is_repeated else (value,):
            name = _name_in(tables[field.type], item)
            if field.type is TriggerSpec:
                etree.SubElement(child, "type").text = name
                _write_fields(child, item, tables)
            elif field.type is GroundTruthSpec:
                child.set("type", name)
                _write_fields(child, item, tables)
            else:
                _write_fields(etree.SubElement(child, _tag_of(name)), item, tables)

    fill_element(node, spec, write_manual)


def _name_in(table: Mapping[str, type], spec: object) -> str:
    """Return the name of a spec in a table; raise BadSetting if it is not there."""
    name = next((name for name, cls in table.items() if cls is type(spec)), None)
    if name is None:
        raise BadSetting(
            f"{type(spec).__name__} has no element. Name the file that defines it as a plugin."
        )
    return name


def _tag_of(name: str) -> str:
    """Return the qualified name of an element: ``u:waterUpdater`` is in the namespace of uwsim."""
    return f"{{{NAMESPACE}}}{name.removeprefix('u:')}" if name.startswith("u:") else name
