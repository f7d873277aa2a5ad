"""Curves on the page: names of phases, ranges of shares, gaps, and colours that differ."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from uwsim.viewer.document import document
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob, make_pack

pytestmark = pytest.mark.slow
PHASES = ["look", "take", "lift"]


@pytest.fixture
def page(tab: Any, tmp_path: Path) -> Any:
    """A replay of a scene in which nothing moves, with eight curves of 4 s."""
    blob = Blob()
    with uwsim.load("currents-scene") as simulation:
        head = scene_head(simulation, "page", blob)
    times = blob.add(np.arange(0, 40000, 5000, dtype="<u4"))  # [0.1 ms]
    nan = np.nan
    rows = {
        "phase": ([0, 1, 1, 2, 2, 3, 3, 3], "1", PHASES, False),
        "share": ([0.2, 0.3, nan, nan, 0.4, 0.4, nan, 0.3], "1", [], True),
        **{f"other {k}": ([k, 2, 3, 4, 5, 6, 7, 8], "m", [], False) for k in range(6)},
    }
    curves = [
        {"name": name, "unit": unit, "names": names, "is_share": is_share, "times": times}
        | {"values": blob.add(np.array(values, "<f4"))}
        for name, (values, unit, names, is_share) in rows.items()
    ]
    level = {"label": "one", "status": "ok", "why": None, "start": 0.0, "end": 4.0, "values": {}}
    trial = {"title": "page", "motion": None, "levels": [level], "curves": curves, "poses": {}}
    path = tmp_path / "page.html"
    path.write_text(
        document("page", make_pack({**head, "trials": [trial]}, blob)), encoding="utf-8"
    )
    tab.goto(path.as_uri())
    tab.wait_for_function("window.uwsim !== undefined")
    return tab


def shown(page: Any, time: float) -> dict[str, str]:
    """Name of each curve, and what is written beside it at a time."""
    page.evaluate("time => uwsim.seek(time)", time)
    lines = page.locator("#curves figcaption").all()
    return {
        line.locator("button").inner_text(): line.locator("output").inner_text() for line in lines
    }


def test_a_phase_has_its_name_and_what_was_not_measured_a_dash(page: Any) -> None:
    wanted = {0.1: "none yet", 0.6: "look", 1.6: "take", 3.9: "lift"}
    assert {time: shown(page, time)["phase"] for time in wanted} == wanted
    assert [shown(page, time)["share"] for time in (0.1, 1.1, 2.1)] == ["0.2000", "–", "0.4000"]


def test_a_share_goes_from_0_to_1_and_curves_have_colours_of_their_own(page: Any) -> None:
    charts = "uwsim.page.curves.charts"
    ranges = page.evaluate(f"{charts}.map(({{ plot: {{ scales: {{ y }} }} }}) => [y.min, y.max])")
    assert ranges[:2] == [[0, 3], [0, 1]]
    assert all(low < 1 and high > 8 for low, high in ranges[2:3])
    colours = page.evaluate(f"{charts}.map(({{ plot }}) => String(plot.series[1]._stroke))")
    assert len(set(colours)) == 8
    alone = f"{charts}[1].plot.series[1].points.filter({charts}[1].plot, 1)"
    assert page.evaluate(alone) == [7]  # between gaps no line leads to it


def test_a_curve_is_folded_by_a_click_on_its_name(page: Any) -> None:
    plot = page.locator("#curves figure").first.locator(".uplot")
    assert plot.is_visible()
    page.locator("#curves figcaption button").first.click()
    assert not plot.is_visible()
