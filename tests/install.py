"""Installs the project into an empty folder and builds a program there with find_package(RotorStator).

It catches a header that is not installed or includes one that is not, a library that the package does not name,
and an installed explore that needs the source folder, for its figures and its Python module too.

Usage: tests/install.py BUILD_FOLDER   (from the project's root)
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(outside LANGUAGES CXX)
find_package(RotorStator {version} REQUIRED)
add_executable(outside outside.cpp)
target_link_libraries(outside PRIVATE RotorStator::rotor_stator)
"""
HEADERS = """#include <cstdio>
{includes}
int main(int, char** argv)
{{
  using namespace rotor_stator;
  const Parameters machine = read_parameters(argv[1]);
  const bool found = motion::find_periodic({{machine, angular(45), 6, 50}}).found();
  std::printf("%s: %s\\n", machine.title.c_str(), found ? "periodic" : "no solution");
  return found ? 0 : 1;
}}
"""


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, text=True,
                          stdout=subprocess.PIPE, **options).stdout


def main(build):
    version = re.search(r"^project\(\w+ VERSION (\S+)", Path("CMakeLists.txt").read_text(), re.MULTILINE)[1]
    machine = Path("data/set1.toml").resolve()
    headers = sorted(str(file.relative_to("src")) for file in Path("src").glob("*/*.hpp"))
    with tempfile.TemporaryDirectory(prefix="with a blank ") as folder:
        prefix, outside = Path(folder, "prefix"), Path(folder, "outside")
        outside.mkdir()
        run("cmake", "--install", Path(build).resolve(), "--prefix", prefix)
        (outside / "CMakeLists.txt").write_text(PROJECT.format(version=version))
        (outside / "outside.cpp").write_text(HEADERS.format(
            includes="\n".join(f"#include <{name}>" for name in headers)))
        run("cmake", "-S", outside, "-B", outside / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
        run("cmake", "--build", outside / "build")
        print(run(outside / "build" / "outside", machine), end="")
        table = run(prefix / "bin" / "explore", "orbit", machine, "--frequency", 45, "--harmonics", 6, cwd=folder)
        if "\nphase\t" not in table:
            sys.exit("the installed explore prints no orbit")
        run(prefix / "bin" / "explore", "attractors", machine, "--from", 45, "--to", 45, "--count", 1,
            "--starts", 0, "--plot", "figure.svg", cwd=folder)
        if "</svg>" not in Path(folder, "figure.svg").read_text(encoding="utf-8"):
            sys.exit("the installed explore draws no figure")
        script = ("import sys, rotor_stator as r; t = r.run('orbit', sys.argv[1], frequency=45, harmonics=6, plot=True); "
                  "print(*r.explore(), r.__file__, len(t['x_r']), t.value('stability'), '</svg>' in t.svg, sep='\\n')")
        modules = prefix / "lib/python3/dist-packages"
        program, module, *ends = run(sys.executable, "-c", script, machine, cwd=outside, env={"PYTHONPATH": str(modules)}).split("\n")
        if ends != ["256", "stable", "True", ""] or (program + module).count(str(prefix)) != 2:
            sys.exit(f"the installed module does not run explore: {program} {module} {ends}")


if __name__ == "__main__":
    main(*sys.argv[1:])
