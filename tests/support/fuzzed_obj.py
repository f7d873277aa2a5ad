"""OBJ files and materials, damaged at random, for a test and for scripts/fuzz."""

from __future__ import annotations

import random
import warnings
from pathlib import Path

from PIL import Image

from uwsim.assets.loaders import read_model
from uwsim.errors import UwsimError

OBJ = """mtllib m.mtl
o a
v 0 0 0
v 1 0 0
v 0 1 0
v 0 1 1
vn 0 0 1
vt 0 0
vt 1 0
vt 0 1
usemtl m
s off
g a
f 1/1/1 2/2/1 3/3/1
f 1//1 2//1 4//1
f 2 3 4
usemtl n
f -1 -2 -3 -4
"""
MATERIALS = """newmtl m
Ka 0.1 0.1 0.1
Kd 0.8 0.8 0.8
Ns 10
d 1
map_Kd p.png
newmtl n
Kd 1 0 0
"""
WORDS = (
    "", "x", "nan", "inf", "-1", "0", "1e400", "1e39", "1/", "/", "//", "1//", "9" * 20, "-99",
    "f", "v", "v 1", "vt", "usemtl", "mtllib", "1.5", "\\", "\0", "#", "é", "f 1 2",
    "f 1 2 3 4 5 6 7", "vn nan nan nan", "newmtl", "Kd", "map_Kd", "p.png", "../x.png", "Kd x y z",
    "Kd 1", "Kd 1 1 1 1 1", "Kd nan 0 0", "Kd 1e400 0 0", "map_Kd -s 1 1 1 p.png",
)  # fmt: skip


def damage_text(text: str, chance: random.Random) -> str:
    """Return the text with a few errors in its lines."""
    for _ in range(chance.choice((1, 1, 2, 4))):
        lines = text.split("\n")
        k = chance.randrange(len(lines))
        words = lines[k].split(" ")
        match chance.randrange(6):
            case 0:
                del lines[k]
            case 1:
                lines.insert(k, chance.choice(WORDS))
            case 2:
                words[chance.randrange(len(words))] = chance.choice(WORDS)
                lines[k] = " ".join(words)
            case 3:
                lines[k] = lines[k][: chance.randrange(len(lines[k]) + 1)]
            case 4:
                lines.insert(k, chance.choice(lines))
            case _:
                del words[chance.randrange(len(words))]
                lines[k] = " ".join(words)
        text = "\n".join(lines)
    return text


def trial(folder: Path, seed: int) -> str | None:
    """Damage an OBJ file or its materials, and read it; return a description of the failure."""
    chance = random.Random(f"obj {seed}")
    is_mesh = chance.random() < 0.6
    file = folder / f"m{seed}.obj"
    file.write_text(damage_text(OBJ, chance) if is_mesh else OBJ)
    (folder / "m.mtl").write_text(MATERIALS if is_mesh else damage_text(MATERIALS, chance))
    if not (folder / "p.png").exists():
        Image.new("RGB", (4, 2)).save(folder / "p.png")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            read_model(file, name="m")
    except UwsimError as error:
        return f"two lines: {error}" if "\n" in str(error) else None
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    finally:
        file.unlink()
    return None
