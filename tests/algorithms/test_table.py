from __future__ import annotations

import re
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from tests.algorithms.textures import Texture, rectangle
from uwsim.algorithms import ALGORITHMS, Esm, check_parameters, load_algorithm, summary
from uwsim.bus import Bus
from uwsim.errors import BadSetting
from uwsim.messages import (
    Empty,
    EmptyResponse,
    Float32MultiArray,
    GTpublish,
    Image,
    String,
    image,
)
from uwsim.simulation.nodes.node import InProcessNode

DOCS = Path(__file__).parents[2] / "docs"
QUAD = rectangle(160.0, 120.0, 93.0, 28.0)


def test_the_table_is_in_alphabetical_order_with_a_line_for_each() -> None:
    assert list(ALGORITHMS) == sorted(ALGORITHMS)
    lines = [summary(algorithm) for algorithm in ALGORITHMS.values()]
    assert all(20 < len(line) < 100 and line.endswith(".") for line in lines)
    assert len(set(lines)) == len(lines)


def test_a_bundled_algorithm_is_found_by_its_name() -> None:
    assert load_algorithm("esm") is Esm


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("ems", "Did you mean 'esm'"),
        ("nowhere.to.be.found:Thing", "cannot be imported: ModuleNotFoundError"),
        ("uwsim.algorithms:Ems", "no class 'Ems'. Did you mean 'Esm'"),
        ("uwsim.algorithms:summary", "no class 'summary'"),
        ("uwsim.algorithms.tracker:Estimate", r"no method start\(node\)"),
        ("uwsim.algorithms:", "no class ''"),
        (":Esm", "cannot be imported"),
    ],
)
def test_an_algorithm_that_is_not_there_is_a_clean_error(name: str, message: str) -> None:
    with pytest.raises(BadSetting, match=message):
        load_algorithm(name)


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("import sys; sys.exit(0)", "SystemExit: 0"),
        ("raise SystemExit", "SystemExit"),
        ("raise BaseException('x')", "BaseException: x"),
        ("raise ValueError('a\\nb')", "ValueError: a b"),
    ],
)
def test_a_module_that_leaves_when_it_is_imported_is_a_clean_error(
    line: str, why: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A script without ``if __name__ == ...`` ended the benchmark without a word, with 0."""
    (tmp_path / "leaves.py").write_text(f"{line}\nclass A: pass\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "leaves", raising=False)
    with pytest.raises(BadSetting) as raised:
        load_algorithm("leaves:A")
    assert f"the module 'leaves' cannot be imported: {why}. (" in str(raised.value)


def test_parameters_can_be_checked_before_anything_runs() -> None:
    check_parameters(Esm, {"levels": 2, "latency_s": 0.1})
    with pytest.raises(BadSetting, match="Did you mean 'levels'"):
        check_parameters(Esm, {"level": 2})

    class ThirdParty:
        def start(self, node: object) -> None: ...

    check_parameters(ThirdParty, {"whatever": 1.0})


def test_every_algorithm_is_described_in_the_documentation() -> None:
    text = (DOCS / "algorithms.md").read_text()
    for name, algorithm in ALGORITHMS.items():
        assert f"`{name}`" in text
        for parameter in algorithm.PARAMETERS:
            assert f"`{parameter}`" in text


def test_the_third_party_algorithm_of_the_documentation_works(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (DOCS / "your-own-algorithm.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    (tmp_path / "brightest_third_party.py").write_text(blocks[0])
    monkeypatch.syspath_prepend(tmp_path)
    node = FakeNode()
    load_algorithm("brightest_third_party:Brightest")().start(node)
    pixels = np.zeros((240, 320, 3), np.uint8)
    node.show(pixels)
    assert node.calls == ["startBench"]
    node.auto_init(QUAD)
    pixels = pixels.copy()
    pixels[100, 150] = 255
    node.show(pixels)
    assert node.statuses == ["tracking"]
    assert node.corners[-1].mean(axis=0) == pytest.approx([150, 100])
    assert node.centroids[-1] == pytest.approx([150, 100])


def test_on_the_real_bus_an_estimate_comes_in_the_step_of_its_image() -> None:
    bus = Bus()
    corners = bus.inbox("cornersTopic", Float32MultiArray)
    status = bus.inbox("algorithmStatus", String)
    show = bus.publisher("/uwsim/camera1", Image)
    started = []
    bus.services.serve("startBench", Empty, lambda _: started.append(bus.step) or EmptyResponse())
    random = np.random.Generator(np.random.Philox(0))
    node = InProcessNode(bus, name="esm", timestep=0.002, rng=random, parameters={})
    node.run(Esm())
    pixels = np.rint(Texture().image()).astype(np.uint8)
    for step in (0, 17, 34):
        bus.step = step
        show(image(pixels, time=step * 0.002))
        bus.deliver()
        if step == 0:
            bus.services.call("autoInit", GTpublish(QUAD.astype(np.float32).reshape(8)))
            bus.deliver()
    assert node.error is None
    assert started == [0]
    assert [m.data for m in status.take()] == ["tracking"]
    assert corners.last_step == 34
    estimates = corners.take()
    assert len(estimates) == 2
    assert estimates[0].data == pytest.approx(QUAD.reshape(8), abs=0.01)
