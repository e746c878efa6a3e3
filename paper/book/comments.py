"""Text made ready for pandoc: a source's comments as Markdown with the code between them as blocks, and the
pages that are Markdown already."""
import re

COMMENT = re.compile(r"^[ \t]*/\*\*(.*?)\*/[ \t]*\n", re.DOTALL | re.MULTILINE)
EQUATION = re.compile(r"\$\$(.+?)\$\$", re.DOTALL)
TAG = re.compile(r"\\tag\{([^}]*)\}")
DEVIATION = re.compile(r"\bD-(\d\d)\b")
SYMBOL = re.compile(r"(?P<whole>`[^`]*`|\$\$.*?\$\$|\$[^$]*\$)|"
                    r"(?<![\w\\])(?P<letter>[A-Za-zΑ-Ωα-ω])_(?P<index>\w+)", re.DOTALL)


def numbered(match):
    """A displayed equation with the paper's number beside it."""
    body = match[1]
    tags = TAG.findall(body)
    equation = f"$${TAG.sub('', body).strip()}$$"
    if not tags:
        return equation
    return f"\n::: equation\n{equation}\n\n[({', '.join(tags)})]{{.number}}\n:::\n"


def markdown_of(source):
    """Comments as they are, code as fenced blocks."""
    parts, at = [], 0
    for comment in COMMENT.finditer(source):
        parts += [code_block(source[at:comment.start()]), prose(comment[1])]
        at = comment.end()
    parts.append(code_block(source[at:]))
    return "\n\n".join(part for part in parts if part)


def prose(comment):
    lines = comment.strip("\n").split("\n")
    indent = min((len(line) - len(line.lstrip()) for line in lines[1:] if line.strip()), default=0)
    text = "\n".join([lines[0].strip()] + [line[indent:].rstrip() for line in lines[1:]])
    text = EQUATION.sub(numbered, SYMBOL.sub(subscripted, text))
    return DEVIATION.sub(r"[D-\1](list_of_deviations.html#d-\1)", text)


def subscripted(match):
    """x_r of the text as it is printed; code and equations stay."""
    return match[0] if match["whole"] else f"{match['letter']}~{match['index']}~"


def code_block(code):
    code = code.strip("\n")
    return f"````cpp\n{code}\n````" if code.strip() else ""


def lines_of_code(text):
    return sum(bool(line.strip()) for line in COMMENT.sub("", text).split("\n"))


def with_names(deviations):
    """Each entry can be pointed at by its number."""
    return re.sub(r"^## D-(\d\d) (.*)$", r"## D-\1 \2 {#d-\1}", deviations, flags=re.MULTILINE)


def with_files(guide):
    """The file that a block is written to stands above it."""
    return re.sub(r'^(```\{\.\w+ (file|append)="([^"]+)"\})$',
                  lambda match: f"`{match[3]}`"
                  f"{', at the end' if match[2] == 'append' else ''}:\n\n{match[1]}",
                  guide, flags=re.MULTILINE)
