"""Draw the images of docs/scenes.md again: each bundled scene, or those named, from its <camera>.

python examples/scene_images.py docs/images/scenes [SCENE ...]
"""

from __future__ import annotations

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

from uwsim.assets.bundled import bundled_files
from uwsim.cli import main as uwsim

SIZE, SUPERSAMPLING = (800, 450), 2  # of the images [px], factor of each axis
EXPOSURES = {
    "dredging-scene": 2.0,
    "relay-scene": 4.0,
    "remus-scene": 1.8,
    "rendezvous-scene": 4.0,
    "shipwreck-scene": 1.8,
    "stereo-scene": 2.0,
    "structured-light-scene": 1.8,
    "survey-scene": 2.0,
    "two-vehicles-scene": 5.0,
}
"""The exposures of images that are dark with the automatic one, which is that of a white board."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the images of the bundled scenes.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("scene", nargs="*", default=list(bundled_files("scenes")))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    size = f"{SUPERSAMPLING * SIZE[0]}x{SUPERSAMPLING * SIZE[1]}"
    for name in options.scene:
        with TemporaryDirectory() as scratch:
            image_file = Path(scratch) / "scene.png"
            words = ["render", name, "--view", "viewer", "--size", size, "-o", str(image_file)]
            if name in EXPOSURES:
                words += ["--set", f"oceanState.water.exposure={EXPOSURES[name]}"]
            if uwsim(words) != 0:
                raise SystemExit(f"{name} was not drawn")
            image = Image.open(image_file).convert("RGB").resize(SIZE, Image.Resampling.LANCZOS)
        image.save(options.folder / f"{name}.jpg", quality=88, optimize=True)


if __name__ == "__main__":
    main()
