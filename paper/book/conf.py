"""Sphinx: its extensions, and what is copied into the pages, which ask nothing of the network."""
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))
project = html_title = "Rotor, stator and a ball bearing"
language = "en"
extensions = ["pages", "myst_parser", "sphinx_copybutton", "sphinxcontrib.bibtex", "sphinx.ext.mathjax"]
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
