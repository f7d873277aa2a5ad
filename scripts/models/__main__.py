"""Write the bundled models: ``python -m scripts.models [FILE ...]``."""

from __future__ import annotations

import sys

from uwsim.assets.bundled_models import FOLDER

from .build import FILES, build_file

MEGABYTE = 1e6


def write_files(names: list[str]) -> None:
    """Write files by their names, all by default, and print the size of each [MB]."""
    if unknown_names := sorted(set(names) - set(FILES)):
        sys.exit(f"unknown: {', '.join(unknown_names)}; expected some of {', '.join(FILES)}")
    for name in names or FILES:
        path = FOLDER / f"{name}.glb"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(build_file(name))
        print(f"{path.stat().st_size / MEGABYTE:6.2f} MB  {name}")
    total = sum(path.stat().st_size for path in FOLDER.rglob("*.glb"))
    print(f"{total / MEGABYTE:6.2f} MB in all")


if __name__ == "__main__":
    write_files(sys.argv[1:])
