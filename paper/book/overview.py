"""The parts of the index that are made from results: small figures, verdicts, deviations."""
import html
import re
from pathlib import Path

READINGS = {"exchanged": Path("data/generated/claims.tsv"),
            "printed": Path("data/generated/as-printed/claims.tsv")}
DEVIATIONS = Path("data/generated/deviations.md")


def gallery(shown, figures):
    """The figures of a chapter, small, each leading to its page: (page, its title, figure)."""
    if not shown:
        return ""
    pictures = "".join(
        f'<a href="{page}" title="{html.escape(title)}"><img src="figures/{name}.svg" '
        f'alt="{html.escape(figures[name]["alt"])}"></a>' for page, title, name in shown)
    return f'```{{=html}}\n<p class="gallery">{pictures}</p>\n```'


def rows(path):
    """The named cells of a table of words."""
    lines = [line.split("\t") for line in path.read_text(encoding="utf-8").splitlines()
             if line and not line.startswith("#")]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def claims_section():
    """What the paper claims, what we find, and the verdict for each reading of Table 1."""
    exchanged, printed = (rows(path) for path in READINGS.values())
    lines = [[row["id"], row["claim"], row["ours"], row["verdict"], row["range"], other["verdict"]]
             for row, other in zip(exchanged, printed)]
    head = "".join(f"<th>{name}</th>" for name in
                   ("", "the paper says", "we find", "exchanged reading", "over the accepted machines", "printed reading"))
    body = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in line) + "</tr>"
                   for line in lines)
    return ("## Claims\n\nEach claim of the paper, with what the tables say of it (exchanged reading) and "
            "the verdict for both readings of Table 1. The paper prints no masses: the column beside the verdict says for "
            "which of the machines that its text admits the verdict holds, m_s being the stator's mass. The rules were "
            "written down before the results.\n\n"
            f'```{{=html}}\n<table class="claims"><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>'
            "\n```")


def deviations_section():
    """The entries of the page of deviations, each a link."""
    entries = re.findall(r"^## (D-\d\d) (.*)$", DEVIATIONS.read_text(encoding="utf-8"), re.MULTILINE)
    return ("## Deviations\n\nWhere the paper cannot be followed as printed, or leaves something out; each "
            "entry has what is printed, what is done here, the evidence and the effect.\n\n"
            + "\n".join(f"- [{key}](list_of_deviations.html#{key.lower()}) {title}" for key, title in entries))
