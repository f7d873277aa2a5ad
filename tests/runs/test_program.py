"""Classes of users' programs: what a file lacks, and what a policy may return."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.policy import PolicyNode
from uwsim.errors import BadMessage, BadSetting
from uwsim.messages import Float64MultiArray, MultiArrayLayout
from uwsim.runs.program import load_program

PROGRAM = """
def function(observation):
    return observation


class Silent:
    pass


class Hello:
    def __call__(self, observation):
        return "hello"
"""


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("function", "'function' is no class; expected a class with a method start"),
        ("Silent", r"the class 'Silent' has no .* or __call__\(observation\) of a policy"),
        ("Helo", "has no class 'Helo'. Did you mean 'Hello'"),
        ("Other", "has no class 'Other'. Known: Hello"),
    ],
)
def test_a_name_that_is_no_program_is_a_clean_error(
    name: str, message: str, tmp_path: Path
) -> None:
    path = tmp_path / "program.py"
    path.write_text(PROGRAM)
    with pytest.raises(BadSetting, match=message):
        load_program(f"{path}:{name}", {})


def test_a_policy_that_returns_no_numbers_is_told_what_it_returned() -> None:
    node = FakeNode()
    PolicyNode(lambda: lambda observation: "hello").start(node)
    layout = MultiArrayLayout(dim=[], data_offset=0)
    with pytest.raises(BadMessage, match="The policy returned 'hello'; expected an array of numb"):
        node.readers["observation"](Float64MultiArray(layout=layout, data=np.zeros(3)))
