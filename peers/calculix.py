"""Matrices of CalculiX as Matrix Market files.

A job with `*FREQUENCY, SOLVER=MATRIXSTORAGE` writes JOB.mas and JOB.sti, lines of row, column and value of the upper
triangle, and JOB.dof, the node and direction of each row. Elements with incompatible modes (C3D8I) export other matrices
than they are solved with; C3D8, C3D20 and the tetrahedra do not. The table lists which degree of freedom each row is: 12.2
is y of node 12.

Usage: peers/calculix.py JOB FOLDER > dofs.tsv
"""
import sys
from pathlib import Path


def converted(source, target):
    """The upper triangle of the one as the lower triangle of the other; the number of rows."""
    entries = [line.split() for line in source.read_text(encoding="utf-8").splitlines() if line.strip()]
    size = max(int(column) for _, column, _ in entries)
    target.write_text(f"%%MatrixMarket matrix coordinate real symmetric\n{size} {size} {len(entries)}\n"
                      + "".join(f"{column} {row} {value}\n" for row, column, value in entries), encoding="utf-8")
    return size


def main(job, folder):
    Path(folder).mkdir(exist_ok=True)
    sizes = {converted(Path(f"{job}.{suffix}"), Path(folder, f"{name}.mtx")) for suffix, name in (("mas", "M"), ("sti", "K"))}
    places = Path(f"{job}.dof").read_text(encoding="utf-8").split()
    if sizes != {len(places)}:
        sys.exit(f"{job}: {len(places)} degrees of freedom, and matrices of {sorted(sizes)} rows")
    print("row\tnode\tdirection")
    for row, place in enumerate(places, 1):
        print(row, *place.split("."), sep="\t")


if __name__ == "__main__":
    main(*sys.argv[1:])
