from __future__ import annotations

import re
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.packs import decode_text, read_array, unpack
from tests.support.short_benchmark import run, write_benchmark
from tests.support.short_trial import DATA
from tests.support.stored_rows import stored_row
from uwsim.errors import ResultError
from uwsim.results.log import load_log
from uwsim.results.motion import TrackLevel
from uwsim.viewer.document import FOLDER, document
from uwsim.viewer.pack import Blob
from uwsim.viewer.recorded import RecordedLevel, _level
from uwsim.viewer.replay import Replay, _curve, _curve_names


@pytest.fixture(scope="module")
def page(stored: Path) -> str:
    return Replay(stored).html()


def pack_of(page: str) -> tuple[dict[str, Any], bytes]:
    found = re.search(r'id="pack">([^<]+)<', page)
    assert found is not None
    return unpack(decode_text(found[1]))


@pytest.mark.slow
def test_the_same_result_gives_the_same_bytes(stored: Path, page: str, tmp_path: Path) -> None:
    saved = Replay(stored).save(tmp_path / "a.html")
    assert saved.read_bytes() == page.encode()
    assert saved.stat().st_size < 2_000_000


def test_levels_and_curves_are_those_of_the_result(stored: Path, page: str) -> None:
    head, data = pack_of(page)
    (trial,) = head["trials"]
    assert [level["values"] for level in trial["levels"]] == [{"fog": f} for f in (0.0, 0.4, 0.8)]
    assert trial["levels"][0]["status"] == "ok"
    curve, *further = trial["curves"]
    corners = ("nw", "ne", "se", "sw")
    names = [f"corners.{corner}_{axis}" for corner in corners for axis in "xy"]
    assert [each["name"] for each in further] == names
    assert (curve["name"], curve["unit"]) == ("corners", "px")
    values = read_array(curve["values"], data)
    logged = [sample[2] for sample in load_log(stored / "measure-corners.csv").samples]
    found = values[~(values != values)].tolist()
    assert found == pytest.approx([v for v in logged if v is not None], rel=1e-6)


def level(began: float, row: dict[str, Any]) -> RecordedLevel:
    values = {"fog": began}
    return _level(
        stored_row(**row), TrackLevel(values=values, start_time=began, duration=1.0, status="ok")
    )


def test_curves_have_the_further_columns_of_a_log_with_names_of_phases_and_ranges() -> None:
    header = ["value", "height [m]", "load [1]", "phase [1]", "nothing [N]"]
    row = {
        "measures": {"held": (1.0, "1"), "depth": (3.0, "m")},
        "logs": {
            "held": [[0.0, 0.0, 0.1, 1.5, 0.0, None], [0.5, 1.0, None, 0.5, 2.0, None]],
            "depth": [[0.0, 0.2], [0.5, 0.4]],
        },
        "log_headers": {"held": header, "depth": ["value"]},
        "details": {
            "held.phase": [2.0, "1"],
            "held.time.look": [0.4, "s"],
            "held.time.take": [0.1, "s"],
        },
    }
    blob = Blob()
    levels = [level(0.0, row), level(5.0, row)]
    curves = {name: _curve(name, levels, blob) for name in _curve_names(levels)}
    assert list(curves) == ["held", "held.height", "held.load", "held.phase", "depth"]
    assert curves["held.phase"]["names"] == ["look", "take"]
    assert [name for name, each in curves.items() if each["is_share"]] == ["held"]
    assert [each["names"] for name, each in curves.items() if name != "held.phase"] == [[]] * 4
    height = read_array(curves["held.height"]["values"], blob.data)
    assert height.tolist() == pytest.approx([0.1, np.nan, np.nan, 0.1, np.nan], nan_ok=True)


def test_the_page_loads_nothing_and_may_not(page: str) -> None:
    assert "connect-src 'none'" in page
    assert not re.search(r"""(src|href)=["'](?!data:)""", page.split('id="pack"')[0])
    assert page.count("</script>") == 2


def test_a_title_is_text(tmp_path: Path) -> None:
    page = document('</title><script>alert("{script}")</script>', None)
    assert "<script>alert" not in page
    assert "{script}" in page
    assert "connect-src 'self'" in page


def test_a_notebook_shows_it_in_a_frame(stored: Path) -> None:
    shown = Replay(stored)._repr_html_()
    assert shown.startswith('<iframe srcdoc="&lt;!doctype html&gt;')
    assert pack_of(unescape(shown))[0]["uwsim_head"] == 1


def test_another_suffix_is_refused(stored: Path, tmp_path: Path) -> None:
    with pytest.raises(ResultError, match=r"\.html"):
        Replay(stored).save(tmp_path / "x.pdf")


def test_a_result_without_motion_says_so(stored: Path, tmp_path: Path) -> None:
    (tmp_path / "result.json").write_bytes((stored / "result.json").read_bytes())
    with pytest.raises(ResultError, match="motion"):
        Replay(tmp_path)


def test_the_script_is_small_and_names_its_licences() -> None:
    script = FOLDER / "page.js"
    assert script.stat().st_size < 700_000
    assert "The MIT License" in script.read_text(encoding="utf-8")


@pytest.mark.slow
def test_what_a_seed_puts_elsewhere_is_there(tmp_path: Path) -> None:
    scene = (DATA / "scenes" / "visibility-scene.xml").read_text(encoding="utf-8")
    drawn = "<u:path>object[blackbox].position.x</u:path><u:low>1.9</u:low><u:high>2.1</u:high>"
    vary = f'<u:vary xmlns:u="urn:uwsim:1"><u:uniform>{drawn}</u:uniform></u:vary></UWSimScene>'
    (tmp_path / "visibility-scene.xml").write_text(scene.replace("</UWSimScene>", vary))
    benchmark = write_benchmark(tmp_path, "0.1")
    run(benchmark, tmp_path / "result", repeat=2)
    head, _ = unpack(Replay(tmp_path / "result").pack())
    at_first = next(body["pose"] for body in head["bodies"] if body["name"] == "blackbox")
    first, second = head["trials"]
    assert first["poses"] == {}
    assert list(second["poses"]) == ["blackbox"]
    assert second["poses"]["blackbox"] != at_first
    labels = [[level["label"] for level in trial["levels"]] for trial in head["trials"]]
    seeds = [label.partition(": ")[0] for trial in labels for label in trial]
    assert list(dict.fromkeys(seeds)) == ["seed 1", "seed 2"]
    assert head["title"].endswith(", 2 seeds")
