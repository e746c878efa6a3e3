"""The moving picture on the page of Fig. 7: both rings in the frame of the stator, the balls coloured by load, and both orbits.

Its motions are those of Fig. 6, the ball loads Eqs 3 to 6 of the displacements there. The picture stands still without JavaScript;
animation.js moves it."""
import json
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, "figures")
from tables import Table  # noqa: E402

FRAMES, GAP, INNER, OUTER, BALL = 64, 9, 70, 116, 18.5  # frames in a turn; clearance and radii as drawn [px]
COLOURS = ["#fde725", "#5ec962", "#21918c", "#3b528b", "#440154"]
SIZE = 360


def motions(table):
    """Of each panel: speed, displacements [µm] and ball loads [N] over two turns, in one of which the cage makes half a turn."""
    n, K, delta, c = (table.value(name) for name in ("balls", "contact_stiffness", "clearance", "cage_speed_ratio"))
    for panel in np.unique(table["panel"]):
        rows = table.where("panel", panel)
        rows = rows.where("source", rows.first("shown"))
        turn = 128
        chosen = (np.arange(2 * FRAMES) * turn // FRAMES) % len(rows)
        q = np.array([rows[name][chosen] for name in ("x_r", "y_r", "x_s", "y_s")])
        angle = 2 * np.pi * (c * np.arange(2 * FRAMES)[:, None] / FRAMES + np.arange(n) / n)
        pressed = np.maximum(0, np.cos(angle) * (q[0] - q[2])[:, None] + np.sin(angle) * (q[1] - q[3])[:, None] - delta)
        yield {"f": rows.first("f"), "q": np.round(1e6 * q.T, 2).tolist(), "Q": np.round(K * pressed**1.5, 1).tolist(),
               "by": "harmonic balance" if rows.first("shown") == 1 else "time integration"}


def circle(x, y, r, **style):
    words = " ".join(f'{key.replace("_", "-")}="{value}"' for key, value in style.items())
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r}" {words}/>'


def still(motion, delta, n):
    """The first instant as SVG; y upwards on the page is negative."""
    scale, middle, x, y = GAP / delta, SIZE / 2, 540, SIZE / 2
    x_r, y_r, x_s, y_s = motion["q"][0]
    parts = [circle(middle, middle, 148, fill="#F3C4A3", stroke="#555"), circle(middle, middle, OUTER + 1.5, fill="#fff", stroke="#555")]
    load = max(map(max, motion["Q"])) or 1
    for j, Q in enumerate(motion["Q"][0]):
        angle, r = 2 * np.pi * j / n, OUTER - BALL
        parts.append(circle(middle + r * np.cos(angle), middle - r * np.sin(angle), BALL, class_="ball", stroke="#555",
                            fill=COLOURS[min(4, int(5 * Q / load))] if Q > 0 else "#fff").replace("class-", "class"))
    parts.append(circle(middle + scale * (x_r - x_s), middle - scale * (y_r - y_s), INNER, id="rotor", fill="#A8CDE6", stroke="#555"))
    span = max(abs(value) for row in motion["q"] for value in row) / 140
    for k, (name, colour) in enumerate((("r", "#0072B2"), ("s", "#D55E00"))):
        path = " ".join(f"{x + row[2 * k] / span:.1f},{y - row[2 * k + 1] / span:.1f}" for row in motion["q"])
        parts.append(f'<polygon id="orbit_{name}" points="{path}" fill="none" stroke="{colour}"{" stroke-dasharray=" + chr(34) + "6 3" + chr(34) if k else ""}/>')
        parts.append(circle(x + motion["q"][0][2 * k] / span, y - motion["q"][0][2 * k + 1] / span, 6, id=f"dot_{name}", fill=colour))
    return (f'<svg viewBox="0 0 720 {SIZE}" style="width:100%" role="img" aria-label="Inner ring, balls and outer ring at {motion["f"]:g} Hz, loaded balls '
            'coloured, beside the orbits of rotor and stator"><rect width="100%" height="100%" fill="#fff"/>' + "".join(parts) + "</svg>")


def moving(name):
    """The block of the page of Fig. 7, a link to it from Fig. 6, nothing for other figures."""
    if name == "fig06_orbits":
        return '<p><a href="fig07_contact.html#motion">These motions as an animation</a>, with the balls coloured by load.</p>\n'
    if name != "fig07_contact":
        return ""
    table = Table("data/generated/fig06_orbits.tsv")
    data, n, delta = list(motions(table)), int(table.value("balls")), 1e6 * table.value("clearance")
    first = next(k for k, motion in enumerate(data) if motion["f"] == 45)
    told = (f"Left: the bearing in the frame of its outer ring (stator, orange); the inner ring (rotor, blue) moves in the clearance of "
            f"{delta:g} µm, which is drawn far too large, as 1/{OUTER / GAP:.0f} of the outer ring's radius. An overlap is the elastic approach. Balls: white "
            "without load, from yellow to dark with the load, relative to the largest load at that speed. Right: orbits of rotor (solid) "
            "and stator (dashed), at the scale that fits them.")
    facts = {"motions": data, "first": first, "frames": FRAMES, "delta": delta, "gap": GAP, "ball": BALL, "outer": OUTER, "size": SIZE,
             "cage": table.value("cage_speed_ratio"), "colours": COLOURS}
    return (f'```````{{raw}} html\n<figure id="motion">{still(data[first], delta, n)}<div id="controls"></div>'
            f"<figcaption>{told}</figcaption></figure>\n<script>const FACTS = {json.dumps(facts, separators=(',', ':'))};\n"
            + Path("paper/book/animation.js").read_text("utf-8") + "</script>\n```````\n")
