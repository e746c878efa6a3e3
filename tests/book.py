"""Reads the pages as a reader would, in a headless browser.

Every program and module has its page. All pages: every link leads somewhere, every picture has an
alternative text, the HTML is valid, and none is longer than a sitting; a page with a figure has words of
its own.
The index, two pages and the article, opened: no message of the browser, all pictures loaded, equations
rendered, nothing wider than the window, and the search finds what is there and nothing else. Each
is kept as a picture, 1280 and 400 pixels wide, in build/screenshots.

Usage: tests/book.py   (from the project's root, after `make all`)
"""
import re
import shutil
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

BOOK, ARTICLE = Path("build/book"), Path("build/paper/article.html")
SHOTS = Path("build/screenshots")
OPENED = [BOOK / "index.html", BOOK / "model-ball_bearing.html", BOOK / "fig07_contact.html",
          ARTICLE]
COLLECTIONS = {"index.html", "list_of_deviations.html", "article.html"}
WITH_EQUATIONS = {"model-ball_bearing.html", "article.html"}
WIDTHS = (1280, 400)
# A file is cut at its headings from 250 lines of code on; one idea may be longer than that.
LEAST_WORDS, MOST_WORDS, MOST_CODE = 200, 3000, 330


class Links(HTMLParser):
    """What a page points to, what it can be pointed at, and its pictures without a text."""

    def __init__(self):
        super().__init__()
        self.targets, self.names, self.silent = [], set(), []

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.targets += [found[key] for key in ("href", "src") if found.get(key)]
        self.names.update(found[key] for key in ("id", "name") if found.get(key))
        if tag == "img" and not found.get("alt"):
            self.silent.append(found.get("src"))


def read(page):
    links = Links()
    links.feed(page.read_text(encoding="utf-8"))
    return links


def broken_links(pages):
    """Links within the project that lead nowhere; those to the network are not followed."""
    known = {page.resolve(): read(page) for page in pages}
    for page, links in known.items():
        yield from (f"{page.name}: no text for {name}" for name in links.silent)
        for target in links.targets:
            if re.match(r"[a-z]+:", target):
                continue
            file, _, name = target.partition("#")
            to = (page.parent / file).resolve() if file else page
            if not to.exists():
                yield f"{page.name}: {target} is not there"
            elif name and to in known and name not in known[to].names:
                yield f"{page.name}: {target} names no place"


def invalid(pages):
    """What the validator says; MathML and SVG it does not know."""
    foreign = re.compile(r"<(math|svg)\b.*?</\1>", re.DOTALL)
    for page in pages:
        text = foreign.sub("", page.read_text(encoding="utf-8"))
        said = subprocess.run(["tidy", "-quiet", "-errors", "-utf8", "--drop-empty-elements", "no"],
                              input=text, text=True, capture_output=True)
        yield from (f"{page.name}: {line}" for line in said.stderr.splitlines()
                    if "Error:" in line or "Warning:" in line)


def words_in(text):
    return len(re.sub(r"<[^>]+>", " ", text).split())


def lengths(pages):
    """Pages that are too long to read at once, and pages of a figure that say too little of it. Code,
    tables, captions and links to neighbours are not words of their own."""
    for page in pages:
        text = re.search(r"<main>(.*)</main>", page.read_text(encoding="utf-8"), re.DOTALL)[1]
        code = re.findall(r"<pre.*?</pre>", text, re.DOTALL)
        lines = sum(bool(line.strip()) for block in code
                    for line in re.sub(r"<[^>]+>", "", block).splitlines())
        prose = re.sub(r"<(pre|table|figure|math|style)\b.*?</\1>", " ", text, flags=re.DOTALL)
        own = words_in(re.split(r"<h2[^>]*>(?:What it makes|Where it stands)</h2>", prose)[0])
        if lines > MOST_CODE or own > MOST_WORDS:
            yield f"{page.name}: {lines} lines of code and {own} words are too much for one sitting"
        if re.match(r"fig\d\d", page.name) and 'src="figures/' not in text:
            yield f"{page.name}: shows no figure"
        if 'src="figures/' in text and own < LEAST_WORDS:
            yield f"{page.name}: shows a figure and has {own} words of its own"


def without_page():
    """Programs and modules that have no page."""
    for source in sorted(Path("src").rglob("*.?pp")):
        name = "-".join(source.with_suffix("").parts[1:]) + ".html"
        if not (BOOK / name).exists():
            yield f"{source}: no page {name}"


def browser(profile):
    options = webdriver.ChromeOptions()
    for flag in ("headless=new", "no-sandbox", "disable-gpu", "hide-scrollbars", "no-first-run",
                 "disable-background-networking", "disable-component-update", "disable-sync",
                 "allow-file-access-from-files", f"user-data-dir={profile}"):
        options.add_argument(f"--{flag}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


def window(driver, width):
    """Sets the width of the page itself, whatever the least width of a window is."""
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})


def faults_of(driver, page, width):
    """What is wrong with an opened page."""
    for entry in driver.get_log("browser"):
        yield f"the browser says {entry['message']}"
    for image in driver.find_elements(By.TAG_NAME, "img"):
        if not driver.execute_script("return arguments[0].naturalWidth > 0", image):
            yield f"{image.get_attribute('src')} did not load"
    if page.name in WITH_EQUATIONS:
        shown = driver.execute_script(
            "return [...document.querySelectorAll('math')].filter("
            "m => m.getBoundingClientRect().height > 5).length")
        if shown == 0:
            yield "no equation is rendered"
    wide = driver.execute_script("return document.documentElement.scrollWidth")
    if wide > width:
        yield f"{wide} pixels wide in a window of {width}"


def search_faults(driver):
    """The box finds the page of the ball bearing, and nothing for a word that is not there."""
    for word, least, most in (("clearance stiffness", 1, 60), ("xylophone", 0, 0)):
        box = driver.find_element(By.CSS_SELECTOR, ".search")
        box.clear()
        box.send_keys(word)
        found = len(driver.find_elements(By.CSS_SELECTOR, "#found li"))
        if not least <= found <= most:
            yield f"the search for {word!r} finds {found} pages"


def opened(profile):
    driver = browser(profile)
    try:
        for page in OPENED:
            for width in WIDTHS:
                window(driver, width)
                driver.get(page.resolve().as_uri())
                yield from (f"{page.name} at {width}: {fault}"
                            for fault in faults_of(driver, page, width))
                driver.save_screenshot(str(SHOTS / f"{page.stem}-{width}.png"))
            if page.name == "index.html":
                yield from search_faults(driver)
    finally:
        driver.quit()


def main():
    pages = sorted(BOOK.glob("*.html")) + [ARTICLE]
    SHOTS.mkdir(parents=True, exist_ok=True)
    sittings = [page for page in pages if page.name not in COLLECTIONS]
    faults = [*broken_links(pages), *invalid(pages), *lengths(sittings), *without_page()]
    with tempfile.TemporaryDirectory() as profile:
        faults += opened(profile)
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{len(pages)} pages, {len(faults)} faults")
    return 1 if faults or len(pages) < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
