"""Reader of SDF files: worlds and models, with the files that they include."""

from __future__ import annotations

import dataclasses
import re
from dataclasses import dataclass, field
from pathlib import Path

from lxml import etree

from ...errors import BadSetting, FileError, SceneError
from ...schema import Diagnostics, parse, quote
from ..report import ImportReport
from .joints import read_frame, read_joint
from .links import read_link, read_sensor
from .search import MAX_FILES, MAX_INCLUDE_DEPTH, ModelSearch
from .spec import SEPARATOR, Joint, Link, Model, Plugin, SdfWorld
from .values import (
    Source,
    attribute_of,
    child_of,
    children_of,
    flag_of,
    number_of,
    pose_of,
    tag_of,
    text_of,
)

MAX_LINKS = 5000
"""The greatest number of links in an import."""
MAX_MODELS = 2000
"""The greatest number of models in an import."""
IGNORED_MODEL_TAGS = {
    "allow_auto_disable", "enable_wind", "pose", "self_collide", "static", "link", "joint",
    "frame", "model", "include", "plugin",
}  # fmt: skip
IGNORED_WORLD_TAGS = {
    "model", "include", "plugin", "frame", "physics", "gravity", "spherical_coordinates", "gui",
    "scene", "state", "magnetic_field", "atmosphere", "audio",
}  # fmt: skip
UNREAD_TAGS = {
    "light": "lights of Gazebo are not imported; the sky lights the scene",
    "actor": "actors are not imported",
    "road": "roads are not imported",
    "population": "populations are not imported",
    "wind": "wind has no effect under water",
    "joint": "joints between models of a world are not imported",
}
FUEL_REASON = "files are not downloaded; download the model, and add its folder with --data-path"
_KIND = re.compile(r"^(lib)?(gz-sim\d*-|ignition-gazebo\d*-)?(?P<kind>.*?)(-system)?(\.so)?$")


@dataclass(kw_only=True)
class SdfReader:
    """The reader of a file and its included files.

    Args:
        search: the search of included models.
        report: receives the elements that are not imported.
    """

    search: ModelSearch
    report: ImportReport
    n_files: int = 0
    n_links: int = 0
    n_models: int = 0
    _chain: list[Path] = field(default_factory=list)

    def read(self, path: Path) -> SdfWorld:
        """Read a file of SDF.

        Raises:
            SceneError: the file, or one that it includes, is invalid; it has every mistake in it.
        """
        root, source = self._open(path)
        worlds, models = children_of(root, "world"), children_of(root, "model")
        if not worlds and not models:
            source.diagnostics.error(root, "it has no <world> and no <model>")
            source.diagnostics.check(SceneError)
        for world in worlds[1:]:
            label = f"world {attribute_of(world, 'name')}"
            source.leave_out(world, label, "only the first world of a file is imported")
        self._chain.append(path.resolve())
        result = self._read_world(worlds[0] if worlds else root, path, source, is_model=not worlds)
        self._chain.pop()
        source.diagnostics.check(SceneError)
        return result

    def _open(self, path: Path) -> tuple[etree._Element, Source]:
        self.n_files += 1
        if self.n_files > MAX_FILES:
            raise BadSetting(f"{path}: more than {MAX_FILES} files are included, the limit.")
        document = parse(path, error=SceneError, allows_undeclared_prefixes=True)
        diagnostics = Diagnostics(path)
        if tag_of(document.root) != "sdf":
            diagnostics.error(
                document.root, f"the root element is <{tag_of(document.root)}>; expected <sdf>"
            )
            diagnostics.check(SceneError)
        words = attribute_of(document.root, "version").split(".")
        numbers = [int(word) for word in words if word.isdecimal()]
        version = (numbers[0], numbers[1]) if len(numbers) >= 2 else (1, 12)
        return document.root, Source(str(path), diagnostics, self.report, version)

    def _read_world(
        self, node: etree._Element, path: Path, source: Source, *, is_model: bool
    ) -> SdfWorld:
        models: list[Model] = []
        for child in node:
            tag = tag_of(child)
            if tag == "model":
                models.append(self._read_model(child, path, source))
            elif tag == "include":
                if (model := self._read_include(child, path, source)) is not None:
                    models.append(model)
            elif tag and tag not in IGNORED_WORLD_TAGS:
                label = f"{tag} {attribute_of(child, 'name')}".strip()
                reason = UNREAD_TAGS.get(tag, f"<{tag}> of a world has no counterpart")
                source.leave_out(child, label, reason)
        plugins = [] if is_model else children_of(node, "plugin")
        return SdfWorld(
            name=attribute_of(node, "name") or path.stem,
            models=tuple(models),
            frames=tuple(read_frame(child, source) for child in children_of(node, "frame")),
            plugins=tuple(_read_plugin(child, source) for child in plugins),
            is_model=is_model,
            earth_origin=_read_earth_origin(child_of(node, "spherical_coordinates"), source),
        )

    def _read_model(self, node: etree._Element, path: Path, source: Source) -> Model:
        self.n_models += 1
        if self.n_models > MAX_MODELS:
            raise BadSetting(f"{path}: more than {MAX_MODELS} models, the limit.")
        for child in node:
            if (tag := tag_of(child)) and tag not in IGNORED_MODEL_TAGS:
                label = f"{tag} {attribute_of(child, 'name')}".strip()
                source.leave_out(child, label, f"<{tag}> of a model has no counterpart")
        links = self._read_links(node, path, source)
        joints = [read_joint(child, source) for child in children_of(node, "joint")]
        inner_models = [
            self._read_model(child, path, source) for child in children_of(node, "model")
        ]
        included_models = [
            self._read_include(child, path, source) for child in children_of(node, "include")
        ]
        child_models = [
            *inner_models,
            *(model for model in included_models if model is not None),
        ]
        model = Model(
            name=attribute_of(node, "name"),
            pose=pose_of(node, source),
            placement_frame=attribute_of(node, "placement_frame"),
            canonical_link=attribute_of(node, "canonical_link"),
            is_static=flag_of(node, False, "static"),
            is_merged=False,
            links=links,
            joints=tuple(joint for joint in joints if joint is not None),
            frames=tuple(read_frame(child, source) for child in children_of(node, "frame")),
            models=tuple(child_models),
            plugins=tuple(_read_plugin(child, source) for child in children_of(node, "plugin")),
            file=path,
            place=source.place(node),
        )
        _check_names(model, source)
        return model

    def _read_links(self, node: etree._Element, path: Path, source: Source) -> tuple[Link, ...]:
        nodes = children_of(node, "link")
        self.n_links += len(nodes)
        if self.n_links > MAX_LINKS:
            raise BadSetting(f"{path}: more than {MAX_LINKS} links, the limit.")
        return tuple(read_link(child, path, source) for child in nodes)

    def _read_include(self, node: etree._Element, path: Path, source: Source) -> Model | None:
        """Read an included model with the changes of the ``<include>``; None if it is not found."""
        uri = text_of(node, "uri")
        label = f"include {uri}"
        file = self.search.find(uri, path) if uri else None
        if file is None:
            is_remote = "://" in uri and not uri.startswith(("model://", "package://", "file://"))
            reason = "there is no such model; --data-path adds a folder of models"
            source.leave_out(node, label, FUEL_REASON if is_remote else reason)
            return None
        if len(self._chain) >= MAX_INCLUDE_DEPTH or file.resolve() in self._chain:
            source.diagnostics.error(node, f"<include> {quote(uri)} includes itself, or is nested "
                                     f"more than {MAX_INCLUDE_DEPTH} deep")  # fmt: skip
            return None
        self._chain.append(file.resolve())
        try:
            model = self._read_model_file(file)
        except FileError as error:
            for diagnostic in error.diagnostics:
                source.diagnostics.extend([diagnostic])
            return None
        finally:
            self._chain.pop()
        if model is None:
            source.leave_out(node, label, f"{file} has no <model>")
            return None
        return self._change_included(model, node, source)

    def _read_model_file(self, file: Path) -> Model | None:
        root, source = self._open(file)
        nodes = children_of(root, "model")
        model = self._read_model(nodes[0], file, source) if nodes else None
        source.diagnostics.check(SceneError)
        return model

    def _change_included(self, model: Model, node: etree._Element, source: Source) -> Model:
        """Return an included model with the name, pose, plug-ins and sensors of the include."""
        pose = child_of(node, "pose")
        is_moved = pose is not None and (
            (pose.text or "").strip() or attribute_of(pose, "relative_to")
        )
        plugins = tuple(_read_plugin(child, source) for child in children_of(node, "plugin"))
        changed_model = dataclasses.replace(
            model,
            name=text_of(node, "name") or model.name,
            pose=pose_of(node, source) if is_moved else model.pose,
            placement_frame=text_of(node, "placement_frame") or model.placement_frame,
            is_static=flag_of(node, model.is_static, "static"),
            is_merged=attribute_of(node, "merge").lower() in ("true", "1"),
            plugins=(*model.plugins, *plugins),
        )
        return _add_parameters(changed_model, child_of(node, "params"), source)


def _add_parameters(model: Model, node: etree._Element | None, source: Source) -> Model:
    """Add the sensors of ``<experimental:params>`` to the links that they name."""
    links = {link.name: link for link in model.links}
    for child in () if node is None else node:
        link = attribute_of(child, "element_id")
        tag, action = tag_of(child), attribute_of(child, "action")
        if (tag, action) == ("sensor", "add") and link in links:
            sensors = (*links[link].sensors, read_sensor(child, source))
            links[link] = dataclasses.replace(links[link], sensors=sensors)
        elif tag:
            label = f"params {tag} {attribute_of(child, 'name')}".strip()
            source.leave_out(child, label, "only sensors that are added to a link are imported")
    return dataclasses.replace(model, links=tuple(links.values()))


def _read_plugin(node: etree._Element, source: Source) -> Plugin:
    file, name = attribute_of(node, "filename"), attribute_of(node, "name")
    match = _KIND.match(file.rpartition("/")[2])
    return Plugin(
        kind=(match["kind"] if match else file).lower(),
        name=name or file,
        node=node,
        place=source.place(node),
    )


def _check_names(model: Model, source: Source) -> None:
    """Report names that are reason or that two elements of a model share."""
    names: set[str] = set()
    parts: list[Link | Joint | Model] = [*model.links, *model.joints]
    parts += [child for child in model.models if not child.is_merged]
    for part in parts:
        line = part.place.line if part.place.file == source.file else None
        if not part.name:
            source.diagnostics.error(line, f"a part of model {model.name!r} has no name")
        elif part.name in names:
            source.diagnostics.error(
                line, f"two parts of model {model.name!r} are called {part.name!r}"
            )
        elif SEPARATOR in part.name or part.name.startswith("__"):
            source.diagnostics.error(line, f"the name {part.name!r} is reserved in SDF")
        names.add(part.name)


def _read_earth_origin(node: etree._Element | None, source: Source) -> tuple[float, float] | None:
    if node is None:
        return None
    latitude = number_of(node, 0.0, source, "latitude_deg")
    longitude = number_of(node, 0.0, source, "longitude_deg")
    if not abs(latitude) <= 90.0 or not abs(longitude) <= 360.0:
        source.diagnostics.error(
            node, f"latitude {latitude:g} and longitude {longitude:g} are no place on Earth"
        )
        return None
    if number_of(node, 0.0, source, "heading_deg"):
        source.report.add(
            "changed", "spherical_coordinates", source.place(node),
            "its heading is not imported: x is east, y is north",
        )  # fmt: skip
    return latitude, longitude
