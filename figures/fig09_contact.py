"""Figure 9: evolution of the contact with speed, data set 2

Paper: §3.3, Fig. 9 (black = contact, white = none), claims C8 and C13.
Usage: /usr/bin/python3 figures/fig09_contact.py data/generated/fig09_contact.tsv fig09_contact.svg
"""

from contact_map import draw
from tables import run

run(draw)
