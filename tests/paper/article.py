"""The article's source holds no typed number: no digit outside generated values, equations, headings, code and references to
equations, figures, tables, sections, data sets, claims and deviations, and no number in words with a unit. At least twenty
cited references have a DOI; the others say that none was confirmed. A caption says what its figure shows: eight words or more,
and every figure and table has one. The article as it is read, with its numbers: at most 5,500 words with captions, tables and
references apart; nine figures; an abstract of 180 words with 12 numbers; keywords; no name beside a citation that repeats it.
"""
import re
import sys
from pathlib import Path

SOURCE, REFERENCES = Path("paper/article.md"), Path("paper/references.bib")
READ = Path("data/generated/article.md")
MOST = {"words": 5500, "figures": 9, "words of the abstract": 180, "numbers of the abstract": 12}
ALLOWED = [
    r"(?s)\A---\n.*?^---\n",                      # the head
    r"(?s)\{\{.*?\}\}",                           # generated
    r"(?s)\$\$.*?\$\$", r"\$[^$\n]+\$",           # equations
    r"^#+ .*$",                               # headings
    r"`[^`]*`", r"<!--.*?-->",
    r"\[[^\]@]*@[^\]]*\]", r"(?<!\w)@\w+", r"\]\([^)]*\)",  # citations, links
    r"\b(?:Eqs?|Figs?|Figures?)\.? \d+(?:[a-f]?(?:(?:,| and| to) \d+[a-f]?)*)",
    r"\b[Ss]et [12]\b", r"\bc = 1/2",               # the two data sets; the paper's cage
    r"§\d(?:\.\d)?", r"\bTable \d", r"\bD-\d\d\b", r"\bC\d+\b",
    r"\^1\.5\^",                              # the unit of K_H
    r"\bAUTO-07p\b",
]


WORDS = "two three four five six seven eight nine ten twelve fifteen twenty thirty forty fifty sixty eighty hundred thousand".split()
NUMBER = re.compile(rf"(?<![\w.])\d[\d.,]*\d|(?<![\w.])\d|\b(?:{'|'.join(WORDS)})\b")
UNITS = "%|per cent|Hz|mm|µm|kg|N|kN|s|seconds|degrees(?! of)|harmonics|times (?:faster|slower)"
TYPED = re.compile(rf"\b(?:{'|'.join(WORDS)})[ -](?:{UNITS})(?!\w)", re.IGNORECASE)


def references(text):
    """Cited keys that are missing, or have neither DOI nor a note; and too few with one."""
    entries = {entry[1]: entry[0] for entry in
               re.finditer(r"^@\w+\{(\w+),.*?^\}", REFERENCES.read_text(encoding="utf-8"),
                           re.MULTILINE | re.DOTALL)}
    cited = sorted(set(re.findall(r"(?<!\w)@(\w+)", text)))
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


def plain(text):
    """The words that are read, with captions: without head, tables, equations, addresses and references."""
    text = text.partition("\n---\n")[2].partition("\n## References")[0]
    for pattern, instead in ((r"(?s)\$\$.*?\$\$", ""), (r"\$[^$\n]+\$", "x"), (r"(?m)^\|.*$", ""), (r"(?m)^:::.*$", ""), (r"\]\([^)]*\)", "]")):
        text = re.sub(pattern, instead, text)
    return text


def counts(text):
    """What has a limit, counted in the article with its numbers."""
    abstract = re.search(r"## Abstract\n(.*?)\*\*Keywords:\*\* \w", text, re.DOTALL)[1]
    return {"words": len(plain(text).split()), "figures": len(re.findall(r"^!\[", text, re.MULTILINE)),
            "words of the abstract": len(abstract.split()), "numbers of the abstract": len(NUMBER.findall(abstract))}


def too_many(text):
    for what, number in counts(text).items():
        if number > MOST[what]:
            yield f"{READ}: {number} {what}, at most {MOST[what]}"


def doubled(text):
    """A name before a citation in brackets that says it again: `Fukata et al. [@fukata1985]`."""
    for name, key in re.findall(r"(\w+)(?: et al\.| and \w+)? \[@([a-z]+)\d", text):
        if name.lower() == key:
            yield f"{SOURCE}: {name} is named twice; @{key} names it"


def main():
    read = READ.read_text(encoding="utf-8")
    text = SOURCE.read_text(encoding="utf-8")
    bare = [*references(text), *captions(text), *doubled(text), *too_many(read)]
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])  # noqa: E731
    for pattern in ALLOWED:
        text = re.sub(pattern, blank, text, flags=re.MULTILINE)
    faults = [f"{SOURCE}:{number}: {line.strip()}"
              for number, line in enumerate(text.splitlines(), 1) if re.search(r"\d", line) or TYPED.search(line)]
    for fault in [*faults, *bare]:
        print(fault, file=sys.stderr)
    values = len(re.findall(r"\{\{", SOURCE.read_text(encoding="utf-8")))
    print(f"{counts(read)}, {values} generated values, {len(faults)} typed numbers")
    return 1 if faults or bare or values < 30 else 0


if __name__ == "__main__":
    sys.exit(main())
