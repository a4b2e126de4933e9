"""The snippets of docs/python.md, in the order of the page."""

import contextlib
import io
import os
import re
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["PERILINK_SOURCE_DIR"])


class Docs(unittest.TestCase):
    def test_snippets_run_as_they_stand(self):
        page = (SOURCE / "docs/python.md").read_text(encoding="utf-8")
        snippets = re.findall(r"^```python\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        self.assertGreater(len(snippets), 4)
        names = {}
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            Path("meshes").symlink_to(SOURCE / "meshes")
            for number, snippet in enumerate(snippets, 1):
                with contextlib.redirect_stdout(io.StringIO()):
                    exec(compile(snippet, f"snippet {number} of docs/python.md", "exec"), names)
            self.assertTrue(Path("results/fine/history.csv").exists())
        peaks = names["peaks"]
        self.assertLess(peaks[2.0], peaks[4.0])
        self.assertEqual(names["scan"].table["peak_load"][3], peaks[3.0])
        self.assertEqual(len(names["problem"].regions["lower edge"]), 21)
        self.assertEqual(names["row"].step, 1)
        self.assertGreater(names["row"].load, 0.0)


if __name__ == "__main__":
    unittest.main()
