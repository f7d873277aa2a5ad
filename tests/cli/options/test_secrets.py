"""Tokens and secrets come from a variable or a file, and are neither typed nor kept."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.base.environment import remove_secrets
from uwsim.cli.options.client_options import ClientOptions
from uwsim.cli.options.connections import ConnectionOptions
from uwsim.cli.options.secrets import MAX_BYTES, read_client_secret, read_web_token
from uwsim.errors import BadSetting


@pytest.fixture(autouse=True)
def nothing_set(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("UWSIM_WEB_TOKEN", "UWSIM_CLIENT_SECRET"):
        monkeypatch.delenv(name, raising=False)


def test_a_typed_token_is_refused_and_what_to_do_instead_is_said() -> None:
    options = ConnectionOptions(web=0, web_token="in-clear")
    with pytest.raises(BadSetting, match=r"UWSIM_WEB_TOKEN.*--web-token-file") as refused:
        options.web_options()
    assert "in-clear" not in str(refused.value)


@pytest.mark.parametrize("content", ["tide", "tide\n", "  tide \nsecond line\n", "tide\r\n"])
def test_the_first_line_of_a_file_is_the_secret_and_counts_before_the_variable(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: str
) -> None:
    file = tmp_path / "secret"
    file.write_text(content, newline="")
    monkeypatch.setenv("UWSIM_WEB_TOKEN", "ebb")
    monkeypatch.setenv("UWSIM_CLIENT_SECRET", "slack")
    assert (read_web_token(None, None), read_client_secret(None)) == ("ebb", "slack")
    assert (read_web_token(None, file), read_client_secret(file)) == ("tide", "tide")


@pytest.mark.parametrize("content", ["", " \n", "\n\n", "x" * (MAX_BYTES + 1)])
def test_a_blank_or_endless_secret_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: str
) -> None:
    file = tmp_path / "secret"
    with pytest.raises(BadSetting, match="cannot be read"):
        read_client_secret(file)
    file.write_text(content)
    with pytest.raises(BadSetting, match="--client-secret-file"):
        read_client_secret(file)
    if not content.strip():
        monkeypatch.setenv("UWSIM_CLIENT_SECRET", content)
        with pytest.raises(BadSetting, match="UWSIM_CLIENT_SECRET"):
            read_client_secret(None)


def test_a_secret_that_is_no_text_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "secret"
    file.write_bytes(b"tide\xff\n")
    with pytest.raises(BadSetting, match=r"--web-token-file .* no characters of UTF-8"):
        read_web_token(None, file)
    monkeypatch.setenv("UWSIM_CLIENT_SECRET", "ebb\udcff")  # as Python reads the byte 0xff
    with pytest.raises(BadSetting, match="UWSIM_CLIENT_SECRET: it has bytes that are no char"):
        read_client_secret(None)


def test_secrets_are_not_shown_with_what_holds_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("UWSIM_WEB_TOKEN", "high-water")
    monkeypatch.setenv("UWSIM_CLIENT_SECRET", "low-water")
    spec = ClientOptions(client="a", web=0).client_spec()
    assert spec is not None
    assert spec.secret == "low-water"
    assert spec.connection.web is not None
    assert spec.connection.web.token == "high-water"
    assert "water" not in repr(spec)
    assert remove_secrets({"UWSIM_WEB_TOKEN": "a", "HOME": "b", "UWSIM_CLIENT_SECRET": "c"}) == {
        "HOME": "b"
    }


def test_the_secret_is_of_a_client_that_joins(tmp_path: Path) -> None:
    from uwsim.errors import ErrorCollector

    file = tmp_path / "secret"
    file.write_text("tide")
    for options in (
        ClientOptions(client="a", web=0, sync="none", client_secret_file=file),
        ClientOptions(client_secret_file=file),
    ):
        wrong = ErrorCollector()
        options.check(wrong, "0")
        with pytest.raises(BadSetting, match="--client-secret-file needs"):
            wrong.raise_errors()
