"""Reading a benchmark file: XML -> `BenchmarkSpec`, every error at once.

.. code-block:: xml

    <benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml" u:algorithm="esm">
      <measures> <euclideanNorm> ... </euclideanNorm> </measures>
      <startOn> <type>service</type> <target>startBench</target> </startOn>
      <stopOn> <type>never</type> </stopOn>
      <function>corners+centroid</function>
      <sceneUpdater> <sceneFogUpdater> ... </sceneFogUpdater> </sceneUpdater>
    </benchmark>

The tables of measures, triggers and updaters are arguments: a benchmark can be read with more of
them than the package has.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from lxml import etree

from ..base.compatibility import COMPATIBILITY
from ..errors import BenchmarkError, Diagnostic, did_you_mean
from ..scene.variation import check_variations
from ..schema import (
    NAMESPACE,
    Diagnostics,
    advice,
    check_head,
    fields_of,
    format_tag,
    parse,
    read,
    read_text,
)
from ..world import TIMESTEP
from .element_names import element_name, error_node
from .element_order import check_order
from .ground_truth import GROUND_TRUTHS, ConstantSpec, GroundTruthSpec
from .measures import MEASURES, MeasureSpec, PathFollowingSpec
from .name_checks import check_function, check_names
from .plugin_tables import PREFIX
from .spec import BenchmarkSpec
from .sweep_checks import check_levels, warn_endless, warn_overridden, warn_still_water
from .triggers import TRIGGERS, NeverSpec, TriggerSpec
from .updater_settings import locate_in_benchmark, same_levels
from .updaters import (
    UPDATERS,
    NoneSpec,
    SceneUpdaterSpec,
)
from .warnings import never_started, too_short

OF_A_PLUGIN = ", nor of a plugin that was given (--plugin FILE.py)"

T = TypeVar("T")


def read_benchmark(
    path: Path | str,
    *,
    measures: Mapping[str, type[MeasureSpec]] = MEASURES,
    triggers: Mapping[str, type[TriggerSpec]] = TRIGGERS,
    updaters: Mapping[str, type[SceneUpdaterSpec]] = UPDATERS,
    timestep: float = TIMESTEP,
) -> BenchmarkSpec:
    """Read a benchmark file; durations of less than half a ``timestep`` [s] are errors.

    Raises:
        BenchmarkError: with everything that is wrong about it.
    """
    path = Path(path)
    diagnostics = Diagnostics(path)
    spec = _Reader(diagnostics, measures, triggers, updaters, timestep).benchmark(path)
    diagnostics.check(BenchmarkError)
    assert spec is not None
    return spec


def check_benchmark(
    path: Path,
    *,
    strict: bool = False,
    measures: Mapping[str, type[MeasureSpec]] = MEASURES,
    triggers: Mapping[str, type[TriggerSpec]] = TRIGGERS,
    updaters: Mapping[str, type[SceneUpdaterSpec]] = UPDATERS,
    timestep: float = TIMESTEP,
) -> tuple[list[Diagnostic], BenchmarkSpec | None]:
    """Return all errors and warnings of a benchmark file, ordered by line, and what could be read.

    Where there are errors, the spec lacks the parts that are wrong, or there is none.

    Args:
        path: the file.
        strict: also hold it against the order of the original's grammar.
        measures: element -> spec.
        triggers: type -> spec.
        updaters: element -> spec.
        timestep: length of a step [s].
    """
    diagnostics = Diagnostics(path)
    reader = _Reader(diagnostics, measures, triggers, updaters, timestep)
    try:
        spec = reader.benchmark(path, strict=strict)
    except BenchmarkError as error:
        return list(error.diagnostics), None
    return diagnostics.to_list(), spec


@dataclass(frozen=True)
class _Reader:
    """Reads one file with the given tables."""

    diagnostics: Diagnostics
    measures: Mapping[str, type[MeasureSpec]]
    triggers: Mapping[str, type[TriggerSpec]]
    updaters: Mapping[str, type[SceneUpdaterSpec]]
    timestep: float

    def benchmark(self, path: Path, *, strict: bool = False) -> BenchmarkSpec | None:
        document = parse(path, error=BenchmarkError)
        root = document.root
        check_head(document, "benchmark", self.diagnostics)
        if root.tag != "benchmark":
            return None
        self.diagnostics.allows_trailing_text = (
            document.has_doctype
        )  # the original read its numbers with atof
        if strict:
            check_order(root, self.diagnostics)
        given: dict[str, object] = {"path": str(path)}
        for tag, field in (("startOn", "start_on"), ("stopOn", "stop_on")):
            if (node := root.find(tag)) is not None:
                given[field] = self.trigger(node)
        found: list[MeasureSpec] = []
        if (node := root.find("measures")) is not None:
            found = self.all_measures(node)
            given["measures"] = tuple(found)
        updater: SceneUpdaterSpec | None = None
        if (node := root.find("sceneUpdater")) is not None:
            updater = self.updater(node)
            given["scene_updater"] = updater or NoneSpec()
        if updater is not None:
            check_levels(updater, self.diagnostics)
            warn_overridden(updater, self.diagnostics)
            warn_still_water(updater, self.diagnostics)
        given["compatibility"] = self.compatibility(root)
        given["plugin"] = tuple(str(root.get(f"{{{NAMESPACE}}}plugin", "")).split())
        spec = read(BenchmarkSpec, root, self.diagnostics, known_fields=given)
        if spec is not None and updater is not None:
            check_variations(
                spec,
                self.diagnostics,
                find=locate_in_benchmark,
                check_bound=functools.partial(same_levels, spec),
            )
        check_names(found, updater, self.diagnostics)
        function = None if spec is None else spec.function
        if function is not None:
            check_function(root, function, found, self.diagnostics)
        given_step = None if spec is None else spec.timestep
        timestep = self.timestep if given_step is None else given_step
        for place, message in too_short(found, updater, function, timestep):
            self.diagnostics.error(place, message)
        if spec is not None and updater is not None:
            warn_endless(spec, self.diagnostics)
        if spec is not None and not self.diagnostics.has_errors:
            for place, message in never_started(spec):
                self.diagnostics.warning(place, message)
        return spec

    def all_measures(self, box: etree._Element) -> list[MeasureSpec]:
        """Read the children of ``<measures>``, in the file's order."""
        found = []
        if box.find("*") is None:
            self.diagnostics.warning(box, "<measures> is empty: nothing is measured")
        for node in self.children(box):
            cls = self.measures.get(element_name(node))
            if cls is None:
                self.unknown(node, box, self.measures)
            elif (spec := self.measure(cls, node)) is not None:
                found.append(spec)
        return found

    def measure(self, cls: type[MeasureSpec], node: etree._Element) -> MeasureSpec | None:
        spec = read(cls, node, self.diagnostics, known_fields=self.by_hand(cls, node))
        if spec is None:
            return None
        if isinstance(spec, PathFollowingSpec) and spec.topic is None and spec.reference is None:
            self.diagnostics.warning(
                node, "<pathFollowing> without <topic> and <u:path> has no path, and no value"
            )
        if spec.value not in cls.values:
            self.diagnostics.error(
                node,
                f"u:value is {spec.value!r}; "
                f"the value of <{element_name(node)}> is always its last",
            )
        for message in spec.errors():
            self.diagnostics.error(error_node(node, message), message)
        return spec

    def by_hand(self, cls: type, node: etree._Element) -> dict[str, Any]:
        """Read the fields of a spec whose class depends on the file."""
        given: dict[str, Any] = {}
        for field in fields_of(cls):
            child = node.find(field.tag)
            if field.kind != "manual" or child is None:
                continue
            if field.type is TriggerSpec:
                given[field.name] = self.trigger(child)
            elif field.type is GroundTruthSpec:
                given[field.name] = self.ground_truth(child)
            elif field.type is SceneUpdaterSpec:
                given[field.name] = self.updater(child)
        for own in dataclasses.fields(cls):
            if "path" in own.metadata:
                given[own.name] = self.diagnostics.file
        return given

    def trigger(self, node: etree._Element) -> TriggerSpec:
        """Read ``<startOn>`` or ``<stopOn>``; what a type has no use for is ignored."""
        kinds = node.findall("type")
        kind = read_text(kinds[0], self.diagnostics) if kinds else ""
        if not kind:
            self.diagnostics.error(
                node, f"<{node.tag}> lacks <type>: one of {', '.join(self.triggers)}"
            )
        elif kind not in self.triggers:
            near = did_you_mean(kind, self.triggers) if len(kind) < 80 else ""
            own = OF_A_PLUGIN * (kind.startswith(PREFIX) and not near)
            self.diagnostics.error(
                kinds[0],
                f"<type> is {kind[:60]!r}; expected one of {', '.join(self.triggers)}{own}.{near}",
            )
        cls = self.triggers.get(kind)
        if len(kinds) > 1:
            self.diagnostics.error(kinds[1], f"<type> is given twice in <{node.tag}>; only one may")
        for child in kinds:
            _take_out(child)
        if cls is None:
            return NeverSpec()
        known = {field.tag for field in fields_of(cls)}
        for child in list(node.iterchildren("target", "position")):
            if child.tag not in known:
                self.diagnostics.warning(child, f"<{child.tag}> means nothing to {kind!r}: ignored")
                _take_out(child)
        return read(cls, node, self.diagnostics) or NeverSpec()

    def ground_truth(self, node: etree._Element) -> GroundTruthSpec:
        """Read ``<groundTruth>``, by its type."""
        placeholder = ConstantSpec(values=())
        kind = str(node.attrib.pop("type", "")).strip()
        if not kind and {element_name(child) for child in self.children(node)} == {"value"}:
            kind = "constant"
            self.diagnostics.warning(
                node, "<groundTruth> without a type, as in 2013: read as constant"
            )
        cls = GROUND_TRUTHS.get(kind)
        if cls is None:
            near = did_you_mean(kind, GROUND_TRUTHS) if len(kind) < 80 else ""
            message = f"type is {kind[:60]!r}" if kind else "<groundTruth> lacks the attribute type"
            self.diagnostics.error(
                node, f"{message}; expected one of {', '.join(GROUND_TRUTHS)}.{near}"
            )
            return placeholder
        return read(cls, node, self.diagnostics) or placeholder

    def updater(self, box: etree._Element) -> SceneUpdaterSpec | None:
        """Read ``<sceneUpdater>`` with its nested updaters."""
        nodes = self.children(box)
        if not nodes:
            self.diagnostics.error(
                box, f"<sceneUpdater> is empty; expected one of <{'>, <'.join(UPDATERS)}>"
            )
        for extra in nodes[1:]:
            self.diagnostics.error(
                extra,
                f"<{element_name(extra)}> is a sibling of <{element_name(nodes[0])}> in "
                "<sceneUpdater>; only one may: nest it in a <sceneUpdater> of its own",
            )
        if not nodes:
            return None
        node = nodes[0]
        cls = self.updaters.get(element_name(node))
        if cls is None:
            self.unknown(node, box, self.updaters)
            return None
        spec = read(cls, node, self.diagnostics, known_fields=self.by_hand(cls, node))
        wrong = [] if spec is None else list(spec.errors())
        for message in wrong:
            self.diagnostics.error(error_node(node, message), message)
        return None if wrong else spec

    def compatibility(self, root: etree._Element) -> tuple[str, ...]:
        names = tuple(str(root.get(f"{{{NAMESPACE}}}compatibility", "")).replace(",", " ").split())
        known = [*COMPATIBILITY, "uwsim"]
        for name in [name for name in names if name not in known][:10]:
            self.diagnostics.report_unknown(
                root, f"u:compatibility names {name[:60]!r}", name, known
            )
        return names

    def children(self, box: etree._Element) -> list[etree._Element]:
        """The children of an element that may contain nothing else."""
        for piece in (box.text, *(child.tail for child in box)):
            if (stray := (piece or "").strip()) != "":
                self.diagnostics.error(box, f"stray text {stray[:60]!r} in <{box.tag}>")
                break
        for name in box.attrib:
            self.diagnostics.error(box, f"{str(name)[:60]} is not an attribute of <{box.tag}>")
        return list(box.iterchildren("*"))

    def unknown(self, node: etree._Element, box: etree._Element, known: Mapping[str, T]) -> None:
        name = element_name(node)
        message = (
            f"{format_tag(str(node.tag))} is not an element of <{box.tag}>{advice(str(node.tag))}"
        )
        if name.startswith(PREFIX):
            message += OF_A_PLUGIN
            if (plugin := node.getroottree().getroot().get(f"{{{NAMESPACE}}}plugin")) is not None:
                message += f"; {str(plugin)[:100]!r} of u:plugin is not run by `uwsim check`"
        self.diagnostics.report_unknown(node, message, name, known)


def _take_out(node: etree._Element) -> None:
    """Remove an element that has been dealt with, so that it is not found unknown."""
    parent = node.getparent()
    if parent is not None:
        parent.remove(node)
