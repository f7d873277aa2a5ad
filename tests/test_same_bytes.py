"""The same bytes on every processor: what must not be called, and what comes out when it is.

Libraries choose their code by the processor. Environment variables let this machine pass for
others, so that what an older or a newer one would have found can be compared here.
"""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parent.parent / "src" / "uwsim"

CHOSEN_BY_THE_PROCESSOR = """
    arccos arccosh arcsin arcsinh arctan arctan2 arctanh cbrt cosh exp exp2 expm1 float_power log
    log10 log1p log2 logaddexp power sinh tan tanh
    convolve corrcoef correlate cov dot inner lstsq matmul matvec polyfit tensordot vdot vecdot
    vecmat
"""
"""Of numpy: functions of which there are several codes, and what calls BLAS or LAPACK."""
NEEDS = {"np.linalg.norm": "axis", "np.argsort": "kind"}
"""Of numpy: the argument that makes the difference."""
MAKE_NO_NUMBERS = {
    "base/numerics/linear.py": "raises numpy's error",
    "physics/hydrodynamics/self_test.py": "says that MuJoCo is another",
    "scene/hydrodynamics/checks.py": "says that a vehicle's file is wrong",
    "scene/hydrodynamics/passivity.py": "says that a vehicle's file is wrong",
    "viewer/film/paths.py": "where the camera of a film is",
    "viewer/live/view.py": "refuses a view that is none",
    "viewer/shapes.py": "meshes for the viewers of recordings",
    "examples/paper/station_keeping.py": "the theory beside the measurements in a report",
}
FITTED = ("statistics/", "calibration/", "identification/")
"""Rooms whose fits are by SciPy's and LAPACK's least squares, which make the last bits; their files
have six digits."""
POSES = re.compile(r"_from_|[pP]ose|_before|\.now|motion|place|scaled")
NO_POSES = re.compile(r"\.matrix|\.rotation|\.T\b|np\.|\(self\._water")


def calls(path: Path) -> list[str]:
    found = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult):
            sides = [ast.unparse(side) for side in (node.left, node.right)]
            if not all(POSES.search(side) and not NO_POSES.search(side) for side in sides):
                found.append(f"{node.lineno}: {' @ '.join(sides)}")
        elif isinstance(node, ast.Attribute):
            text = ast.unparse(node)
            is_method = node.attr == "dot"
            is_numpys = text == f"np.{node.attr}" and node.attr in CHOSEN_BY_THE_PROCESSOR.split()
            is_lapack = ast.unparse(node.value) == "np.linalg" and node.attr != "norm"
            if is_method or is_numpys or is_lapack:
                found.append(f"{node.lineno}: {text}")
        elif isinstance(node, ast.Call) and ast.unparse(node.func) in (
            "np.linalg.norm",
            "np.argsort",
        ):
            given = {keyword.arg for keyword in node.keywords}
            if not given & {"axis", "kind"}:
                found.append(f"{node.lineno}: {ast.unparse(node)}")
    return found


def test_nothing_that_the_processor_chooses_makes_numbers() -> None:
    """Use linear and elementwise of uwsim.base.numerics instead, or the argument in `NEEDS`."""
    found = []
    for path in sorted(PACKAGE.rglob("*.py")):
        name = path.relative_to(PACKAGE).as_posix()
        if name not in MAKE_NO_NUMBERS and not name.startswith(FITTED):
            found += [f"{name}:{call}" for call in calls(path)]

    assert found == []


def numpys_newest() -> str:
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    return " ".join(name for name in __cpu_dispatch__ if __cpu_features__[name])


OTHERS = {
    "old libraries": {
        "OPENBLAS_CORETYPE": "Prescott",
        "NPY_DISABLE_CPU_FEATURES": numpys_newest(),
        "OPENCV_CPU_DISABLE": "AVX2,AVX512-SKX",
        "OPENCV_IPP": "disabled",
    },
    "newer BLAS": {"OPENBLAS_CORETYPE": "SkylakeX"},
}
"""What this processor can pass for. numba's code for any (``NUMBA_CPU_NAME=generic``) gives the
same, too, and takes minutes to compile: ``benchmarks/`` has it."""


def hashes(**variables: str) -> dict[str, str]:
    """Play a little of everything in a process of its own, and return what came out, as hashes."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.support.byte_hashes"],
        cwd=PACKAGE.parent.parent,
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        check=True,
    )
    found: dict[str, str] = json.loads(done.stdout.splitlines()[-1])
    return found


@pytest.fixture(scope="module")
def here() -> dict[str, str]:
    return hashes()


def has_avx512() -> bool:
    from numpy._core._multiarray_umath import __cpu_features__

    return any(__cpu_features__.get(name) for name in ("AVX512_SKX", "X86_V4"))


@pytest.mark.slow
@pytest.mark.skipif(os.uname().machine != "x86_64", reason="switches of x86 processors")
@pytest.mark.parametrize("other", OTHERS)
def test_another_processor_finds_the_same_bytes(other: str, here: dict[str, str]) -> None:
    if "newer" in other and not has_avx512():
        pytest.skip("this processor has no AVX-512")

    there = hashes(**OTHERS[other])

    assert {name for name in here if here[name] != there[name]} == set()
    assert len(here) > 10


@pytest.mark.slow
@pytest.mark.skipif(os.uname().machine != "x86_64", reason="switches of x86 processors")
def test_the_libraries_themselves_do_differ() -> None:
    program = (
        "import numpy as np, hashlib; r = np.random.Generator(np.random.Philox(1));"
        "a = r.normal(size=(40, 40)); "
        "print(hashlib.sha256(np.linalg.solve(a, a[::-1]).tobytes()).hexdigest())"
    )

    def hashed(**variables: str) -> str:
        done = subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, **variables},
            capture_output=True,
            text=True,
            check=True,
        )
        return done.stdout

    assert hashed() != hashed(**OTHERS["old libraries"])
