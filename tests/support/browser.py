"""A headless browser and a server, for the tests that read pages."""
import functools
import http.server
import shutil
import threading

FLAGS = ("headless=new", "no-sandbox", "disable-gpu", "hide-scrollbars", "no-first-run", "disable-background-networking",
         "disable-component-update", "disable-sync")


def browser(folder, *flags):
    """Its profile and what it downloads go into the folder; all its messages and requests are kept."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    options = webdriver.ChromeOptions()
    for flag in (*FLAGS, *flags, f"user-data-dir={folder}/profile"):
        options.add_argument(f"--{flag}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    driver.set_script_timeout(300)
    driver.execute_cdp_cmd("Page.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})
    return driver


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
