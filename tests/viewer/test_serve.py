from __future__ import annotations

import urllib.error
import urllib.request
from urllib.parse import urlsplit

import pytest

from uwsim.errors import BadSetting
from uwsim.viewer.serve import serve


def test_the_page_is_served_at_its_address_alone() -> None:
    served = serve("<p>é</p>")
    try:
        place = urlsplit(served.url)
        assert place.hostname == "127.0.0.1"
        with urllib.request.urlopen(served.url, timeout=200) as answer:
            assert answer.read().decode() == "<p>é</p>"
        with pytest.raises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(f"http://{place.netloc}/", timeout=200)
        refused.value.close()
        assert refused.value.code == 404
    finally:
        served.close()


def test_a_port_that_is_taken_is_named() -> None:
    served = serve("")
    try:
        port = urlsplit(served.url).port
        assert port is not None
        with pytest.raises(BadSetting, match=f"--port {port}"):
            serve("", port=port)
    finally:
        served.close()
