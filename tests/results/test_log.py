"""What a log promises."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from uwsim.errors import ResultError
from uwsim.results.log import Log, load_log, log_text, logs_of, save_log
from uwsim.results.provenance import load_provenance, save_provenance

LOG = Log(
    measure="corners",
    header=("fog [1/m]", "time [s]", "corners [px]", "nw, x [px]"),
    samples=((0.0, 0.1, 1.8300000000000003, -0.0), (0.05, 2.1, None, None)),
)


def test_a_log_reads_back_exactly(tmp_path: Path) -> None:
    assert load_log(save_log(LOG, tmp_path)) == LOG
    assert [p.name for p in logs_of(tmp_path)] == ["measure-corners.csv"]


def test_a_name_with_a_slash_stays_in_the_directory(tmp_path: Path) -> None:
    log = Log(measure="../x/y", header=("time [s]",))
    assert save_log(log, tmp_path) == tmp_path / "measure-_x_y.csv"


def test_what_could_not_be_measured_is_an_empty_field() -> None:
    assert log_text(LOG).splitlines() == [
        'fog [1/m],time [s],corners [px],"nw, x [px]"',
        "0.0,0.1,1.8300000000000003,-0.0",
        "0.05,2.1,,",
    ]


def test_numbers_of_numpy_are_written_as_numbers() -> None:
    log = Log(measure="m", header=("time [s]",), samples=((np.float64(0.1),),))
    assert log_text(log) == "time [s]\n0.1\n"


def test_a_sample_that_does_not_fit_the_header_is_refused() -> None:
    with pytest.raises(ResultError, match="sample 0 has 1 values, the header 4"):
        log_text(Log(measure="m", header=LOG.header, samples=((1.0,),)))


@pytest.mark.parametrize("text", ["", "a,b\n1,2,3\n", "a\nfast\n", "a\n1e308\n", "a\nnan\n"])
def test_what_is_no_log_is_a_clean_error(tmp_path: Path, text: str) -> None:
    path = tmp_path / "measure-m.csv"
    path.write_text(text)
    with pytest.raises(ResultError, match=r"measure-m\.csv"):
        load_log(path)


def test_provenance_is_read_back_and_does_without(tmp_path: Path) -> None:
    assert load_provenance(tmp_path) == {}
    save_provenance({"host": "reef", "cores": 2}, tmp_path)
    assert load_provenance(tmp_path) == {"host": "reef", "cores": 2}
    (tmp_path / "provenance.json").write_text("{")
    assert load_provenance(tmp_path) == {}
