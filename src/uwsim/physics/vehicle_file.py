"""A vehicle's hydrodynamics file: what a URDF cannot say about a robot in water.

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
      </thruster>
      <joint name="elbow"> <efficiency>0.5</efficiency> <copperLoss>0.02</copperLoss> </joint>
    </hydrodynamics>

One file is one named set, keyed by the links of the URDF. ``<include>`` takes the bodies and
thrusters of another file in (an arm that several vehicles carry). docs/your-own-vehicle.md has
every element.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

from lxml import etree

from ..assets.find import roots
from ..errors import FileError, UnknownName, choices
from ..files.input_files import is_inside
from ..schema import LARGEST, Faults, cut, number, parse, read
from .actuation.power import power_faults
from .hydrodynamics.faults import body_faults, thruster_faults
from .hydrodynamics.spec import (
    SIZES,
    BodyHydrodynamics,
    JointDrive,
    Numbers,
    ThrusterSpec,
    VehicleHydrodynamics,
)
from .vehicle_elements import BodyElement, HydrodynamicsElement, ThrusterElement

MAX_NUMBERS = 36
"""In one element: a full matrix."""
HEAD = 65536
"""Bytes of a file in which its root element begins."""


class VehicleError(FileError):
    """A hydrodynamics file is wrong."""


@dataclass
class _Parts:
    links: list[str] | None
    """What the robot has; None to take any."""
    movable: list[str] | None
    """Joints that it can move; None to take any."""
    bodies: list[BodyHydrodynamics] = field(default_factory=list)
    thrusters: list[ThrusterSpec] = field(default_factory=list)
    joints: list[JointDrive] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)


def vehicle_sets() -> dict[str, Path]:
    """The bundled sets: name -> file."""
    return {path.stem: path for path in sorted(_bundled().glob("*.xml"))}


def find_vehicle(name: str, beside: Path | None = None) -> Path:
    """Find the hydrodynamics file of a set: ``name.xml`` beside the scene, or a bundled one.

    Raises:
        UnknownName: there is none.
    """
    if beside is not None and name == Path(name).name:
        own = beside.parent / f"{name}.xml"
        with suppress(OSError, ValueError):  # no name of a file
            if own.is_file():
                return own
    known = vehicle_sets()
    if name not in known:
        raise UnknownName("hydrodynamics set", name, [*_own_sets(beside), *known])
    return known[name]


def _bundled() -> Path:
    """The folder of the bundled hydrodynamics files; ``<include>`` searches it last."""
    return Path(str(files("uwsim"))) / "data" / "vehicles"


def _own_sets(beside: Path | None) -> list[str]:
    """Names of the hydrodynamics files that lie beside a scene."""
    found = []
    with suppress(OSError):
        found_here = [] if beside is None else sorted(beside.parent.glob("*.xml"))
        for path in filter(Path.is_file, found_here):
            with path.open("rb") as file:
                if b"<hydrodynamics" in file.read(HEAD):
                    found.append(path.stem)
    return found


def read_vehicle(
    path: Path | str, links: Iterable[str] | None = None, joints: Iterable[str] | None = None
) -> VehicleHydrodynamics:
    """Read a hydrodynamics file.

    Args:
        path: the file.
        links: names of the robot's links; None to take any.
        joints: names of the joints that it can move; None to take any.

    Raises:
        VehicleError: with every fault of the file.
    """
    path = Path(path)
    faults = Faults(path)
    vehicle = read_vehicle_into(path, links, faults, joints)
    faults.check(VehicleError)
    assert vehicle is not None
    return vehicle


def read_vehicle_into(
    path: Path,
    links: Iterable[str] | None,
    faults: Faults,
    joints: Iterable[str] | None = None,
) -> VehicleHydrodynamics | None:
    """Read a hydrodynamics file into ``faults``; None when it has some."""
    parts = _Parts(None if links is None else list(links), None if joints is None else list(joints))
    head = _read_file(path, faults, parts, ())
    if head is None or faults.any:
        return None
    if head.name != path.stem:
        faults.notice(
            faults.node_of(head),
            f"the set is called {cut(head.name)}; scenes find it by the name of its file, "
            f"{cut(path.stem)}",
        )
    return VehicleHydrodynamics(
        name=head.name,
        source=" ".join(head.source.split()),
        density=head.density,
        bodies=tuple(parts.bodies),
        thrusters=tuple(parts.thrusters),
        joints=tuple(parts.joints),
        files=tuple(parts.files),
    )


def _read_file(
    path: Path, faults: Faults, parts: _Parts, above: tuple[Path, ...]
) -> HydrodynamicsElement | None:
    root = parse(path, error=VehicleError).root
    parts.files.append(path)
    if root.tag != "hydrodynamics":
        faults.add(root, f"the root element is <{str(root.tag)[:60]}>; expected <hydrodynamics>")
        return None
    head = read(HydrodynamicsElement, root, faults)
    if head is None:
        return None
    if not head.name.strip():
        faults.add(root, "the set has no name")
    for one in head.body:
        node = faults.node_of(one)
        assert node is not None
        if any(one.link == known.link for known in parts.bodies):
            faults.add(node, f"two <body> for the link {one.link!r}; only one may be")
        _check_name(node, "link", one.link, parts.links, faults)
        parts.bodies.append(_body(one, node, faults))
    for propeller in head.thruster:
        node = faults.node_of(propeller)
        assert node is not None
        if not propeller.name.strip():
            faults.add(node, "a thruster has no name")
        if any(propeller.name == known.name for known in parts.thrusters):
            faults.add(node, f"two thrusters are called {propeller.name!r}")
        _check_name(node, "link", propeller.link, parts.links, faults)
        parts.thrusters.append(_thruster(propeller, node, faults))
    for joint in head.joint:
        node = faults.node_of(joint)
        assert node is not None
        if any(joint.name == known.name for known in parts.joints):
            faults.add(node, f"two <joint> for the joint {joint.name!r}; only one may be")
        _check_name(node, "movable joint", joint.name, parts.movable, faults)
        parts.joints.append(
            JointDrive(name=joint.name, efficiency=joint.efficiency, copper_loss=joint.copper_loss)
        )
    for name, node in zip(head.include, root.findall("include"), strict=False):
        _include(name, path, node, faults, parts, above)
    return head


def _include(
    name: str,
    path: Path,
    node: etree._Element,
    faults: Faults,
    parts: _Parts,
    above: tuple[Path, ...],
) -> None:
    """Read another hydrodynamics file, beside the first or bundled, into ``parts``."""
    inner = Faults(path)
    try:
        other = next(
            (place / name for place in (path.parent, _bundled()) if (place / name).is_file()),
            path.parent / name,
        )
        inner = Faults(other)
        whole = other.resolve()
        if not is_inside(other, [*roots(beside=path), _bundled()]):
            faults.add(node, f"<include> {cut(name)} is outside the folders of its file")
            return
        if whole in (one.resolve() for one in (*above, path)):
            faults.add(node, f"<include> {cut(name)} includes itself")
            return
        if whole in (one.resolve() for one in parts.files):
            faults.add(node, f"<include> {cut(name)}: it is included already")
            return
        _read_file(other, inner, parts, (*above, path))
    except (OSError, ValueError) as error:
        faults.add(node, f"<include> {cut(name)}: {getattr(error, 'strerror', None) or error}")
        return
    except VehicleError as error:
        for fault in error.faults:
            faults.add(node, f"<include> {cut(name)}: {fault.message}")
        return
    for fault in inner.all():
        say = faults.add if fault.severity == "fault" else faults.notice
        say(node, f"in {name}, line {fault.line}: {fault.message}")


def _check_name(
    node: etree._Element, what: str, name: str, known: list[str] | None, faults: Faults
) -> None:
    if known is not None and name not in known:
        faults.add(
            node,
            f"the robot has no {what} {name!r}."
            + choices(name, known, called=f"{what.split()[-1].capitalize()}s"),
        )


def _body(one: BodyElement, node: etree._Element, faults: Faults) -> BodyHydrodynamics:
    zeros = (0.0,) * 6
    shape = node.find("shape")
    has_known_shape = shape is None or (shape.text or "").strip() in SIZES  # others are said
    quadratic = _numbers(one.quadratic_damping, "quadraticDamping", node, faults) or zeros
    is_isotropic = len(quadratic) == 6 and len(set(quadratic[:3])) == 1 and quadratic[0] > 0.0
    found = BodyHydrodynamics(
        link=one.link,
        reference=one.reference,
        added_mass=_numbers(one.added_mass, "addedMass", node, faults) or zeros,
        linear_damping=_numbers(one.linear_damping, "linearDamping", node, faults) or zeros,
        quadratic_damping=quadratic,
        drag_law=one.drag_law or ("speed" if is_isotropic else "axes"),
        volume=one.volume,
        centre_of_buoyancy=one.centre_of_buoyancy,
        shape=one.shape,
        size=_numbers(one.size, "size", node, faults) if has_known_shape else (),
        mass=one.mass,
        centre_of_mass=one.centre_of_mass,
        inertia=_numbers(one.inertia, "inertia", node, faults) or None,
        implicitness=one.implicitness,
    )
    for message in body_faults(found):
        faults.add(node, message)
    return found


def _thruster(one: ThrusterElement, node: etree._Element, faults: Faults) -> ThrusterSpec:
    found = ThrusterSpec(
        name=one.name,
        link=one.link,
        position=one.position,
        direction=one.direction,
        forward=_numbers(one.forward, "forward", node, faults) or ThrusterSpec.forward,
        backward=_numbers(one.backward, "backward", node, faults) or None,
        dead_zone=one.dead_zone,
        limits=_pair(one.limits, "limits", node, faults) or (-1.0, 1.0),
        saturation=_pair(one.saturation, "saturation", node, faults),
        time_constant=one.time_constant,
        torque=one.torque,
        radius=one.radius,
        efficiency=ThrusterSpec.efficiency if one.efficiency is None else one.efficiency,
        power=_numbers(one.power, "power", node, faults) or None,
        power_backward=_numbers(one.power_backward, "powerBackward", node, faults) or None,
    )
    if one.efficiency is not None and one.power:
        faults.add(
            node,
            f"thruster {one.name!r}: <efficiency> and <power> both say what it draws; give one",
        )
    for message in thruster_faults(found) or power_faults(found):
        faults.add(node, message)
    return found


def _pair(text: str, name: str, node: etree._Element, faults: Faults) -> tuple[float, float] | None:
    values = _numbers(text, name, node, faults)
    if values and len(values) != 2:
        faults.add(_child(node, name), f"<{name}> has {len(values)} numbers; expected 2")
        return None
    return (values[0], values[1]) if values else None


def _numbers(text: str, name: str, node: etree._Element, faults: Faults) -> Numbers:
    """The numbers of an element, separated by blanks; commas may stand between them."""
    words = text.replace(",", " ").split()
    if text and not words:
        faults.add(_child(node, name), f"<{name}> holds {text[:40]!r}; expected numbers")
    if len(words) > MAX_NUMBERS:
        said = f"<{name}> holds {len(words)} numbers; expected {MAX_NUMBERS} at most"
        faults.add(_child(node, name), said)
        return ()
    values = [number(word) for word in words]
    if None in values:
        wrong = words[values.index(None)]
        faults.add(_child(node, name), f"<{name}> holds {wrong[:40]!r}; expected numbers")
        return ()
    for word, value in zip(words, values, strict=False):
        if value is not None and abs(value) > LARGEST:
            message = f"<{name}> holds {word[:40]!r}; no quantity is beyond {LARGEST:g}"
            faults.add(_child(node, name), message)
            return ()
    return tuple(value for value in values if value is not None)


def _child(node: etree._Element, name: str) -> etree._Element:
    child = node.find(name)
    return node if child is None else child
