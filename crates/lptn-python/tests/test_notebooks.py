"""The notebooks of docs/notebooks print what stands in them, and are pages of the book.

`LPTN_BLESS=1` runs them and writes their outputs and pages. They run from the root of the repository, in a kernel if
nbclient and ipykernel are installed, otherwise cell by cell in this process, without the pictures.
"""

import contextlib
import importlib.util
import io
import json
import os
import pathlib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
FOLDER = ROOT / "docs" / "notebooks"
BLESS = bool(os.environ.get("LPTN_BLESS"))


def missing():
    """A package of the notebooks that is not installed."""
    needed = ["pandas", "scipy"] + (["nbclient", "ipykernel"] if BLESS else [])
    return [name for name in needed if importlib.util.find_spec(name) is None]


def has_kernel():
    return all(importlib.util.find_spec(name) for name in ("nbclient", "nbformat", "ipykernel"))


def in_kernel(notebook):
    """Texts and pictures of each code cell, from a kernel."""
    import nbclient
    import nbformat

    node = nbformat.reads(json.dumps(notebook), as_version=4)
    # the kernel of this environment, whatever others are installed
    nbclient.NotebookClient(
        node, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(ROOT)}}
    ).execute()
    return [outputs(cell) for cell in node.cells if cell.cell_type == "code"]


def outputs(cell):
    """Text on stdout, and the picture."""
    text = "".join("".join(out["text"]) for out in cell["outputs"] if out["output_type"] == "stream")
    data = [out["data"] for out in cell["outputs"] if "data" in out]
    pictures = [one["image/svg+xml"] for one in data if "image/svg+xml" in one]
    return text, "".join(pictures[0]) if pictures else None


def in_process(notebook):
    """The texts of each code cell; pictures need a kernel."""
    names, found = {}, []
    before = os.getcwd()
    os.chdir(ROOT)
    try:
        for cell in notebook["cells"]:
            if cell["cell_type"] != "code":
                continue
            code = "".join(cell["source"])
            out = io.StringIO()
            if "IPython" not in code:
                with contextlib.redirect_stdout(out):
                    exec(compile(code, "cell", "exec"), names)
            found.append((out.getvalue(), None))
    finally:
        os.chdir(before)
    return found


def lines(text):
    return text.splitlines(keepends=True)


def stored(found):
    """Outputs as a notebook stores them."""
    text, picture = found
    kept = []
    if text:
        kept.append({"name": "stdout", "output_type": "stream", "text": lines(text)})
    if picture:
        data = {"image/svg+xml": lines(picture), "text/plain": ["<picture>"]}
        kept.append({"data": data, "metadata": {}, "output_type": "display_data"})
    return kept


def joined(parts):
    """The parts of a page: a block needs no empty line around it."""
    text = parts[0]
    for before, part in zip(parts, parts[1:]):
        block = before.startswith("```") or part.startswith("```")
        text += ("\n" if block else "\n\n") + part
    return text


def page(file, notebook):
    """The notebook as a page of the book, and its pictures by name."""
    parts, pictures = [], {}
    for cell in notebook["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(source)
            continue
        parts.append(f"```python\n{source}\n```")
        text, picture = outputs(cell)
        if text:
            parts.append(f"```text\n{text.rstrip()}\n```")
        if picture:
            name = f"{file.stem}_{len(pictures) + 1}.svg"
            pictures[name] = picture
            parts.append(f"![The figure of the last cell]({name})")
    link = f"This page is the notebook [{file.name}]({file.name}).\nRun it from the root of the repository."
    return joined([*parts, link]) + "\n", pictures


@unittest.skipIf(missing(), f"SKIPPED: not installed: {', '.join(missing())}")
class Notebooks(unittest.TestCase):
    def test_notebooks_print_what_stands_in_them(self):
        files = sorted(FOLDER.glob("*.ipynb"))
        self.assertEqual(len(files), 4)
        for file in files:
            with self.subTest(notebook=file.name):
                self.one(file)

    def one(self, file):
        notebook = json.loads(file.read_text(encoding="utf-8"))
        found = in_kernel(notebook) if has_kernel() else in_process(notebook)
        cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
        if BLESS:
            for cell, one in zip(cells, found):
                cell["outputs"], cell["execution_count"] = stored(one), None
            file.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        for cell, (text, picture) in zip(cells, found):
            kept = outputs(cell)
            self.assertEqual(text, kept[0])
            if picture is not None:
                self.assertEqual(picture, kept[1])
        text, pictures = page(file, notebook)
        for name, picture in {**pictures, file.with_suffix(".md").name: text}.items():
            if BLESS:
                (FOLDER / name).write_text(picture, encoding="utf-8")
            self.assertEqual((FOLDER / name).read_text(encoding="utf-8"), picture, name)


if __name__ == "__main__":
    unittest.main()
