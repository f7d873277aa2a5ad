"""Run short samples of all parts, and print hashes of their results; see `test_same_bytes`."""

from __future__ import annotations

import hashlib
import json
import os
import re
import tempfile
from collections.abc import Iterator
from importlib import resources
from pathlib import Path

from scripts.models.catalogue import STAND_INS
from tests.sensors.acoustic_world import AcousticWorld, FakeCarrier, plate, sphere
from tests.support.short_benchmark import fingerprint, run, write_benchmark
from uwsim.assets.mesh import ArrayDigest
from uwsim.base.expression import parse
from uwsim.base.geometry import Pose
from uwsim.base.numerics.opencv import deterministic_opencv
from uwsim.sensors.sonar.imaging_sonar import ImagingSonarSpec

TRACKERS = ("ecc", "esm", "orb")
MODELS = (
    "objects/amphora",
    "objects/blackbox_uib",
    "objects/ship",
    "robot/ARM5E/ARM5E_part2",
    "robot/GIRONA500/g500_March11",
    "terrain/CIRS/cirs_trident",
)


def run_hash(folder: Path, benchmark: Path, algorithm: str, level: str) -> str:
    out = folder / f"{benchmark.stem}-{algorithm}"
    run(benchmark, out, algorithm=algorithm, levels=[level])
    return hashlib.sha256(json.dumps(fingerprint(out)).encode()).hexdigest()


def model_hashes() -> Iterator[tuple[str, str]]:
    """Make models anew, and hash them."""
    makers = {name: make for models in STAND_INS.values() for name, make in models.items()}
    with deterministic_opencv():
        for name in MODELS:
            yield name, ArrayDigest(makers[name]()).sha256


def sonar_hash() -> str:
    """Return the hash of a sonar ping over a floor with a ball, and of its image."""
    ball = sphere((5.0, 1.0, -2.5), 0.5, n=24)
    world = AcousticWorld(plate(30.0, -3.0), ball, surface_height=4.0)
    spec = ImagingSonarSpec(name="fls", relative_to="base", beams=64, bins=200, multipath=True)
    sonar = spec.bind(world, FakeCarrier(Pose.from_rpy((0.0, 0.0, 0.0), (0.1, 0.4, 0.2))))  # type: ignore[arg-type]
    image_bytes = sonar.sample(0.0).image.data.tobytes() + sonar.image(0.0).data.tobytes()
    return hashlib.sha256(image_bytes).hexdigest()


def score_hash() -> str:
    text = "exp(a)+ln(b)+a^b+atan2(a,b)+tanh(a)+tan(b)+acos(a)+sinh(b)+log2(b)+asinh(b)"
    expression = parse(text, ["a", "b"])
    values = [expression.evaluate({"a": n / 101.0, "b": 1.0 + n / 7.0}) for n in range(100)]
    return hashlib.sha256(json.dumps(values).encode()).hexdigest()


def compute_hashes(folder: Path) -> dict[str, str]:
    hashes = {**dict(model_hashes()), "scores": score_hash(), "echoes": sonar_hash()}
    fog = write_benchmark(folder, "0.5")
    for tracker in TRACKERS:
        hashes[tracker] = run_hash(folder, fog, tracker, "fog=0.4")
    hashes["p"] = run_hash(folder, short_currents(folder), "p", "current=0.2")
    return hashes


def short_currents(folder: Path) -> Path:
    """Write the currents benchmark with a level of 6 s."""
    full_text = (
        resources.files("uwsim").joinpath("data/benchmarks/currents-figures.xml").read_text()
    )
    short_text = re.sub(r"<interval>\s*[0-9.]+\s*</interval>", "<interval>6</interval>", full_text)
    assert short_text != full_text
    path = folder / "currents.xml"
    path.write_text(short_text)
    return path


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as home:
        os.environ["XDG_CACHE_HOME"] = home
        print(json.dumps(compute_hashes(Path(home))))
