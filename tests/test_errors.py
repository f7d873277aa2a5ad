import pickle

import pytest

from uwsim.base.expression import ScoreError
from uwsim.errors import (
    BadSetting,
    BenchmarkError,
    Diagnostic,
    ErrorCollector,
    NeverStarted,
    SeveralErrors,
    UnknownName,
    UwsimError,
    did_you_mean,
)


@pytest.mark.parametrize(
    "error",
    [
        NeverStarted("nobody called startBench"),
        UnknownName("body", "girona50", ["girona500"]),
        BenchmarkError([Diagnostic(file="a", line=n, message="no") for n in (3, None)]),
        ScoreError("1 +", 3, "something is missing"),
    ],
)  # fmt: skip
def test_an_error_sent_home_by_a_worker_is_the_one_that_was_raised(error: UwsimError) -> None:
    error.add_note("where it was raised")
    back = pickle.loads(pickle.dumps(error))
    assert type(back) is type(error)
    assert str(back) == str(error)
    assert back.__dict__ == error.__dict__


def test_errors_are_kept_in_order_each_once_and_a_single_one_as_it_is() -> None:
    none, one, many = ErrorCollector(), ErrorCollector(), ErrorCollector()
    none.raise_errors()
    for _ in range(2):
        with one.collect():
            raise BadSetting("a")
    with pytest.raises(BadSetting, match="a"):
        one.raise_errors()
    for error in (BadSetting("b"), SeveralErrors([NeverStarted("c"), BadSetting("b")])):
        with many.collect():
            raise error
    with pytest.raises(SeveralErrors) as caught:
        many.raise_errors()
    assert list(map(str, caught.value.errors)) == ["b", "c"]
    with pytest.raises(KeyError), many.collect():
        raise KeyError


def test_of_many_names_the_nearest_are_listed() -> None:
    known = [f"corners.{part}{number}" for part in ("mean", "max") for number in range(30)]
    assert str(UnknownName("column", "corners.men7", known)) == (
        "No column is called 'corners.men7'. Did you mean 'corners.mean7'? Nearest of 60: "
        "corners.mean7, corners.mean27, corners.mean17."
    )
    assert str(UnknownName("column", "b", ["a"])) == "No column is called 'b'. Known: a."


def test_no_name_is_looked_for_near_an_endless_text() -> None:
    """Of a peer: it took seconds, in which nothing else was read."""
    assert did_you_mean("publis", ["publish"]) == " Did you mean 'publish'?"
    endless = "publish" * 1_000_000
    assert did_you_mean(endless, [f"{endless}s"]) == ""
    assert "Nearest of 40: " in str(UnknownName("topic", endless, [f"t{i}" for i in range(40)]))
