"""``docs/*dialect.md`` and ``docs/grammar/*.rng``: the dialects, generated from the specs.

All are generated from the table that reads the files (`uwsim.schema.fields_of`), so that they agree
with the reader.
"""

from __future__ import annotations

import dataclasses
import inspect
import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType

from uwsim.cli.list import qualified_name
from uwsim.schema import Field, fields_of
from uwsim.schema.names import prefixed_name

from .relax_ng import benchmark_grammar, scene_grammar

HEAD = """\
# Scene file reference

All elements of a scene file; `scripts/docs` generates this page from the specs that read the files.
Elements may be in any order; those with a default may be left out. Numbers may be `M_PI`, `M_PI_2`,
`M_PI_4` and their negatives. Flags are 0 or 1. `u:` is the namespace `urn:uwsim:1`: a file that
uses it carries no DOCTYPE. An empty element of `u:` that needs a value is an error; an empty
element of the original keeps its default. [Old names](#old-names) of older UWSim files are read,
too, with a warning; `uwsim check FILE.xml` reports them. Elements marked as *read, not simulated
yet* have no effect.

The grammar for editors is [uwsim-scene.rng](grammar/uwsim-scene.rng) (RELAX NG). It has today's
names only.
"""

BENCHMARK_HEAD = """\
# Benchmark file reference

All elements of a benchmark file; `scripts/docs` generates this page from the specs that read the
files. Elements may be in any order; those with a default may be left out. Numbers may be `M_PI`,
`M_PI_2`, `M_PI_4` and their negatives. `u:` is the namespace `urn:uwsim:1`: a file that uses it
carries no DOCTYPE. The meaning of the elements: [measures](measures.md), [levels](levels.md).
`uwsim check FILE.xml` checks a file, `--strict` also the order of elements in the original. In a
file with the original's DOCTYPE text after a number (`2 s`) is ignored with a warning; a decimal
comma is an error.

The grammar for editors is [uwsim-benchmark.rng](grammar/uwsim-benchmark.rng) (RELAX NG). It has
today's names only, without the limits of numbers and the elements of plugins.
"""


def page() -> str:
    """Return ``docs/dialect.md``."""
    from uwsim.scene.reader import ROOT
    from uwsim.scene.spec import SceneSpec
    from uwsim.scene.unsupported import describe_limitation

    parts = [HEAD]
    described_specs: set[type] = set()
    for parent, name, cls in _specs("", ROOT, SceneSpec):
        if cls not in described_specs:
            described_specs.add(cls)
            limitation = describe_limitation(parent, qualified_name(name))
            parts.append(_section(name, cls, limitation=limitation, homes=_scene_homes()))
    return "\n".join([*parts, _plausibility_warnings(), _old_names()])


def _plausibility_warnings() -> str:
    """Return the section of plausibility warnings of `uwsim check`."""
    from uwsim.scene.accepted_warnings import PLAUSIBILITY_WARNINGS

    lines = [
        "## Plausibility warnings", "",
        "`uwsim check`, and `uwsim bench` and `uwsim render` before they begin, warn about values "
        "that are valid but unlikely. `<u:accept>NAME</u:accept>` in a vehicle, or "
        "`buoyancy`, `places` and `start` in an object, accepts the value. All warnings but "
        "`passable`, `size` and `start` concern vehicles with dynamics, and loose objects in a "
        "scene with one.", "",
        "| name | warns when |", "|---|---|",
    ]  # fmt: skip
    return "\n".join(
        [
            *lines,
            *(f"| `{name}` | {condition} |" for name, condition in PLAUSIBILITY_WARNINGS.items()),
            "",
        ]
    )


def _old_names() -> str:
    """Return the section of elements of files from 2011 to 2019."""
    from uwsim.scene.legacy import ANY_PARENT_RULES, RULES

    by_parent: dict[str, list[str]] = {}
    for parent, element in RULES:
        by_parent.setdefault(parent, []).append(element)
    lines = [
        "## Old names", "",
        "Elements of earlier versions of UWSim and its forks. They are read under today's names or "
        "ignored; `uwsim check` reports each.", "",
        "| in | old elements |", "|---|---|",
    ]  # fmt: skip
    for parent, elements in [*sorted(by_parent.items()), ("anything", list(ANY_PARENT_RULES))]:
        parent_text = parent if parent == "anything" else f"`{parent}`"
        lines.append(
            f"| {parent_text} | " + ", ".join(f"`{name}`" for name in sorted(elements)) + " |"
        )
    return "\n".join(lines) + "\n"


def benchmark_page() -> str:
    """Return ``docs/benchmark-dialect.md``."""
    from uwsim.benchmark.environment import (
        ActionSpec,
        ContactSpec,
        EnvironmentSpec,
        EpisodeLevelsSpec,
        ImageSpec,
        RelativePoseSpec,
        TopicFieldSpec,
    )
    from uwsim.benchmark.ground_truth import GROUND_TRUTHS
    from uwsim.benchmark.measures import MEASURES
    from uwsim.benchmark.spec import BenchmarkSpec, FunctionSpec
    from uwsim.benchmark.triggers import TRIGGERS
    from uwsim.benchmark.updaters import UPDATERS

    families: tuple[tuple[str, str, Mapping[str, type]], ...] = (
        ("Measures", "<{}>", MEASURES),
        ("Ground truths", '<groundTruth type="{}">', GROUND_TRUTHS),
        ("Triggers", "<type> {} </type>", TRIGGERS),
        ("Scene updaters", "<{}>", UPDATERS),
    )
    homes = {cls: f"dialect.md{home}" for cls, home in _scene_homes().items()}
    parts = [BENCHMARK_HEAD, _section("benchmark", BenchmarkSpec, homes=homes)]
    parts.append(_section("function", FunctionSpec))
    parts.append(_section("u:environment", EnvironmentSpec))
    parts.append(_section("relativePose", RelativePoseSpec))
    parts.append(_section("contact", ContactSpec))
    parts.append(_section("topicField", TopicFieldSpec))
    parts.append(_section("image", ImageSpec))
    parts.append(_section("action", ActionSpec))
    parts.append(_section("episodeLevels", EpisodeLevelsSpec))
    for title, form, table in families:
        parts.append(f"## {title}\n")
        for name, cls in table.items():
            parts.append(_section(name, cls, title=form.format(name)))
            parts += [
                _section(field.label, field.type, title=f"<{field.label}>")
                for field in fields_of(cls)
                if field.kind == "spec"
            ]
    return "\n".join(parts)


def _scene_homes() -> dict[type, str]:
    """Return the link to the section of each spec of a scene, by its first name in files."""
    from uwsim.scene.reader import ROOT
    from uwsim.scene.spec import SceneSpec

    homes: dict[type, str] = {}
    for _, name, cls in _specs("", ROOT, SceneSpec):
        homes.setdefault(cls, f"#{_anchor(name)}")
    return homes


def _specs(parent: str, name: str, cls: type) -> Iterator[tuple[str, str, type]]:
    """Yield all specs below a spec with parent and name, itself first, in the order of files."""
    yield parent, name, cls
    for field in fields_of(cls):
        if field.kind == "spec":
            yield from _specs(name, field.label, field.type)
        elif field.kind == "choice":
            for child, spec in field.type.items():
                yield from _specs(field.label, prefixed_name(child), spec)


def _section(
    name: str,
    cls: type,
    *,
    title: str | None = None,
    limitation: str = "",
    homes: Mapping[type, str] = MappingProxyType({}),
) -> str:
    """Return the section of an element: description, example and table of its content.

    Args:
        name: the name of the element.
        cls: the spec of the element.
        title: the title of a member of a family, whose module describes it alone.
        limitation: the limitation of its simulation; empty: none.
        homes: links to sections of specs; others have sections on this page.
    """
    from uwsim.scene.unsupported import describe_limitation

    doc = (inspect.getdoc(cls) or "").strip()
    module = sys.modules[cls.__module__].__doc__ or ""
    lines = [f"## `<{name}>`" if title is None else f"### `{title}`", "", _markdown(doc), ""]
    if limitation:
        lines += [f"*{_markdown(limitation)[0].upper()}{_markdown(limitation)[1:]}.*", ""]
    block = re.search(r"\.\. code-block:: xml\n\n((?:    .*\n|\n)+)", module)
    first_line = rf"<{re.escape(name)}[ >/]|<(start|stop)On>.*<type>{name}<"
    if block and re.search(first_line, " ".join(block[1].split("\n")[: 1 if title is None else 2])):
        lines += ["```xml", inspect.cleandoc(block[1]).rstrip(), "```", ""]
    if not fields_of(cls):
        return "\n".join(lines)
    lines += ["| element | content | default | meaning |", "|---|---|---|---|"]
    for field in fields_of(cls):
        mark = " (attribute)" if field.xml.attribute else ""
        part = "" if title is not None else describe_limitation(name, qualified_name(field.label))
        meaning = _markdown(field.doc) + (f" *({part})*" if part else "")
        cells = (f"`{field.label}`{mark}", _kind(field, homes), _default(field), meaning)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def _kind(field: Field, homes: Mapping[type, str]) -> str:
    content = field.expected
    if field.kind == "spec":
        content = f"[`<{field.label}>`]({homes.get(field.type, f'#{_anchor(field.label)}')})"
    elif field.kind == "choice":
        names = {prefixed_name(child): cls for child, cls in field.type.items()}
        content = "any of " + ", ".join(
            f"[`{name}`]({homes.get(cls, f'#{_anchor(name)}')})" for name, cls in names.items()
        )
    elif field.kind == "triple":
        unit = f" [{field.unit}]" if field.unit else ""
        content = " ".join(f"`<{part}>`" for part in field.xml.parts) + unit
        if field.words:
            content += ", or one of " + ", ".join(f"`{word}`" for word in field.words)
    elif field.kind == "manual":
        content = _family(field)
    elif field.xml.item:
        item = "a number" if field.kind == "list" else content
        content = f"`<{field.xml.item}>`, any number: {item}"
    return (
        f"{content}, any number"
        if field.is_repeated and field.kind in ("spec", "list")
        else content
    )


def _family(field: Field) -> str:
    """Return a link to the section of a benchmark's family of elements."""
    kind = field.type.__name__.removesuffix("Spec")
    title = {"SceneUpdater": "Scene updaters", "GroundTruth": "Ground truths"}.get(kind, f"{kind}s")
    quantifier = "any of" if field.is_repeated else "one of"
    return f"{quantifier} the [{title.lower()}](#{title.lower().replace(' ', '-')})"


def _anchor(name: str) -> str:
    """Return the anchor of an element."""
    return name.lower().replace(":", "")


def _default(field: Field) -> str:
    default = field.default
    if default is dataclasses.MISSING:
        return "required"
    if default is None or default in ((), "") or field.kind == "spec":
        return "-"
    if isinstance(default, bool):
        return str(default).lower() if field.xml.attribute else str(int(default))
    if isinstance(default, tuple):
        return " ".join(f"{value:g}" for value in default)
    return f"{default:g}" if isinstance(default, float) else str(default)


def _markdown(text: str) -> str:
    return " ".join(text.replace("``", "`").split())


def pages() -> Mapping[str, str]:
    """Return the texts of the generated files below ``docs``."""
    return {
        "dialect.md": page(),
        "benchmark-dialect.md": benchmark_page(),
        "grammar/uwsim-benchmark.rng": benchmark_grammar(),
        "grammar/uwsim-scene.rng": scene_grammar(),
    }


def main() -> None:
    """Write the generated files below a folder."""
    folder = Path(sys.argv[1])
    for name, text in pages().items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


if __name__ == "__main__":
    main()
