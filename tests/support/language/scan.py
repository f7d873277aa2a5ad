"""The violations and counts of files of the repository."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from .docstrings import docstring_fault
from .names import name_fault
from .sentences import (
    MAX_WORDS,
    MAX_WORDS_EVER,
    count_words,
    page_sentences,
    text_sentences,
)
from .syntax import Module, Name, read_module, strings
from .typescript import read_typescript
from .violation import Violation

ROOT = Path(__file__).parents[3]
"""The folder of the repository."""
CODE = ("src/uwsim", "scripts", "benchmarks", "examples", "tests/support", "tests/conftest.py")
"""The files whose names and docstrings are checked."""
PAGES = ("docs", "README.md", "CONTRIBUTING.md")
"""The pages whose sentences are checked."""
GENERATED_PAGES = frozenset(
    ("docs/dialect.md", "docs/command-line.md", "docs/benchmark-dialect.md")
)
"""The pages that are written from the texts of the program."""
STORED_TEXTS = frozenset(
    ("src/uwsim/benchmark/measures/euclidean_norm.py", "src/uwsim/physics/engine_warnings.py")
)
"""The files with long texts in stored rows, which `uwsim verify` compares to the byte."""
ROS_TYPES = "src/uwsim/messages/"
"""The folder whose classes have the names of ROS types: ``std_srvs/Empty``."""
MAX_SHARE = 0.03
"""The greatest share of long sentences of a page."""


@dataclass
class Report:
    """The violations of a set of files, with what was counted."""

    violations: list[Violation] = field(default_factory=list)
    """The violations, in the order of the files."""
    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    """The number of names, docstrings or sentences, for each package and kind."""

    def total(self, kind: str) -> int:
        """Return how many of a kind were read."""
        return sum(count for (_, name), count in self.counts.items() if name == kind)

    def select(self, *kinds: str) -> list[Violation]:
        """Return the violations of some kinds."""
        return [violation for violation in self.violations if violation.kind in kinds]


def package_of(path: str) -> str:
    """Return the package or folder in which a file is counted."""
    parts = Path(path).parts
    if parts[0] == "src":
        return parts[2] if len(parts) > 3 else "uwsim"
    return "/".join(parts[:2]) if parts[0] == "tests" else parts[0]


def scan(folders: Iterable[str] = (*CODE, *PAGES)) -> Report:
    """Check the files of folders; paths are relative to the repository."""
    report = Report()
    for path in _files(folders):
        relative_path = str(path.relative_to(ROOT))
        if path.suffix == ".py":
            check_module(report, read_module(path.read_text(), relative_path))
        elif path.suffix == ".ts":
            check_names(report, relative_path, read_typescript(path.read_text()))
        elif path.suffix == ".md" and relative_path not in GENERATED_PAGES:
            check_page(report, relative_path, path.read_text())
    return report


def _files(folders: Iterable[str]) -> Iterator[Path]:
    for folder in folders:
        path = ROOT / folder
        if path.is_dir():
            files = sorted(file for file in path.rglob("*") if file.suffix in (".py", ".ts", ".md"))
            yield from (file for file in files if not file.name.endswith(".d.ts"))
        else:
            yield path


def check_module(report: Report, module: Module) -> None:
    """Check the names, docstrings and messages of a Python module."""
    package = package_of(module.path)
    check_names(report, module.path, module.names)
    for docstring in module.docstrings:
        report.counts[package, "docstring"] += 1
        if (fault := docstring_fault(docstring.owner, docstring.text)) is not None:
            kind, reason = fault
            report.violations.append(
                Violation(
                    path=module.path,
                    line=docstring.line,
                    kind=kind,
                    name=docstring.name,
                    reason=reason,
                )
            )
    if not module.path.startswith("src/uwsim/") or module.path in STORED_TEXTS:
        return
    texts = [(text.line, text.scope or "module", text.text) for text in strings(module)]
    if module.path.startswith("src/uwsim/cli/"):
        texts += [
            (docstring.line, docstring.name, docstring.text)
            for docstring in module.docstrings
            if docstring.owner in ("function", "procedure")
        ]
    for line, name, text in texts:
        for sentence in text_sentences(text):
            report.counts[package, "message"] += 1
            if (length := count_words(sentence)) > MAX_WORDS:
                reason = f"a sentence of {length} words: {sentence[:60]} ..."
                report.violations.append(
                    Violation(path=module.path, line=line, kind="message", name=name, reason=reason)
                )


def check_names(report: Report, path: str, names: Iterable[Name]) -> None:
    """Check the names of a module."""
    package = package_of(path)
    for name in names:
        if name.kind == "class" and path.startswith(ROS_TYPES):
            continue
        report.counts[package, name.kind] += 1
        if (reason := name_fault(name.kind, name.name)) is not None:
            report.violations.append(
                Violation(
                    path=path,
                    line=name.line,
                    kind=name.kind,
                    name=name.qualified_name,
                    reason=reason,
                )
            )


def check_page(report: Report, path: str, text: str) -> None:
    """Check the sentences of a page: none over 40 words, and few over 25 words."""
    package = package_of(path)
    n_sentences = n_long = 0
    for line, sentence in page_sentences(text):
        length = count_words(sentence)
        n_sentences += 1
        n_long += length > MAX_WORDS
        if length > MAX_WORDS_EVER:
            start = " ".join(sentence.split()[:6])
            reason = f"a sentence of {length} words; at most {MAX_WORDS_EVER}"
            report.violations.append(
                Violation(path=path, line=line, kind="sentence", name=start, reason=reason)
            )
    report.counts[package, "sentence"] += n_sentences
    report.counts[package, "long sentence"] += n_long
    if n_long > max(1.0, MAX_SHARE * n_sentences):
        reason = f"{n_long} of {n_sentences} sentences have more than {MAX_WORDS} words"
        report.violations.append(
            Violation(path=path, line=1, kind="page", name="long sentences", reason=reason)
        )
