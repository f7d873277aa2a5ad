"""Build the documentation site: ``scripts/docs`` runs it, ``build/site/index.html`` is the result.

The pages of ``docs/`` and those that they link to are copied; a page of the Python reference is
added for each package, an image for each bundled scene, a page for each notebook. Zensical makes
HTML of them, TeX formulas become MathML, and the result is checked: every link and anchor leads
somewhere, and nothing is loaded from the network, so that the site opens from disk.
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

from formulas import with_mathml
from links import broken_links, network_sources

SITE_FOLDER = Path(__file__).resolve().parent
ROOT = SITE_FOLDER.parent.parent
PACKAGE = ROOT / "src" / "uwsim"
NOTEBOOKS = ROOT / "examples" / "notebooks"
LINK = re.compile(r"(!?\[[^\]]*\])\(([^)#\s]+)(#[^)\s]*)?\)")
"""A link or an image of Markdown: its text, its target, its anchor."""
SHIM = "https://unpkg.com/iframe-worker/shim"
"""The script that Zensical loads for search from disk; this folder has a copy."""
Navigation = dict[str, dict[str, list[str]]]
"""The pages of each group of each section, by the titles; pages without a group are in ``""``."""


def main() -> None:
    """Build the site."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path, help="folder of the site, which is replaced")
    arguments = parser.parse_args()
    work = arguments.out.resolve().with_suffix(".work")
    shutil.rmtree(work, ignore_errors=True)
    pages = work / "pages"
    shutil.copytree(ROOT / "docs", pages)
    for name in ("style.css", "iframe-worker.js", "iframe-worker.LICENSE"):
        shutil.copy(SITE_FOLDER / name, pages)
    nav = copy_pages(pages)
    nav["Learn"]["Notebooks"] = notebook_pages(pages)
    nav["Reference"]["Python packages"] = reference_pages(pages)
    configure(work, nav)
    run_zensical(work)
    finish(work / "site")
    shutil.rmtree(arguments.out, ignore_errors=True)
    (work / "site").rename(arguments.out)
    shutil.rmtree(work)


def copy_pages(pages: Path) -> Navigation:
    """Rewrite the links of the copied pages; return the navigation of ``index.md``.

    A linked Markdown file from outside ``docs/`` becomes a page of its own. A link to a notebook
    leads to its page, and one to any other file of the repository becomes its path.
    """
    extra_pages: dict[Path, str] = {}
    for page in sorted(pages.glob("*.md")):
        page.write_text(rewrite_links(page.read_text(), ROOT / "docs", extra_pages))
    for path, name in list(extra_pages.items()):
        (pages / name).write_text(rewrite_links(path.read_text(), path.parent, extra_pages))
    index = (pages / "index.md").read_text()
    nav = navigation(index)
    targets = {target for _, target, _ in LINK.findall(index)}
    nav["More"] = {"": [name for name in sorted(extra_pages.values()) if name not in targets]}
    return nav


def navigation(index: str) -> Navigation:
    """Return the sections of the site: the headings of the index, with the pages below them.

    A heading of the third level is a group inside its section. A page is in the first section that
    links to it; links before the first section do not count.
    """
    nav: Navigation = {"Start": {"": ["index.md"]}}
    group = ""
    pages = set[str]()
    for line in index.splitlines():
        level, _, title = line.partition(" ")
        if level == "##":
            section = nav[title] = {}
            group = ""
        elif level == "###":
            group = title
        elif len(nav) > 1:
            for _, target, _ in LINK.findall(line):
                if target.endswith(".md") and target not in pages:
                    pages.add(target)
                    section.setdefault(group, []).append(target)
    return nav


def rewrite_links(text: str, folder: Path, extra_pages: dict[Path, str]) -> str:
    """Return the page with links that work in the site; add linked pages to ``extra_pages``."""

    def replace(match: re.Match[str]) -> str:
        label, target, anchor = match.groups()
        if "://" in target or target.startswith("mailto:"):
            return match.group()
        path = (folder / target).resolve()
        if path.is_relative_to(ROOT / "docs") and path.is_file():
            name = path.relative_to(ROOT / "docs").as_posix()
        elif path.suffix == ".md":
            name = path.relative_to(ROOT).as_posix().replace("/", "-")
            name = (
                "repository.md" if name == "README.md" else name
            )  # README.md would become index.html
            extra_pages.setdefault(path, name)
        elif path.parent == NOTEBOOKS:
            name = f"{path.stem}.md"
        else:
            return f"{label.strip('![]')} (`{path.relative_to(ROOT)}`)"
        return f"{label}({name}{anchor or ''})"

    return LINK.sub(replace, text)


def notebook_pages(pages: Path) -> list[str]:
    """Execute each notebook, and write its output as a page."""
    sources = sorted(NOTEBOOKS.glob("*.py"))
    if not sources:
        return []
    import jupytext
    from nbclient import NotebookClient
    from nbconvert import MarkdownExporter

    names = []
    for source in sources:
        notebook = jupytext.read(source)
        NotebookClient(
            notebook, timeout=300, resources={"metadata": {"path": source.parent}}
        ).execute()
        text, resources = MarkdownExporter().from_notebook_node(
            notebook, resources={"output_files_dir": f"notebooks/{source.stem}"}
        )
        for name, data in resources["outputs"].items():
            (pages / name).parent.mkdir(parents=True, exist_ok=True)
            (pages / name).write_bytes(data)
        (pages / f"{source.stem}.md").write_text(text)
        names.append(f"{source.stem}.md")
    return names


def reference_pages(pages: Path) -> list[str]:
    """Write a page for each package: the names of its ``__init__``, otherwise its modules."""
    (pages / "reference").mkdir()
    names = []
    for init in sorted(PACKAGE.rglob("__init__.py"), key=lambda path: path.parent):
        package = ".".join(("uwsim", *init.parent.relative_to(PACKAGE).parts))
        modules = sorted(
            path.stem for path in init.parent.glob("*.py") if not path.stem.startswith("_")
        )
        shown_modules = [package]
        if package != "uwsim" and not lists_names(init):
            shown_modules += [f"{package}.{module}" for module in modules]
        lines = [f"# {package}", "", f"::: {shown_modules[0]}", ""]
        for module in shown_modules[1:]:
            lines += [f"## {module}", "", f"::: {module}", "    options:", "      heading_level: 3"]
            lines += [""]
        (pages / "reference" / f"{package}.md").write_text("\n".join(lines))
        names.append(f"reference/{package}.md")
    return names


def lists_names(init: Path) -> bool:
    """Return True if the ``__init__`` of a package has an ``__all__`` with names."""
    for node in ast.parse(init.read_text()).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return bool(ast.literal_eval(node.value))
    return False


def configure(work: Path, nav: Navigation) -> None:
    """Write ``zensical.toml`` of this build: the common settings and the navigation."""
    text = (
        (SITE_FOLDER / "zensical.toml")
        .read_text()
        .replace('paths = ["src"]', f'paths = ["{ROOT}/src"]')
    )
    entries = [
        f"  {{{json.dumps(title)} = {toml_array(groups)}}},"
        for title, groups in nav.items()
        if any(groups.values())
    ]
    text = text.replace(
        "\n[project.theme]", "\n".join(["", "nav = [", *entries, "]", "", "[project.theme]"]), 1
    )
    tomllib.loads(text)
    (work / "zensical.toml").write_text(text)


def toml_array(groups: dict[str, list[str]]) -> str:
    """Return the pages and groups of a section as an array of TOML."""
    parts = [json.dumps(page) for page in groups.get("", [])]
    parts += [
        f"{{{json.dumps(title)} = {json.dumps(names)}}}"
        for title, names in groups.items()
        if title and names
    ]
    return f"[{', '.join(parts)}]"


def run_zensical(work: Path) -> None:
    """Generate HTML; a warning, such as a missing anchor, is an error."""
    run(str(Path(sys.executable).with_name("zensical")), "build", "--strict", folder=work)


def run(*command: str, folder: Path = ROOT) -> None:
    """Run a command; exit with its output if it fails."""
    environment = os.environ | {"NO_COLOR": "1"}
    process = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    if process.returncode:
        raise SystemExit(f"{' '.join(command)} failed:\n{process.stdout}{process.stderr}")


def finish(site: Path) -> None:
    """Render the formulas, load the search's script from the site itself, and check the result."""
    for page in sorted(site.rglob("*.html")):
        up = "../" * len(page.relative_to(site).parts[1:])
        text = page.read_text().replace(SHIM, f"{up}iframe-worker.js")
        page.write_text(with_mathml(text))
    errors = broken_links(site) + network_sources(site)
    if errors:
        raise SystemExit("\n".join(errors))


if __name__ == "__main__":
    main()
