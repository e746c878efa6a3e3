"""An extension of Sphinx: every program, module, study and text is a page. Comments with a heading or an equation become text, the other
lines stand below. Equations, figures, deviations, claims and names are links; the pages marks and names-* list who uses them."""
import inspect
import re
import tomllib
from collections import defaultdict
from fnmatch import filter as matching
from pathlib import Path

from pygments import formatters, highlight, lexers
from paper.ages import age
from paper.book.animation import Table, moving
from paper.include import read_values, render

BOOK, SHOWN = (tomllib.loads(render(Path(f"paper/book/{name}.toml").read_text("utf-8"), read_values("data/generated/article.tsv"), name))
               for name in ("chapters", "figures"))
PAGES = {page: [Path(file) for file in files] for page, files in BOOK["text"].items()}
for source in sorted([*Path("src").rglob("*.?pp"), *Path("studies").rglob("*.?pp"), *Path("studies").glob("*.py")], reverse=True):  # x.hpp before x.cpp
    PAGES.setdefault("-".join(source.with_suffix("").parts[1:]), []).append(source)
TEXTS = {file.name: page for page, files in PAGES.items() for file in files if file.suffix == ".md"}
TEMPLATES = {file.stem: file.read_text("utf-8") for file in Path("paper/book").glob("*.md")}
FIGURES = {name: {"name": name, "page": name, "script": next(Path("figures").glob(f"{name}.*"), None),
                  "table": max(Path("data").glob(f"[gr]e*/{name}.tsv"), default=""), **SHOWN["default"], **SHOWN.get(name, {})}
           for name in sorted({*SHOWN, *(drawing.stem for drawing in Path("figures/generated").glob("*.svg"))} - {"default"})}
PROSE = re.compile(r'(^/\*\*(?=\s*#|(?:(?!\*/).)*?\$\$).*?\*/[ \t]*\n|\Ar?""".*?"""\n)', re.M | re.S)
MARK = r"\b(?:figure|table)\s`\w+`|\b(?:Eq|Fig|Figure|Table)s?\.? \d+(?:(?:, | and | to |-)\d+)*|\bD-\d\d\b|(?<!class )\bC(?:1[0-4]|[1-9])\b"
INLINE = re.compile(  # what has no name stays as it is
    r"^ *(?P<fence>`{3,}).*?^ *(?P=fence)$|^(?:    |#)[^\n]*|\$\$.*?\$\$|\$[^$\n]+\$|<[^>\n]*>|"
    rf"(?P<open>\[)?(?P<mark>{MARK})(?(open)\]\([^)]*\))|"
    r"(?P<words>\[[^]]*\])\((?P<path>(?!http)[^)#]+)(?P<place>[^)]*)\)|\]\([^)]*\)|"
    rf"`(?P<name>\w{{4,}})`|`[^`]*`|(?<![\w\\])(?P<letter>[A-Za-zΑ-Ωα-ω])_(?P<index>\w+)", re.S | re.M)
BLOCKS = ((r'\A/\*\* ?|\s*\*/\s*\Z|"""\s*\Z|<!-- not in the book -->[^>]*>', ""),
          (r"^# Rotor, stator and a ball .*", "# Overview"), (r'^```\{\.(\w+) \w+="([^"]+)"\}$', r"```{code-block} \1\n:caption: \2"),
          (r"\$\$([^$]*)\\tag\{(\d+)\}([^$]*)\$\$", r'\n<div id="eq-\2"></div>\n\n\\begin{equation*}\1\3\\tag{\2}\\end{equation*}'
           r'\n\n<p class="cited"><a href="marks.html#\2">Where it is used</a></p>\n\n'),
          (r"^## (D-\d\d) .*$", r'<div id="\1"></div>\n\n\g<0>\n\n<p class="cited"><a href="marks.html#\1">Where it is cited</a></p>'),
          (r'^\| <a href="results.html#(C\d+)">(?=(?:.*\|){6})', r'| <a id="\1" href="marks.html#\1">'))
FIRST = re.compile(r"(?<=\n\n)(?!Paper:|Beside the )[A-Z](?:(?!\n\n).)+?\.(?=\s+[A-Z$`<(]|\s*\n\n|\s*\Z)|\Z", re.S)  # sentence of a page
CODE = re.compile(
    r'(?P<mark>\b(?:Eq|Fig|Figure|Table)s?\.? \d+(?:(?:, | and | to |-)\d+)*|\bD-\d\d\b)|(?<!\.</span>)(?<!-&gt;</span>)(?<!std</span><span class="o">::</span>)'
    r'<span class="n[cf]?">(?:(?P<call>[a-z]\w+)</span>(?=<span class="p">\()|(?P<type>[A-Z]\w+)</span>)')
MARKED = re.compile(r"\\tag\{(\d+)\}()|^(?:## |\| )(?=D-\d\d|C\d+ (?:.*\|){6})([CD][-\d]+)[ |]+([^|\n]*)", re.M)
DECLARED = re.compile(
    r"(?:^/\*\* ?((?:(?!\*/).)*?)\*/\n)?(?:^template[^\n]*\n)?^(?:(?:struct|class|enum class) (\w+)\b(?![;\w])|"
    r"(?!namespace|using|return|extern|static)[A-Za-z][\w:<>,&* ]*[ &*](\w+)\()", re.M | re.S)
NAMES, USED = defaultdict(dict), defaultdict(set)  # {name or mark: {page: (place there, what it is)}}, {(page, name): pages}
for page, text in ((page, file.read_text("utf-8")) for page, files in PAGES.items() for file in files if file.suffix in (".hpp", ".md")):
    NAMES |= {number or mark: {page: (f"eq-{number}" if number else mark, told)} for number, _, mark, told in MARKED.findall(text)}
    for found in DECLARED.finditer(text, text.find("#pragma")) if "#pragma" in text else ():
        told = re.split(r"[.;:](?: |$)", " ".join((found[1] or "").split()))[0].replace("|", "&#124;").replace("<", "&lt;")
        NAMES[found[2] or found[3]].setdefault(page, (f"hpp-{text.count(chr(10), 0, found.end()) + 1}", told))


def named(name, text, page, here=None):
    """A link to where a name or mark stands; from `here`, its place, to its users. Of several, that of the page or its room counts."""
    places, room = NAMES.get(name, {}), page.split("-")[0]
    found = {page} & set(places) or {other for other in places if other.split("-")[0] == room} or set(places)
    for other in found if len(found) == 1 else ():
        if (other, places[other][0]) == (page, here):
            return f'<a href="names-{room}.html#{name}">{text}</a>'
        USED[other, name] |= {page} - {other}
        return f'<a href="{other}.html#{places[other][0]}">{text}</a>'
    return text


def marked(text, page):
    """Links to each equation, figure or table of a list, to a deviation or a claim."""
    def linked(found):
        name = found[1] or found[2] or found[3]
        for other in matching(PAGES, {"F": f"fig0{name}_*", "T": f"tab0{name}_*"}.get(text[0], name))[:1]:
            return found[0] if other == page else f'<a href="{other}.html">{found[0].strip("`")}</a>'
        return named(name, found[0], page)
    return re.sub(r"([CD]-?\d+)|(?:[A-Z]\w+\.? )?(\d+)|`(\w+)`", linked, text)


def code(file, text, first, page):
    """Lines with their numbers."""
    def linked(found, n):
        return marked(found[0], page) if found["mark"] else named(found["call"] or found["type"], found[0], page, f"hpp-{n}")
    kind, shown = file.suffix[1:], highlight(text.strip("\n"), lexers.get_lexer_for_filename(file.name), formatters.HtmlFormatter(nowrap=True))
    lines = [f'<a class="line" id="{kind}-{n}" href="#{kind}-{n}" data-line="{n}" aria-label="line {n}"></a>'
             + (line if kind == "py" else CODE.sub(lambda found: linked(found, n), line))
             for n, line in enumerate(shown.rstrip("\n").split("\n"), first + len(text) - len(text.lstrip("\n")))]
    return '``````{raw} html\n<div class="highlight"><pre>' + "\n".join(lines) + "</pre></div>\n``````"


def prose(text, file, page):
    """Text with its links, to equations, names, files and pages; x_r as it is printed."""
    def linked(found):
        if found["path"]:
            name, known = Path(found["path"]).name, [file.parent / found["path"], *Path("figures/generated").glob(Path(found["path"]).name)]
            return f"{found['words']}({TEXTS[name] + '.md' if name in TEXTS else f'../../{known[-1]}'}{found['place']})"
        if found["mark"] or found["name"]:
            return marked(found["mark"], page) if found["mark"] else named(found["name"], found[0], page)
        return f"{found['letter']}<sub>{found['index']}</sub>" if found["letter"] else found[0]
    text = INLINE.sub(linked, re.sub(r'\Ar?"""(.*?)\.?$', r"# \1", inspect.cleandoc(text), flags=re.M))
    for pattern, shown in BLOCKS:
        text = re.sub(pattern, shown, text.strip(), flags=re.M)
    return text


def page_text(page):
    """Text and code of its files in their order; where it shows a figure, the picture first, then how it was made."""
    parts = []
    for file in PAGES[page]:
        line, heading, text = 1, "## {}\n\n".format(re.sub("(?<=[/_])", "\u200b", str(file))), file.read_text("utf-8")  # breaks there
        for k, piece in enumerate(["", text] if file.suffix == ".md" else PROSE.split(text)):
            if piece.strip():
                parts.append(prose(piece, file, page) if k % 2 else heading + code(file, piece, line, page))
                heading *= k % 2
            line += piece.count("\n")
    for name in reversed([name for name in FIGURES if FIGURES[name]["page"] == page]):
        heading, _, told = parts[0].partition("\n")
        known = age(FIGURES[name]["table"])
        shown = FIGURES[name] | {"age": known and f", {known}"} | {key: prose(FIGURES[name][key], Path("x"), page) for key in ("caption", "differs")}
        rows = {} if shown["script"] else Table(shown["table"]).first_rows(6)
        picture = TEMPLATES["table" if rows else "drawing"].format(**shown, **rows)
        parts[0] = TEMPLATES["figure"].format(heading=heading, picture=picture, moving=moving(name), told=told, **shown)
    return "\n\n".join(parts)


def write(app):
    """All pages, those that list others last; where the contents change, which all pages show, everything anew."""
    made, rows = {page: page_text(page) for page in PAGES}, defaultdict(list)
    titles = {page: re.search(r"^# (.+)", text, re.M)[1] for page, text in made.items()}
    for (mark, _), page, name, place, told in sorted(
            ((len(name), name) if place in (name, f"eq-{name}") else (0, page + name), page, name, place, told)
            for name, pages in NAMES.items() for page, (place, told) in pages.items()):
        users = ", ".join(f'<a href="{user}.html">{titles[user]}</a>' for user in sorted(USED[page, name]))
        rows["marks" if mark else f"names-{page.split('-')[0]}"].append(
            f'| <a id="{name}" href="{page}.html#{place}">{"Eq. " * name.isdigit()}{name}</a> | {told or titles[page]} | {users} |')
    for page, listed in rows.items():
        made[page] = TEMPLATES["names"].format(of=f"Names of {page[6:]}" if page[6:] else "Equations, claims and deviations", rows="\n".join(listed))
    left = sorted(made)
    for number, chapter in enumerate(BOOK["chapter"], 1):
        pages = dict.fromkeys(page for entry in chapter["pages"] for page in ([entry] if entry[0] == "#" else matching(left, entry)))
        left = [page for page in left if page not in pages]
        listed = "\n".join(page if page[0] == "#" else f"- []({page}.md). {FIRST.search(made[page])[0]}" for page in pages)
        made[f"chapter-{number:02}"] = TEMPLATES["chapter"].format(
            title=chapter["title"], introduction=prose(chapter["introduction"], Path("x"), ""), listed=listed, pages="\n".join(filter(made.get, pages)))
    live = '- <a href="../live/index.html">The live page</a> computes motions in the browser' * Path("build/live/index.html").exists()
    made["index"] = TEMPLATES["index"].format(live=live, **FIGURES["fig03_response"])
    contents = {"contents": "\n".join(page + re.search(r"^# .+", text, re.M)[0] for page, text in made.items())}
    for file, text in ((Path(app.srcdir, f"{page}.md"), text) for page, text in {**contents, **made}.items()):
        if not file.exists() or file.read_text("utf-8") != text:
            for old in [*file.parent.glob("*.md"), *Path(app.outdir).glob("*.html")] if file.stem == "contents" else ():
                old.unlink()
            file.write_text(text, "utf-8")


def complete(app, error):
    """What Debian's furo lacks: the style and the script that it imports, and dark colours where the reader's system is dark."""
    theme, static = Path("/usr/lib/python3/dist-packages/furo/theme/furo/static"), Path(app.outdir, "_static")
    normal, style, spy, script = ((theme / file).read_text("utf-8") for file in (
        "/usr/share/javascript/normalize.css/normalize.css", "styles/furo.css", "scripts/gumshoe-patched.js", "scripts/furo.js"))
    dark = re.search(r'body\[data-theme="dark"\] (\{.*?\})', style, re.S)[1]
    (static / "styles/furo.css").write_text(f"""{normal}{style.partition(chr(10))[2]}
@media screen and (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark} }}""", "utf-8")
    (static / "scripts/furo.js").write_text(spy + script.partition("\n")[2], "utf-8")


def setup(app):
    app.connect("builder-inited", write)
    app.connect("build-finished", complete)
