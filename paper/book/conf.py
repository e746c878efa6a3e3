"""Sphinx: its extensions, and what is copied into the pages, which ask nothing of the network."""
project = html_title = "Rotor, stator and a ball bearing"
extensions = ["paper.book.pages", "myst_parser", "sphinx_copybutton", "sphinxcontrib.bibtex", "sphinx.ext.mathjax"]
myst_enable_extensions, myst_heading_anchors = ["amsmath", "dollarmath"], 3
myst_update_mathjax = smartquotes = html_copy_source = html_show_sphinx = html_show_copyright = html_use_index = False
bibtex_bibfiles = ["../../paper/references.bib"]
highlight_language, pygments_style, pygments_dark_style = "text", "default", "github-dark"
html_theme, html_favicon = "furo", "icon.svg"
html_css_files, html_js_files, html_static_path = ["book.css"], ["book.js"], ["book.css", "book.js", "/usr/share/javascript/mathjax"]
mathjax_path = "MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"tex2jax": {"processClass": "math"}, "SVG": {"linebreaks": {"automatic": True}}}
exclude_patterns = ["contents.md", "fonts", "localization", "test", "unpacked", "config/local", "config/*[!G].js", "jax/input/[!T]*",
                    "jax/output/[!S]*", "jax/output/SVG/fonts/[!T]*"]
