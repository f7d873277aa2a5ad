"""Generate the message classes of ``src/uwsim/messages``: a module for each package.

The types of ROS are defined by the texts that rosbags ships, those of other packages by the
``.msg`` and ``.srv`` files in a folder of ``messages``. In such a file, the comment above the first
field is the docstring of the class, and a comment behind a field is the field's docstring. The
defaults are those of ROS: 0, False, an empty text or list, arrays of zeros, or the value in the
file, as in ``uint8 result 1``.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from graphlib import TopologicalSorter
from pathlib import Path
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

ROS: dict[str, dict[str, str]] = {
    "std_msgs": {
        "builtin_interfaces/Time": "A time since the start of the simulation.",
        "Header": "The time and the frame of a message.",
        "Bool": "A truth value.",
        "Float64": "A number.",
        "String": "A text.",
        "MultiArrayDimension": "One dimension of an array.",
        "MultiArrayLayout": "The layout of an array.",
        "Float32MultiArray": "An array of 32-bit floating-point numbers.",
        "Float64MultiArray": "An array of 64-bit floating-point numbers.",
        "UInt8MultiArray": "An array of bytes.",
        "ColorRGBA": "A colour and its opacity [0..1].",
        "builtin_interfaces/Duration": "A length of time.",
    },
    "geometry_msgs": {
        "Point": "A position [m].",
        "PointStamped": "A position with its time and frame.",
        "Vector3": "A vector; the message that contains it gives the unit and the frame.",
        "Quaternion": "A rotation; the identity by default (w is 1).",
        "Pose": "A position and an orientation.",
        "PoseStamped": "A pose with its time and frame.",
        "PoseWithCovariance": "A pose and its 6x6 covariance, by rows.",
        "Twist": "Linear [m/s] and angular [rad/s] velocity.",
        "TwistStamped": "A twist with its time and frame.",
        "TwistWithCovariance": "A twist and its 6x6 covariance, by rows.",
        "Wrench": "Force [N] and torque [N m].",
        "WrenchStamped": "A wrench with its time and frame.",
        "Transform": "The pose of one frame in another: the translation [m] and the rotation.",
        "TransformStamped": "The pose of a child frame in the frame of the header, with its time.",
    },
    "sensor_msgs": {
        "Image": "An image as the bytes of its pixels, row 0 at the top.",
        "RegionOfInterest": "A part of an image [px].",
        "CameraInfo": (
            "The calibration of a camera: distortion d, intrinsics k, rectification r, projection "
            "p."
        ),
        "JointState": "Names, positions [rad or m], velocities and efforts of joints.",
        "BatteryState": (
            "Voltage [V], current [A] (negative: discharging), charge [A h] and share left [0..1]."
        ),
        "Range": "The distance to the nearest object in a cone [m].",
        "LaserScan": "Distances [m] along rays in a plane, at equal steps of angle [rad].",
        "PointField": "The name, offset and type of a field of each point.",
        "PointCloud2": "Points as bytes, which `fields` describes.",
        "CompressedImage": "An image as the bytes of a PNG or JPEG file.",
        "Imu": (
            "Attitude, angular velocity [rad/s], specific force [m/s2]; 3x3 covariances by rows."
        ),
        "NavSatStatus": "The status of a satellite receiver: whether it has a fix.",
        "NavSatFix": (
            "Latitude and longitude [deg], altitude [m], and their 3x3 covariance east, north, up "
            "[m2]."
        ),
    },
    "nav_msgs": {
        "Odometry": "Pose and velocity of a vehicle.",
        "Path": "A sequence of poses, the path of a vehicle.",
    },
    "tf2_msgs": {"TFMessage": "Transforms between frames."},
    "visualization_msgs": {
        "MeshFile": "The content of a mesh file.",
        "UVCoordinate": "A position in a texture [0..1].",
        "Marker": (
            "A shape in viewers: `ns` and `id` identify it; type, pose, scale [m], colour define "
            "it."
        ),
        "MarkerArray": "Several markers.",
    },
    "simulation_interfaces": {
        "geometry_msgs/Accel": "Linear [m/s^2] and angular [rad/s^2] acceleration."
    },
}
"""The docstrings of the ROS types of each module; a type may name another package."""
MODULES = {"marine_acoustic_msgs": "sonar", "underwater_sensor_msgs": "underwater"}
"""The module of each package, where it has another name."""
DEFAULTS = {"geometry_msgs/msg/Quaternion": {"w": "1.0"}}
"""The defaults of fields in ROS 2's texts, which rosbags does not store."""
SERVICES = ("simulation_interfaces",)
"""The packages whose services are generated, too; the others' are in ``services.py``."""
SCALARS = {"bool": ("bool", "False"), "string": ("str", '""'), "float": ("float", "0.0")}
"""The annotation and default of each field type without its bits; others are integers."""
DTYPES = {"bool": "bool_", "byte": "uint8", "char": "uint8"}
"""The numpy type of each field type, where the two differ."""
WIDTH = 100
LINE = re.compile(r"\S+\s+(?P<name>\w+)(?:\s+(?P<default>[^=\s#]+))?\s*(?:#\s*(?P<doc>.*))?")
"""A field in a text: type, name, perhaps a default and a comment."""


@dataclass(frozen=True, kw_only=True)
class Definition:
    """The definition of a type, from which a class is generated."""

    name: str
    """The name in ROS 2, as ``std_msgs/msg/Header``."""
    doc: str
    """The docstring of the class."""
    constants: Sequence[tuple[str, str, Any]]
    """The constants: name, type and value."""
    fields: Sequence[tuple[str, Any]]
    """The fields: name, and rosbags' description of the type."""
    defaults: Mapping[str, str]
    """The defaults of fields that differ from those of their types."""
    docs: Mapping[str, str]
    """The docstrings of fields."""

    @property
    def class_name(self) -> str:
        """The name of the class."""
        base = self.name.rpartition("/")[2]
        return base.removesuffix("_Request").replace("_Response", "Response")


def modules(folder: Path) -> dict[str, str]:
    """Return the text of every generated module of ``messages`` by its name.

    Raises:
        ValueError: a text has no comment above its fields, or a field has an unknown type.
    """
    folder_packages = {path.parts[-3] for path in folder.glob("*/msg/*.msg")}
    packages = {
        package: [
            *(_ros_definition(package, name, doc) for name, doc in ROS.get(package, {}).items()),
            *_sort_by_dependency(_folder_definitions(folder / package, package)),
        ]
        for package in (*ROS, *sorted(folder_packages - ROS.keys()))
    }
    module_of = {
        definition.name: MODULES.get(package, package)
        for package, types in packages.items()
        for definition in types
    }
    return {
        MODULES.get(package, package): _module(package, types, module_of)
        for package, types in packages.items()
    }


def _ros_definition(package: str, name: str, doc: str) -> Definition:
    full_name = f"{package}/{name}" if "/" not in name else name
    full_name = full_name.replace("/", "/msg/")
    constants, fields = get_typestore(Stores.ROS2_JAZZY).fielddefs[full_name]
    defaults = DEFAULTS.get(full_name, {})
    return Definition(
        name=full_name, doc=doc, constants=constants, fields=fields, defaults=defaults, docs={}
    )


def _folder_definitions(folder: Path, package: str) -> Iterator[Definition]:
    for path in sorted(folder.glob("msg/*.msg")):
        yield _parse_definition(
            f"{package}/msg/{path.stem}", path.read_text(encoding="utf-8"), path
        )
    for path in sorted(folder.glob("srv/*.srv")) if package in SERVICES else ():
        request, response = re.split(r"^---\n", path.read_text(encoding="utf-8"), flags=re.M)
        purpose = f"The request of ``{path.stem}``: "
        yield _parse_definition(
            f"{package}/srv/{path.stem}_Request", request, path, purpose=purpose
        )
        response = f"# The response of ``{path.stem}``.\n{response}"
        yield _parse_definition(f"{package}/srv/{path.stem}_Response", response, path)


def _parse_definition(name: str, text: str, path: Path, *, purpose: str = "") -> Definition:
    comment = re.match(r"(#.*\n)*", text)
    doc = re.sub(r"^# ?", "", comment[0] if comment else "", flags=re.M).strip()
    if not doc:
        raise ValueError(f"{path}:1: expected a comment, which is the docstring of the class")
    if purpose:
        doc = f"{purpose}{doc[0].lower()}{doc[1:]}"
    ((constants, fields),) = get_types_from_msg(text, name).values()
    names = {field for field, _ in fields}
    lines = [match for match in map(LINE.fullmatch, text.splitlines()) if match]
    return Definition(
        name=name,
        doc=doc,
        constants=constants,
        fields=fields,
        defaults={line["name"]: line["default"] for line in lines if line["default"]},
        docs={line["name"]: line["doc"] for line in lines if line["doc"] and line["name"] in names},
    )


def _sort_by_dependency(types: Iterable[Definition]) -> list[Definition]:
    """Sort the types of a package by name, those that others contain first."""
    by_name = {definition.name: definition for definition in types}
    order = TopologicalSorter(
        {
            name: sorted(_contained_types(definition) & by_name.keys())
            for name, definition in by_name.items()
        }
    )
    return [by_name[name] for name in order.static_order()]


def _contained_types(definition: Definition) -> set[str]:
    """Return the names of the types in a type."""
    type_names = set()
    for _, (kind, element) in definition.fields:
        if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
            kind, element = element[0]
        if kind == Nodetype.NAME:
            type_names.add(element)
    return type_names


def _module(package: str, types: list[Definition], module_of: Mapping[str, str]) -> str:
    """Return the text of the module of a package."""
    body = "".join(f"\n\n{_class(definition)}" for definition in types)
    arrays = sorted(set(re.findall(r"=(_[A-Z]\w+)\n? *\)", body)))
    contained_types = {name for definition in types for name in _contained_types(definition)}
    if unknown_types := sorted(contained_types - module_of.keys()):
        raise ValueError(f"{package}: uwsim.messages has no {', '.join(unknown_types)}")
    imports: dict[str, list[str]] = {}
    for name in sorted(contained_types - {definition.name for definition in types}):
        imports.setdefault(module_of[name], []).append(name.rpartition("/")[2])
    parts = [
        f'"""Messages of {package}, generated by scripts/messages (see `uwsim.messages`)."""\n',
        "from __future__ import annotations\n",
        f"from dataclasses import dataclass{', field' if 'field(' in body else ''}\n"
        + ("from functools import partial\n" if arrays else "")
        + f"from typing import {'Any, ' if arrays else ''}ClassVar\n",
        "import numpy as np\n" if arrays else "",
        "".join(
            f"from .{module} import {', '.join(sorted(names, key=_import_order))}\n"
            for module, names in sorted(imports.items())
        ),
        "".join(_factory(name) for name in arrays),
    ]
    return "\n".join(part for part in parts if part) + body


def _import_order(name: str) -> tuple[bool, str]:
    """Return the place of a name in an import: ruff sorts those without small letters first."""
    return not name.isupper(), name


def _factory(name: str) -> str:
    """Return the text of a factory of arrays: ``_FLOAT64_9`` for nine zeros."""
    dtype, _, length = name[1:].lower().rpartition("_")
    return f"{name}: Any = partial(np.zeros, {length}, np.{dtype})\n"


def _class(definition: Definition) -> str:
    """Return the text of a class."""
    is_long = "\n" in definition.doc
    text = f'"""{definition.doc}{chr(10) if is_long else ""}"""\n\n'
    for name, _, value in definition.constants:
        text += f"{name}: ClassVar[{type(value).__name__}] = {value!r}\n"
    for name, kind in definition.fields:
        annotation, default = _field(definition.name, kind)
        default = definition.defaults.get(name, default)
        line = f"{name}: {annotation} = {default}\n"
        if len(line) + 3 > WIDTH:
            line = line.replace("field(", "field(\n    ").removesuffix(")\n") + "\n)\n"
        text += line
        if name in definition.docs:
            text += f'"""{definition.docs[name]}"""\n'
    text += f'__msgtype__: ClassVar[str] = "{definition.name}"\n'
    indented_text = re.sub(r"^(?=.)", "    ", text, flags=re.M)
    return f"@dataclass\nclass {definition.class_name}:\n{indented_text}"


def _field(owner: str, kind: Any) -> tuple[str, str]:
    """Return the annotation and the default of a field."""
    node, element = kind
    if node == Nodetype.NAME:
        name = element.rpartition("/")[2]
        return name, f"field(default_factory={name})"
    if node == Nodetype.BASE:
        return SCALARS.get(element[0].rstrip("0123456789"), ("int", "0"))
    ((node, element), length) = element
    if node == Nodetype.NAME and kind[0] == Nodetype.SEQUENCE:
        return f"list[{element.rpartition('/')[2]}]", "field(default_factory=list)"
    if node == Nodetype.BASE and element[0] == "string" and kind[0] == Nodetype.SEQUENCE:
        return "list[str]", "field(default_factory=list)"
    if node == Nodetype.NAME or element[0] == "string":
        raise ValueError(f"{owner}: an array of {length} texts or messages; expected a list")
    dtype = DTYPES.get(element[0], element[0])
    length = length if kind[0] == Nodetype.ARRAY else 0
    annotation = f"np.ndarray[tuple[int, ...], np.dtype[np.{dtype}]]"
    return annotation, f"field(default_factory=_{dtype.upper()}_{length})"


def main() -> None:
    """Write the modules of a folder that are not up to date."""
    folder = Path(sys.argv[1])
    for module, text in modules(folder).items():
        path = folder / f"{module}.py"
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
            print(path)


if __name__ == "__main__":
    main()
