"""Puts the live page into one file: page, style, script, the presets, the worker and the WebAssembly module.

Usage: live/assemble.py CORE.js CORE.wasm PAGE.html   (from the project's root)
"""
import base64
import gzip
import json
import sys
from pathlib import Path

LIVE = Path(__file__).parent
# What the page offers, with the speed [Hz], harmonics and range [Hz] that it begins with.
PRESETS = [
    ("data/set1.toml", "Set 1", {"f": 12, "m": 16, "from": 1, "to": 60}),
    ("data/set2.toml", "Set 2", {"f": 45, "m": 6, "from": 1, "to": 60}),
    ("data/set1-as-printed.toml", "Set 1, printed reading", {"f": 45, "m": 10, "from": 1, "to": 60}),
    ("live/presets/bearing-6205.toml", "Bearing 6205", {"f": 45, "m": 10, "from": 5, "to": 60}),
    ("live/presets/varying-compliance.toml", "Varying compliance", {"f": 31, "m": 16, "from": 15, "to": 45}),
]


def text_of(path):
    return Path(path).read_text(encoding="utf-8")


def main(core, wasm, page):
    presets = [{"name": Path(path).name, "path": path, "title": title, "toml": text_of(path), "start": start}
               for path, title, start in PRESETS]
    data = {"PRESETS": presets, "WORKER": text_of(core) + text_of(LIVE / "worker.js"),
            "DRAWING_STYLE": text_of(LIVE / "drawing.css"),
            "WASM": base64.b64encode(gzip.compress(Path(wasm).read_bytes(), 9, mtime=0)).decode()}
    parts = {"/*page.css*/": text_of(LIVE / "page.css"), "/*page.js*/": text_of(LIVE / "page.js"),
             "/*data*/": "".join(f"const {name} = {json.dumps(value, ensure_ascii=False)};\n"
                                 for name, value in data.items()).replace("</script", "<\\/script")}
    html = text_of(LIVE / "page.html")
    for place, text in parts.items():
        html = html.replace(place, text, 1)
    Path(page).write_text(html, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
