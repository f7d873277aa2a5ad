"""A stored result, and a browser without a network."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.short_benchmark import run, write_benchmark

CHROMIUM = "/usr/bin/chromium"
ARGUMENTS = [
    *("--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"),
    "--disable-gpu-watchdog",  # it ends what draws slowly, as software does on a busy computer
    "--disable-domain-blocking-for-3d-apis",  # after a crash of the graphics process, draw again
]
WEBGL = "document.createElement('canvas').getContext('webgl2') !== null"
LIMIT = 120_000
"""How long a page may take before it counts as hanging [ms]."""


@pytest.fixture(scope="session")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A result: a trial of three levels of half a second."""
    folder = tmp_path_factory.mktemp("stored")
    run(write_benchmark(folder, "0.5"), folder / "result")
    return folder / "result"


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium; the test is skipped where there is none.

    Of a module and no longer: while playwright is open, no test can run an event loop.
    """
    api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if not shutil.which(CHROMIUM):
        pytest.skip(f"{CHROMIUM} is not installed (Debian: apt-get install chromium)")
    with api.sync_playwright() as playwright:
        try:
            opened = playwright.chromium.launch(
                executable_path=CHROMIUM, args=ARGUMENTS, timeout=LIMIT
            )
            page = opened.new_page()
            has_webgl = page.evaluate(WEBGL)
            page.close()
        except api.Error as error:
            pytest.skip(f"{CHROMIUM} cannot be used here: {error.message.splitlines()[0]}")
        if not has_webgl:
            opened.close()
            pytest.skip(f"{CHROMIUM} has no WebGL 2 here")
        yield opened
        opened.close()


@pytest.fixture
def tab(browser: Any) -> Iterator[Any]:
    """A page of the browser with the network off; any error of it fails the test."""
    context = browser.new_context(
        viewport={"width": 1024, "height": 768}, offline=True, bypass_csp=True
    )
    page = context.new_page()
    page.set_default_timeout(LIMIT)
    page.set_default_navigation_timeout(LIMIT)
    errors: list[str] = []
    requests: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda said: errors.append(said.text) if said.type == "error" else None)
    page.on("request", lambda request: requests.append(request.url))
    yield page
    context.close()
    assert errors == []
    assert [url for url in requests if not url.startswith(("file:", "data:", "blob:"))] == []
