"""Reads the book and the article as a reader would, in a headless browser.

Files: no replacement character, no link that leads nowhere, a text for every picture, a page for every program and
module, a complete page for every figure, links from equations and names to where they stand and back. Browser: on every
page all mathematics is set, nothing is wider than the window, no message of the browser and no request but to the pages;
the search finds what is there; text has contrast and pictures a text (axe-core, where npm has it). With FULL in the
environment, two other locales give the same bytes. The animation moves, and shows the motion of the table.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import quote, unquote, urlsplit

import numpy as np

from tests.support.browser import BrowserCase, served
from tests.support.explore import FULL, Table, some

BUILD, BOOK, ARTICLE = Path("build"), Path("build/book"), Path("build/paper/article.html")
AXE = BUILD / "npm/node_modules/axe-core/axe.min.js"
FIGURES = tomllib.loads(Path("paper/book/figures.toml").read_text(encoding="utf-8"))
SHOWN = ["index.html", "chapter-07.html", "fig06_orbits.html", "model-rotor_stator.html", "results.html", "fig07_contact.html",
         "list_of_deviations.html", "guide.html", "marks.html", "names-model.html"]
NARROW, WIDE = 400, 1400
# Equations of a page: asked for, set, wrong, and raw MathML, which Chromium draws without a font.
EQUATIONS = """return [document.querySelectorAll('.math').length,
  [...document.querySelectorAll('.MathJax_SVG svg')].filter(s => s.getBoundingClientRect().height > 5).length,
  document.querySelectorAll('.MathJax_SVG_Error, .MathJax_SVG [fill=red], .merror, .noError').length,
  [...document.querySelectorAll('math')].filter(m => !m.closest('.MJX_Assistive_MathML')).length]"""


def page_of(figure):
    """The page that shows a figure: its own, unless it says another."""
    return FIGURES.get(figure, {}).get("page", figure)


class Links(HTMLParser):
    """What a page points to, what it can be pointed at, and its pictures without a text."""

    def __init__(self, text):
        super().__init__()
        self.targets, self.names, self.silent = set(), {"", "top"}, []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.targets |= {found[key] for key in ("href", "src") if found.get(key)}
        self.names |= {found[key] for key in ("id", "name") if found.get(key)}
        if tag == "img" and not found.get("alt"):
            self.silent.append(found.get("src"))


class Files(unittest.TestCase):
    """What can be read without a browser."""

    @classmethod
    def setUpClass(cls):
        cls.text = {page.resolve(): page.read_text(encoding="utf-8") for page in [*BOOK.glob("*.html"), ARTICLE]}
        cls.links = {page: Links(text) for page, text in cls.text.items()}

    def page(self, name):
        return self.text[(BOOK / f"{name}.html").resolve()]

    def test_no_replacement_character(self):
        self.assertGreater(len(self.text), 130)
        self.assertEqual([page.name for page, text in self.text.items() if "\ufffd" in text], [])

    def test_every_link_leads_somewhere(self):
        broken = []
        for page, links in self.links.items():
            for target in links.targets:
                if not re.match(r"[a-z]+:", target):
                    parts = urlsplit(target)
                    to = (page.parent / unquote(parts.path)).resolve() if parts.path else page
                    known = self.links[to].names if to in self.links else {parts.fragment}
                    if not to.exists() or unquote(parts.fragment) not in known:
                        broken.append(f"{page.name}: {target}")
        self.assertEqual(broken, [])

    def test_every_picture_has_a_text(self):
        self.assertEqual({page.name: links.silent for page, links in self.links.items() if links.silent}, {})

    def test_every_source_has_its_page_with_all_its_lines(self):
        """Only what stands in comments that became text is not shown with its line's number."""
        for source in sorted(file for folder in ("src", "studies") for file in Path(folder).rglob("*.?pp")):
            text, lines = self.page("-".join(source.with_suffix("").parts[1:])), source.read_text(encoding="utf-8").split("\n")
            shown = set(map(int, re.findall(rf'id="{source.suffix[1:]}-(\d+)"', text)))
            comment = False
            for number, line in enumerate(lines, 1):
                comment = comment or line.startswith("/**")
                if line.strip() and not comment:
                    self.assertIn(number, shown, source)
                comment = comment and "*/" not in line

    def test_every_figure_has_a_complete_page(self):
        for figure in sorted(Path("figures/generated").glob("*.svg")):
            page = self.page(page_of(figure.stem))
            for part in (f'src="_images/{figure.name}"', "How it was computed", "make</span>", "What differs from the paper", "(D-\\d\\d|paper)"):
                self.assertRegex(page, part, figure.stem)

    def test_the_example_of_the_guide_is_whole(self):
        """A page's own comment marks are taken away, those of a program that it shows are not."""
        shown = unescape(re.sub(r"<[^>]*>", "", self.page("guide")))
        self.assertRegex(shown, r"/\*\*\n# Two masses and a unilateral spring(?s:.*?)\*/\n#include")

    def test_every_attack_has_its_test(self):
        """Each row of the page names a file of tests, and tests that stand in it."""
        rows = Path("tests/hard/attacks.md").read_text(encoding="utf-8").split("What was once found")[1].split("\n")
        named = [re.findall("`(tests/[^`]+)`(?:: `([^`]+)`(?:, `([^`]+)`)*)?", row) for row in rows if row.startswith("| ")][1:]
        self.assertGreater(len(named), 15)
        for file, *tests in sum(named, []):
            text = Path(file).read_text(encoding="utf-8")
            self.assertTrue(all(re.search(rf"(def|class) {test}\b", text) for test in tests if test), (file, tests))
        self.assertTrue(all(named))

    def test_every_table_without_figure_is_shown(self):
        """All its columns with their values in the first row, and the file: a page that only speaks of its table would have neither."""
        for page in ("tab01_parameters", "tab02_timing", "tab02_equal_error", "regimes", "deviations"):
            text, file = self.page(page), next(Path("data").glob(f"[gr]e*/{page}.tsv"))
            names, first = [line.split("\t") for line in file.read_text(encoding="utf-8").splitlines() if line[:1] != "#"][:2]
            for name, cell in zip(names, first):
                row = re.search(rf"<span class=\"pre\">{name}</span>.*?</tr>", text, re.DOTALL)[0]
                cells = re.findall(r"<t[dh][^>]*>(?:<p>)?([^<]*)", unescape(row))
                self.assertTrue(cell in cells or any(re.fullmatch(r"-?[\d.]+(e-?\d+)?", one) and np.isclose(float(one), float(cell), rtol=1e-3)
                                                    for one in cells), (page, name, cell, cells))
            self.assertRegex(text, rf'download internal" download="" href="_downloads/[^"]*/{page}.tsv"')

    def test_links_go_both_ways(self):
        """Equation 5, a deviation, a claim and a function: from a page that names them, and back."""
        for name, mark, place in (("fig07_contact", "eq-5", "model-hertz"), ("fig06_orbits", "D-17", "list_of_deviations"),
                                  ("fig09_contact", "C8", "results")):
            self.assertIn(f'href="{place}.html#{mark}"', self.page(name))
            back = mark.removeprefix("eq-")
            self.assertIn(f'href="marks.html#{back}"', self.page(place))
            self.assertIn(f'href="{name}.html"', self.row("marks", back))
        line = int(re.search(r'href="motion-find_periodic.html#hpp-(\d+)"[^>]*><span class="n[f]?">find_periodic<', self.page("explore-map_quantities"))[1])
        self.assertIn("find_periodic(", Path("src/motion/find_periodic.hpp").read_text(encoding="utf-8").split("\n")[line - 1])
        self.assertIn('href="names-motion.html#find_periodic"', self.page("motion-find_periodic"))
        self.assertIn('href="explore-map_quantities.html"', self.row("names-motion", "find_periodic"))

    def row(self, page, anchor):
        return re.search(rf'id="{anchor}".*?</tr>', self.page(page), re.DOTALL)[0]

    def test_previous_and_next_pass_every_page(self):
        """From the first page to the last, in the order of the paper."""
        passed, page = [], "index"
        while page and page not in passed:
            passed.append(page)
            found = re.search(r'<link rel="next"[^>]*href="([^"]+)\.html"', self.page(page))
            page = found and found[1]
        self.assertEqual({page.stem for page in BOOK.glob("*.html")} - set(passed), {"search"})
        order = ["model-hertz", "balance-newton", "continuation-sweep", "fig03_response", "fig09_contact", "guide"]
        self.assertEqual(sorted(order, key=passed.index), order)

    @unittest.skipUnless(FULL, "of make test-all: the pages are written twice more")
    def test_same_bytes_in_every_locale(self):
        """As those that make has written."""
        with tempfile.TemporaryDirectory(dir=BUILD) as pages, tempfile.TemporaryDirectory() as scratch:
            for locale in ["de_DE.UTF-8", "C.UTF-8"]:
                out = Path(scratch, locale)
                subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "-E", "-c", "paper/book", "-d", f"{scratch}/trees", pages, out],
                               check=True, env={**os.environ, "LC_ALL": locale, "PYTHONDONTWRITEBYTECODE": "1"})
                made = [file.relative_to(out) for file in out.rglob("*") if file.is_file()]
                self.assertGreater(len(made), 130)
                self.assertEqual([name for name in made if (out / name).read_bytes() != (BOOK / name).read_bytes()], [], locale)


class Browser(BrowserCase):
    """What a browser shows."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.address = served("build", cls.addClassCleanup)

    def setUp(self):
        super().setUp()
        self.show(WIDE)

    def tearDown(self):
        """No message of the browser, and nothing asked of another place."""
        super().tearDown()
        self.assertEqual({a for a in self.requests() if not a.startswith((self.address, "file:///", "data:", "chrome:", "about:"))}, set())

    def show(self, width, scheme="light"):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def open(self, page, folder="book/"):
        """The page when its equations are set."""
        self.driver.get(self.address + folder + page)
        self.driver.execute_async_script(
            "const done = arguments[0]; window.MathJax && MathJax.Hub ? MathJax.Hub.Queue(done) : done()")

    def test_every_page_fits_and_has_its_mathematics_and_figures(self):
        """In a narrow window, the worst for both, figures in a wide one too: half of the pages with figures, those of SHOWN, every
        sixth with mathematics and every sixteenth, with FULL in the environment all."""
        equations, figures = 0, {}
        for figure in sorted(Path("figures/generated").glob("*.svg")):
            figures.setdefault(page_of(figure.stem) + ".html", []).append(figure.name)
        pages = sorted(page.name for page in BOOK.glob("*.html"))
        with_mathematics = {page for page in pages if 'class="math' in (BOOK / page).read_text(encoding="utf-8")}
        for page in pages if FULL else sorted({*pages[::16], *SHOWN, *some(figures, 2), *some(sorted(with_mathematics), 6)}):
            with self.subTest(page):
                self.show(NARROW)
                self.open(page)
                self.assertEqual(self.js("""return [...document.querySelectorAll('article *')].filter(
                  part => part.getBoundingClientRect().right > innerWidth && !part.closest('pre, .table-wrapper, .math, .MathJax_SVG')).map(
                  part => part.outerHTML.slice(0, 100))"""), [])
                asked, given, wrong, _ = self.js(EQUATIONS)
                equations += asked
                self.assertEqual((given, wrong), (asked, 0))
                for width in (NARROW, WIDE) if page in figures else ():
                    self.show(width)
                    for figure in figures[page]:
                        left, right, natural, whole = self.js("""
                          const image = document.querySelector(`img[src="_images/${arguments[0]}"]`), box = image.getBoundingClientRect();
                          return [box.left, box.right, image.naturalWidth, document.documentElement.scrollWidth];""", figure)
                        self.assertGreater(natural, 0)
                        self.assertGreater(right - left, 0.8 * width if width == NARROW else 500)
                        self.assertTrue(left >= 0 and max(whole, right) <= width, (left, right, whole))
        self.assertGreater(equations, 25)

    def found(self, words, start=""):
        self.driver.get(f"{start or self.address}book/search.html?q={quote(words)}")
        self.driver.execute_async_script("""const done = arguments[0];
          (function wait() { /finished|did not match/i.test(document.body.innerText) ? done() : setTimeout(wait, 50); })();""")
        return [link.get_attribute("href") for link in self.driver.find_elements("css selector", "#search-results li > a")]

    def test_questions_of_a_reader(self):
        """The clearance of set 2, why frequencies are exchanged, the code of Eq. 5, how to add a nonlinearity, the error at 45 Hz: the page
        is among the first three that a search finds (a title without the word would not be), and says it."""
        for words, page, said in (("clearance", "tab01_parameters", "radial clearance"), ("exchanged", "list_of_deviations", "D-09 Natural frequencies"),
                                  ("Eq. 5", "model-hertz", "hertz_force"), ("nonlinearity", "guide", "Adding another nonlinearity"),
                                  ("error at 45 Hz", "fig05_displacements", r"rms [\d.]+ %")):
            with self.subTest(words):
                self.assertIn(page, "\n".join(self.found(words)[:3]))
                self.assertRegex(self.page(page), said)

    def test_search(self):
        """The word clearance, in titles and in text; nothing for a word that is not there. From the file system too."""
        for start in (self.address, BUILD.resolve().as_uri() + "/"):
            for word, least, most in (("clearance", 20, 150), ("xylophone", 0, 0)):
                found = self.found(word, start)
                self.assertTrue(least <= len(found) <= most, (start, word, found))
                if found:
                    self.assertIn("model-ball_bearing.html", "\n".join(found))

    def test_dark_where_the_reader_has_it_so(self):
        for scheme, dark in (("light", False), ("dark", True)):
            self.show(WIDE, scheme)
            self.open("index.html")
            colour = self.js("return getComputedStyle(document.body).backgroundColor")
            self.assertEqual(sum(map(int, re.findall(r"\d+", colour)[:3])) < 200, dark, colour)

    def test_copy_leaves_out_the_line_numbers(self):
        self.open("fig06_orbits.html")
        shown = self.js("return document.querySelector('.highlight .line').closest('pre').innerText")
        self.assertIn(shown.strip(), Path("src/fig06_orbits.cpp").read_text(encoding="utf-8"))

    def test_contrast_and_texts_by_axe(self):
        if not AXE.exists() and shutil.which("npm"):
            subprocess.run(["npm", "install", "--silent", "--no-audit", "--no-fund", "--prefix", BUILD / "npm", "axe-core@4.10.3"],
                           check=False, capture_output=True)
        if not AXE.exists():
            self.skipTest("no npm with axe-core here")
        for page in some(SHOWN, 2):
            self.open(page)
            self.js(AXE.read_text(encoding="utf-8"))
            for scheme in ("light", "dark"):
                self.show(WIDE, scheme)
                with self.subTest(page, scheme=scheme):
                    found = self.driver.execute_async_script(
                        "const done = arguments[0]; axe.run({runOnly: ['wcag2a', 'wcag2aa']}).then(r => done(r.violations.map("
                        "v => [v.id, v.nodes.length, v.nodes[0].html.slice(0, 200), v.nodes[0].failureSummary])))")
                    self.assertEqual(found, [])

    def test_article(self):
        """It fits, shows its pictures, and every equation is set."""
        self.open("article.html", "paper/")
        for width in (NARROW, WIDE):
            self.show(width)
            self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), width)
            self.assertEqual(self.js("return [...document.images].filter(i => !i.naturalWidth).length"), 0)
            asked, given, wrong, raw = self.js(EQUATIONS)
            self.assertEqual((given, wrong, raw), (asked, 0, 0))
            self.assertGreater(asked, 30)

    def test_animation(self):
        """The picture of Fig. 7 stands still for who wants less motion, moves otherwise, and shows the table's motion: its ball loads
        sum to the force that the table of Fig. 6 holds (a wrong ball, sign or clearance would not). Without a script it is there too."""
        for wish, moves in (("reduce", False), ("no-preference", True)):
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": wish}]})
            self.open("fig07_contact.html")
            first = self.js("return document.getElementById('instant').value")
            seen = self.driver.execute_async_script("setTimeout(() => arguments[0](document.getElementById('instant').value), 700)")
            self.assertEqual(seen != first, moves)
        self.js("document.getElementById('play').click()")
        self.assertEqual(self.js("return document.getElementById('play').textContent"), "Play")
        self.js("""const speed = document.getElementById('speed'), instant = document.getElementById('instant');
            speed.value = 0; speed.onchange(); instant.value = 32; instant.oninput();""")
        self.assertIn("t/T = 0.50", self.js("return document.getElementById('now').value"))
        table = Table("data/generated/fig06_orbits.tsv")
        facts = self.js("return FACTS")
        for motion in facts["motions"]:
            rows = table.where("f", motion["f"])
            rows = rows.where("source", rows.first("shown"))
            for frame in (0, 10, 32):
                row = frame * 128 // facts["frames"]
                angle = 2 * np.pi * (facts["cage"] * frame / facts["frames"] + np.arange(16) / 16)
                force = np.array([np.cos(angle), np.sin(angle)]) @ motion["Q"][frame]
                np.testing.assert_allclose(force, [rows["F_x"][row], rows["F_y"][row]], rtol=1e-3, atol=3)
        self.assertGreater(len({ball.get_attribute("fill") for ball in self.driver.find_elements("css selector", "#motion .ball")}), 1)
        still = re.search(r'<figure id="motion">(.*?)<div', self.page("fig07_contact"), re.DOTALL)[1]
        self.assertEqual(still.count('class="ball"'), 16)

    def page(self, name):
        return (BOOK / f"{name}.html").read_text(encoding="utf-8")
