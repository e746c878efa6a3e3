"""The tests in Python, each a module of this package: python3 -m unittest tests/unit/maps.py, in the project's root."""
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[1] / folder) for folder in ("studies", "figures")]  # a study may be called like its figure
