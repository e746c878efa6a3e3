"""Parametric study of clearance and contact stiffness (C11).

The paper announces such studies and shows none. Response curves of many machines, set 1 with other clearances and contact
stiffnesses, are computed by `explore map` with six harmonics (studies/clearance_stiffness.yaml). The speed of the peak hardly
moves; contact is lost in a band that grows with the clearance; and the larger the clearance and the stiffer the contact, the more
speeds have no solution with so few harmonics. This program gives the columns the names that figure and claims read.

Usage: studies/clearance_stiffness.py MAP.tsv > clearance_stiffness.tsv
"""
import sys
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from tables import Table, print_columns  # noqa: E402

COLUMNS = [
    ("delta", "m", "radial clearance", "bearing.radial_clearance_m"),
    ("K_H", "N/m^1.5", "contact stiffness", "bearing.contact_stiffness_N_per_m1p5"),
    ("f_peak", "Hz", "speed of the largest x_r; -1 without any solution", "peak_frequency"),
    ("amp_peak", "m", "half peak-to-peak of x_r there", "peak"),
    ("f_loss_first", "Hz", "first speed at which contact is lost; -1 when never", "loss_first"),
    ("f_loss_last", "Hz", "last such speed; -1 when never", "loss_last"),
    ("largest_force", "N", "largest force on one ball over all speeds", "largest_load"),
    ("missed", "-", "speeds without a solution", "missed")]


def main(file):
    table = Table(file)
    kept = [line for line in table.header.split("\n") if not line.startswith(("# Map", "# row keys", "# column"))]
    print("# Clearance against contact stiffness", *kept, sep="\n")
    print_columns([column[:3] for column in COLUMNS])
    for cells in zip(*(table[source] for *_, source in COLUMNS)):
        print("\t".join(str(cell) if isinstance(cell, str) else f"{cell:.15g}" for cell in cells))


if __name__ == "__main__":
    main(*sys.argv[1:])
