"""An extension of Sphinx: every program, module, study and text is a page. Comments with a heading or an equation become text, the
other lines stand below with their numbers. Equations, deviations, claims and names are links to where they stand; the pages marks and
names-* list who uses them. A page that would be the same is left as it is."""
import inspect
import re
import tomllib
from collections import defaultdict
from pathlib import Path

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_for_filename
from paper.book.animation import moving
from paper.include import read_values, render

BOOK, SHOWN = (tomllib.loads(render(Path(f"paper/book/{name}.toml").read_text("utf-8"), read_values("data/generated/article.tsv"), name))
               for name in ("chapters", "figures"))
PAGES = {page: [Path(file) for file in files] for page, files in BOOK["text"].items()}
for source in sorted([*Path("src").rglob("*.?pp"), *Path("studies").glob("*.py")], reverse=True):  # x.hpp before x.cpp
    PAGES.setdefault("-".join(source.with_suffix("").parts[1:]), []).append(source)
TEXTS = {file.name: page for page, files in PAGES.items() for file in files if file.suffix == ".md"}
FIGURES = {name: {"page": name, "alt": name, "time": "a while", "command": f"make figures/generated/{name}.svg",
                  "table": max(Path("data").glob(f"[gr]e*/{name}.tsv"), default=""),  # reference/ before generated/
                  "script": next(Path("figures").glob(f"{name}.*")), "differs": "The paper has no such figure.", **SHOWN.get(name, {})}
           for name in sorted(drawing.stem for drawing in Path("figures/generated").glob("*.svg"))}
PROSE = re.compile(r'(^/\*\*(?=\s*#|(?:(?!\*/).)*?\$\$).*?\*/[ \t]*\n|\A""".*?"""\n)', re.M | re.S)
MARK = r"\bEqs?\. ?\d+|\bEqs \d+(?:(?:, | and | to |-)\d+)*|\bD-\d\d\b|(?<!class )\bC(?:1[0-4]|[1-9])\b"
INLINE = re.compile(  # what has no name stays as it is
    r"^ *(?P<fence>`{3,}).*?^ *(?P=fence)$|^(?:    |#)[^\n]*|\$\$.*?\$\$|\$[^$\n]+\$|<[^>\n]*>|"
    r"(?P<words>\[[^]]*\])\((?P<path>(?!http)[^)#]+)(?P<place>[^)]*)\)|\]\([^)]*\)|"
    rf"`(?P<name>\w{{4,}})`|`[^`]*`|(?P<mark>{MARK})|(?<![\w\\])(?P<letter>[A-Za-zΑ-Ωα-ω])_(?P<index>\w+)", re.S | re.M)
BLOCKS = ((r'^/\*\* ?|\s*\*/\s*\Z|"""\s*\Z', ""), (r'\A"""(.*?)\.?$', r"# \1"),
          (r'^```\{\.(\w+) \w+="([^"]+)"\}$', r"```{code-block} \1\n:caption: \2"),
          (r"\$\$([^$]*)\\tag\{(\d+)\}([^$]*)\$\$", r'\n<div id="eq-\2"></div>\n\n\\begin{equation*}\1\3\\tag{\2}\\end{equation*}'
           r'\n\n<p class="cited"><a href="marks.html#\2">Where it is used</a></p>\n\n'),
          (r"^## (D-\d\d) .*$", r'<div id="\1"></div>\n\n\g<0>\n\n<p class="cited"><a href="marks.html#\1">Where it is cited</a></p>'),
          (r'^\| <a href="results.html#(C\d+)">(?=(?:.*\|){6})', r'| <a id="\1" href="marks.html#\1">'))
CODE = re.compile(
    r'(?P<mark>\bEq\. \d+|\bD-\d\d\b)|(?<!\.</span>)(?<!-&gt;</span>)(?<!std</span><span class="o">::</span>)'
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
    return re.sub(r"(?:Eqs?\.? ?)?(\d+)" if text[0] == "E" else "(.+)", lambda found: named(found[1], found[0], page), text)


def code(file, text, first, page):
    """Lines with their numbers."""
    def linked(found, n):
        return marked(found[0], page) if found["mark"] else named(found["call"] or found["type"], found[0], page, f"hpp-{n}")
    kind, shown = file.suffix[1:], highlight(text.strip("\n"), get_lexer_for_filename(file.name), HtmlFormatter(nowrap=True))
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
            return marked(found[0], page) if found["mark"] else named(found["name"], found[0], page)
        return f"{found['letter']}<sub>{found['index']}</sub>" if found["letter"] else found[0]
    text = INLINE.sub(linked, inspect.cleandoc(text))
    for pattern, shown in BLOCKS:
        text = re.sub(pattern, shown, text.strip(), flags=re.M)
    return text


def page_text(page):
    """Text and code of its files in their order; where it shows a figure, the picture first, then how it was made."""
    parts = []
    for file in PAGES[page]:
        line, heading, text = 1, f"## {file}\n\n", file.read_text("utf-8")
        for k, piece in enumerate(["", text] if file.suffix == ".md" else PROSE.split(text)):
            if k % 2:
                parts.append(prose(piece, file, page))
            elif piece.strip():
                parts.append(heading + code(file, piece, line, page))
                heading = ""
            line += piece.count("\n")
    for name in reversed([name for name in FIGURES if FIGURES[name]["page"] == page]):
        heading, _, told = parts[0].partition("\n")
        parts[0] = Path("paper/book/figure.md").read_text("utf-8").format(**FIGURES[name] | {
            "heading": heading, "name": name, "moving": moving(name), "told": told, "differs": prose(FIGURES[name]["differs"], Path("x"), page)})
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
        title = f"# {'Names of ' + page[6:] if page[6:] else 'Equations, claims and deviations'}: where they are used\n\n"
        made[page] = title + "| | what it is | used in |\n|---|---|---|\n" + "\n".join(listed)
    left = sorted(made)
    for number, chapter in enumerate(BOOK["chapter"], 1):
        pages = [page for page in [*chapter["pages"], *left] if page in chapter["pages"] or page.startswith(tuple(chapter["rest_of"]))]
        pages = [page for page in dict.fromkeys(pages) if page in left]
        left = [page for page in left if page not in pages]
        made[f"chapter-{number}"] = f"# {chapter['title']}\n\n{chapter['introduction']}\n```{{toctree}}\n" + "\n".join(pages) + "\n```"
    live = '- <a href="../live/index.html">The live page</a> computes motions in the browser' * Path("build/live/index.html").exists()
    made["index"] = Path("paper/book/index.md").read_text("utf-8").format(chapters="\n".join(page for page in made if page[:8] == "chapter-"), live=live)
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
    (static / "styles/furo.css").write_text(normal + style.partition("\n")[2] + (
        f'@media screen and (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark} }}\n'), "utf-8")
    (static / "scripts/furo.js").write_text(spy + script.partition("\n")[2], "utf-8")


def setup(app):
    app.connect("builder-inited", write)
    app.connect("build-finished", complete)
