"""Sphinx: its extensions, and what is copied into the pages, which ask nothing of the network."""
import re
from pathlib import Path

import furo

project = html_title = "Rotor, stator and a ball bearing"
language = "en"
extensions = ["myst_parser", "sphinx_copybutton", "sphinxcontrib.bibtex", "sphinx.ext.mathjax"]
myst_enable_extensions = ["amsmath", "dollarmath"]
myst_heading_anchors = 3
myst_update_mathjax = smartquotes = False
bibtex_bibfiles = [str(Path("../references.bib").resolve())]
highlight_language = "text"
html_theme = "furo"
pygments_style, pygments_dark_style = "default", "github-dark"
html_static_path = ["book.css", "book.js", "/usr/share/javascript/mathjax"]
html_css_files, html_js_files, html_favicon = ["book.css"], ["book.js"], "icon.svg"
html_copy_source = html_show_sphinx = html_show_copyright = html_use_index = False
mathjax_path = "MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"tex2jax": {"processClass": "math"}, "SVG": {"linebreaks": {"automatic": True}}}
exclude_patterns = ["contents.md", "fonts", "localization", "test", "unpacked", "config/local", "config/[!T]*", "config/TeX-[!A]*", "config/TeX-AMS[!_]*",
                    "config/TeX-AMS_[!S]*", "config/*-full.js", "jax/input/[!T]*", "jax/output/[!S]*", "jax/output/SVG/fonts/[!T]*"]


def complete(app, error):
    """Debian's furo leaves its parts in files of their own, one of them outside, and dark colours to the button alone."""
    theme, static = Path(furo.__file__).parent / "theme/furo/static", Path(app.outdir) / "_static"
    style, script, spy = ((theme / name).read_text("utf-8") for name in ("styles/furo.css", "scripts/furo.js", "scripts/gumshoe-patched.js"))
    dark = re.search(r'body\[data-theme="dark"\] (\{.*?\})', style, re.S)[1]
    normal = Path("/usr/share/javascript/normalize.css/normalize.css").read_text("utf-8")
    (static / "styles/furo.css").write_text(normal + style.partition("\n")[2] + "@media not print { @media (prefers-color-scheme: dark) {"
                                            + f' body:not([data-theme="light"]) {dark} }} }}\n', "utf-8")
    (static / "scripts/furo.js").write_text(spy + script.partition("\n")[2], "utf-8")


def setup(app):
    app.add_config_value("contents", (Path(app.srcdir) / "contents.md").read_text("utf-8"), "html")  # every page shows them
    app.connect("build-finished", complete)
