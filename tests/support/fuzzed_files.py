"""Damage input files at random: scenes, robots, benchmarks, meshes, images, currents, scores."""

from __future__ import annotations

import functools
import io
import random
import re
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import trimesh
from PIL import Image
from scipy.io import netcdf_file

from uwsim.assets.loaders import read_model
from uwsim.base.expression import ScoreError, parse
from uwsim.checks import check_file
from uwsim.currents import read_grid
from uwsim.errors import UwsimError

TESTS = Path(__file__).parents[1]
DATA = TESTS.parent / "src" / "uwsim" / "data"
WORDS = (
    "", "x", "nan", "inf", "-1", "0", "1e400", "-1e39", "5e-324", "9" * 20, "true", "../x", "/",
    "/dev/zero", "M_PI", "1 2 3", "\x1b[31m", "\u202e", "é", "a" * 400, "%s", "1:2",
)  # fmt: skip
SIGNS = ("(", ")", ",", "?", ":", "^", "-", "*", "/", "&&", "||", "<", "==", " ", ".", "1e")
NAMES = ("a", "b", "_pi", "max", "min", "sin", "sqrt", "rint", "if", "ln", "2", "0.5", "1e300")
SCORE = "a > 0 ? 100 - 2*b : max(a, b, 0)^2 + sqrt(sin(_pi))"
MAX_LINE_LENGTH = 5000
"""The longest line of an error [characters]; `clean_text` cuts longer lines."""


@functools.cache
def sources(kind: str) -> tuple[Path, ...]:
    """Return the intact files of a kind."""
    return {
        "scene": (TESTS / "scene" / "every-element.xml", *sorted(DATA.glob("scenes/*.xml"))),
        "robot": (DATA / "scenes" / "g500ARM5.urdf", *sorted(DATA.glob("vehicles/*.urdf"))),
        "benchmark": (
            TESTS / "benchmark" / "every-element.xml",
            *sorted(DATA.glob("benchmarks/*.xml")),
            *sorted((TESTS / "benchmark" / "files").glob("*.xml")),
        ),
    }[kind]


def check_damaged_xml(kind: str, folder: Path, chance: random.Random) -> None:
    """Damage a file of XML, by its elements or its bytes, and check it."""
    text = chance.choice(sources(kind)).read_text()
    path = folder / "damaged.xml"
    if chance.random() < 0.2:
        path.write_bytes(damage_bytes(text.encode(), chance))
    else:
        path.write_text(damage_xml(text, chance))
    for error in check_file(path):
        is_score = "<function>" in error.message  # its second line marks the position
        assert is_score or "\n" not in str(error), f"two lines: {str(error)[:200]!r}"
        assert len(str(error)) < MAX_LINE_LENGTH, f"{len(str(error))} characters"


def damage_xml(text: str, chance: random.Random) -> str:
    """Change values, or remove, repeat or exchange elements."""
    for _ in range(chance.choice((1, 1, 2, 5))):
        values = list(re.finditer(r">([^<>\n]+)<|\"([^\"<>]*)\"", text))
        elements = list(re.finditer(r"<(\w[\w:]*)[^<>]*>[^<>]*</\1>|<\w[^<>]*/>", text))
        if chance.random() < 0.6 and values:
            value_match = chance.choice(values)
            start, end = value_match.span(1 if value_match[1] is not None else 2)
            replacement = chance.choice((*WORDS, value_match[0][1:-1] * 2))
        elif elements:
            start, end = chance.choice(elements).span()
            replacement = chance.choice(("", text[start:end] * 2, chance.choice(elements)[0]))
        else:
            return text
        text = text[:start] + replacement + text[end:]
    return text


def damage_bytes(data: bytes, chance: random.Random) -> bytes:
    """Change, remove, repeat or add bytes."""
    for _ in range(chance.choice((1, 1, 2, 8))):
        k = chance.randrange(len(data) + 1)
        n = chance.choice((1, 1, 2, 4, 16))
        match chance.randrange(5):
            case 0:
                data = data[:k] + chance.randbytes(n) + data[k + n :]
            case 1:
                data = data[:k] + data[k + n :]
            case 2:
                data = data[:k]
            case 3:
                data = data[:k] + bytes(chance.choice((b"\0", b"\xff"))) * n + data[k + n :]
            case _:
                data = data[:k] + data[k : k + n] * 2 + data[k + n :]
    return data


@functools.cache
def meshes() -> dict[str, bytes]:
    """Return an intact mesh file of each format."""
    box = trimesh.creation.box()
    box.visual.vertex_colors = np.full((8, 4), 200, np.uint8)
    exports = {
        kind: box.export(file_type=kind) for kind in ("stl", "stl_ascii", "glb", "ply", "dae")
    }
    ascii_stl = exports.pop("stl_ascii")
    contents = {
        kind: data.encode() if isinstance(data, str) else bytes(data)
        for kind, data in exports.items()
    }
    return {**contents, "stl ascii": ascii_stl.encode()}


def read_damaged_mesh(folder: Path, chance: random.Random) -> None:
    """Damage a mesh and read it."""
    kind, data = chance.choice(sorted(meshes().items()))
    path = folder / f"damaged.{kind.partition(' ')[0]}"
    path.write_bytes(damage_bytes(data, chance))
    read_model(path, name="m")


@functools.cache
def images() -> dict[str, bytes]:
    """Return an intact image file of each format."""
    contents = {}
    for kind in ("PNG", "JPEG", "BMP", "GIF", "TIFF", "TGA", "WEBP", "PPM"):
        with io.BytesIO() as stream:
            Image.radial_gradient("L").resize((9, 7)).convert("RGB").save(stream, kind)
            contents[kind] = stream.getvalue()
    return contents


def read_damaged_image(folder: Path, chance: random.Random) -> None:
    """Damage the image of a mesh and read the mesh."""
    _, data = chance.choice(sorted(images().items()))
    (folder / "p.png").write_bytes(damage_bytes(data, chance))
    (folder / "m.mtl").write_text("newmtl m\nmap_Kd p.png\n")
    (folder / "m.obj").write_text(
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
    )
    read_model(folder / "m.obj", name="m")


@functools.cache
def currents() -> dict[str, bytes]:
    """Return a table and a NetCDF file of a current."""
    stream = io.BytesIO()
    with netcdf_file(stream, "w") as file:
        for name in ("t", "x"):
            file.createDimension(name, 3)
            file.createVariable(name, "f8", (name,))[:] = np.arange(3.0)
            file.variables[name].units = {"t": "s", "x": "m"}[name]
        for name in ("u", "v"):
            file.createVariable(name, "i2", ("t", "x"))[:] = np.ones((3, 3))
            file.variables[name].units = "cm/s"
            file.variables[name].scale_factor = 0.5
        file.flush()
        netcdf_data = stream.getvalue()
    table = "x,y,t,u,v\n" + "".join(f"{i},{j},0,0.1,-0.2\n" for i in range(3) for j in range(2))
    return {"csv": table.encode(), "nc": netcdf_data}


def read_damaged_current(folder: Path, chance: random.Random) -> None:
    """Damage the data of a current and read it."""
    kind, data = chance.choice(sorted(currents().items()))
    path = folder / f"damaged.{kind}"
    path.write_bytes(damage_bytes(data, chance))
    read_grid(path)


def evaluate_damaged_score(folder: Path, chance: random.Random) -> None:
    """Damage a score formula or generate one at random, and evaluate it."""
    if chance.random() < 0.5:
        k = chance.randrange(len(SCORE))
        text = SCORE[:k] + chance.choice((*SIGNS, *WORDS)) + SCORE[k + chance.randrange(4) :]
    else:
        text = "".join(chance.choice((*SIGNS, *NAMES)) for _ in range(chance.randrange(1, 40)))
    values = {"a": chance.choice((0.0, -1.0, 1e308)), "b": chance.choice((0.0, 2.0, -1e308))}
    parse(text, values).score(values)


TARGETS: dict[str, Callable[[Path, random.Random], None]] = {
    "benchmark": functools.partial(check_damaged_xml, "benchmark"),
    "current": read_damaged_current,
    "expression": evaluate_damaged_score,
    "image": read_damaged_image,
    "mesh": read_damaged_mesh,
    "robot": functools.partial(check_damaged_xml, "robot"),
    "scene": functools.partial(check_damaged_xml, "scene"),
}


def trial(folder: Path, target: str, seed: int) -> str | None:
    """Damage and read a file; return a description of the failure."""
    chance = random.Random(f"{target} {seed}")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            TARGETS[target](folder, chance)
    except UwsimError as error:
        is_one = "\n" not in str(error) or hasattr(error, "diagnostics")
        return None if is_one or isinstance(error, ScoreError) else f"two lines: {error}"
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return None
