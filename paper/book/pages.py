"""The pages of the book in MyST Markdown, made from the sources; an extension of Sphinx.

Every program, every module of src/ and every entry [text] of chapters.toml is a page. Comments with a heading or an
equation become text, the other lines stand below with their numbers. Equations, deviations, claims and names of src/
are links to where they stand; the pages marks and names-* list who uses them. A page that would be the same is left.
"""
import inspect
import re
import shutil
import tomllib
from collections import defaultdict
from pathlib import Path

import furo
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_by_name

HERE = Path("paper/book")
BOOK, DRAWN = (tomllib.loads((HERE / f"{name}.toml").read_text("utf-8")) for name in ("chapters", "figures"))
PAGES = {page: [Path(file) for file in files] for page, files in BOOK["text"].items()}
for source in sorted(Path("src").rglob("*.?pp"), reverse=True):  # x.hpp before x.cpp
    PAGES.setdefault("-".join(source.relative_to("src").with_suffix("").parts), []).append(source)
FIGURES = {name: {"page": name, "alt": name, "table": name, "time": "a while", "command": f"make figures/generated/{name}.svg",
                  "differs": "The paper has no such figure.", **DRAWN.get(name, {})}
           for name in sorted(drawing.stem for drawing in Path("figures/generated").glob("*.svg"))}
TEXTS = {file.name: page for page, files in PAGES.items() for file in files if file.suffix == ".md"}
LANGUAGES = {".py": "python", ".gp": "gnuplot"}
PROSE = defaultdict(lambda: re.compile(r"^(/\*\*(?=\s*#|(?:(?!\*/).)*?\$\$).*?\*/[ \t]*\n)", re.M | re.S), {
    ".py": re.compile(r'\A(""".*?"""\n)', re.S), ".gp": re.compile(r"\A((?:#.*\n)+)"), ".md": re.compile(r"(?s)\A(.*)\Z")})
MARK = r"\bEqs?\. ?\d+|\bEqs \d+(?:(?:, | and | to |-)\d+)*|\bD-\d\d\b|(?<!class )\bC(?:1[0-4]|[1-9])\b"
INLINE = re.compile(  # what has no name stays as it is
    r"^ *(?P<fence>`{3,}).*?^ *(?P=fence)$|^(?:    |#)[^\n]*|\$\$.*?\$\$|\$[^$\n]+\$|<[^>\n]*>|"
    r"(?P<words>\[[^]]*\])\((?P<path>(?!http)[^)#]+)(?P<place>[^)]*)\)|\]\([^)]*\)|"
    rf"`(?P<name>\w{{4,}})`|`[^`]*`|(?P<mark>{MARK})|(?<![\w\\])(?P<letter>[A-Za-zΑ-Ωα-ω])_(?P<index>\w+)", re.S | re.M)
BLOCKS = ((r"^(Usage|Run): ([^`\n]+(?:\n +.+)*)", r"\1:\n\n```\n\2\n```"),
          (r'^```\{\.(\w+) \w+="([^"]+)"\}$', r"```{code-block} \1\n:caption: \2"),
          (r"\$\$([^$]*)\\tag\{(\d+)\}([^$]*)\$\$", r'\n<div id="eq-\2"></div>\n\n\\begin{equation*}\1\3\\tag{\2}\\end{equation*}'
           r'\n\n<p class="cited"><a href="marks.html#eq-\2">Where it is used</a></p>\n\n'),
          (r"^## (D-\d\d) .*$", r'<div id="\1"></div>\n\n\g<0>\n\n<p class="cited"><a href="marks.html#\1">Where it is cited</a></p>'),
          (r'^\| <a href="results.html#(C\d+)">(?=(?:.*\|){6})', r'| <a id="\1" href="marks.html#\1">'))
CODE = re.compile(
    r'(?P<comment><span class="c[1m]">.*?</span>)|(?<!\.</span>)(?<!-&gt;</span>)(?<!std</span><span class="o">::</span>)'
    r'<span class="n[cf]?">(?:(?P<call>[a-z]\w+)</span>(?=<span class="p">\()|(?P<type>[A-Z]\w+)</span>)')
DECLARED = re.compile(
    r"(?:^/\*\* ?((?:(?!\*/).)*?)\*/\n)?(?:^template.*\n)?^(?:(?:struct|class|enum class) (\w+)\b(?![;\w])|"
    r"(?!namespace|using|return|extern|static)[A-Za-z][\w:<>,&* ]*[ &*](\w+)\()", re.M | re.S)
NAMES, PLACES, USED = defaultdict(dict), {}, defaultdict(set)  # {name: {page: (line, what it is)}}, {mark: page}, {(page, name): pages}
for page, text in ((page, file.read_text("utf-8")) for page, files in PAGES.items() for file in files if file.suffix == ".hpp"):
    PLACES.update({f"eq-{number}": page for number in re.findall(r"\\tag\{(\d+)\}", text)})
    for found in DECLARED.finditer(text, text.find("#pragma")):
        told = re.split(r"[.;:](?: |$)", " ".join((found[1] or "").split()))[0].replace("|", "&#124;")
        NAMES[found[2] or found[3]].setdefault(page, (text.count("\n", 0, found.end()) + 1, told))


def marks(text, page):
    """Eqs 3 and 4, D-09, C8: each a link to its place."""
    def one(match):
        anchor = match[0] if match[0][0] in "DC" else "eq-" + re.search(r"\d+", match[0])[0]
        place = {"D": "list_of_deviations", "C": "results"}.get(anchor[0]) or PLACES.get(anchor, "marks")
        USED[place, anchor].add(page)
        return f'<a href="{place}.html#{anchor}">{match[0]}</a>'
    return re.sub(r"(?:Eqs?\.? ?)?\d+" if text[0] == "E" else r".+", one, text)


def named(name, text, page, number=0):
    """A link to the line that declares a name, there to its users. Of several, that of the page or its room counts."""
    pages, room = NAMES.get(name, {}), page.split("-")[0]
    found = {page} & set(pages) or {other for other in pages if other.split("-")[0] == room} or set(pages)
    for place in found if len(found) == 1 else ():
        if (place, pages[place][0]) == (page, number):
            return f'<a href="names-{room}.html#{name}">{text}</a>'
        USED[place, name].add(page)
        return f'<a href="{place}.html#hpp-{pages[place][0]}">{text}</a>'
    return text


def code(file, text, first, page):
    """Lines with their numbers."""
    def linked(found):
        name = found["call"] or found["type"]
        return named(name, found[0], page, n) if name else re.sub(MARK, lambda mark: marks(mark[0], page), found[0])
    kind, lines = file.suffix[1:], []
    shown = highlight(text.strip("\n"), get_lexer_by_name(LANGUAGES.get(file.suffix, "cpp")), HtmlFormatter(nowrap=True))
    for n, line in enumerate(shown.rstrip("\n").split("\n"), first + len(text) - len(text.lstrip("\n"))):
        lines.append(f'<a class="line" id="{kind}-{n}" href="#{kind}-{n}" data-line="{n}" aria-label="line {n}"></a>'
                     + (CODE.sub(linked, line) if kind[1:] == "pp" else line))
    return '``````{raw} html\n<div class="highlight"><pre>' + "\n".join(lines) + "</pre></div>\n``````"


def prose(text, file, page):
    """Text with its links, to equations, names, files and pages; x_r as it is printed."""
    def one(found):
        if found["path"]:
            name, known = Path(found["path"]).name, file.parent / found["path"]
            known = known if known.exists() else Path("figures/generated", name)
            return f"{found['words']}({TEXTS[name] + '.md' if name in TEXTS else f'../../{known}'}{found['place']})"
        if found["mark"] or found["name"]:
            return marks(found[0], page) if found["mark"] else named(found["name"], found[0], page)
        return f"{found['letter']}<sub>{found['index']}</sub>" if found["letter"] else found[0]
    text = re.sub(r'^/\*\* ?|\s*\*/\s*$|"""', "", text)
    text = INLINE.sub(one, inspect.cleandoc("# " + re.sub(r"^# ?", "", text, flags=re.M) if file.suffix in LANGUAGES else text))
    for pattern, shown in BLOCKS:
        text = re.sub(pattern, shown, text, flags=re.M)
    return text


def page_text(page):
    """Text and code of its files in their order; where it shows a figure, the picture first, then how it was made."""
    parts = []
    for file in PAGES[page]:
        line, heading = 1, f"## {file}\n\n"
        for k, piece in enumerate(PROSE[file.suffix].split(file.read_text("utf-8"))):
            if k % 2:
                parts.append(prose(piece, file, page))
            elif piece.strip():
                parts.append(heading + code(file, piece, line, page))
                heading = ""
            line += piece.count("\n")
    for name, shown in ((name, shown) for name, shown in FIGURES.items() if shown["page"] == page):
        table = max(Path("data").glob(f"[gr]e*/{shown['table']}.tsv"))  # reference/ before generated/
        header = re.findall(r"^# (?!source|compiler|panel|event)(.*)", table.read_text("utf-8"), re.M)
        heading, _, told = parts[0].partition("\n")
        parts[0] = (HERE / "figure.md").read_text("utf-8").format(**shown | {
            "name": name, "heading": heading, "told": told, "table": table, "header": "\n".join(header),
            "script": next(Path("figures").glob(f"{name}.*")), "differs": prose(shown["differs"], table, page)})
    return "\n\n".join(parts)


def write(app):
    """All pages, those that list others last; where the contents change, which all pages show, everything anew."""
    made, rows, chapters = {page: page_text(page) for page in PAGES}, defaultdict(list), []
    titles = {page: re.search(r"^# (.+)", text, re.M)[1] for page, text in made.items()}
    for page, name, line, told in sorted((page, name, *at) for name, pages in NAMES.items() for page, at in pages.items()):
        rows[f"names-{page.split('-')[0]}"].append((page, name, f"hpp-{line}", f"<code>{name}</code>", told))
    for place, key in sorted({*USED, *((place, key) for key, place in PLACES.items())}, key=lambda at: (at[1][0] != "e", len(at[1]), at[1])):
        if re.fullmatch(r"eq-\d+|D-\d\d|C\d+", key):
            rows["marks"].append((place, key, key, key.replace("eq-", "Eq. "), titles.get(place, "")))
    for page, listed in rows.items():
        made[page] = f"# {'Where they are used: ' + page.replace('-', ' of ')}\n\n| | what it is | used in |\n|---|---|---|\n" + "\n".join(
            f'| <a id="{anchor}" href="{place}.html#{target}">{text}</a> | {told} | ' + ", ".join(
                f'<a href="{user}.html">{titles[user]}</a>' for user in sorted(USED[place, anchor])) + " |"
            for place, anchor, target, text, told in listed)
    left = sorted(made)
    for number, chapter in enumerate(BOOK["chapter"], 1):
        named_here = [page for page in chapter.get("pages", []) if page in left]
        pages = named_here + [page for page in left if page not in named_here and page.startswith(tuple(chapter.get("rest_of", "/")))]
        left = [page for page in left if page not in pages]
        if pages:
            chapters.append(f"chapter-{number}")
            made[chapters[-1]] = f"# {chapter['title']}\n\n{chapter['introduction']}\n```{{toctree}}\n" + "\n".join(pages) + "\n```\n"
    live = '- <a href="../live/index.html">The live page</a> computes motions in the browser' if Path("build/live/index.html").exists() else ""
    made["index"] = (HERE / "index.md").read_text("utf-8").format(chapters="\n".join(chapters), live=live)
    made["contents"] = "\n".join(f"{page} {re.search(r'^# .+', text, re.M)[0]}" for page, text in made.items())
    files = {Path(app.srcdir, f"{page}.md"): text for page, text in made.items()}
    changed = {file for file, text in files.items() if not file.exists() or file.read_text("utf-8") != text}
    if Path(app.srcdir, "contents.md") in changed:
        for old in [*Path(app.srcdir).glob("*.md"), *Path(app.outdir).glob("*.html")]:
            old.unlink()
    for file in changed:
        file.write_text(files[file], "utf-8")


def complete(app, error):
    """What Debian's furo lacks: the style and the script that it imports, and dark colours where the reader's system is dark."""
    theme, static = Path(furo.__file__).parent / "theme/furo/static", Path(app.outdir, "_static")
    normal, (style, spy, script) = Path("/usr/share/javascript/normalize.css/normalize.css").read_text("utf-8"), (
        (theme / name).read_text("utf-8") for name in ("styles/furo.css", "scripts/gumshoe-patched.js", "scripts/furo.js"))
    dark = re.search(r'body\[data-theme="dark"\] (\{.*?\})', style, re.S)[1]
    system = f'@media screen and (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark} }}\n'
    (static / "styles/furo.css").write_text(normal + style.partition("\n")[2] + system, "utf-8")
    (static / "scripts/furo.js").write_text(spy + script.partition("\n")[2], "utf-8")


def setup(app):
    app.connect("builder-inited", write)
    app.connect("build-finished", complete)
