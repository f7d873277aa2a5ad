"""Reading a benchmark file into a `BenchmarkSpec`; all errors are reported at once.

.. code-block:: xml

    <benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml" u:algorithm="esm">
      <measures> <euclideanNorm> ... </euclideanNorm> </measures>
      <startOn> <type>service</type> <target>startBench</target> </startOn>
      <stopOn> <type>never</type> </stopOn>
      <function>corners+centroid</function>
      <sceneUpdater> <sceneFogUpdater> ... </sceneFogUpdater> </sceneUpdater>
    </benchmark>

The tables of measures, triggers and updaters are arguments, since plugins add entries to them.
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
from .environment import selection_errors
from .ground_truth import GROUND_TRUTHS, ConstantSpec, GroundTruthSpec
from .measures import MEASURES, MeasureSpec, PathFollowingSpec
from .name_checks import check_function, check_names, check_outcomes
from .plugin_tables import PREFIX
from .spec import BenchmarkSpec
from .sweep_checks import check_levels, warn_endless, warn_overridden, warn_still_water
from .triggers import TRIGGERS, NeverSpec, TriggerSpec
from .updater_settings import check_same_levels, locate_in_benchmark
from .updaters import UPDATERS, NoneSpec, SceneUpdaterSpec
from .warnings import find_short_times, warn_never_started

PLUGIN_HINT = ", nor of a plugin that was given (--plugin FILE.py)"
"""The text after an unknown name that may be a plugin's."""

T = TypeVar("T")


def read_benchmark(
    path: Path | str,
    *,
    measures: Mapping[str, type[MeasureSpec]] = MEASURES,
    triggers: Mapping[str, type[TriggerSpec]] = TRIGGERS,
    updaters: Mapping[str, type[SceneUpdaterSpec]] = UPDATERS,
    timestep: float = TIMESTEP,
) -> BenchmarkSpec:
    """Read a benchmark file.

    Args:
        path: the benchmark file.
        measures: the specs of measures by the names of their elements.
        triggers: the specs of triggers by the names of their types.
        updaters: the specs of scene updaters by the names of their elements.
        timestep: the length of a simulation step [s], unless the file states another.

    Raises:
        BenchmarkError: the file is invalid; the error lists everything that is wrong.
    """
    path = Path(path)
    diagnostics = Diagnostics(path)
    spec = _Reader(diagnostics, measures, triggers, updaters, timestep).read_benchmark(path)
    diagnostics.check(BenchmarkError)
    assert spec is not None
    return spec


def check_benchmark(
    path: Path,
    *,
    is_strict: bool = False,
    measures: Mapping[str, type[MeasureSpec]] = MEASURES,
    triggers: Mapping[str, type[TriggerSpec]] = TRIGGERS,
    updaters: Mapping[str, type[SceneUpdaterSpec]] = UPDATERS,
    timestep: float = TIMESTEP,
) -> tuple[list[Diagnostic], BenchmarkSpec | None]:
    """Return all errors and warnings of a benchmark file, ordered by line, and its spec.

    The spec of a file with errors lacks the invalid parts, or is None.

    Args:
        path: the benchmark file.
        is_strict: also check the order of elements, as the original UWSim does (`element_order`).
        measures: the specs of measures by the names of their elements.
        triggers: the specs of triggers by the names of their types.
        updaters: the specs of scene updaters by the names of their elements.
        timestep: the length of a simulation step [s], unless the file states another.
    """
    diagnostics = Diagnostics(path)
    reader = _Reader(diagnostics, measures, triggers, updaters, timestep)
    try:
        spec = reader.read_benchmark(path, is_strict=is_strict)
    except BenchmarkError as error:
        return list(error.diagnostics), None
    return diagnostics.to_list(), spec


@dataclass(frozen=True)
class _Reader:
    """A reader of one benchmark file; see `check_benchmark` for the fields."""

    diagnostics: Diagnostics
    measures: Mapping[str, type[MeasureSpec]]
    triggers: Mapping[str, type[TriggerSpec]]
    updaters: Mapping[str, type[SceneUpdaterSpec]]
    timestep: float

    def read_benchmark(self, path: Path, *, is_strict: bool = False) -> BenchmarkSpec | None:
        document = parse(path, error=BenchmarkError)
        root = document.root
        check_head(document, "benchmark", self.diagnostics)
        if root.tag != "benchmark":
            return None
        # the original UWSim, whose files have a DOCTYPE, reads numbers with atof.
        self.diagnostics.allows_trailing_text = document.has_doctype
        if is_strict:
            check_order(root, self.diagnostics)
        known_fields: dict[str, object] = {"path": str(path)}
        for tag, field in (("startOn", "start_on"), ("stopOn", "stop_on")):
            if (node := root.find(tag)) is not None:
                known_fields[field] = self.read_trigger(node)
        measures: list[MeasureSpec] = []
        if (node := root.find("measures")) is not None:
            measures = self.read_measures(node)
            known_fields["measures"] = tuple(measures)
        updater: SceneUpdaterSpec | None = None
        if (node := root.find("sceneUpdater")) is not None:
            updater = self.read_updater(node)
            known_fields["scene_updater"] = updater or NoneSpec()
        if updater is not None:
            check_levels(updater, self.diagnostics)
            warn_overridden(updater, self.diagnostics)
            warn_still_water(updater, self.diagnostics)
        known_fields["compatibility"] = self.compatibility(root)
        known_fields["plugin"] = tuple(str(root.get(f"{{{NAMESPACE}}}plugin", "")).split())
        spec = read(BenchmarkSpec, root, self.diagnostics, known_fields=known_fields)
        if spec is not None and updater is not None:
            check_variations(
                spec,
                self.diagnostics,
                find=locate_in_benchmark,
                check_bound=functools.partial(check_same_levels, spec),
            )
        check_names(measures, updater, self.diagnostics)
        check_outcomes(root, measures, self.diagnostics)
        function = None if spec is None else spec.function
        if function is not None:
            check_function(root, function, measures, self.diagnostics)
        self.check_environment(root, spec, measures)
        file_timestep = None if spec is None else spec.timestep
        timestep = self.timestep if file_timestep is None else file_timestep
        for location, message in find_short_times(measures, updater, function, timestep):
            self.diagnostics.error(location, message)
        if spec is not None and updater is not None:
            warn_endless(spec, self.diagnostics)
        if spec is not None and not self.diagnostics.has_errors:
            for location, message in warn_never_started(spec):
                self.diagnostics.warning(location, message)
        return spec

    def check_environment(
        self, root: etree._Element, spec: BenchmarkSpec | None, measures: list[MeasureSpec]
    ) -> None:
        """Report the errors of each ``<u:environment>`` at the lines of its children."""
        nodes = root.findall(f"{{{NAMESPACE}}}environment")
        environments = () if spec is None else spec.environments
        for i, (node, environment) in enumerate(zip(nodes, environments, strict=False)):
            errors = [*environment.errors(measures)]
            if environment.vehicle in [other.vehicle for other in environments[:i]]:
                errors.append(
                    (
                        "vehicle",
                        f"the vehicle {environment.vehicle[:60]!r} has an <u:environment> already",
                    )
                )
            for tag, message in errors:
                child = node.find(tag)
                self.diagnostics.error(node if child is None else child, message)
            if spec is not None and not self.diagnostics.has_errors:
                for message in selection_errors(spec.scene_updater, environment.episode_levels):
                    self.diagnostics.error(node.find("episodeLevels"), message)

    def read_measures(self, parent: etree._Element) -> list[MeasureSpec]:
        """Read the children of ``<measures>``, in the file's order."""
        measures = []
        if parent.find("*") is None:
            self.diagnostics.warning(parent, "<measures> is empty: nothing is measured")
        for node in self.read_children(parent):
            cls = self.measures.get(element_name(node))
            if cls is None:
                self.report_unknown_element(node, parent, self.measures)
            elif (spec := self.read_measure(cls, node)) is not None:
                measures.append(spec)
        return measures

    def read_measure(self, cls: type[MeasureSpec], node: etree._Element) -> MeasureSpec | None:
        spec = read(cls, node, self.diagnostics, known_fields=self.read_manual_fields(cls, node))
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

    def read_manual_fields(self, cls: type, node: etree._Element) -> dict[str, Any]:
        """Read the children whose spec classes depend on the file: triggers, truths, updaters."""
        known_fields: dict[str, Any] = {}
        for field in fields_of(cls):
            child = node.find(field.tag)
            if field.kind != "manual" or child is None:
                continue
            if field.type is TriggerSpec:
                known_fields[field.name] = self.read_trigger(child)
            elif field.type is GroundTruthSpec:
                known_fields[field.name] = self.read_ground_truth(child)
            elif field.type is SceneUpdaterSpec:
                known_fields[field.name] = self.read_updater(child)
        for dataclass_field in dataclasses.fields(cls):
            if "path" in dataclass_field.metadata:
                known_fields[dataclass_field.name] = self.diagnostics.file
        return known_fields

    def read_trigger(self, node: etree._Element) -> TriggerSpec:
        """Read ``<startOn>`` or ``<stopOn>``; ignore children that its type does not use."""
        kinds = node.findall("type")
        kind = read_text(kinds[0], self.diagnostics) if kinds else ""
        if not kind:
            self.diagnostics.error(
                node, f"<{node.tag}> lacks <type>: one of {', '.join(self.triggers)}"
            )
        elif kind not in self.triggers:
            suggestion = did_you_mean(kind, self.triggers) if len(kind) < 80 else ""
            hint = PLUGIN_HINT * (kind.startswith(PREFIX) and not suggestion)
            types = ", ".join(self.triggers) + hint
            message = f"<type> is {kind[:60]!r}; expected one of {types}.{suggestion}"
            self.diagnostics.error(kinds[0], message)
        cls = self.triggers.get(kind)
        if len(kinds) > 1:
            self.diagnostics.error(kinds[1], f"<type> is given twice in <{node.tag}>; expected one")
        for child in kinds:
            _remove(child)
        if cls is None:
            return NeverSpec()
        tags = {field.tag for field in fields_of(cls)}
        for child in list(node.iterchildren("target", "position")):
            if child.tag not in tags:
                self.diagnostics.warning(child, f"the type {kind!r} ignores <{child.tag}>")
                _remove(child)
        return read(cls, node, self.diagnostics) or NeverSpec()

    def read_ground_truth(self, node: etree._Element) -> GroundTruthSpec:
        """Read ``<groundTruth>`` into the spec of its type."""
        placeholder = ConstantSpec(values=())
        kind = str(node.attrib.pop("type", "")).strip()
        if not kind and {element_name(child) for child in self.read_children(node)} == {"value"}:
            kind = "constant"
            self.diagnostics.warning(
                node, "<groundTruth> without a type, as in 2013: read as constant"
            )
        cls = GROUND_TRUTHS.get(kind)
        if cls is None:
            suggestion = did_you_mean(kind, GROUND_TRUTHS) if len(kind) < 80 else ""
            message = f"type is {kind[:60]!r}" if kind else "<groundTruth> lacks the attribute type"
            self.diagnostics.error(
                node, f"{message}; expected one of {', '.join(GROUND_TRUTHS)}.{suggestion}"
            )
            return placeholder
        return read(cls, node, self.diagnostics) or placeholder

    def read_updater(self, parent: etree._Element) -> SceneUpdaterSpec | None:
        """Read ``<sceneUpdater>`` with its nested updaters."""
        nodes = self.read_children(parent)
        if not nodes:
            self.diagnostics.error(
                parent, f"<sceneUpdater> is empty; expected one of <{'>, <'.join(UPDATERS)}>"
            )
        for sibling in nodes[1:]:
            self.diagnostics.error(
                sibling,
                f"<{element_name(sibling)}> is a sibling of <{element_name(nodes[0])}> in "
                "<sceneUpdater>; expected one: nest it in a <sceneUpdater> of its own",
            )
        if not nodes:
            return None
        node = nodes[0]
        cls = self.updaters.get(element_name(node))
        if cls is None:
            self.report_unknown_element(node, parent, self.updaters)
            return None
        spec = read(cls, node, self.diagnostics, known_fields=self.read_manual_fields(cls, node))
        errors = [] if spec is None else list(spec.errors())
        for message in errors:
            self.diagnostics.error(error_node(node, message), message)
        return None if errors else spec

    def compatibility(self, root: etree._Element) -> tuple[str, ...]:
        names = tuple(str(root.get(f"{{{NAMESPACE}}}compatibility", "")).replace(",", " ").split())
        known_names = [*COMPATIBILITY, "uwsim"]
        for name in [name for name in names if name not in known_names][:10]:
            self.diagnostics.report_unknown(
                root, f"u:compatibility names {name[:60]!r}", name, known_names
            )
        return names

    def read_children(self, parent: etree._Element) -> list[etree._Element]:
        """Return the children of an element that must have no text and no attributes."""
        for text in (parent.text, *(child.tail for child in parent)):
            if (stray := (text or "").strip()) != "":
                self.diagnostics.error(parent, f"stray text {stray[:60]!r} in <{parent.tag}>")
                break
        for name in parent.attrib:
            self.diagnostics.error(
                parent, f"{str(name)[:60]} is not an attribute of <{parent.tag}>"
            )
        return list(parent.iterchildren("*"))

    def report_unknown_element(
        self, node: etree._Element, parent: etree._Element, known_names: Mapping[str, T]
    ) -> None:
        name = element_name(node)
        tag = str(node.tag)
        message = f"{format_tag(tag)} is not an element of <{parent.tag}>{advice(tag)}"
        if name.startswith(PREFIX):
            message += PLUGIN_HINT
            if (plugin := node.getroottree().getroot().get(f"{{{NAMESPACE}}}plugin")) is not None:
                message += f"; {str(plugin)[:100]!r} of u:plugin is not run by `uwsim check`"
        self.diagnostics.report_unknown(node, message, name, known_names)


def _remove(node: etree._Element) -> None:
    parent = node.getparent()
    if parent is not None:
        parent.remove(node)
