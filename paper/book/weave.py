"""Weaves the sources into pages: comments as text, the code between them highlighted, and below
them the figure and the table that a program makes.

Every program and every module (header and implementation together) of src/ becomes a page; chapters.toml
gives the order in which they teach, figures.toml says what the figures show. pandoc converts; what is done
here is to turn comments into Markdown and to link.

A file is written beside its name and moved into place; a page whose text is that of the page there is left as
it is, and pages that are no longer made are removed. The index comes last.

Usage: weave.py OUTPUT_FOLDER   (from the project's root; reads figures/generated and data/generated)
"""
import hashlib
import html
import json
import os
import re
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from comments import COMMENT, lines_of_code, markdown_of, with_files, with_names
from folder_map import folder_map
from overview import claims_section, deviations_section, gallery

HERE = Path("paper/book")
DRAWN, TABLES = Path("figures/generated"), (Path("data/generated"), Path("data/reference"))
SHOWN = tomllib.loads((HERE / "figures.toml").read_text())
SHOWN |= {figure.stem: {"alt": f"Figure {figure.stem}"}
          for figure in sorted(DRAWN.glob("*.svg")) if figure.stem not in SHOWN}
REPOSITORY_FILES = ("book.css", "book.js")
BIBLIOGRAPHY = "paper/references.bib"
MOST_CODE = 250  # lines on a page
SECTION = re.compile(r"^/\*\*\s+## (.+?)(?: \*/)?$", re.MULTILINE)
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


class Folder:
    """The folder of the pages, and which of its files this run has made."""

    def __init__(self, path):
        self.path, self.made = path, set()

    def write(self, name, content):
        """A file with this content; one that has it already keeps its date."""
        target = self.path / name
        self.made.add(target)
        if target.exists() and target.read_bytes() == content:
            return
        target.parent.mkdir(parents=True, exist_ok=True)
        beside = target.with_name(f"{target.name}.{os.getpid()}.tmp")
        beside.write_bytes(content)
        beside.replace(target)

    def copy(self, file, place="."):
        self.write(f"{place}/{file.name}", file.read_bytes())

    def remove_others(self):
        for file in self.path.rglob("*"):
            if file.is_file() and file.suffix != ".tmp" and file not in self.made:
                file.unlink()


class Page:
    """One program or module, or a part of its implementation: where it stands, what it says, what it
    makes."""

    def __init__(self, files, part_of=None, number=1, text=None):
        self.files = files
        path = files[0].relative_to("src")
        self.is_program = len(path.parts) == 1
        self.key = str(path if part_of else path.with_suffix("")) + (f"-{number}" if number > 1 else "")
        self.file = self.key.replace("/", "-").replace(".", "-") + ".html"
        self.text = {file: text or file.read_text() for file in files}
        self.title = self.first_heading() or self.key
        if part_of:
            self.title = part_of.title + ": " + (SECTION.search(text)[1] if number > 1 else "implementation")

    def first_heading(self):
        for text in self.text.values():
            found = re.search(r"^(?:/\*\* )?# (.+?)(?: \*/)?$", text, re.MULTILINE)
            if found:
                return found[1]
        return None

    def includes(self):
        return sorted({name for text in self.text.values() for name in INCLUDE.findall(text)})

    def figures(self):
        """The drawn figures that stand on this page."""
        return [name for name, figure in SHOWN.items() if self.is_program
                and figure.get("program", name) == self.key and (DRAWN / f"{name}.svg").exists()]

    def table(self):
        """The table that the program writes: computed, or kept from a long study."""
        found = [folder / f"{self.key}.tsv" for folder in TABLES if self.is_program]
        return next((path for path in found if path.exists()), None)


def script_of(figure):
    """The script that draws a figure."""
    return next(Path("figures").glob(f"{figure}.*"))


def parts(file):
    """The text of a file, cut at its headings where all of it is more than a sitting."""
    found = []
    for section in re.split(f"(?={SECTION.pattern})", file.read_text(), flags=re.MULTILINE)[::2]:
        if found and lines_of_code(found[-1] + section) <= MOST_CODE:
            found[-1] += section
        else:
            found.append(section)
    return found


def all_pages():
    """A header and its implementation are one page, or several where that is more than a sitting."""
    groups, pages = {}, []
    for file in sorted(Path("src").rglob("*.?pp")):
        groups.setdefault(file.with_suffix(""), []).append(file)
    for group in groups.values():
        files = sorted(group, key=lambda f: f.suffix, reverse=True)
        long = len(files) > 1 and sum(lines_of_code(file.read_text()) for file in files) > MOST_CODE
        pages.append(Page(files[:1] if long else files))
        if long:
            header = pages[-1]
            pages += [Page(files[1:], header, number, text)
                      for number, text in enumerate(parts(files[1]), 1)]
    return pages


def link(page):
    return f"[{page.title}]({page.file})"


def neighbours(page, pages):
    """What the page builds on, and what builds on it."""
    by_header = {f"{other.key}.hpp": other for other in pages}
    builds_on = [by_header[name] for name in page.includes()
                 if name in by_header and by_header[name] is not page]
    used_by = [other for other in pages
               if other is not page and f"{page.key}.hpp" in other.includes()]
    lines = []
    if builds_on:
        lines.append("Builds on: " + ", ".join(link(p) for p in builds_on) + ".")
    if used_by:
        lines.append("Used by: " + ", ".join(link(p) for p in used_by) + ".")
    return "\n\n".join(lines)


def table_excerpt(path, rows=6):
    """The names and the first rows of a table; the whole of it is a link away."""
    lines = [line for line in path.read_text().split("\n") if line and not line.startswith("#")]
    cells = [[html.escape(cell) for cell in line.split("\t")] for line in lines[:rows + 1]]
    if not cells:
        return ""
    head = "".join(f"<th>{cell}</th>" for cell in cells[0])
    body = "".join("<tr>" + "".join(f"<td>{shortened(cell)}</td>" for cell in row) + "</tr>"
                   for row in cells[1:])
    return (f'```{{=html}}\n<div class="table"><table><thead><tr>{head}</tr></thead>'
            f"<tbody>{body}</tbody></table></div>\n```")


def shortened(cell):
    """Six digits are enough to look at."""
    try:
        return f"{float(cell):.6g}"
    except ValueError:
        return cell


def figure_markdown(name, caption, output):
    script = script_of(name)
    output.copy(DRAWN / f"{name}.svg", "figures")
    output.copy(script, "scripts")
    return (f"![{caption}](figures/{name}.svg){{alt=\"{SHOWN[name]['alt']}\"}}\n\n"
            f"Drawn by [{script}](scripts/{script.name}).")


def results(page, output):
    """The figures, their scripts and the table of a program."""
    parts = [figure_markdown(name, page.title, output) for name in page.figures()]
    table = page.table()
    if table:
        output.copy(table, "tables")
        parts += [f"The first rows of [{table.name}](tables/{table.name}):", table_excerpt(table)]
    return "\n\n## What it makes\n\n" + "\n\n".join(parts) if parts else ""


def page_markdown(page, pages, output):
    bodies = []
    for file in page.files:
        bodies.append((f"## {file}\n\n" if len(page.files) > 1 and bodies else "")
                      + markdown_of(page.text[file]))
    return "\n\n".join([*bodies, results(page, output), "## Where it stands",
                        neighbours(page, pages)])


def convert(output, name, markdown, title, navigation="", cited=False):
    """A page by pandoc, unless the one that is there was made from the same text."""
    options = ["--from", "markdown-markdown_in_html_blocks+tex_math_dollars", "--to", "html5",
               "--mathml", "--standalone", "--template", str(HERE / "template.html"),
               "--metadata", f"title={title}", "--variable", f"navigation={navigation}"]
    sources = [HERE / "template.html"]
    if cited:
        options += ["--citeproc", "--bibliography", BIBLIOGRAPHY, "--metadata", "link-citations=true"]
        sources.append(Path(BIBLIOGRAPHY))
    inputs = [markdown, *options, *(file.read_text() for file in sources)]
    digest = hashlib.sha256("\0".join(inputs).encode()).hexdigest()
    page = output.path / name
    if page.exists() and digest in page.read_text():
        output.made.add(page)
        return
    # pandoc reads its arguments in the encoding of the locale
    html_page = subprocess.run(["pandoc", *options, "--variable", f"digest={digest}"], check=True,
                               input=markdown.encode(), stdout=subprocess.PIPE,
                               env={**os.environ, "LC_ALL": "C.UTF-8"}).stdout
    output.write(name, html_page)


def chapters(pages):
    """Titles with their introductions and pages, in teaching order; nothing is left out."""
    known = tomllib.loads((HERE / "chapters.toml").read_text())["chapter"]
    left = {page.key: page for page in pages}
    for chapter in known:
        named = [key for first in chapter.get("pages", []) for key in sorted(left)
                 if key == first or key.startswith(first + ".cpp")]
        chapter["found"] = [left.pop(key) for key in named]
        for key in sorted(left):
            if any(key.startswith(prefix) for prefix in chapter.get("rest_of", [])):
                chapter["found"].append(left.pop(key))
    if left:
        raise SystemExit("no chapter for: " + ", ".join(sorted(left)))
    return known


def index_markdown(found_chapters, pages):
    text = (HERE / "index.md").read_text()
    if Path("build/live/index.html").exists():
        live = "[The live page](../live/index.html) computes motions of a machine in the browser."
        text = text.replace("## The folders", live + "\n\n## The folders")
    parts = [text, folder_map(pages)]
    for chapter in found_chapters:
        if not chapter["found"]:
            continue
        if chapter.get("after_results"):
            parts += [claims_section(), deviations_section()]
        parts.append(f"## {chapter['title']}\n\n{chapter['introduction'].strip()}\n")
        parts.append("\n".join(f"- {link(page)} `{page.key}`" for page in chapter["found"]))
        parts.append(gallery([(page.file, page.title, name) for page in chapter["found"]
                              for name in page.figures()], SHOWN))
    return "\n\n".join(parts)


def search_words(pages):
    """What the search box looks through: title, name and the comments of each page."""
    entries = []
    for page in pages:
        words = " ".join(match[1] for text in page.text.values() for match in COMMENT.finditer(text))
        entries.append({"title": page.title, "file": page.file, "name": page.key,
                        "text": re.sub(r"\s+", " ", words).strip()})
    return "const pages = " + json.dumps(entries, ensure_ascii=False, indent=0) + ";\n"


def navigation(order, k):
    """Back, index, on."""
    before = f'<a href="{order[k - 1].file}">← {html.escape(order[k - 1].title)}</a>' if k else ""
    after = (f'<a href="{order[k + 1].file}">{html.escape(order[k + 1].title)} →</a>'
             if k + 1 < len(order) else "")
    return f'<span>{before}</span><a href="index.html">Index</a><span>{after}</span>'


def main(output):
    pages = all_pages()
    found = chapters(pages)
    order = [page for chapter in found for page in chapter["found"]]
    for name in REPOSITORY_FILES:
        output.copy(HERE / name)
    output.write("pages.js", search_words(order).encode())

    def weave(k):
        page = order[k]
        convert(output, page.file, page_markdown(page, pages, output), page.title, navigation(order, k))

    with ThreadPoolExecutor() as pool:
        list(pool.map(weave, range(len(order))))
    back = '<a href="index.html">Index</a>'
    convert(output, "list_of_deviations.html", with_names(Path("data/generated/deviations.md").read_text()),
            "Deviations", back, cited=True)
    for text, title in (("paper/guide.md", "A study of one's own"), ("paper/varying_compliance.md", "Varying compliance"),
                        ("data/generated/cage.md", "What a cage ratio of 1/2 hides")):
        text = Path(text)
        linked = re.sub(r"\((varying_compliance|cage)\.md\)", r"(\1.html)", text.read_text())
        convert(output, text.stem + ".html", with_files(linked), title, back, cited=True)
    convert(output, "index.html", index_markdown(found, pages), "Contents")
    output.remove_others()
    (output.path / "index.html").touch()


if __name__ == "__main__":
    main(Folder(Path(sys.argv[1])))
