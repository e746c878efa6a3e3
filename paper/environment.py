"""Versions of what built the programs, drew the figures and wove the pages, a line each.

What compiled the programs stands in build/libraries.txt, written by CMake.

Usage: paper/environment.py > build/environment.txt   (from the project's root)
"""
import platform
import subprocess
from pathlib import Path

import matplotlib
import numpy


def first_line(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[0]


if __name__ == "__main__":
    print(Path("build/libraries.txt").read_text(encoding="utf-8"), end="")
    print(first_line("gnuplot", "--version"))
    print("Python", platform.python_version())
    print("NumPy", numpy.__version__)
    print("Matplotlib", matplotlib.__version__)
    print(first_line("pandoc", "--version"))
