"""Clearance against contact stiffness, walked from small clearances to large ones and back.

Along a line each solution begins from that of its neighbour. Where several exist the way decides which is found, and with it
the motion that its error is taken against. This program puts the error of the way back beside that of the way there.

Usage: studies/stiffness_border.py MAP.tsv BACK.tsv > stiffness_border.tsv
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from tables import Table  # noqa: E402


def main(there, back):
    there, back = Table(there), Table(back)
    (x, y), = there.members("keys")
    lines = len(np.unique(back[y]))
    clearance, error = (back[name].reshape(lines, -1)[:, ::-1].ravel() for name in (x, "error"))
    np.testing.assert_allclose(clearance, there[x], atol=1e-15)
    print(there.header, "# column: error_back [-] the same as error, walked from the largest clearance to the smallest", sep="\n")
    print(*there.columns, "error_back", sep="\t")
    for *cells, last in zip(*there.columns.values(), error):
        print(*(cell if isinstance(cell, str) else f"{cell:.15g}" for cell in (*cells, last)), sep="\t")


if __name__ == "__main__":
    main(*sys.argv[1:])
