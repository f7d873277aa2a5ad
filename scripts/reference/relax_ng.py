"""RELAX NG grammars of the two dialects, generated from the specs.

A spec is a ``<define>`` of what stands in its element, each part once and in any order. A family of
a benchmark (measures, triggers, ground truths, scene updaters) is a ``<define>`` of its members to
choose from; a scene updater may hold another. Values are compared with a pattern, not against the
limits that the reader knows, and the parts of a plugin are not in it.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Iterable, Iterator, Mapping

from lxml import etree

from uwsim.schema import NAMESPACE, TOKENS, Field, fields_of

RNG = "http://relaxng.org/ns/structure/1.0"
TYPES = "http://www.w3.org/2001/XMLSchema-datatypes"

SIGNED = "|".join(token.removeprefix("-") for token in TOKENS if not token.startswith("-"))
NUMBER = rf"[+\-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+\-]?[0-9]+)?|-?({SIGNED})"
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
        MeasureSpec: (MEASURES, _by_element),
        TriggerSpec: (TRIGGERS, _by_type),
        GroundTruthSpec: (GROUND_TRUTHS, _by_type_attribute),
        SceneUpdaterSpec: (UPDATERS, _by_element),
    }
    return _grammar("benchmark", BenchmarkSpec, families)


def _grammar(root: str, spec: type, families: Mapping[type, tuple[Family, Members]]) -> str:
    """The grammar of a document whose root element is read by ``spec``."""
    tree = etree.Element(f"{{{RNG}}}grammar", {"datatypeLibrary": TYPES}, nsmap={None: RNG})  # type: ignore[dict-item]  # the stubs know no default namespace
    _ref(_sub(_sub(tree, "start"), "element", name=root), spec)
    members = [cls for family, _ in families.values() for cls in family.values()]
    for cls in _each_once([spec, *members]):
        content = _sub(_sub(tree, "define", name=cls.__name__), "interleave")
        _sub(content, "empty")
        for field in fields_of(cls):
            _field(content, field)
    for base, (family, add_members) in families.items():
        add_members(_sub(_sub(tree, "define", name=base.__name__), "choice"), family)
    etree.indent(tree)
    return etree.tostring(tree, encoding="unicode") + "\n"


def _each_once(specs: Iterable[type]) -> Iterator[type]:
    """These specs and all nested ones, in the order of the files."""
    waiting, done = list(specs), set[type]()
    while waiting:
        cls = waiting.pop(0)
        if cls in done:
            continue
        done.add(cls)
        yield cls
        inside: list[type] = []
        for field in fields_of(cls):
            if field.kind == "spec":
                inside.append(field.type)
            elif field.kind == "choice":
                inside += field.type.values()
        waiting = inside + waiting


def _by_element(choice: etree._Element, family: Family) -> None:
    """Members that are elements: ``<distance>``."""
    for name, spec in family.items():
        tag = f"{{{NAMESPACE}}}{name[2:]}" if name.startswith("u:") else name
        _ref(_sub(choice, "element", **_named(tag)), spec)


def _by_type(choice: etree._Element, family: Family) -> None:
    """Alternatives distinguished by ``<type>``; an element that a type does not use is ignored."""
    places = {field.tag: field for spec in family.values() for field in fields_of(spec)}
    for name, spec in family.items():
        member = _sub(choice, "interleave")
        _pattern(_sub(member, "element", name="type"), f"{SPACE}{name}{SPACE}")
        _ref(member, spec)
        for tag in sorted(places.keys() - {field.tag for field in fields_of(spec)}):
            _field(member, dataclasses.replace(places[tag], default=None))


def _by_type_attribute(choice: etree._Element, family: Family) -> None:
    """Alternatives distinguished by ``type=``."""
    for name, spec in family.items():
        member = _sub(choice, "group")
        _pattern(_sub(member, "attribute", name="type"), f"{SPACE}{name}{SPACE}")
        _ref(member, spec)


def _field(content: etree._Element, field: Field) -> None:
    """The pattern of one field."""
    if field.xml.text:
        _data(content, field)
        return
    is_needed = field.default is dataclasses.MISSING
    if _stands_often(field):
        content = _sub(content, "oneOrMore" if is_needed else "zeroOrMore")
    elif not is_needed:
        content = _sub(content, "optional")
    what = "attribute" if field.xml.attribute else "element"
    own = [name for name in field.xml.original.aliases if name.startswith("{")]
    node = _sub(content, what, **({} if own else _named(field.tag)))
    if own:
        names = _sub(node, "choice")
        for name in (field.tag, *own):
            entry = _named(name)
            _sub(names, "name", ns=entry.get("ns", "")).text = entry["name"]
    if field.kind == "spec":
        _ref(node, field.type)
    elif field.kind == "manual":
        _ref(_sub(node, "zeroOrMore") if field.is_repeated else node, field.type)
    elif field.kind == "choice":
        several = _sub(_sub(node, "zeroOrMore"), "choice")
        for child, spec in field.type.items():
            _ref(_sub(several, "element", **_named(child, within=field)), spec)
    elif field.kind == "triple":
        if field.words:
            node = _sub(node, "choice")
            words = dataclasses.replace(field, kind="word", type=field.words)
            _data(node, words, may_be_empty=False)
        parts = _sub(node, "interleave")
        for part in field.xml.parts:
            _data(_sub(parts, "element", **_named(part, within=field)), field, may_be_empty=True)
    elif field.xml.item:
        _data(
            _sub(_sub(node, "zeroOrMore"), "element", **_named(field.xml.item, within=field)), field
        )
    else:
        _data(node, field, may_be_empty=not is_needed)


def _stands_often(field: Field) -> bool:
    """Whether the element itself may be repeated, not only its content."""
    is_one_box = field.kind in ("choice", "manual") or (
        field.kind != "list" and bool(field.xml.item)
    )
    return field.is_repeated and not is_one_box and not field.xml.attribute


def _named(tag: str, *, within: Field | None = None) -> dict[str, str]:
    """How the grammar names an element or attribute; it would inherit the namespace around it."""
    if tag.startswith("{"):
        return {"name": tag.split("}")[1], "ns": NAMESPACE}
    return {"name": tag, "ns": ""} if within and within.xml.namespaced else {"name": tag}


def _literal(word: str) -> str:
    """A word as a pattern of XML Schema, which has no escaped blanks."""
    return re.escape(word).replace("\\ ", " ")


def _data(node: etree._Element, field: Field, *, may_be_empty: bool = False) -> None:
    """The pattern of a scalar."""
    if field.kind == "str":
        if may_be_empty:
            _sub(node, "text")
        else:
            _pattern(node, SOME_TEXT)
        return
    patterns = {
        "int": r"[+\-]?[0-9]+",
        "numbers": rf"({NUMBER})([ ,]+({NUMBER}))*",
        "bool": "true|false|0|1" if field.xml.attribute else "0|1",
        "word": "|".join(map(_literal, field.type)) if field.kind == "word" else "",
    }
    inner = f"({patterns.get(field.kind, NUMBER)})" + ("?" if may_be_empty else "")
    _pattern(node, f"{SPACE}{inner}{SPACE}")


def _pattern(node: etree._Element, pattern: str) -> None:
    """Text that matches a regular expression of XML Schema."""
    data = _sub(node, "data", type="string")
    _sub(data, "param", name="pattern").text = pattern


def _ref(node: etree._Element, spec: type) -> None:
    """The content of an element, from its ``spec``."""
    _sub(node, "ref", name=spec.__name__)


def _sub(parent: etree._Element, tag: str, **attributes: str) -> etree._Element:
    return etree.SubElement(parent, f"{{{RNG}}}{tag}", dict(attributes))
