"""The examples of docs/python.md print what stands there. `LPTN_BLESS=1` writes it."""

import contextlib
import importlib.util
import io
import os
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs" / "python.md"

# A block of Python, perhaps with the block of what it prints.
EXAMPLE = re.compile(
    r"```python (?P<file>\S+) optional\n(?P<code>.*?)```\n(?:\n?```text\n(?P<text>.*?)```\n)?",
    re.DOTALL,
)


def missing(code):
    """The first package that an example imports and that is not installed."""
    names = re.findall(r"^(?:import|from) (\w+)", code, re.MULTILINE)
    return next((name for name in names if importlib.util.find_spec(name) is None), None)


class Page(unittest.TestCase):
    def test_examples_print_what_the_page_says(self):
        page = PAGE.read_text(encoding="utf-8")
        examples = [found for found in EXAMPLE.finditer(page) if found["code"].startswith("import lptn")]
        self.assertGreaterEqual(len(examples), 5)
        before = os.getcwd()
        os.chdir(ROOT)
        self.addCleanup(os.chdir, before)
        for found in examples:
            if found["text"] is None and missing(found["code"]):
                print(f"SKIPPED: {found['file']} needs {missing(found['code'])}")
                continue
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                exec(compile(found["code"], found["file"], "exec"), {})
            if os.environ.get("LPTN_BLESS") and found["text"] is not None:
                new = found[0].replace(f"```text\n{found['text']}", f"```text\n{out.getvalue()}")
                page = page.replace(found[0], new)
                PAGE.write_text(page, encoding="utf-8")
            elif found["text"] is not None:
                self.assertEqual(out.getvalue(), found["text"], found["file"])


if __name__ == "__main__":
    unittest.main()
