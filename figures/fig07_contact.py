"""Figure 7: evolution of the contact with speed, data set 1

Paper: §3.3, Fig. 7 (black = contact, white = none), claims C4 to C7 and C10.
Usage: /usr/bin/python3 figures/fig07_contact.py data/generated/fig07_contact.tsv fig07_contact.svg
"""

from contact_map import draw
from tables import run

run(draw)
