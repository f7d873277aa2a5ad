"""What libraries chose for the processor is recorded, and a difference is named; none is not."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.compared_results import make_result
from tests.support.stored_rows import stored_row
from uwsim.analysis.report.configuration import provenance_texts as shown
from uwsim.errors import ReplayDiffers
from uwsim.results import journal
from uwsim.results.code_paths import chosen_code, code_differences, names_text
from uwsim.results.provenance import (
    codes_of,
    lasting_provenance,
    load_provenance,
    machine,
    save_beginning,
    save_provenance,
)
from uwsim.results.run_info import RunInfo
from uwsim.verify.environment import environment_differences

OLD = {"numpy": ["OLD_X86"], "OpenBLAS": ["Katmai"]}
ELSEWHERE = "OpenBLAS Katmai there, "


def begun_elsewhere(directory: Path) -> Path:
    code = {**chosen_code(), **OLD}
    save_provenance({"command": ["bench", "x"], **machine(), "code": code}, directory)
    return directory


def test_an_unchanged_choice_is_not_reported() -> None:
    here = json.loads(json.dumps(chosen_code()))
    assert set(here) == {"numpy", "OpenBLAS", "OpenCV", "numba"}
    assert all(here["OpenBLAS"])
    assert here["numba"]
    assert code_differences(here) == code_differences(None) == code_differences({}) == ""


def test_what_another_processor_had_chosen_is_named() -> None:
    here = chosen_code()
    said = code_differences({**here, "numba": [*here["numba"], "avx99"], "OpenBLAS": ["Katmai"]})
    blas = here["OpenBLAS"][0]
    assert said == f"OpenBLAS Katmai there, {blas} here; numba avx99 there, nothing more here"
    assert names_text("abcdefghi") == "a b c d e f and 3 more"


@pytest.mark.slow
@pytest.mark.skipif(os.uname().machine != "x86_64", reason="switches of x86 processors")
def test_what_environment_variables_make_libraries_choose_is_seen() -> None:
    program = (
        "from uwsim.results.code_paths import *; import json; print(json.dumps(chosen_code()))"
    )
    variables = {
        "OPENBLAS_CORETYPE": "Prescott",
        "NUMBA_CPU_NAME": "generic",
        "OPENCV_CPU_DISABLE": "SSE4.2,AVX2",
    }
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, **variables}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    said = code_differences(json.loads(done.stdout))
    assert [each.split()[0] for each in said.split("; ")] == ["OpenBLAS", "OpenCV", "numba"]


def test_a_run_that_goes_on_elsewhere_records_both_and_says_so(tmp_path: Path) -> None:
    (tmp_path / "here").mkdir()
    assert save_beginning(["bench", "x"], tmp_path / "here") == ""
    before = (tmp_path / "here" / "provenance.json").read_bytes()
    assert save_beginning(["bench", "x", "--resume"], tmp_path / "here") == ""
    assert (tmp_path / "here" / "provenance.json").read_bytes() == before

    begun_elsewhere(tmp_path)
    assert ELSEWHERE in save_beginning(["bench", "x", "--resume"], tmp_path)
    now = load_provenance(tmp_path)
    assert now["command"] == ["bench", "x"]
    assert [code["OpenBLAS"] for code in codes_of(now)] == [chosen_code()["OpenBLAS"], ["Katmai"]]
    assert save_beginning(["bench", "x", "--resume"], tmp_path) == ""
    assert [code["OpenBLAS"] for code in lasting_provenance(tmp_path)["code_before"]] == [
        ["Katmai"]
    ]


def test_a_row_that_cannot_be_played_again_names_the_other_code(tmp_path: Path) -> None:
    def play(total: float) -> None:
        file = journal.Journal(tmp_path, 0, {})
        try:
            file.add(stored_row(total=total))
        finally:
            file.close()

    play(1.0)
    with pytest.raises(ReplayDiffers, match=r"in total.*random numbers of its own"):
        play(2.0)
    begun_elsewhere(tmp_path)
    with pytest.raises(ReplayDiffers, match="chosen other code paths for the processor") as caught:
        play(2.0)
    assert ELSEWHERE in str(caught.value)


def test_verify_names_what_was_chosen_otherwise_and_nothing_where_it_was_the_same(
    tmp_path: Path,
) -> None:
    result = make_result("esm", {0.0: [1.0]})
    run = RunInfo(version="0.1.0")
    save_provenance({**machine(), "cpu": "abacus"}, tmp_path)
    assert environment_differences(result, tmp_path, run) == {}
    said = environment_differences(result, begun_elsewhere(tmp_path), run)
    assert list(said) == ["code"]
    assert ELSEWHERE in said["code"]
    save_beginning([], tmp_path)
    assert ELSEWHERE in environment_differences(result, tmp_path, run)["code"]


def test_a_report_shows_what_was_chosen_shortly(tmp_path: Path) -> None:
    rows = dict(shown(load_provenance(begun_elsewhere(tmp_path))))
    assert rows["code.OpenBLAS"] == "Katmai"
    assert rows["code.numba"].endswith(" more")
