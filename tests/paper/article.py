"""The article's source holds no typed number: no digit outside generated values, equations, headings,
code, the notation table, and references to equations, figures, tables, sections, claims and deviations.
Every reference that it cites is in references.bib with its DOI.

Usage: tests/paper/article.py   (from the project's root)
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
    r"§\d(?:\.\d)?", r"\bTable \d", r"\bD-\d\d\b", r"\bC\d+\b",
    r"\^1\.5\^",                              # the unit of K_H
    r"\bAUTO-07p\b",
]


def without_doi(text):
    """Cited keys whose entry is missing or has no DOI."""
    entries = {entry[1]: entry[0] for entry in
               re.finditer(r"^@\w+\{(\w+),.*?^\}", REFERENCES.read_text(encoding="utf-8"),
                           re.MULTILINE | re.DOTALL)}
    for key in sorted(set(re.findall(r"(?<=@)\w+", " ".join(re.findall(r"\[@[^\]]*\]", text))))):
        if not re.search(r"^\s*doi\s*=", entries.get(key, ""), re.MULTILINE):
            yield f"{REFERENCES}: {key} is cited and has no DOI"


def main():
    text = SOURCE.read_text(encoding="utf-8")
    bare = list(without_doi(text))
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])  # noqa: E731
    for pattern in ALLOWED:
        text = re.sub(pattern, blank, text, flags=re.MULTILINE)
    faults = [f"{SOURCE}:{number}: {line.strip()}"
              for number, line in enumerate(text.splitlines(), 1) if re.search(r"\d", line)]
    for fault in [*faults, *bare]:
        print(fault, file=sys.stderr)
    words = len(re.findall(r"\w+", text))
    values = len(re.findall(r"\{\{", SOURCE.read_text(encoding="utf-8")))
    print(f"{words} words, {values} generated values, {len(faults)} typed numbers")
    return 1 if faults or bare or values < 30 else 0


if __name__ == "__main__":
    sys.exit(main())
