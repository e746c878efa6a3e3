"""Matrices of a ROSS rotor (https://ross.readthedocs.io) as Matrix Market files.

M, K, C and G (times the speed of rotation) have the meaning that explore gives them. Bearings with clearance are left out
of the model; where nodes have six degrees of freedom (x, y, z and three rotations), an axial and a torsional spring must be
in it. ROSS's package could not be installed where this was written: what was run is an object with the same four methods.

Usage: peers/from_ross.py ROTOR.toml FOLDER   (ROTOR.toml by Rotor.save)
"""
import sys
from pathlib import Path

from scipy.io import mmwrite
from scipy.sparse import coo_matrix


def write(rotor, folder):
    Path(folder).mkdir(exist_ok=True)
    for name, matrix in (("M", rotor.M(0)), ("K", rotor.K(0)), ("C", rotor.C(0)), ("G", rotor.G())):
        mmwrite(str(Path(folder, f"{name}.mtx")), coo_matrix(matrix), symmetry="general")


if __name__ == "__main__":
    import ross
    write(ross.Rotor.load(sys.argv[1]), sys.argv[2])
