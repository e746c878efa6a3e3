"""The stored verdicts on the claims, counted: the only place where they are.

A claim is confirmed if it is reproduced and nothing in the model was chosen so that it holds. One that
is reproduced because masses or cage were chosen so (`built_in` of data/claims.toml) counts apart.
README, article and results take their counts from `score` and their words from `in_words`.
"""
from pathlib import Path

KINDS = {"confirmed": "confirmed independently", "built_in": "reproduced by the choice of masses or cage",
         "partly": "partly reproduced", "not_reproduced": "not reproduced", "not_tested": "not tested"}


def stored(path):
    """The claims of a table, each as {column: cell}."""
    lines = [line.split("\t") for line in Path(path).read_text(encoding="utf-8").splitlines() if line[:1] != "#"]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def kind(claim):
    """Which of KINDS a stored claim is."""
    if claim["verdict"] != "reproduced":
        return claim["verdict"].replace(" ", "_")
    return "confirmed" if claim["built_in"] == "-" else "built_in"


def score(claims):
    """{kind: ids of the claims}, every claim once."""
    return {name: [claim["id"] for claim in claims if kind(claim) == name] for name in KINDS}


def listed(words):
    return " and ".join([", ".join(words[:-1])] * (len(words) > 1) + words[-1:])


def in_words(claims, ids=True):
    """`3 confirmed independently (C7, C8 and C13), ...`, without the kinds of no claim."""
    return listed([f"{len(found)} {KINDS[name]}" + f" ({listed(found)})" * ids
                   for name, found in score(claims).items() if found])


def changing(claims):
    """The claims whose verdict changes within the masses that the text admits."""
    def verdicts(claim):
        return {part.split(" for m_s")[0].split(": ")[-1] for part in claim["range"].split("; ") if " for m_s" in part}
    return [claim["id"] for claim in claims if len(verdicts(claim)) > 1]


def differing(claims, others):
    """The claims of `others` whose verdict is another one, with it."""
    return [f"{other['id']} ({other['verdict']})" for claim, other in zip(claims, others)
            if claim["verdict"] != other["verdict"]]
