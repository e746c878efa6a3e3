"""Sphinx: its extensions, and what is copied into the pages, which ask nothing of the network."""
project = html_title = "Rotor, stator and a ball bearing"
extensions = ["paper.book.pages", "myst_parser", "sphinx_copybutton", "sphinxcontrib.bibtex", "sphinx.ext.mathjax"]
bibtex_bibfiles, myst_enable_extensions, html_favicon = ["../../paper/references.bib"], ["amsmath", "dollarmath"], "icon.svg"
myst_update_mathjax = smartquotes = html_copy_source = html_show_sphinx = html_show_copyright = html_use_index = False
html_theme, highlight_language, pygments_style, pygments_dark_style, myst_heading_anchors = "furo", "text", "default", "github-dark", 3
html_css_files, html_js_files, html_static_path = ["book.css"], ["book.js"], ["book.css", "book.js", "/usr/share/javascript/mathjax"]
mathjax_path, mathjax2_config = "MathJax.js?config=TeX-AMS_SVG", {"tex2jax": {"processClass": "math"}, "SVG": {"linebreaks": {"automatic": True}}}
exclude_patterns = "contents.md fonts local* test unpacked config/local config/*[!G].js jax/input/[!T]* jax/output/[!S]* jax/output/SVG/fonts/[!T]*".split()
