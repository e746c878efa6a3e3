"""A headless browser and a server, for the tests that read pages."""
import functools
import http.server
import json
import shutil
import tempfile
import threading
import unittest
from pathlib import Path

FLAGS = ("headless=new", "no-sandbox", "disable-gpu", "hide-scrollbars", "no-first-run", "disable-background-networking",
         "disable-component-update", "disable-sync")


class BrowserCase(unittest.TestCase):
    """A headless browser, whose profile and downloads go into a folder of its own. No test may leave a message of it."""
    FLAGS = ()

    @classmethod
    def setUpClass(cls):
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = Path(scratch.name)
        options = webdriver.ChromeOptions()
        for flag in (*FLAGS, *cls.FLAGS, f"user-data-dir={cls.folder}/profile"):
            options.add_argument(f"--{flag}")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        cls.addClassCleanup(cls.driver.quit)
        cls.driver.set_script_timeout(300)
        cls.driver.execute_cdp_cmd("Page.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(cls.folder)})

    def setUp(self):
        self.driver.get("about:blank")
        self.driver.get_log("browser"), self.driver.get_log("performance")

    def tearDown(self):
        self.assertEqual([entry["message"] for entry in self.driver.get_log("browser")], [])

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def requests(self):
        """The addresses that the browser has asked for since they were last looked at."""
        sent = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return {message["params"]["request"]["url"] for message in sent if message["method"] == "Network.requestWillBeSent"}


class Silent(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def served(folder, cleanup):
    """The address of a folder's files; `cleanup` takes what ends the server."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Silent, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    cleanup(server.server_close)
    cleanup(server.shutdown)
    return f"http://127.0.0.1:{server.server_port}/"
