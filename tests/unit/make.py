"""What make leaves behind, and what may stand in the name of its folder.
"""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

FILES = ["Makefile", "CMakeLists.txt", "data/tables.mk", "paper/paper.mk",
         "paper/packages.sh", "paper/ages.py", "live/live.mk", "peers/peers.mk",
         "tests/tests.mk", "src/io/stamp_revision.sh", "paper/article.md"]


class Make(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name) / "$(touch broken) a'b"
        for file in FILES:
            (self.folder / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, self.folder / file)
        for folder in ("data/scenes", "data/bearings"):
            shutil.copytree(folder, self.folder / folder)

    def make(self, *goals, where=None, **environment):
        own = {name: value for name, value in os.environ.items() if "MAKE" not in name}
        return subprocess.run(["make", *goals], cwd=where or self.folder, capture_output=True,
                              text=True, env={**own, **environment}, check=False)

    def test_a_folder_that_a_shell_would_run(self):
        result = self.make("list")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("test-all", result.stdout)
        self.assertFalse(list(self.folder.parent.rglob("broken")))

    def test_temporaries_of_dead_makes(self):
        """Go with the next make; those of one at work, and what is no temporary, stay."""
        dead = subprocess.Popen(["true"])
        dead.wait()
        stay = [f"data/generated/a.tsv.{os.getpid()}.tmp", "figures/generated/a.svg",
                "build/a.tmp"]
        go = [f"{folder}/a.{dead.pid}.tmp"
              for folder in ("build", "data/generated/as-printed", "figures/generated")]
        for name in stay + go:
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).touch()
        for words in (["-n", "list"], ["list"]):
            known = len(stay) + len(go) * (words[0] == "-n")
            self.assertEqual(self.make(*words).returncode, 0)
            left = [str(file.relative_to(self.folder)) for file in
                    self.folder.rglob("a*.*") if file.suffix in (".tmp", ".svg")]
            self.assertEqual(len(left), known, left)
        self.assertEqual(sorted(left), sorted(stay))

    def test_no_fuzzer(self):
        """One line; what has none is attacked by the rest."""
        own = self.folder / "bin"
        own.mkdir()
        (own / "clang++").write_text("#!/bin/sh\nexit 1\n", encoding="utf-8")
        (own / "clang++").chmod(0o755)
        result = self.make("fuzz", PATH=f"{own}:{os.environ['PATH']}")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"\Amake fuzz: needs clang\+\+ with libFuzzer"
                                        r"[^\n]*\nmake: [^\n]*\n\Z")

    def test_the_revision_is_that_of_the_sources(self):
        """Whatever repository the environment names."""
        subprocess.run(["git", "init", "-q", self.folder / "other"], check=True)
        commit = "git -c user.name=a -c user.email=a@b commit -q --allow-empty -m a"
        subprocess.run(commit.split(), cwd=self.folder / "other", check=True)
        run = ["sh", "src/io/stamp_revision.sh", "1.2", "-O2", "out.hpp"]
        other = {"GIT_DIR": str(self.folder / "other/.git")}
        subprocess.run(run, cwd=self.folder, check=True, env={**os.environ, **other})
        header = (self.folder / "out.hpp").read_text(encoding="utf-8")
        found = re.findall('rotor_stator 1.2 [^"]*', header)
        self.assertEqual(found, ["rotor_stator 1.2 unknown"])

    def test_the_live_page_has_what_its_sources_use(self):
        """Of std::ranges: the browser's library has the names in live/libcxx.hpp alone, and few machines compile for it."""
        sources = self.make("-s", "--eval", "sources: ; @echo $(live_sources)", "sources", where=".").stdout.split()
        self.assertGreater(len(sources), 50)
        text = "".join(file.read_text(encoding="utf-8") for source in map(Path, sources)
                       for file in (source, source.with_suffix(".hpp")) if file.exists())
        given = Path("live/libcxx.hpp").read_text(encoding="utf-8")
        has = set(re.findall(r"(?:WITH_\w+\(|auto |void )(\w+)", given)) | {"greater"}  # which the library has
        self.assertEqual(set(re.findall(r"std::ranges::(\w+)", text)) - has, set())
