"""RELAX NG grammars of the two dialects, generated from the specs.

A spec is a ``<define>`` of the content of its element, each part once and in any order. A family of
a benchmark (measures, triggers, ground truths, scene updaters) is a ``<define>`` of its members to
choose from; a scene updater may hold another. Values are compared with a pattern, not with the
limits of the reader, and elements of plugins are not included.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Iterable, Iterator, Mapping

from lxml import etree

from uwsim.schema import NAMESPACE, TOKENS, Field, fields_of

RNG = "http://relaxng.org/ns/structure/1.0"
TYPES = "http://www.w3.org/2001/XMLSchema-datatypes"

SIGNED_TOKENS = "|".join(token.removeprefix("-") for token in TOKENS if not token.startswith("-"))
NUMBER = rf"[+\-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+\-]?[0-9]+)?|-?({SIGNED_TOKENS})"
SPACE = r"[ \t\n\r]*"
SOME_TEXT = rf"{SPACE}[^ \t\n\r][\s\S]*"

Family = Mapping[str, type]
Members = Callable[[etree._Element, Family], None]


def scene_grammar() -> str:
    """Return ``docs/grammar/uwsim-scene.rng``."""
    from uwsim.scene.reader import ROOT
    from uwsim.scene.spec import SceneSpec

    return _grammar(ROOT, SceneSpec, {})


def benchmark_grammar() -> str:
    """Return ``docs/grammar/uwsim-benchmark.rng``."""
    from uwsim.benchmark.ground_truth import GROUND_TRUTHS, GroundTruthSpec
    from uwsim.benchmark.measures import MEASURES, MeasureSpec
    from uwsim.benchmark.spec import BenchmarkSpec
    from uwsim.benchmark.triggers import TRIGGERS, TriggerSpec
    from uwsim.benchmark.updaters import UPDATERS, SceneUpdaterSpec

    families: dict[type, tuple[Family, Members]] = {
        MeasureSpec: (MEASURES, _add_elements),
        TriggerSpec: (TRIGGERS, _add_types),
        GroundTruthSpec: (GROUND_TRUTHS, _add_type_attributes),
        SceneUpdaterSpec: (UPDATERS, _add_elements),
    }
    return _grammar("benchmark", BenchmarkSpec, families)


def _grammar(root: str, spec: type, families: Mapping[type, tuple[Family, Members]]) -> str:
    """Return the grammar of a document whose root element has the spec ``spec``."""
    tree = etree.Element(f"{{{RNG}}}grammar", {"datatypeLibrary": TYPES}, nsmap={None: RNG})  # type: ignore[dict-item]  # the stubs know no default namespace
    _add_reference(_add_child(_add_child(tree, "start"), "element", name=root), spec)
    members = [cls for family, _ in families.values() for cls in family.values()]
    for cls in _all_specs([spec, *members]):
        content = _add_child(_add_child(tree, "define", name=cls.__name__), "interleave")
        _add_child(content, "empty")
        for field in fields_of(cls):
            _add_field(content, field)
    for base, (family, add_members) in families.items():
        add_members(_add_child(_add_child(tree, "define", name=base.__name__), "choice"), family)
    etree.indent(tree)
    return etree.tostring(tree, encoding="unicode") + "\n"


def _all_specs(specs: Iterable[type]) -> Iterator[type]:
    """Yield specs and all nested specs once, in the order of files."""
    queue, visited_specs = list(specs), set[type]()
    while queue:
        cls = queue.pop(0)
        if cls in visited_specs:
            continue
        visited_specs.add(cls)
        yield cls
        nested_specs: list[type] = []
        for field in fields_of(cls):
            if field.kind == "spec":
                nested_specs.append(field.type)
            elif field.kind == "choice":
                nested_specs += field.type.values()
        queue = nested_specs + queue


def _add_elements(choice: etree._Element, family: Family) -> None:
    """Add members that are elements: ``<distance>``."""
    for name, spec in family.items():
        tag = f"{{{NAMESPACE}}}{name[2:]}" if name.startswith("u:") else name
        _add_reference(_add_child(choice, "element", **_name_attributes(tag)), spec)


def _add_types(choice: etree._Element, family: Family) -> None:
    """Add alternatives distinguished by ``<type>``; unused elements of a type are ignored."""
    places = {field.tag: field for spec in family.values() for field in fields_of(spec)}
    for name, spec in family.items():
        member = _add_child(choice, "interleave")
        _add_pattern(_add_child(member, "element", name="type"), f"{SPACE}{name}{SPACE}")
        _add_reference(member, spec)
        for tag in sorted(places.keys() - {field.tag for field in fields_of(spec)}):
            _add_field(member, dataclasses.replace(places[tag], default=None))


def _add_type_attributes(choice: etree._Element, family: Family) -> None:
    """Add alternatives distinguished by ``type=``."""
    for name, spec in family.items():
        member = _add_child(choice, "group")
        _add_pattern(_add_child(member, "attribute", name="type"), f"{SPACE}{name}{SPACE}")
        _add_reference(member, spec)


def _add_field(content: etree._Element, field: Field) -> None:
    """Add the pattern of a field."""
    if field.xml.text:
        _add_scalar(content, field)
        return
    is_needed = field.default is dataclasses.MISSING
    if _is_element_repeated(field):
        content = _add_child(content, "oneOrMore" if is_needed else "zeroOrMore")
    elif not is_needed:
        content = _add_child(content, "optional")
    node_type = "attribute" if field.xml.attribute else "element"
    namespaced_aliases = [name for name in field.xml.original.aliases if name.startswith("{")]
    node = _add_child(
        content, node_type, **({} if namespaced_aliases else _name_attributes(field.tag))
    )
    if namespaced_aliases:
        names = _add_child(node, "choice")
        for name in (field.tag, *namespaced_aliases):
            entry = _name_attributes(name)
            _add_child(names, "name", ns=entry.get("ns", "")).text = entry["name"]
    if field.kind == "spec":
        _add_reference(node, field.type)
    elif field.kind == "manual":
        _add_reference(_add_child(node, "zeroOrMore") if field.is_repeated else node, field.type)
    elif field.kind == "choice":
        choice = _add_child(_add_child(node, "zeroOrMore"), "choice")
        for child, spec in field.type.items():
            _add_reference(
                _add_child(choice, "element", **_name_attributes(child, parent=field)), spec
            )
    elif field.kind == "triple":
        if field.words:
            node = _add_child(node, "choice")
            words = dataclasses.replace(field, kind="word", type=field.words)
            _add_scalar(node, words, may_be_empty=False)
        parts = _add_child(node, "interleave")
        for part in field.xml.parts:
            _add_scalar(
                _add_child(parts, "element", **_name_attributes(part, parent=field)),
                field,
                may_be_empty=True,
            )
    elif field.xml.item:
        _add_scalar(
            _add_child(
                _add_child(node, "zeroOrMore"),
                "element",
                **_name_attributes(field.xml.item, parent=field),
            ),
            field,
        )
    else:
        _add_scalar(node, field, may_be_empty=not is_needed)


def _is_element_repeated(field: Field) -> bool:
    """Return True if the element itself may be repeated, not only its content."""
    is_one_box = field.kind in ("choice", "manual") or (
        field.kind != "list" and bool(field.xml.item)
    )
    return field.is_repeated and not is_one_box and not field.xml.attribute


def _name_attributes(tag: str, *, parent: Field | None = None) -> dict[str, str]:
    """Return name and namespace of an element or attribute, which else inherits its parent's."""
    if tag.startswith("{"):
        return {"name": tag.split("}")[1], "ns": NAMESPACE}
    return {"name": tag, "ns": ""} if parent and parent.xml.namespaced else {"name": tag}


def _literal(word: str) -> str:
    """Return a word as a pattern of XML Schema, which has no escaped blanks."""
    return re.escape(word).replace("\\ ", " ")


def _add_scalar(node: etree._Element, field: Field, *, may_be_empty: bool = False) -> None:
    """Add the pattern of a scalar."""
    if field.kind == "str":
        if may_be_empty:
            _add_child(node, "text")
        else:
            _add_pattern(node, SOME_TEXT)
        return
    patterns = {
        "int": r"[+\-]?[0-9]+",
        "numbers": rf"({NUMBER})([ ,]+({NUMBER}))*",
        "bool": "true|false|0|1" if field.xml.attribute else "0|1",
        "word": "|".join(map(_literal, field.type)) if field.kind == "word" else "",
    }
    pattern = f"({patterns.get(field.kind, NUMBER)})" + ("?" if may_be_empty else "")
    _add_pattern(node, f"{SPACE}{pattern}{SPACE}")


def _add_pattern(node: etree._Element, pattern: str) -> None:
    """Add text that matches a regular expression of XML Schema."""
    data = _add_child(node, "data", type="string")
    _add_child(data, "param", name="pattern").text = pattern


def _add_reference(node: etree._Element, spec: type) -> None:
    """Add a reference to the content of an element with the spec ``spec``."""
    _add_child(node, "ref", name=spec.__name__)


def _add_child(parent: etree._Element, tag: str, **attributes: str) -> etree._Element:
    return etree.SubElement(parent, f"{{{RNG}}}{tag}", dict(attributes))
