import pickle

import pytest

from uwsim.benchmark.score import ScoreFault
from uwsim.errors import BenchmarkError, Fault, NeverStarted, UnknownName, UwsimError


@pytest.mark.parametrize(
    "error",
    [
        NeverStarted("nobody called startBench"),
        UnknownName("body", "girona50", ["girona500"]),
        BenchmarkError([Fault(file="a", line=n, message="no") for n in (3, None)]),
        ScoreFault("1 +", 3, "something is missing"),
    ],
)  # fmt: skip
def test_an_error_sent_home_by_a_worker_is_the_one_that_was_raised(error: UwsimError) -> None:
    error.add_note("where it was raised")
    back = pickle.loads(pickle.dumps(error))
    assert type(back) is type(error)
    assert str(back) == str(error)
    assert back.__dict__ == error.__dict__
