"""The line of provenance of the tables that Python writes."""

import re
from pathlib import Path


def source_line():
    """Name and version of the project, from the one place that gives it; a table's second line."""
    text = Path("CMakeLists.txt").read_text(encoding="utf-8")
    name, version = re.search(r"^project\((\w+) VERSION (\S+)", text, re.MULTILINE).groups()
    return f"# source: {name} {version}"
