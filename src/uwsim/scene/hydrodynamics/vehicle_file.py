"""Reader of a vehicle's hydrodynamics file, which complements its URDF.

.. code-block:: xml

    <hydrodynamics name="my_rov">
      <source>tow tank, 2026</source>
      <body link="base_link">
        <mass>13.5</mass>
        <addedMass>6.36 7.12 18.68 0.189 0.135 0.222</addedMass>
        <linearDamping>13.7 0 33 0 0.8 0</linearDamping>
        <quadraticDamping>141 217 190 1.19 0.47 1.5</quadraticDamping>
        <volume>0.0134</volume>
        <centreOfBuoyancy> <x>0</x> <y>0</y> <z>-0.01</z> </centreOfBuoyancy>
      </body>
      <thruster name="surge" link="base_link">
        <position> <x>0</x> <y>0</y> <z>0</z> </position>
        <direction> <x>1</x> <y>0</y> <z>0</z> </direction>
        <forward>0 40</forward>
        <timeConstant>0.1</timeConstant>
        <radius>0.04</radius> <efficiency>0.35</efficiency>
        <advance>0 0.45 0.66 0.18</advance>
      </thruster>
      <fin name="rudder" link="base_link">
        <position> <x>-0.6</x> <y>0</y> <z>0</z> </position>
        <area>0.01</area> <aspectRatio>2.2</aspectRatio> <rate>0.5</rate>
      </fin>
      <joint name="elbow"> <efficiency>0.5</efficiency> <copperLoss>0.02</copperLoss> </joint>
    </hydrodynamics>

A file contains one hydrodynamics set, which refers to links of the URDF by name. ``<include>`` adds
the bodies, thrusters and fins of another file, such as an arm that several vehicles carry. The
page docs/your-own-vehicle.md describes every element.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from lxml import etree

from ...assets.find import roots
from ...base.files.input_files import is_inside
from ...errors import FileError, choices
from ...schema import Diagnostics, Spec, line_of, parse, quote, read
from .checks import body_errors, thruster_errors
from .fin_checks import fin_errors
from .power_checks import power_errors
from .spec import (
    N_LENGTHS,
    BodyHydrodynamics,
    FinSpec,
    JointDrive,
    ThrusterSpec,
    VehicleHydrodynamics,
)
from .vehicle_sets import bundled_folder


class VehicleError(FileError):
    """An error for an invalid hydrodynamics file."""


@dataclass
class _Parts:
    """The contents of a hydrodynamics file and its included files, as far as they are read."""

    links: list[str] | None
    """The names of the robot's links; None to accept any."""
    movable_joints: list[str] | None
    """The names of the robot's movable joints; None to accept any."""
    bodies: list[BodyHydrodynamics] = field(default_factory=list)
    thrusters: list[ThrusterSpec] = field(default_factory=list)
    fins: list[FinSpec] = field(default_factory=list)
    joints: list[JointDrive] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)

    def add_body(self, body: BodyHydrodynamics, diagnostics: Diagnostics) -> None:
        if any(body.link == other.link for other in self.bodies):
            diagnostics.error(body, f"two <body> for the link {body.link!r}; only one is allowed")
        _check_name(body, "link", body.link, self.links, diagnostics)
        for message in body_errors(body):
            diagnostics.error(body, message)
        self.bodies.append(body)

    def add_thruster(self, thruster: ThrusterSpec, diagnostics: Diagnostics) -> None:
        if not thruster.name.strip():
            diagnostics.error(thruster, "a thruster has no name")
        if any(thruster.name == other.name for other in self.thrusters):
            diagnostics.error(thruster, f"two thrusters are called {thruster.name!r}")
        _check_name(thruster, "link", thruster.link, self.links, diagnostics)
        for message in thruster_errors(thruster) or power_errors(thruster):
            diagnostics.error(thruster, message)
        self.thrusters.append(thruster)

    def add_fin(self, fin: FinSpec, diagnostics: Diagnostics) -> None:
        if not fin.name.strip():
            diagnostics.error(fin, "a fin has no name")
        if any(fin.name == other.name for other in self.fins):
            diagnostics.error(fin, f"two fins are called {fin.name!r}")
        _check_name(fin, "link", fin.link, self.links, diagnostics)
        for message in fin_errors(fin):
            diagnostics.error(fin, message)
        self.fins.append(fin)

    def add_joint(self, joint: JointDrive, diagnostics: Diagnostics) -> None:
        if any(joint.name == other.name for other in self.joints):
            message = f"two <joint> for the joint {joint.name!r}; only one is allowed"
            diagnostics.error(joint, message)
        _check_name(joint, "movable joint", joint.name, self.movable_joints, diagnostics)
        self.joints.append(joint)


def set_errors(vehicle: VehicleHydrodynamics) -> list[str]:
    """Return the errors in the numbers of a hydrodynamics set that was changed after reading."""
    errors = [message for body in vehicle.bodies for message in body_errors(body)]
    for thruster in vehicle.thrusters:
        errors += thruster_errors(thruster) or power_errors(thruster)
    return [*errors, *(message for fin in vehicle.fins for message in fin_errors(fin))]


def read_vehicle(
    path: Path | str, links: Iterable[str] | None = None, joints: Iterable[str] | None = None
) -> VehicleHydrodynamics:
    """Read a hydrodynamics file.

    Args:
        path: the file.
        links: the names of the robot's links; None to accept any.
        joints: the names of the robot's movable joints; None to accept any.

    Raises:
        VehicleError: the file is invalid; the error has every mistake in it.
    """
    path = Path(path)
    diagnostics = Diagnostics(path)
    vehicle = read_vehicle_into(path, links, diagnostics, joints)
    diagnostics.check(VehicleError)
    assert vehicle is not None
    return vehicle


def read_vehicle_into(
    path: Path,
    links: Iterable[str] | None,
    diagnostics: Diagnostics,
    joints: Iterable[str] | None = None,
) -> VehicleHydrodynamics | None:
    """Read a hydrodynamics file; return None and add errors to ``diagnostics`` if it is invalid."""
    parts = _Parts(None if links is None else list(links), None if joints is None else list(joints))
    head = _read_file(path, diagnostics, parts, ())
    if head is None or diagnostics.has_errors:
        return None
    if head.name != path.stem:
        diagnostics.warning(
            head,
            f"the set is called {quote(head.name)}; scenes find it by the name of its file, "
            f"{quote(path.stem)}",
        )
    return dataclasses.replace(
        head,
        source=" ".join(head.source.split()),
        include=(),
        bodies=tuple(parts.bodies),
        thrusters=tuple(parts.thrusters),
        fins=tuple(parts.fins),
        joints=tuple(parts.joints),
        files=tuple(parts.files),
    )


def _read_file(
    path: Path, diagnostics: Diagnostics, parts: _Parts, including_files: tuple[Path, ...]
) -> VehicleHydrodynamics | None:
    root = parse(path, error=VehicleError).root
    parts.files.append(path)
    if root.tag != "hydrodynamics":
        diagnostics.error(
            root, f"the root element is <{str(root.tag)[:60]}>; expected <hydrodynamics>"
        )
        return None
    head = read(VehicleHydrodynamics, root, diagnostics)
    if head is None:
        return None
    if not head.name.strip():
        diagnostics.error(root, "the set has no name")
    for body in head.bodies:
        parts.add_body(_with_drag_law(body, root), diagnostics)
    for thruster in head.thrusters:
        parts.add_thruster(thruster, diagnostics)
    for fin in head.fins:
        parts.add_fin(fin, diagnostics)
    for joint in head.joints:
        parts.add_joint(joint, diagnostics)
    for name, node in zip(head.include, root.findall("include"), strict=False):
        _include(name, path, node, diagnostics, parts, including_files)
    return head


def _include(
    name: str,
    path: Path,
    node: etree._Element,
    diagnostics: Diagnostics,
    parts: _Parts,
    including_files: tuple[Path, ...],
) -> None:
    file_diagnostics = Diagnostics(path)
    try:
        files = [folder / name for folder in (path.parent, bundled_folder())]
        included_file = next(filter(Path.is_file, files), files[0])
        file_diagnostics = Diagnostics(included_file)
        resolved_path = included_file.resolve()
        if not is_inside(included_file, [*roots(named_by=path), bundled_folder()]):
            diagnostics.error(node, f"<include> {quote(name)} is outside the folders of its file")
            return
        if resolved_path in (file.resolve() for file in (*including_files, path)):
            diagnostics.error(node, f"<include> {quote(name)} includes itself")
            return
        if resolved_path in (file.resolve() for file in parts.files):
            diagnostics.error(node, f"<include> {quote(name)}: it is included already")
            return
        _read_file(included_file, file_diagnostics, parts, (*including_files, path))
    except (OSError, ValueError) as error:
        diagnostics.error(
            node, f"<include> {quote(name)}: {getattr(error, 'strerror', None) or error}"
        )
        return
    except VehicleError as error:
        for diagnostic in error.diagnostics:
            diagnostics.error(node, f"<include> {quote(name)}: {diagnostic.message}")
        return
    for diagnostic in file_diagnostics.to_list():
        report = diagnostics.error if diagnostic.severity == "error" else diagnostics.warning
        report(node, f"in {name}, line {diagnostic.line}: {diagnostic.message}")


def _check_name(
    spec: Spec, kind: str, name: str, names: list[str] | None, diagnostics: Diagnostics
) -> None:
    if names is not None and name not in names:
        diagnostics.error(
            spec,
            f"the robot has no {kind} {name!r}."
            + choices(name, names, heading=f"{kind.split()[-1].capitalize()}s"),
        )


def _with_drag_law(body: BodyHydrodynamics, root: etree._Element) -> BodyHydrodynamics:
    """Return the body with the default drag law for its numbers, if its element has none."""
    line = line_of(body)
    nodes = (node for node in root.iterfind("body") if int(str(node.sourceline)) == line)
    node = next(node for node in nodes if node.get("link", "").strip() == body.link)
    text = {name: (node.findtext(name) or "").strip() for name in ("dragLaw", "shape")}
    coefficients = body.quadratic_damping[:3]
    is_equal = len(body.quadratic_damping) == 6 and len(set(coefficients)) == 1
    is_isotropic = is_equal and coefficients[0] > 0.0
    if is_isotropic and not text["dragLaw"]:
        body = dataclasses.replace(body, drag_law="speed")
    if (
        text["shape"] and text["shape"] not in N_LENGTHS
    ):  # an unknown shape, which is reported elsewhere
        body = dataclasses.replace(body, size=())
    return body
