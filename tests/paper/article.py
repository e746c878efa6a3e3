"""The article's source holds no typed number: no digit outside generated values, equations, headings, code and references to
equations, figures, tables, sections, data sets, claims and deviations, and no number in words with a unit. At least twenty
cited references have a DOI; the others say that none was confirmed. A caption says what its figure shows: eight words or more,
and every figure and table has one. With its numbers filled in the article keeps its length: words with captions, figures, words and
numbers of the abstract, which cites nothing; its author is that of CITATION.cff.

Usage: tests/paper/article.py   (from the project's root, after `make all`)
"""
import re
import sys
from pathlib import Path

SOURCE, REFERENCES = Path("paper/article.md"), Path("paper/references.bib")
ALLOWED = [
    r"(?s)\A---\n.*?^---\n",                      # the head
    r"(?s)\{\{.*?\}\}",                           # generated
    r"(?s)\$\$.*?\$\$", r"\$[^$\n]+\$",           # equations
    r"^#+ .*$",                               # headings
    r"`[^`]*`", r"<!--.*?-->",
    r"\[@[^\]]*\]", r"\]\([^)]*\)",           # citations, links
    r"\b(?:Eqs?|Figs?|Figures?)\.? \d+(?:[a-f]?(?:(?:,| and| to) \d+[a-f]?)*)",
    r"\b[Ss]et [12]\b", r"\bc = 1/2",               # the two data sets; the paper's cage
    r"§\d(?:\.\d)?", r"\bTable \d", r"\bD-\d\d\b", r"\bC\d+\b",
    r"\^1\.5\^",                              # the unit of K_H
    r"\bAUTO-07p\b",
]


WORDS = "two three four five six seven eight nine ten twelve fifteen twenty thirty forty fifty sixty eighty hundred thousand".split()
UNITS = "%|per cent|Hz|mm|µm|kg|N|kN|s|seconds|degrees(?! of)|harmonics|times (?:faster|slower)"
TYPED = re.compile(rf"\b(?:{'|'.join(WORDS)})[ -](?:{UNITS})(?!\w)", re.IGNORECASE)


def references(text):
    """Cited keys that are missing, or have neither DOI nor a note; and too few with one."""
    entries = {entry[1]: entry[0] for entry in
               re.finditer(r"^@\w+\{(\w+),.*?^\}", REFERENCES.read_text(encoding="utf-8"),
                           re.MULTILINE | re.DOTALL)}
    cited = sorted(set(re.findall(r"(?<=@)\w+", " ".join(re.findall(r"\[@[^\]]*\]", text)))))
    with_doi = [key for key in cited if re.search(r"^\s*doi\s*=", entries.get(key, ""), re.MULTILINE)]
    for key in cited:
        if key not in with_doi and "no DOI confirmed" not in entries.get(key, ""):
            yield f"{REFERENCES}: {key} is cited and has neither DOI nor note"
    if len(with_doi) < 20:
        yield f"{SOURCE}: {len(with_doi)} references with a DOI"


def captions(text):
    """Figures whose caption is too short to stand alone, and tables without one."""
    for caption in re.findall(r"^!\[(.*)\]\(figures/", text, re.MULTILINE):
        if len(caption.split()) < 8:
            yield f"{SOURCE}: caption '{caption}'"
    for table, after in re.findall(r"^(<!-- table:.*|\{\{table\..*)\n\n(..)", text, re.MULTILINE):
        if after != ": ":
            yield f"{SOURCE}: no caption after {table}"


LONGEST = {"words": 5500, "figures": 9, "words of the abstract": 180, "numbers of the abstract": 12}


def lengths(text):
    """What is too long in the text that is read, tables and references left out."""
    text = re.sub(r"\A---\n(?s:.*?)^---\n|^\|.*$|^## References(?s:.*)", "", text, flags=re.MULTILINE)
    abstract = re.search(r"(?s)^## Abstract\n(.*?)^\*\*Keywords", text, re.MULTILINE)[1]
    words = len(re.findall(r"(?<!\S)[^\W_]\S*|(?<!\S)\(\S+", re.sub(r"(?s)\$\$.*?\$\$|\]\([^)]*\)", "", text)))
    found = {"words": words, "figures": len(re.findall(r"^!\[", text, re.MULTILINE)), "words of the abstract": len(abstract.split()),
             "numbers of the abstract": len(re.findall(r"\d[\d.,]*", abstract))}
    print(", ".join(f"{count} {name}" for name, count in found.items()))
    for name, most in LONGEST.items():
        if found[name] > most:
            yield f"{SOURCE}: {found[name]} {name}, at most {most}"
    if "[@" in abstract:
        yield f"{SOURCE}: the abstract cites"


def authors():
    """Of the article and of CITATION.cff."""
    names = re.findall(r'^  - name: "(.*)"$', Path("CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
    if f"author: {', '.join(names)}\n" not in SOURCE.read_text(encoding="utf-8"):
        yield f"{SOURCE}: its author is not that of CITATION.cff"


def main():
    text = SOURCE.read_text(encoding="utf-8")
    bare = [*references(text), *captions(text), *authors(), *lengths(Path("data/generated/article.md").read_text(encoding="utf-8"))]
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])  # noqa: E731
    for pattern in ALLOWED:
        text = re.sub(pattern, blank, text, flags=re.MULTILINE)
    faults = [f"{SOURCE}:{number}: {line.strip()}"
              for number, line in enumerate(text.splitlines(), 1) if re.search(r"\d", line) or TYPED.search(line)]
    for fault in [*faults, *bare]:
        print(fault, file=sys.stderr)
    words = len(re.findall(r"\w+", text))
    values = len(re.findall(r"\{\{", SOURCE.read_text(encoding="utf-8")))
    print(f"{words} words, {values} generated values, {len(faults)} typed numbers")
    return 1 if faults or bare or values < 30 else 0


if __name__ == "__main__":
    sys.exit(main())
