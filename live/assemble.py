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
PRESETS = [("data/set1.toml", "Set 1", 16, 10, 1, 60), ("data/set2.toml", "Set 2", 45, 6, 1, 60),
           ("data/set1-as-printed.toml", "Set 1, printed reading", 45, 10, 1, 60),
           ("data/live/bearing-6205.toml", "Bearing 6205", 45, 10, 40, 60),
           ("data/live/varying-compliance.toml", "Varying compliance", 31, 16, 15, 45)]


def text_of(path):
    return Path(path).read_text(encoding="utf-8")


def main(core, wasm, page):
    presets = [{"name": Path(path).name, "path": path, "title": title, "toml": text_of(path),
                "start": dict(zip(("f", "m", "from", "to"), start))} for path, title, *start in PRESETS]
    data = {"PRESETS": presets, "WORKER": text_of(core) + text_of(LIVE / "worker.js"),
            "DRAWING_STYLE": text_of(LIVE / "drawing.css"),
            "WASM": base64.b64encode(gzip.compress(Path(wasm).read_bytes(), 9, mtime=0)).decode()}
    script = "".join(f"const {name} = {json.dumps(value, ensure_ascii=False)};\n" for name, value in data.items())
    html = text_of(LIVE / "page.html").replace("/*page.css*/", text_of(LIVE / "page.css"))
    html = html.replace("/*page.js*/", script.replace("</script", "<\\/script") + text_of(LIVE / "page.js"))
    Path(page).write_text(html, encoding="utf-8")


main(*sys.argv[1:])
