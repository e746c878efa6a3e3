"""The article as HTML or as PDF, from its text with the numbers filled in.

A line `<!-- table: FILE column column … -->` becomes those columns of a table.

Usage: paper/render_article.py ARTICLE.md OUTPUT.html|OUTPUT.pdf   (from the project's root)
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from include import read_values, render

EQUATION, TAG = re.compile(r"\$\$(.+?)\$\$", re.DOTALL), re.compile(r"\\tag\{([^}]*)\}")
DEVIATION = re.compile(r"\bD-(\d\d)\b")
TABLE = re.compile(r"^<!-- table: (\S+) (.*?) -->$", re.MULTILINE)
FIGURE = re.compile(r"\]\((figures/(?:as-printed/)?\w+)\.svg\)")
DRAWN = Path("figures/generated")
MATHJAX = "../book/_static/MathJax.js?config=TeX-AMS_SVG"  # that of the book
SHOWN = tomllib.loads(render(Path("paper/book/figures.toml").read_text(encoding="utf-8"), read_values("data/generated/article.tsv"),
                             "paper/book/figures.toml"))


def table_rows(match):
    """The named columns as a table of Markdown."""
    lines = [line.split("\t") for line in Path(match[1]).read_text(encoding="utf-8").splitlines()
             if line and not line.startswith("#")]
    chosen = [lines[0].index(name) for name in match[2].split()]
    rows = [[line[k].replace("|", r"\|") for k in chosen] for line in lines]
    widths = [max(min(90, sum(len(row[k]) for row in rows) // len(rows)), *(len(word) + 3 for row in rows for word in row[k].split()))
              for k in range(len(chosen))]
    rows.insert(1, ["-" * width for width in widths])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def numbered(match):
    """A displayed equation with the paper's number beside it."""
    equation = f"$${TAG.sub('', match[1]).strip()}$$"
    tags = ", ".join(TAG.findall(match[1]))
    return f"\n::: equation\n{equation}\n\n[({tags})]{{.number}}\n:::\n" if tags else equation


def pandoc(text, *options):
    subprocess.run(["pandoc", "--from", "markdown", "--citeproc", *options], input=text, text=True,
                   check=True)


def drawings(text):
    """The figures that the article shows, by their names in the text."""
    return {name: DRAWN / f"{name.removeprefix('figures/')}.svg" for name in FIGURE.findall(text)}


def as_html(text, output):
    (output.parent / "figures").mkdir(parents=True, exist_ok=True)
    for drawing in drawings(text).values():
        shutil.copy(drawing, output.parent / "figures")
    shutil.copy("paper/article.css", output.parent)
    text = FIGURE.sub(lambda match: f'{match[0]}{{alt="{SHOWN[Path(match[1]).name]["alt"]}"}}', text)
    text = DEVIATION.sub(r"[D-\1](../book/list_of_deviations.html#D-\1)", text)
    pandoc(EQUATION.sub(numbered, text), "--to", "html5", f"--mathjax={MATHJAX}", "--standalone", "--toc",
           "--toc-depth", "2", "--template", "paper/article.html", "--output", str(output))


def as_pdf(text, output):
    """Figures as PDF, so that they stay drawings."""
    with tempfile.TemporaryDirectory() as folder:
        for name, drawing in drawings(text).items():
            target = Path(folder) / f"{Path(name).name}.pdf"
            subprocess.run(["rsvg-convert", "--format", "pdf", "--output", str(target),
                            str(drawing)], check=True)
        text = FIGURE.sub(lambda match: f"]({folder}/{Path(match[1]).name}.pdf)", text)
        pandoc(text, "--standalone", "--pdf-engine", "lualatex", "--include-in-header",
               "paper/article.tex", "--variable", "geometry:margin=16mm", "--variable",
               "fontsize=10pt", "--variable", "colorlinks=true", "--output", str(output))


def main():
    """Written beside its name, then moved into place."""
    source, output = Path(sys.argv[1]), Path(sys.argv[2])
    text = TABLE.sub(table_rows, source.read_text(encoding="utf-8"))
    beside = output.with_name(f"{output.stem}.{os.getpid()}.tmp{output.suffix}")
    try:
        (as_pdf if output.suffix == ".pdf" else as_html)(text, beside)
        beside.replace(output)
    finally:
        beside.unlink(missing_ok=True)


if __name__ == "__main__":
    main()
