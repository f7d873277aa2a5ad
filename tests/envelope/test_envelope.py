"""What a search found, in words and in a file."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.support.stored_rows import stored_row
from uwsim.envelope import Envelope, Evaluation, Range, SearchSettings, parse_criterion, search
from uwsim.envelope.plot import draw
from uwsim.results.inputs import Inputs
from uwsim.results.run_info import RunInfo

CRITERION = parse_criterion("corners > 5", ["corners"])
Law = Callable[[int, float], float | None]


def envelope(
    law: Law, n: int = 10, *, start: float = 0.0, stop: float = 2.0, status: str = "lost"
) -> Envelope:
    """Search a law: the error of a seed at a level; None is a run that ends in ``status``."""
    made: dict[tuple[int, float], Evaluation] = {}

    def ask(wanted: Any) -> list[bool]:
        for seed, level in wanted:
            error = law(seed, level)
            row = stored_row(
                status="ok" if error is not None else status,
                total=error,
                measures={"corners": [error, "px"]},
            )
            judged = CRITERION.judge(row)
            made[seed, level] = Evaluation(seed=seed, level=level, judgement=judged, row=row)
        return [made[key].judgement.is_broken for key in wanted]

    where = Range(start=start, stop=stop, tolerance=0.02)
    found = search(range(n), where, ask)
    return Envelope(
        settings=SearchSettings(
            parameter="fog", unit="1/m", criterion=CRITERION.text, fixed={}, bounds=where,
            seeds=tuple(range(n)), confidence=0.95,
        ),
        search=found,
        evaluations=tuple(made[key] for key in sorted(made, key=lambda k: k[::-1])),
        inputs=Inputs(benchmark=("b.xml", "sha256:0")),
        run=RunInfo(algorithm="esm"),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("found", "sentence"),
    [
        (
            envelope(lambda seed, level: 5 * level / (1.0 + 0.02 * seed)),
            "fog 1.09 1/m (95 %: 1.01 .. 1.17)",
        ),
        (
            envelope(lambda seed, level: 5 * level, 3),
            "fog 1.00 1/m (3 seeds; a bound of 95 % needs 6)",
        ),
        (
            envelope(lambda seed, level: 0.0),
            "fog: does not break up to 2.00 1/m "
            "(0 of 10 seeds; with 95 % confidence at most 31% of all runs break there)",
        ),
        (
            envelope(lambda seed, level: 9.0),
            "fog: broken already at 0.00 1/m "
            "(10 of 10 seeds; with 95 % confidence at least 69% of all runs break there)",
        ),
        (
            envelope(lambda seed, level: 5 * level if seed < 3 else 0.0),
            "fog: 3 of 10 seeds break up to 2.00 1/m (95 %: 0.99 .. outside the range)",
        ),
        (
            envelope(lambda seed, level: 1.0 / (level + 1e-9), start=2.0, stop=0.1),
            "fog 0.20 1/m (95 %: 0.19 .. 0.22)",
        ),
    ],
)
def test_a_finding_is_one_line(found: Envelope, sentence: str) -> None:
    assert found.sentence == sentence


@pytest.mark.parametrize(
    ("law", "verdict"),
    [
        (lambda seed, level: 5 * level, "breaks"),
        (lambda seed, level: 0.0, "does not break"),
        (lambda seed, level: 9.0, "broken from the start"),
        (lambda seed, level: 9.0 * (seed % 2), "undecided"),
    ],
)
def test_a_finding_has_a_verdict(law: Law, verdict: str) -> None:
    assert envelope(law).as_dict()["verdict"] == verdict


def test_a_criterion_that_goes_back_and_errors_of_an_algorithm_are_warned_of() -> None:
    folded = envelope(lambda seed, level: 9.0 if 0.6 < level < 1.4 else 0.0)
    assert folded.sentence.startswith("fog 0.6")
    (warning,) = folded.warnings
    assert warning == (
        "not monotone: at fog 0.75 10 of 10 seeds break, at 2.00 10 of 10 hold again; "
        "the first breaking point was searched"
    )
    faulty = envelope(lambda seed, level: None if level > 1 else 0.0, 1, status="algorithm error")
    assert "ended with an algorithm error: a bug rather than a limit?" in faulty.warnings[0]


def test_the_file_is_json_with_a_run_a_line_and_the_plot_is_drawn(tmp_path: Path) -> None:
    found = envelope(lambda seed, level: 3 * level if level < 1.2 else None, 6)
    text = found.save(tmp_path).read_text()
    document = json.loads(text)
    assert document["format"] == "uwsim-envelope/1"
    assert len([line for line in text.splitlines() if '"seed"' in line and '"level"' in line]) == (
        len(found.evaluations)
    )
    assert document["broken_by"] == {"lost": sum(e.row.status == "lost" for e in
                                                 found.evaluations)}  # fmt: skip
    one = draw(found, tmp_path).read_bytes()
    assert one == draw(found, tmp_path).read_bytes()
    assert len(one) > 10_000
