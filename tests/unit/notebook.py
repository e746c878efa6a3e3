"""paper/machine.ipynb runs from top to bottom and shows its pictures.
"""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from tests.support.explore import EXPLORE

NOTEBOOK = Path("paper/machine.ipynb")


class Notebook(unittest.TestCase):
    def test_it_runs(self):
        """Would catch an option or a column of explore, or a name of the module, that the notebook still has by its old name."""
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "EXPLORE": f"env {EXPLORE}", "HOME": folder}
            ran = subprocess.run(["jupyter-nbconvert", "--to", "notebook", "--execute", "--output-dir", folder, NOTEBOOK.resolve()],
                                 capture_output=True, encoding="utf-8", env=environment, check=False)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            cells = json.loads(Path(folder, NOTEBOOK.name).read_text(encoding="utf-8"))["cells"]
        outputs = [output for cell in cells for output in cell.get("outputs", [])]
        self.assertFalse([output for output in outputs if output.get("name") == "stderr"])
        data = [output.get("data", {}) for output in outputs]
        self.assertEqual(sum("image/png" in one or "<img" in "".join(one.get("text/html", "")) for one in data), 4)

    def test_it_is_kept_without_results(self):
        """A number in it would be one that was typed."""
        for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]:
            self.assertFalse(cell.get("outputs"))
