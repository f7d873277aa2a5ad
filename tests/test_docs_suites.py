"""The pages on suites: their tables are fresh, and their files and commands run."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts.reference.suite_tables import fill_tables
from tests.support.documented import read_commands, write_files
from uwsim.cli import main

DOCS = Path(__file__).parent.parent / "docs"


def test_the_tables_of_the_tasks_are_those_of_the_suite() -> None:
    page = (DOCS / "tasks.md").read_text()
    assert fill_tables(page) == page, "run scripts/docs"


@pytest.mark.slow
@pytest.mark.parametrize("page", ["submit-a-result.md", "add-a-task.md"])
def test_the_files_and_commands_of_a_page_run(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (DOCS / page).read_text()
    assert write_files(text, tmp_path)
    monkeypatch.chdir(tmp_path)
    commands = read_commands(text)
    assert len(commands) >= 3
    for command in commands:
        assert command.words[0] == "uwsim"
        assert main(command.words[1:]) == 0, command
    assert (tmp_path / "page" / "index.html").is_file()
