"""The live page in a headless browser, against explore.

Thirty machines at three speeds: displacements, force and verdict are those of explore, which shares the source but neither
compiler, nor transform, nor stepper. What explore refuses is refused with the same line and message. Then what a reader
does: presets, sliders, numbers, dragging, keys, TOML in and out, table, picture, link, cancelling, a crash. From the file
system and through a server: no message of the browser and no request but the page. A thousand changes leave the memory as
it was.

Usage: python3 -m tests.live   (from the project's root, after `make live` and `make build/explore`)
"""
import random
import shutil
import subprocess
import sys
import time
import unittest
import urllib.parse
import xml.dom.minidom
from pathlib import Path

from tests.support.browser import BrowserCase, served
from tests.machines import entries, spread, written
from tests.support.explore import EXPLORE, MACHINE

PAGE = Path("build/live/index.html")
MACHINES, SPEEDS = 30, (8, 90)


def random_machine(dice):
    """A machine near data set 1, every value drawn; a third with other cages or without a stator that moves."""
    log = spread(dice)
    bearing = {"balls": dice.choice([6, 8, 12, 16, 20]), "contact_stiffness_N_per_m1p5": log(3e9, 3e11),
               "radial_clearance_m": log(2e-6, 1e-4), "cage_speed_ratio": 0.5}
    if dice.random() < 0.2:
        bearing.update(balls=8, cage_speed_ratio=dice.choice([0.375, 0.4375]))
    tables = {"stator": {"mass_kg": log(5, 60), "natural_frequency_rad_per_s": log(200, 900), "damping_ratio": log(0.02, 0.2)},
              "rotor": {"mass_kg": log(5, 60), "natural_frequency_rad_per_s": log(60, 400), "damping_ratio": log(0.02, 0.1),
                        "unbalance_kg_m": log(1e-3, 0.1)},
              "bearing": bearing, "gravity": {"acceleration_m_per_s2": dice.choice([0, 9.81])}}
    if dice.random() < 0.1:
        tables["stator"] = {"rigid": True}
    return written(entries(tables, "drawn"))


def numbers_of(text):
    rows = [line.split("\t") for line in text.splitlines() if line and not line.startswith("#")]
    return [[float(cell) for cell in row] for row in rows[1:]]


def note(text, key):
    return next((line[len(key) + 4:] for line in text.splitlines() if line.startswith(f"# {key}: ")), "")


class Page(BrowserCase):
    FLAGS = ("window-size=1400,1000", "enable-precise-memory-info")

    def setUp(self):
        super().setUp()
        self.open(PAGE.resolve().as_uri())

    def open(self, address):
        self.driver.get(address)
        self.settled()

    def wait(self, condition, seconds=60):
        """Until the JavaScript expression is true."""
        end = time.monotonic() + seconds
        while not self.js(f"return Boolean({condition})"):
            self.assertLess(time.monotonic(), end, condition)
            time.sleep(0.02)

    def settled(self):
        self.wait("shown.motion && !engines.quick.job")

    def find(self, selector):
        return self.driver.find_element("css selector", selector)

    def text(self, name):
        return self.find(f"#{name}").text

    def ask(self, what, toml, f, m=10, file="machine.toml", engine="quick"):
        return self.driver.execute_async_script(
            "const [engine, question, done] = arguments;"
            "engines[engine].ask(question).then((r) => done({status: r.status, text: r.text,"
            " samples: r.status === 0 && r.numbers?.length ? Array.from(r.numbers.slice(10, 10 + 6 * r.numbers[0])) : []}))",
            engine, {"what": what, "file": file, "toml": toml, "f": f, "m": m, "from": 1, "to": 60})

    def explore(self, *arguments):
        return subprocess.run([EXPLORE, *map(str, arguments)], cwd=self.folder, capture_output=True, encoding="utf-8")

    def type_into(self, selector, text):
        self.js("const e = document.querySelector(arguments[0]); e.value = arguments[1]; e.dispatchEvent(new Event('input'));"
                "e.dispatchEvent(new Event('change'))", selector, str(text))

    # A wrong transform, stepper, unit or rounding-unsafe flag of the browser's build would show here.
    def test_machines_agree_with_explore(self):
        dice, found, words, unsure = random.Random(1), 0, [], []
        for k in range(MACHINES):
            toml = random_machine(dice)
            (self.folder / "machine.toml").write_text(toml)
            for _ in range(3):
                f = round(dice.uniform(*SPEEDS), 2)
                native = self.explore("orbit", "machine.toml", "--frequency", f, "--harmonics", 10)
                with self.subTest(machine=toml, f=f):
                    judged = self.ask("verdict", toml, f)
                    if judged["status"] != native.returncode:
                        self.assertEqual({judged["status"], native.returncode}, {0, 3}, judged["text"] + native.stderr)
                        unsure.append((f, judged["text"].splitlines()[-1], native.stderr))
                        continue
                    if native.returncode:
                        # The same place; Newton's last residual is a matter of rounding.
                        self.assertEqual(judged["text"].split(" Hz:")[0], native.stderr.split(" Hz:")[0])
                        continue
                    found += 1
                    self.compare(self.ask("orbit", toml, f)["samples"], numbers_of(native.stdout))
                    word = note(native.stdout, "stability")
                    words.append(word)
                    live = note(judged["text"], "stability")
                    if "undecided" in (live, word) and live != word:
                        unsure.append((f, live, word))
                    else:
                        self.assertEqual(live, word)
                        self.compare_multipliers(judged["text"], native.stdout)
        # Where Newton's steps or a chaotic transient lead depends on rounding: one of the two may then find no motion.
        self.assertLessEqual(len(unsure), 2, unsure)
        self.assertGreater(found, 2 * MACHINES)
        self.assertLessEqual({"stable", "unstable"}, set(words))
        print(f"{found} of {3 * MACHINES} solutions,", {word: words.count(word) for word in sorted(set(words))},
              "undecided in one of the two:", unsure)

    def compare_multipliers(self, *texts):
        found = [note(text, "multiplier") for text in texts]
        if all(found):
            uncertainty = sum(float(note(text, "multiplier_uncertainty")) for text in texts)
            self.assertLessEqual(abs(float(found[0]) - float(found[1])), 10 * uncertainty + 1e-8)

    def compare(self, samples, rows):
        self.assertEqual(len(samples), 6 * len(rows))
        for columns in (range(4), range(4, 6)):
            size = max(abs(row[1 + i]) for row in rows for i in columns) or 1
            off = max(abs(samples[6 * k + i] - row[1 + i]) for k, row in enumerate(rows) for i in columns)
            self.assertLess(off / size, 1e-9)

    def test_refusals_are_those_of_explore(self):
        changes = [("mass_kg = 20.0", "mass_kg = -1"), ("mass_kg = 20.0", "mass_kg = "), ("balls = 16", "bals = 16"),
                   ("balls = 16", "balls = 0"), ("balls = 16", "balls = 2000"), ("balls = 16", "balls = 1.5"),
                   ("[gravity]", "[gravty]"), ("cage_speed_ratio = 0.5", "cage_speed_ratio = 0.6"),
                   ("cage_speed_ratio = 0.5", "cage_speed_ratio = 0.5\nball_radius_m = 1"), (MACHINE, ""),
                   (MACHINE, "[" * 40), ("unbalance_kg_m = 0.05", "unbalance_kg_m = nan"), ("1e11", "1e999"),
                   ("0.05", "'a'"), ("[rotor]", "[rotor"), ("[stator]", "[stator]\nrigid = 3")]
        for old, new in changes:
            toml = MACHINE.replace(old, new, 1)
            self.assertNotEqual(toml, MACHINE)
            path = self.folder / "bad.toml"
            path.write_text(toml)
            native = self.explore("orbit", "bad.toml", "--frequency", 45)
            self.assertEqual(native.returncode, 2)
            self.js("alertOf('')")
            before = self.js("return state.toml")
            self.find("#file").send_keys(str(path))
            self.wait("!document.getElementById('alert').hidden")
            self.assertEqual(self.text("alert"), " ".join(native.stderr.split()))
            self.assertEqual(self.js("return state.toml"), before)

    def choose(self, path):
        self.js("const p = document.getElementById('preset'); p.value = arguments[0]; p.onchange()", path)

    def show_parts(self):
        """Every panel is drawn: no sentence instead of a picture, and lines that are somewhere."""
        for panel in ("orbit", "time", "contact", "spectrum", "curve"):
            with self.subTest(panel=panel):
                self.assertEqual(self.js("return document.querySelectorAll(`#${arguments[0]} .none`).length", panel), 0)
                marks = self.js("return Array.from(document.querySelectorAll(`#${arguments[0]} path:not(.axis)`),"
                                " (p) => p.getAttribute('d'))", panel)
                self.assertGreater(len(marks), 0 if panel == "spectrum" else 1)
                self.assertNotIn("NaN", "".join(marks))

    # Every machine that the page offers has a motion, what it does from rest, a verdict and a response.
    def test_presets(self):
        presets = self.js("return PRESETS.map((p) => p.path)")
        self.assertEqual(len(presets), 5)
        for path in presets:
            with self.subTest(preset=path):
                self.choose(path)
                self.settled()
                state = self.js("return state")
                self.assertEqual(state["toml"], Path(path).read_text())
                self.assertIn(f"build/explore orbit {path} --frequency {state['f']}", self.text("command"))
                self.assertEqual(float(self.js("return $('f-slide').value")), state["f"])
                self.wait("$('verdict').className !== 'computing'")
                self.assertIn(self.js("return $('verdict').className"), ("stable", "unstable", "undecided"))
                self.wait("/periodic|chaotic/.test($('steady').textContent)")
                self.wait("!engines.curve.job && shown.branch.length > 30 && $('curve-state').textContent.includes('points')"
                          " && Math.min(...shown.branch.map((p) => p[0])) < state.from + 2", 120)
                self.assertGreater(max(point[0] for point in self.js("return shown.branch")), state["to"] - 2)
                self.show_parts()
                given = self.text("command").split()[2:]
                native = subprocess.run([EXPLORE, "orbit", *given], capture_output=True, encoding="utf-8")
                what, m = ("verdict", 0) if self.js("return shown.motion.isSteady") else ("orbit", state["m"])
                self.compare(self.ask(what, state["toml"], state["f"], m)["samples"], numbers_of(native.stdout))

    # What a page of 0.1.0 has written into the address is still read.
    def test_link_of_the_first_version(self):
        toml = Path("data/live/bearing-6205.toml").read_text()
        for name, text, path in [("bearing-6205.toml", toml, "data/live/bearing-6205.toml"),
                                 ("own.toml", MACHINE.replace("0.05", "0.04"), "own.toml")]:
            given = {"f": 30, "m": 12, "from": 20, "to": 50, "name": name, "toml": text}
            self.driver.get("about:blank")
            self.open(f"{PAGE.resolve().as_uri()}#{urllib.parse.urlencode(given)}")
            self.assertEqual(self.js("return [state.f, state.m, state.from, state.to, state.name, state.toml, state.path]"),
                             [30, 12, 20, 50, name, text, path])
            self.assertGreater(self.js("return shown.motion.rows"), 0)

    def test_controls(self):
        from selenium.webdriver.common.action_chains import ActionChains
        from selenium.webdriver.common.keys import Keys
        slide = self.find('[data-key="bearing.radial_clearance_m"] input[type=range]')
        before = self.js("return Array.from(shown.motion.x_r)")
        slide.send_keys(Keys.ARROW_RIGHT * 5)
        self.settled()
        clearance = self.js("return shown.motion.clearance")
        self.assertAlmostEqual(clearance, 2.2e-5, delta=1e-9)
        self.assertIn(f"radial_clearance_m = {clearance:.7f}".rstrip("0"), self.js("return state.toml"))
        self.assertNotEqual(before, self.js("return Array.from(shown.motion.x_r)"))
        self.find('[data-key="bearing.radial_clearance_m"] button').click()
        self.settled()
        self.assertEqual(self.js("return state.toml"), MACHINE)
        # A number out of range goes red with what is accepted, and nothing is shown for it.
        self.type_into("#f", "45")
        self.type_into("#key-bearing-balls", "0")
        self.wait("$('key-bearing-balls').getAttribute('aria-invalid') === 'true'")
        self.assertIn("must be in 1...1024, got 0", self.find('[data-key="bearing.balls"] .refusal').text)
        self.assertIsNone(self.js("return shown.motion"))
        self.type_into("#key-bearing-balls", "8")
        self.settled()
        self.assertEqual(self.js("return shown.motion.balls"), 8)
        self.find('[data-key="bearing.balls"] button').click()
        self.settled()
        self.type_into("#f", "-3")
        self.assertIn("must be in 0.1", self.find('[data-key="frequency"] .refusal').text)
        self.type_into("#f", "20")
        self.settled()
        # Dragging in the response curve, and its keys.
        curve = self.find("#curve")
        ActionChains(self.driver).move_to_element(curve).click_and_hold().move_by_offset(60, 0).release().perform()
        self.settled()
        dragged = self.js("return state.f")
        self.assertTrue(30 < dragged < 50, dragged)
        curve.send_keys(Keys.ARROW_LEFT)
        self.assertAlmostEqual(self.js("return state.f"), dragged - 0.1, delta=0.011)
        self.settled()
        # Play and help by keyboard.
        body = self.find("body")
        self.js("document.activeElement.blur()")
        body.send_keys(" ")
        self.assertEqual(self.text("play"), "Play")
        turns = self.js("return shown.turns")
        time.sleep(0.2)
        self.assertEqual(self.js("return shown.turns"), turns)
        body.send_keys("?")
        self.assertTrue(self.find("#help").is_displayed())
        self.find("#help").send_keys(Keys.ESCAPE)
        self.assertFalse(self.find("#help").is_displayed())
        self.find("#relative").click()
        self.assertEqual(self.js("return Math.max(...shown.view.x_s.map(Math.abs))"), 0)
        self.find("#reset-all").click()
        self.settled()
        self.assertEqual(self.js("return state.toml"), MACHINE)

    def test_what_is_taken_away(self):
        self.type_into("#key-rotor-unbalance_kg_m", "0.03")
        self.type_into("#f", "30")
        self.settled()
        changed = MACHINE.replace("0.05\n\n[bearing]", "0.03\n\n[bearing]")
        for button, name in [("save-toml", "set1.toml"), ("save-tsv", "set1-orbit.tsv"), ("save-svg", "set1.svg")]:
            self.find(f"#{button}").click()
            end = time.monotonic() + 20
            while not (self.folder / name).exists() and time.monotonic() < end:
                time.sleep(0.05)
        self.assertEqual((self.folder / "set1.toml").read_text(), changed)
        native = self.explore("orbit", *self.text("command").split()[2:])
        table = (self.folder / "set1-orbit.tsv").read_text()
        self.compare([cell for row in numbers_of(table) for cell in row[1:]], numbers_of(native.stdout))
        self.assertEqual([line for line in table.splitlines() if line.startswith("# column")],
                         [line for line in native.stdout.splitlines() if line.startswith("# column")])
        xml.dom.minidom.parse(str(self.folder / "set1.svg"))
        self.find("#make-link").click()
        link = self.find("#link").get_attribute("value")
        self.driver.get("about:blank")
        self.open(link)
        self.assertEqual(self.js("return [state.toml, state.f, state.name]"), [changed, 30, "set1.toml"])
        self.find("#file").send_keys(str(self.folder / "set1.toml"))
        self.wait("state.path === 'set1.toml'")
        self.settled()

    def test_verdicts_look_different_and_the_steady_motion_is_drawn(self):
        self.type_into("#m", "10")
        for f, word in [(45, "stable"), (20, "unstable")]:
            self.type_into("#f", f)
            self.assertEqual(self.js("return $('orbit').getAttribute('class')"), "computing")
            self.wait("$('verdict').className !== 'computing'")
            self.assertEqual(self.js("return [$('verdict').className, $('orbit').getAttribute('class')]"), [word] * 2)
            self.wait("!$('error-state').textContent.includes('computing')")
            self.assertIn("of the largest displacement", self.text("error-state"))
        self.type_into("#f", 45)
        self.settled()
        self.wait("document.querySelectorAll('#orbit .steady').length === 2")
        self.assertIn("periodic", self.text("steady"))
        off = self.js("const a = shown.motion, b = shown.steady; return Math.max(...a.x_r.map((v, k) =>"
                      " Math.abs(v - b.x_r[k]))) / Math.max(...b.x_r)")
        self.assertLess(off, 1e-3)

    def test_no_solution_says_so_and_shows_what_the_machine_does(self):
        self.choose("data/set2.toml")
        self.type_into("#m", 10)
        self.type_into("#f", 15)
        self.wait("$('motion-state').textContent.startsWith('no solution')")
        self.wait("shown.motion && shown.motion.isSteady")
        self.assertIn("no solution found with 10 harmonics at 15 Hz", self.text("motion-state"))
        self.assertIn("orbit data/set2.toml --frequency 15", self.text("command"))
        self.assertNotIn("--harmonics", self.text("command"))
        self.assertRegex(self.text("steady"), "periodic|chaotic")
        self.type_into("#f", 45)
        self.settled()

    def test_cancel_and_crash(self):
        # 1,000 balls at 64 harmonics, and no time to wait.
        self.type_into("#m", 64)
        self.js("setLine(state.toml.split('\\n').findIndex((l) => l.startsWith('balls')), '1000')")
        self.js("engines.quick.cancel()")
        self.wait("$('motion-state').textContent === 'cancelled'")
        self.assertIsNone(self.js("return shown.motion"))
        self.type_into("#m", 10)
        self.type_into("#f", 45)
        self.find("#reset-all").click()
        self.settled()
        crashed = self.ask("crash", MACHINE, 45)
        self.assertEqual(crashed["status"], 4)
        self.assertIn("started again", crashed["text"])
        self.type_into("#f", 44)
        self.settled()
        self.assertTrue(self.js("return shown.motion.rows > 0"))

    def test_response_grows_has_folds_and_is_cancelled(self):
        self.wait("shown.branch.length > 20")
        self.wait("$('curve-state').textContent.includes('folds')")
        self.choose("data/set2.toml")
        self.wait("engines.curve.job && shown.branch.length > 20")
        self.find("#curve-cancel").click()
        self.wait("$('curve-state').textContent === 'cancelled'")
        self.type_into("#from", 44)
        self.wait("$('curve-state').textContent.includes('folds')")
        native = self.explore("response", Path("data/set2.toml").resolve(), "--from", 44, "--to", 60, "--harmonics", 6)
        rows = numbers_of(native.stdout)
        branch = self.js("return shown.branch")
        nearest = min(branch, key=lambda point: abs(point[0] - rows[0][0]))
        for ours, theirs in zip(nearest, rows[0]):
            self.assertAlmostEqual(ours / theirs, 1, delta=1e-9)

    def test_no_request_from_file_or_server(self):
        for address in (PAGE.resolve().as_uri(), served(PAGE.parent, self.addCleanup) + "index.html"):
            self.driver.get("about:blank")
            self.requests()
            self.open(address)
            self.wait("['stable', 'unstable', 'undecided'].includes($('verdict').className)")
            self.assertEqual({url for url in self.requests() if not url.startswith(("data:", "blob:"))}, {address})

    def memory(self):
        self.driver.execute_cdp_cmd("HeapProfiler.collectGarbage", {})
        heap = self.driver.execute_cdp_cmd("Runtime.getHeapUsage", {})
        return heap["usedSize"] + heap["backingStorageSize"], self.js("return [Number(document.body.dataset.memory), document.querySelectorAll('*').length]")

    def test_memory_does_not_grow(self):
        sizes = []
        for changes in (200, 800):
            self.driver.execute_async_script(
                "const [count, done] = arguments; (async () => { for (let k = 0; k < count; ++k) {"
                " setSpeed(20 + 30 * (k % 97) / 97); await new Promise((r) => { const look = () =>"
                " engines.quick.job ? setTimeout(look, 0) : r(); look(); }); } })().then(done)", changes)
            self.settled()
            sizes.append(self.memory())
        (heap, [module, elements]), (heap_after, [module_after, elements_after]) = sizes
        self.assertEqual(module_after, module)
        self.assertLess(heap_after, heap + 2e6)
        self.assertLess(abs(elements_after - elements), 100)
        print(f"memory after 200 and 1,000 changes: module {module} and {module_after} bytes, page {heap} and {heap_after} bytes")


if __name__ == "__main__":
    if not PAGE.exists():
        why = "emscripten is not installed" if not shutil.which("em++") else "it is not built"
        print(f"skipped: there is no live page, {why} (make deps live)")
        sys.exit(77)
    if subprocess.run(["make", "-q", "live"], capture_output=True).returncode:
        print("skipped: the live page is older than its sources (make live)")
        sys.exit(77)
    unittest.main()
