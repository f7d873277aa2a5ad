"""The score language, held against muParser's rules and Python's arithmetic."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from uwsim.base.expression import FUNCTIONS, ScoreError, parse


def value(text: str, **values: float | None) -> float | None:
    return parse(text, list(values)).evaluate(values)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("2^-2^2", 0.0625),
        ("2^-2*3", 0.75),
        ("2*-3^2", -18.0),
        ("10-4-3", 3.0),
        ("16/4/2", 2.0),
        ("1+2*3", 7.0),
        ("(1+2)*3", 9.0),
        ("1<2", 1.0),
        ("2<=1", 0.0),
        ("1==1 && 2!=2", 0.0),
        ("1 || 0 && 0", 1.0),
        ("1+1==2", 1.0),
        ("0 ? 1 : 2", 2.0),
        ("1 ? 2 : 3 ? 4 : 5", 2.0),
        ("0 ? 2 : 0 ? 4 : 5", 5.0),
        ("1 ? 0 ? 7 : 8 : 9", 8.0),
        ("if(0, 1, 2)", 2.0),
        ("min(3, 1, 2) + max(3, 1, 2) + sum(3, 1, 2) + avg(3, 1, 2)", 12.0),
        ("min(5)", 5.0),
        ("sign(-3) + sign(0) + sign(9)*10", 9.0),
        ("rint(2.5) + rint(-2.5)", 1.0),
        ("abs(-1.5e1)", 15.0),
        (".5 + 5.", 5.5),
        ("log(100)", 2.0),
        ("log10(100) + log2(8)", 5.0),
        ("ln(_e)", 1.0),
        ("sin(_pi/2) + cos(0) + tan(0)", 2.0),
        ("asin(1) + acos(1) + atan(0)", math.pi / 2),
        ("atan2(1, 1)", math.pi / 4),
        ("sinh(0) + cosh(0) + tanh(0)", 1.0),
        ("asinh(0) + acosh(1) + atanh(0)", 0.0),
        ("exp(0) + sqrt(9)", 4.0),
        ("--2", 2.0),
        ("+3 - -2", 5.0),
        (" corners\n+\tcentroid ", 3.5),
    ],
)
def test_expressions_have_the_value_muparser_gives_them(text: str, expected: float) -> None:
    assert value(text, corners=1.0, centroid=2.5) == pytest.approx(expected, abs=1e-15)


def test_a_measure_may_be_called_like_a_function() -> None:
    assert value("sum + sum(sum, 1)", sum=2.0) == 5.0


@pytest.mark.parametrize(
    "text",
    [
        "max(1, 0/0)", "max(0/0, 1)", "min(1, 1/0)", "if(0/0, 1, 2)", "0/0 ? 1 : 2", "1 || 1/0",
        "1/0 || 1", "0 && 1/0", "1/(1/0)", "exp(1000) > 5", "atan(1/0)", "1 ? 0/0 : 1",
    ],
)  # fmt: skip
def test_what_is_used_and_not_finite_gives_no_value_in_any_order(text: str) -> None:
    score = parse(text, []).score({})
    assert score.value is None
    assert score.reason is not None
    assert ", from column " in score.reason


@pytest.mark.parametrize("text", ["if(1, 2, 0/0)", "0 ? 1/0 : 2", "1 < 2 ? 2 : max(1, 1/0)"])
def test_the_side_that_is_not_chosen_is_not_used(text: str) -> None:
    assert parse(text, []).evaluate({}) == 2.0


def test_a_number_beyond_float64_is_an_error_where_it_stands() -> None:
    with pytest.raises(ScoreError, match="1e999 is beyond the largest number") as error:
        parse("1 + 1e999", [])
    assert error.value.column == 4


def test_nothing_measured_gives_no_score_and_says_which_measure() -> None:
    score = parse("corners + centroid", ["corners", "centroid"]).score(
        {"corners": None, "centroid": 1.0}
    )
    assert score.value is None
    assert score.reason == "no value for corners"


def test_a_measure_that_is_not_in_the_function_may_be_missing() -> None:
    assert parse("corners", ["corners", "other"]).evaluate({"corners": 2.0, "other": None}) == 2.0


@pytest.mark.parametrize("text", ["1/0", "0/0", "sqrt(-1)", "log(0)", "1e300*1e300", "(-8)^(1/3)"])
def test_what_is_not_a_finite_number_is_no_score_and_has_a_reason(text: str) -> None:
    score = parse(text, []).score({})
    assert score.value is None
    assert score.reason is not None
    assert "the function gives" in score.reason


def test_a_branch_that_is_not_taken_may_divide_by_zero() -> None:
    assert value("done > 0 ? 1/done : 0", done=0.0) == 0.0


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("corners+cetroid", 8, "Did you mean 'centroid'"),
        ("corners +", 9, "ends too early"),
        ("(corners", 8, "ends too early"),
        ("corners centroid", 8, "'centroid' is not allowed here"),
        ("corners $ 2", 8, r"'\$' is not allowed here"),
        ("1 + * 2", 4, r"'\*' is not allowed here"),
        ("sin(1, 2)", 0, "sin takes 1 argument"),
        ("1 + max()", 4, "max takes at least 1 argument, not 0"),
        ("2*sqr(4)", 2, "Did you mean 'sqrt'"),
        ("mod(5, 3)", 0, r"no function is called 'mod'\. Known: .*rint"),
        ("sin + 1", 0, "sin is a function"),
        ("corners = 2", 8, "'=' is not allowed here"),
        ("1 ? 2", 5, "ends too early"),
        ("", 0, "empty"),
        ("corners.real", 7, "is not allowed here"),
        ("__import__('os')", 11, "is not allowed here"),
    ],
)
def test_an_error_is_shown_with_a_caret_under_it(text: str, column: int, message: str) -> None:
    with pytest.raises(ScoreError, match=message) as caught:
        parse(text, ["corners", "centroid"])
    assert caught.value.column == column
    assert str(caught.value).split("\n")[-1] == "  " + " " * column + "^"


@pytest.mark.parametrize(
    "text", ["(" * 4000, "(" * 101 + "1" + ")" * 101, "1+" * 3000 + "1", "1?" * 2000]
)
def test_an_expression_too_long_or_too_deep_is_a_clean_error(text: str) -> None:
    with pytest.raises(ScoreError):
        parse(text, [])


def test_a_long_chain_is_no_deep_nesting() -> None:
    assert value("+".join(["1"] * 2000)) == 2000.0
    assert value("-" * 4000 + "1") == 1.0
    assert value("1^" * 2000 + "1") == 1.0
    assert value("1?" * 1000 + "7" + ":0" * 1000) == 7.0


@settings(max_examples=200, deadline=None)
@given(st.text(alphabet="ab12.+-*/^()?:<>=&|, _e\n$", max_size=40))
def test_any_text_gives_an_expression_or_a_clean_error(text: str) -> None:
    column = 0
    try:
        parse(text, ["a", "b"]).score({"a": 1.5, "b": -2.0})
    except ScoreError as error:
        column = error.column
    assert 0 <= column <= len(text)


numbers = st.integers(0, 9).map(str) | st.sampled_from(["0.5", "2.25", "a", "b"])
expressions = st.recursive(
    numbers,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["+", "-", "*", "/", "^"]), inner).map(" ".join),
        inner.map(lambda text: f"({text})"),
        inner.map(lambda text: f"-{text}"),
        st.tuples(inner, inner).map(lambda pair: f"max({pair[0]}, {pair[1]})"),
    ),
    max_leaves=12,
)


@settings(max_examples=300, deadline=None)
@given(expressions)
def test_arithmetic_agrees_with_python_where_python_has_a_number(text: str) -> None:
    values = {"a": 1.5, "b": -2.0}
    try:
        # floats, as in the language: whole numbers would grow without bound in 9^9^9
        floats = re.sub(r"(?<![\d.])\d(?![\d.])", r"\g<0>.0", text)
        expected = eval(floats.replace("^", "**"), {"max": max, **values})
    except (ZeroDivisionError, OverflowError, TypeError):  # max of a complex root
        return
    if isinstance(expected, complex) or not math.isfinite(expected) or abs(expected) > 1e15:
        return
    found = parse(text, list(values)).evaluate(values)
    assert found is None or found == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert found is not None or "/" in text or "^" in text


def test_every_function_of_the_language_is_there() -> None:
    named = (
        "sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh log2 log10 log ln exp "
        "sqrt sign rint abs min max sum avg if"
    )
    assert set(FUNCTIONS) == set(named.split())
