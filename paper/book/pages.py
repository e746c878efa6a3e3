"""Writes the pages of the book in MyST Markdown, from which Sphinx makes HTML (conf.py).

Every program, every module of src/ (header and implementation together) and every entry [text] of chapters.toml is
a page. Comments with a heading or an equation become text; the other lines are shown with their numbers. Equations,
deviations, claims and names of src/ are linked to where they stand, and from there to where they are used. A page
that would be the same keeps its date, so that Sphinx renders only what changed.

Usage: pages.py FOLDER_OF_MARKDOWN FOLDER_OF_HTML   (from the project's root)
"""
import html
import inspect
import json
import os
import re
import sys
import tomllib
from collections import defaultdict
from pathlib import Path

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_by_name

OUT, RENDERED, DRAWN = Path(sys.argv[1]), Path(sys.argv[2]), Path("figures/generated")
CONTENTS, FIGURES = (tomllib.loads(Path(f"paper/book/{name}.toml").read_text("utf-8")) for name in ("chapters", "figures"))
PAGES = {page: [Path(file) for file in files] for page, files in CONTENTS["text"].items()}
for source in sorted(Path("src").rglob("*.?pp"), reverse=True):  # x.hpp before x.cpp
    PAGES.setdefault("-".join(source.relative_to("src").with_suffix("").parts), []).append(source)
TEXTS = {file.name: page for page, files in PAGES.items() for file in files if file.suffix == ".md"}
PROSE = {".hpp": re.compile(r"^/\*\*(?=\s*#|(?:(?!\*/).)*?\$\$)(.*?)\*/[ \t]*\n", re.M | re.S),
         ".py": re.compile(r'\A"""(.*?)"""\n', re.S), ".gp": re.compile(r"\A((?:#.*\n)+)"), ".md": re.compile(r"\A(.*)\Z", re.S)}
PROSE[".cpp"] = PROSE[".hpp"]
EQUATION = re.compile(r"\$\$((?:(?!\$\$).)*?)\\tag\{([^}]*)\}((?:(?!\$\$).)*?)\$\$", re.S)
MARK = r"\bEqs?\. ?\d+|\bEqs \d+(?:(?:, | and | to |-)\d+)*|\bD-\d\d\b|(?<!class )\bC(?:1[0-4]|[1-9])\b"
INLINE = re.compile(r"(?P<kept>^ *(?P<fence>`{3,}).*?^ *(?P=fence)$|^(?:    |#)[^\n]*|\$\$.*?\$\$|\$[^$\n]+\$|\[[^]]*\]\([^)]*\)|<[^>\n]*>)"
                    rf"|`(?P<name>\w{4,})`|(?P<code>`[^`]*`)|(?P<mark>{MARK})|(?P<cite>\[@\w+\]|(?<!\w)@\w+)"
                    r"|(?<![\w\\])(?P<letter>[A-Za-zΑ-Ωα-ω])_(?P<index>\w+)", re.S | re.M)
DECLARED = re.compile(r"(?:^/\*\* ?((?:(?!\*/).)*?)\*/\n)?(?:^template.*\n)?^(?:(?:struct|class|enum class) (\w+)\b(?![;\w])"
                      r"|(?!namespace|using|return|extern|static)[A-Za-z][\w:<>,&* ]*[ &*](\w+)\()", re.M | re.S)
NAMES, CITED, USERS, SHOWN, MADE = defaultdict(dict), defaultdict(set), defaultdict(set), set(), {}
for page, files in PAGES.items():
    for header in (file for file in files if file.suffix == ".hpp"):
        for comment, kind, function in DECLARED.findall(header.read_text("utf-8")):
            NAMES[kind or function].setdefault(page, re.split(r"[.;:](?: |$)", " ".join(comment.split()))[0])
PLACES = defaultdict(lambda: "marks", {f"eq-{n}": page for page, files in PAGES.items() for file in files
                                       for found in EQUATION.findall(file.read_text("utf-8")) for n in re.findall(r"\d+", found[1])})


def a(page, text, mark=""):
    return f'<a href="{page}.html{mark and "#" + mark}">{text}</a>'


def marks(text, page):
    """Eqs 3 and 4, D-09, C8: each a link to its place."""
    def one(found):
        key = found[0].lower() if found[0][0] in "DC" else "eq-" + re.search(r"\d+", found[0])[0]
        CITED[key].add(page)
        where = {"d": "list_of_deviations", "c": "results"}.get(key[0]) or PLACES[key]
        return found[0] if where == page and key[0] != "d" else a(where, found[0], key)
    return re.sub(r"(?:Eqs?\.? ?)?\d+" if text.startswith("Eq") else r".+", one, text)


def choice(name, page):
    """The page that declares a name: this one, one of the same room, or the only one."""
    rooms = [p for p in NAMES.get(name, {}) if p == page] or [p for p in NAMES.get(name, {}) if p.split("-")[0] == page.split("-")[0]]
    found = rooms or list(NAMES.get(name, {}))
    return found[0] if len(found) == 1 else None


def named(match, page):
    """A name of src/ in highlighted code: a link to its declaration, there one to its users."""
    where = choice(match["n"], page)
    if not where:
        return match[0]
    if where != page:
        USERS[where, match["n"]].add(page)
        return a(where, match[0], f"name-{match['n']}")
    if (page, match["n"]) in SHOWN:
        return a(page, match[0], f"name-{match['n']}")
    SHOWN.add((page, match["n"]))
    return f'<a id="name-{match["n"]}" href="names-{page.split("-")[0]}.html#{match["n"]}">{match[0]}</a>'


def code(file, text, line, page):
    line, text = line + len(text) - len(text.lstrip("\n")), text.strip("\n")
    if not text:
        return ""
    shown = highlight(text, get_lexer_by_name({".py": "python", ".gp": "gnuplot"}.get(file.suffix, "cpp")), HtmlFormatter(lineanchors=file.suffix[1:], linenostart=line))
    if file.suffix in (".cpp", ".hpp"):
        shown = re.sub(r'(?<!\.</span>)(?<!std</span><span class="o">::</span>)(?<!-&gt;</span>)<span class="(?:n|nf)">(?P<n>[a-z]\w+)</span>(?=<span class="p">\()|'
                       r'<span class="(?:n|nc)">(?P<t>[A-Z]\w+)</span>', lambda m: named({"n": m["n"] or m["t"], 0: m[0]}, page), shown)
        shown = re.sub(r'(?<=<span class="c[1m]">).*?(?=</span>)', lambda m: re.sub(MARK, lambda n: marks(n[0], page), m[0]), shown, flags=re.S)
    shown = re.sub(r'<a id="(\w+-(\d+))" name="[^"]*"(?: href="[^"]*")?></a>',
                   r'<a class="line" id="\1" href="#\1" data-line="\2" aria-label="line \2" tabindex="-1"></a>', shown)
    return f"``````{{raw}} html\n{shown}``````"


def inline(text, page):
    """Text with its links: to equations, names, references and other pages; x_r as it is printed."""
    def one(found):
        if found["mark"]:
            return marks(found["mark"], page)
        if found["name"]:
            where = choice(found["name"], page)
            return a(where, found[0], f"name-{found['name']}") if where and where != page else found[0]
        if found["cite"]:
            return f"{{cite:{'p' if found[0][0] == '[' else 't'}}}`{found[0].strip('[@]')}`"
        return f"{found['letter']}<sub>{found['index']}</sub>" if found["letter"] else found[0]

    def numbered(found):
        keys = [f"eq-{n}" for n in re.findall(r"\d+", found[2])]
        places = "".join(f'<span id="{key}"></span>' for key in keys)
        return (f"\n<div>{places}</div>\n\n\\begin{{equation*}}\n{(found[1] + found[3]).strip()} \\tag{{{found[2]}}}\n\\end{{equation*}}\n\n"
                f'<p class="cited">Where used: {", ".join(a("marks", f"Eq. {key[3:]}", key) for key in keys)}</p>\n\n')
    return EQUATION.sub(numbered, INLINE.sub(one, text))


def relinked(text, file):
    def one(found):
        path, hash_mark, place = found[1].partition("#")
        known = [p for p in (file.parent / path, DRAWN / Path(path).name, Path(path)) if path and p.is_file()]
        if Path(path).name in TEXTS:
            return f"]({TEXTS[Path(path).name]}.md{hash_mark}{place})"
        return f"]({os.path.relpath(known[0], OUT)})" if known else found[0]
    text = re.sub(r"\]\((?!http)([^)\s]+)\)", one, text)
    text = re.sub(r'^```\{\.(\w+) (?:file|append)="([^"]+)"\}$', r"```{code-block} \1\n:caption: \2", text, flags=re.M)
    text = re.sub(r"^## (D-\d\d) .*$", lambda m: f'<div id="{m[1].lower()}"></div>\n\n{m[0]}\n\n<p class="cited">'
                  f'{a("marks", "Where it is cited", m[1].lower())}</p>', text, flags=re.M)
    return re.sub(r"^\| (C\d+) \|", lambda m: f'| <a id="{m[1].lower()}" href="marks.html#{m[1].lower()}">{m[1]}</a> |', text, flags=re.M)


def parts(file, page):
    """Text and code of a file in their order, the text first that tells what it is."""
    text, at, begun = file.read_text("utf-8"), 0, False
    for found in [*PROSE[file.suffix].finditer(text), None]:
        block = code(file, text[at:found.start() if found else None], text.count("\n", 0, at) + 1, page)
        if block:
            yield block if begun else f"## {file}\n\n{block}"
            begun = True
        if found:
            prose, at = found[1], found.end()
            if file.suffix in (".py", ".gp"):
                prose = "# " + re.sub(r"^# ?", "", prose, flags=re.M)
            prose = re.sub(r"^(Usage|Run): ([^`\n]+(?:\n +.+)*)", r"\1:\n\n```\n\2\n```", inspect.cleandoc(prose), flags=re.M)
            yield inline(relinked(prose, file), page) + "\n"


def figure(name):
    script = next(Path("figures").glob(f"{name}.*"))
    return (f"```{{figure}} {os.path.relpath(DRAWN, OUT)}/{name}.svg\n:alt: {json.dumps(FIGURES.get(name, {}).get('alt', name))}\n:target: _images/{name}.svg\n\n"
            f"Drawn by [{script}]({os.path.relpath(script, OUT)}).\n```")


def computed(name, page):
    """Command, time and what was modelled; what differs from the paper; the first rows of the table."""
    shown = FIGURES.get(name, {})
    table = next((f for f in (Path(f"data/{w}/{shown.get('table', name)}.tsv") for w in ("reference", "generated")) if f.exists()), None)
    lines = table.read_text("utf-8").splitlines() if table else []
    told = [line[2:] for line in lines if re.match(r"# (?!source|compiler|column|panel|event)", line)][:24]
    rows = [[f"{float(cell):.5g}" if re.match(r"-?\d+\.\d{5}", cell) else cell for cell in line.split("\t")] for line in lines if line[:1] != "#"][:5]
    grid = ["| " + " | ".join(row) + " |" for row in [*rows[:1], ["---"] * len(rows[0]), *rows[1:]]] if rows else []
    command = shown.get("command", f"make figures/generated/{name}.svg")
    return (f"## How {name} was computed\n\n`{command}`" + (f" takes {shown['time']}." if "time" in shown else "") + " The table says what was modelled:\n\n```\n"
            + "\n".join(told) + "\n```\n\n### What differs from the paper\n\n" + inline(shown.get("differs", "The paper has no such figure."), page)
            + (f"\n\n### The table\n\nThe first rows of [{table.name}]({os.path.relpath(table, OUT)}):\n\n" + "\n".join(grid) if table else ""))


def page_text(page):
    texts = [part for file in PAGES[page] for part in parts(file, page)]
    drawn = [n for n in sorted(f.stem for f in DRAWN.glob("*.svg")) if FIGURES.get(n, {}).get("page", n) == page]
    if drawn:
        heading, _, told = texts[0].partition("\n")
        texts = [heading, *map(figure, drawn), told, *(computed(name, page) for name in drawn), *texts[1:]]
    return "\n\n".join(texts)


def toctree(pages, *options):
    return "\n".join(["```{toctree}", *options, "", *pages, "```"])


def chapter_text(chapter):
    pictures = "".join(f'<a href="{page}.html"><img src="_images/{name}.svg" alt="{html.escape(FIGURES.get(name, {}).get("alt", name))}"></a>'
                       for page in chapter["pages"] for name in sorted(f.stem for f in DRAWN.glob("*.svg"))
                       if FIGURES.get(name, {}).get("page", name) == page)
    return f"# {chapter['title']}\n\n{chapter['introduction']}\n{toctree(chapter['pages'], ':maxdepth: 1')}\n\n" + (
        f'<div class="gallery">{pictures}</div>\n' if pictures else "")


def links(pages):
    return ", ".join(a(page, re.search(r'^# (.+)', MADE[page], re.M)[1]) for page in sorted(pages))


def names_text(room):
    rows = [f'| <span id="{name}"></span>{a(page, f"<code>{name}</code>", f"name-{name}")} | {told.replace("|", "&#124;")} '
            f"| {links(USERS[page, name])} |" for page, name, told in sorted((p, n, NAMES[n][p]) for p, n in SHOWN if p.split("-")[0] == room)]
    return "\n".join([f"# Names of {room}", "", "| name | what it is | used by |", "|---|---|---|", *rows])


def marks_text():
    def row(key):
        where = {"d": "list_of_deviations", "c": "results"}.get(key[0]) or PLACES[key]
        name = key.upper() if key[0] in "dc" else f"Eq. {key[3:]}"
        return f'| <span id="{key}"></span>{name if where == "marks" else a(where, name, key)} | {links(CITED[key])} |'
    keys = sorted(set(PLACES) | set(CITED), key=lambda k: ("edc".index(k[0]), int(re.search(r"\d+", k)[0])))
    return "\n".join(["# Equations, deviations and claims: where they are used", "", "| | used in |", "|---|---|", *map(row, keys)])


def main():
    made = MADE
    made |= {page: page_text(page) for page in PAGES}
    rooms = list(dict.fromkeys(page.split("-")[0] for page, _ in sorted(SHOWN) if "-" in page))
    made |= {f"names-{room}": names_text(room) for room in rooms} | {"marks": marks_text()}
    left, chapters = dict.fromkeys(made), CONTENTS["chapter"]
    for chapter in chapters:
        named = [page for page in chapter.get("pages", []) if page in left] + [
            page for page in sorted(left) if page not in chapter.get("pages", []) and page.startswith(tuple(chapter.get("rest_of", ["//"])))]
        chapter["pages"] = [page for page in named if left.pop(page, page) is None]
    if left:
        sys.exit("no chapter for: " + ", ".join(left))
    chapters = [chapter for chapter in chapters if chapter["pages"]]
    made |= {f"chapter-{number}": chapter_text(chapter) for number, chapter in enumerate(chapters, 1)}
    live = '- <a href="../live/index.html">The live page</a> computes motions in the browser\n\n' if Path("build/live/index.html").exists() else ""
    made["index"] = Path("paper/book/index.md").read_text("utf-8") + live + toctree(
        [f"chapter-{number}" for number in range(1, len(chapters) + 1)], ":hidden:", ":titlesonly:")
    made["contents"] = "\n".join(re.search(r"^# .+", text, re.M)[0] for text in made.values())
    OUT.mkdir(parents=True, exist_ok=True)
    for file in OUT.glob("*.md"):
        if file.stem not in made:
            file.unlink()
            (RENDERED / f"{file.stem}.html").unlink(missing_ok=True)
    for page, text in made.items():
        file = OUT / f"{page}.md"
        if not file.exists() or file.read_text("utf-8") != text:
            file.write_text(text, "utf-8")


main()
