"""The language rules of names, docstrings, messages and pages, and tests of their checker."""

from __future__ import annotations

import pytest

from tests.support.language.docstrings import docstring_fault
from tests.support.language.names import name_fault
from tests.support.language.scan import (
    MAX_SHARE,
    Report,
    check_module,
    check_page,
    scan,
)
from tests.support.language.sentences import count_words, page_sentences, text_sentences
from tests.support.language.syntax import read_module
from tests.support.language.typescript import read_typescript
from tests.support.language.words import CLASSES, FIELD_TERMS


@pytest.fixture(scope="module")
def report() -> Report:
    return scan()


def test_no_name_docstring_message_or_page_violates_the_language_rules(report: Report) -> None:
    assert not report.violations, "\n" + "\n".join(map(str, report.violations))


def test_few_sentences_of_all_pages_are_long(report: Report) -> None:
    assert report.total("long sentence") <= MAX_SHARE * report.total("sentence")


@pytest.mark.parametrize(
    ("kind", "name"),
    [
        ("function", "given"),
        ("function", "_because"),
        ("function", "_who"),
        ("function", "_few"),
        ("function", "wishes"),
        ("function", "unfit"),
        ("function", "obey"),
        ("function", "of_row"),
        ("function", "why_not"),
        ("function", "as_read"),
        ("function", "inView"),
        ("class", "Wanted"),
        ("class", "Onlooker"),
        ("class", "Seat"),
        ("constant", "ROOM"),
        ("constant", "OFF"),
        ("constant", "QUALITY"),
        ("constant", "HOLLOW"),
        ("constant", "OF_WINDOW"),
        ("variable", "by"),
        ("variable", "_own"),
        ("variable", "from_"),
        ("variable", "nearest"),
        ("variable", "firstly"),
        ("variable", "turned"),
        ("function", "sendable"),
    ],
)
def test_a_name_without_a_verb_or_noun_is_a_violation(kind: str, name: str) -> None:
    assert name_fault(kind, name) is not None


@pytest.mark.parametrize(
    ("kind", "name"),
    [
        ("function", "compute_allocation"),
        ("function", "desired_twist"),
        ("function", "from_bytes"),
        ("function", "with_name"),
        ("function", "on_message"),
        ("function", "as_json"),
        ("function", "is_running"),
        ("function", "clear"),
        ("function", "world_from_camera"),
        ("class", "ThrusterCommand"),
        ("class", "Servo"),
        ("class", "Recordable"),
        ("constant", "JPEG_QUALITY"),
        ("variable", "workers"),
        ("variable", "quality"),
        ("variable", "seed"),
        ("variable", "left"),
        ("variable", "linear"),
        ("variable", "nu"),
        ("variable", "a1"),
        ("variable", "__all__"),
    ],
)
def test_a_name_of_the_field_is_accepted(kind: str, name: str) -> None:
    assert name_fault(kind, name) is None


@pytest.mark.parametrize(
    ("owner", "text", "kind"),
    [
        ("function", "What it took.", "docstring"),
        ("function", "Whether it runs.", "docstring"),
        ("function", "Shown names.", "docstring"),
        ("procedure", "The start of a step.", "docstring"),
        ("attribute", "Of JPEG images.", "docstring"),
        ("property", "Whether it runs.", "docstring"),
        ("class", "Publishes images.", "article"),
        ("attribute", "Number of images.", "article"),
        ("attribute", "Greatest number of images.", "article"),
    ],
)
def test_a_docstring_that_begins_with_a_fragment_is_a_violation(
    owner: str, text: str, kind: str
) -> None:
    fault = docstring_fault(owner, text)
    assert fault is not None
    assert fault[0] == kind


@pytest.mark.parametrize(
    ("owner", "text"),
    [
        ("procedure", "Publish the images."),
        ("procedure", "Empty the queue."),
        ("function", "Return the number of images."),
        ("function", "Takes the oldest image."),
        ("function", "The number of images."),
        ("property", "The path length so far [m]."),
        ("class", "A ``<distance>`` element."),
        ("attribute", "JPEG quality of images."),
        ("attribute", "Names of the vehicles."),
        ("attribute", ":math:`x` in metres."),
        ("attribute", "One name for each camera."),
        ("property", "True if the pose is constant."),
    ],
)
def test_a_docstring_that_begins_with_a_verb_or_noun_phrase_is_accepted(
    owner: str, text: str
) -> None:
    assert docstring_fault(owner, text) is None


SOURCE = '''
from enum import Enum
from ast import NodeVisitor
from uwsim.schema import element

SIZE = 3
"""Of an image."""


class State(Enum):
    """The state of a simulation."""

    PAUSED = 1


class Visitor(NodeVisitor):
    """A visitor."""

    def found(self, given):
        """What was found."""
        self.seen = given
        """Of the class."""
        for each in given:
            pass
        return [own for own in given]


class CurrentSpec(Spec):
    """A ``<current>`` element."""

    by: float = element(default=0.0)
    at: float = 0.0
'''


def test_the_violations_of_a_module_have_qualified_names() -> None:
    report = Report()
    check_module(report, read_module(SOURCE, "src/uwsim/bus/bus.py"))
    assert [violation.key.partition(": ")[2] for violation in report.violations] == [
        "variable: Visitor.found.given",
        "variable: Visitor.seen",
        "variable: Visitor.found.each",
        "variable: Visitor.found.own",
        "docstring: SIZE",
        "docstring: Visitor.found",
        "docstring: Visitor.seen",
    ]
    assert report.counts["bus", "function"] == 0  # a library prescribes the methods of a visitor


def test_a_function_with_a_deprecated_name_is_not_checked() -> None:
    source = """
class Node:
    @property
    @deprecated_name("rng")
    def random(self): ...

    def latest(self): ...
"""
    names = [name.name for name in read_module(source, "src/uwsim/bus/node.py").names]
    assert names == ["Node", "latest", "self"]


def test_a_generated_module_is_not_read() -> None:
    source = '"""Messages of std_msgs, generated by scripts/messages."""\nby = 1\n'
    assert read_module(source, "src/uwsim/messages/std_msgs.py").names == []


def test_the_text_of_an_error_with_a_long_sentence_is_a_violation() -> None:
    long_text = " ".join(["{name} is not a vehicle"] * 6)
    source = f'def check(name):\n    raise UnknownName(f"{long_text}. Short.")\n'
    report = Report()
    check_module(report, read_module(source, "src/uwsim/bus/bus.py"))
    [violation] = report.violations
    assert (violation.kind, violation.name) == ("message", "check")


def test_the_names_of_a_typescript_module_are_found() -> None:
    source = """
    /** given: a comment */
    export class Live extends View {
      private shown: boolean;
      draw(found: number, at?: string): void {
        const { each, name: own } = this.read("told");
        for (const one of names) send((thing) => thing.id);
        setTimeout(first, last);
      }
    }
    function by(what: string) { return what; }
    const over = (x: number) => x;
    """
    names = {(name.kind, name.name) for name in read_typescript(source)}
    assert names == {
        ("class", "Live"),
        ("function", "draw"),
        ("function", "by"),
        ("function", "over"),
        *(("variable", name) for name in ("shown", "found", "at", "each", "own", "one")),
        *(("variable", name) for name in ("thing", "what", "x")),
    }


PAGE = """# A title that is not a sentence

Sentences end with a period, e.g. here. `uwsim bench a b c` is one word. This one
continues: [a link](https://example.org/a-b).

| a table | is left out |

- an item
- an item of
  two lines

```console
$ uwsim run. This is code.
```
"""


def test_the_sentences_of_a_page_are_found() -> None:
    sentences = [sentence for _, sentence in page_sentences(PAGE)]
    assert [count_words(sentence) for sentence in sentences] == [7, 4, 5, 2, 5]


@pytest.mark.parametrize(("n_words", "n_violations"), [(25, 0), (26, 1), (41, 3)])
def test_the_length_of_a_page_s_sentences_is_limited(n_words: int, n_violations: int) -> None:
    """Two long sentences of two are a share that is too great; two very long ones are listed."""
    sentence = " ".join(["Word", *["word"] * (n_words - 1)]) + "."
    report = Report()
    check_page(report, "docs/page.md", f"{sentence} {sentence}\n")
    assert len(report.violations) == n_violations


def test_code_in_a_string_is_no_sentence() -> None:
    assert list(text_sentences("x = [a[i] * b[i] for i in range(3)] + c[0] - d[1]")) == []
    assert len(list(text_sentences("The scene has no vehicle. Add a <vehicle> to it."))) == 2


def test_each_field_term_has_a_reason_and_is_needed() -> None:
    listed = frozenset().union(*(words for words, _ in CLASSES))
    endings = ("ed", "est", "ly")
    assert all(FIELD_TERMS.values())
    assert [term for term in FIELD_TERMS if term not in listed and not term.endswith(endings)] == []
