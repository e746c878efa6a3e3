"""Normalised derivatives with respect to what the paper leaves out, from the table of the sensitivity.

By what power of an unpublished parameter each output changes at the default: 0 says that the paper could leave it out.
The difference is between the nearest values on both sides of the default where the output exists; on one side only,
the default itself stands for the other.

Usage: figures/sensitivity_derivatives.py SENSITIVITY.tsv > sensitivity_derivatives.tsv
"""
import sys

import numpy as np
from project import source_line
from tables import Table, print_columns

BALANCED = ("f_peak", "amp_peak", "amp_x_13p4_aft", "amp_y_13p4_aft")
INTEGRATED = ("f_peak", "amp_peak", "f_loss_first", "f_loss_last", "amp_x_13p4", "amp_y_13p4")
OUTPUTS = (*INTEGRATED, "amp_x_13p4_aft", "amp_y_13p4_aft")
ENTERED = {"samples": BALANCED, "step": INTEGRATED}  # by the other parameters all
ERRORS = {"f_loss_first": "error_f_loss_first", "f_loss_last": "error_f_loss_last",
          "amp_x_13p4": "error_x_13p4", "amp_y_13p4": "error_y_13p4"}
COLUMNS = [
    ("parameter", "word", "mass: m_s + m_r; mass_ratio: m_r/m_s at the default m_s + m_r; cage_ratio: "
     "omega_cage/omega; samples: N; step: longest h of rk4"),
    ("output", "word", "a column of sensitivity.tsv"),
    ("derivative", "-", "d ln(output)/d ln(parameter) at the default"),
    ("uncertainty", "-", "from the errors of loss of contact and of the mean over periods"),
    ("low", "see unit", "value of the parameter at one end of the difference"),
    ("high", "see unit", "and at the other"), ("unit", "word", "of the parameter")]


def derivative(rows, output):
    """Slope, its uncertainty and the two values of the parameter; None where there is no pair."""
    known = np.flatnonzero(rows[output] >= 0)
    at = int(np.flatnonzero(rows["default"] == 1)[0])
    low, high = max(known[known < at], default=at), min(known[known > at], default=at)
    if at not in known or low == high:
        return None
    ends = rows["value"][[low, high]]
    if output not in ENTERED.get(rows.first("parameter"), OUTPUTS):
        return 0, 0, *ends
    values, span = rows[output][[low, high]], np.log(ends[1] / ends[0])
    errors = rows[ERRORS[output]][[low, high]] if output in ERRORS else np.zeros(2)
    return np.log(values[1] / values[0]) / span, (errors / values).sum() / span, *ends


def main(file):
    table = Table(file)
    print("# Normalised derivatives with respect to what the paper leaves out")
    print(source_line())
    print(f"# modelled: nothing; {file}")
    print_columns(COLUMNS)
    for parameter in dict.fromkeys(table["parameter"]):
        rows = table.where("parameter", parameter)
        for output in OUTPUTS:
            found = derivative(rows, output)
            if found:
                print("\t".join([parameter, output, *(f"{cell:.15g}" for cell in found), rows.first("unit")]))


if __name__ == "__main__":
    main(*sys.argv[1:])
