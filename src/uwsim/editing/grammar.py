"""The kinds of elements that an element of a scene or benchmark may contain."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ..benchmark.ground_truth import GROUND_TRUTHS, GroundTruthSpec
from ..benchmark.measures import MeasureSpec
from ..benchmark.plugin_tables import Tables
from ..benchmark.triggers import TriggerSpec
from ..benchmark.updaters import SceneUpdaterSpec
from ..checks.benchmark_tables import bundled_tables
from ..schema import Field, fields_of


@dataclass(frozen=True)
class Place:
    """A field of a spec that contains other specs."""

    name: str
    """The name of the field."""
    kinds: Mapping[str, type]
    """The specs that the field may contain, by element name without ``u:``."""
    is_list: bool
    """True if the field contains any number of specs."""
    is_grouped: bool
    """True if a file has the specs in the order of their kinds."""
    is_optional: bool
    """True if the field may be None."""

    def sort(self, specs: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return specs in the order in which a file has them."""
        if not self.is_grouped:
            return specs
        order = {kind: index for index, kind in enumerate(self.kinds.values())}
        return tuple(sorted(specs, key=lambda spec: order[type(spec)]))


@functools.cache
def default_tables() -> Tables:
    """Return the bundled measures, triggers, updaters and algorithms."""
    return bundled_tables()


def places_of(cls: type, tables: Tables) -> dict[str, Place]:
    """Return the fields of a spec that contain specs, by name.

    Args:
        cls: the class of the spec.
        tables: the measures, triggers and updaters of benchmarks.
    """
    places: dict[str, Place] = {}
    for field in fields_of(cls):
        kinds = dict(_kinds(field, tables))
        if not kinds:
            continue
        first_place = places.get(field.name)
        is_list = field.is_member or field.is_repeated or field.kind == "choice"
        is_optional = field.is_optional and not field.is_member
        places[field.name] = Place(
            field.name,
            kinds if first_place is None else {**first_place.kinds, **kinds},
            is_list,
            field.is_member,
            is_optional,
        )
    return places


def value_fields(cls: type, tables: Tables) -> dict[str, Field]:
    """Return the fields of a spec that contain values and no specs, by name."""
    places = places_of(cls, tables)
    return {field.name: field for field in fields_of(cls) if field.name not in places}


def _kinds(field: Field, tables: Tables) -> Iterator[tuple[str, type]]:
    if field.kind == "choice":
        yield from ((_plain_name(tag), kind) for tag, kind in field.type.items())
    elif field.kind == "spec":
        yield _plain_name(field.tag), field.type
    elif field.kind == "manual":
        by_class: dict[type, Mapping[str, type]] = {
            MeasureSpec: tables.measures,
            TriggerSpec: tables.triggers,
            SceneUpdaterSpec: tables.updaters,
            GroundTruthSpec: GROUND_TRUTHS,
        }
        yield from ((_plain_name(tag), kind) for tag, kind in by_class.get(field.type, {}).items())


def _plain_name(tag: str) -> str:
    """Return the name of an element without namespace or ``u:``."""
    return tag.rpartition("}")[2].removeprefix("u:")
