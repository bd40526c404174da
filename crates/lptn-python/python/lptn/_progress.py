"""Progress bars by tqdm."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

Told = Callable[[float, float, str], None]


@contextmanager
def shown(words: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The words with a function for `progress=True`: a bar of tqdm while the work lasts."""
    if words.get("progress") is not True:
        if words.get("progress") is False:
            words = {name: word for name, word in words.items() if name != "progress"}
        yield words
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise ImportError("progress=True needs tqdm: pip install tqdm") from None

    with tqdm() as bar:

        def told(done: float, all: float, noun: str) -> None:
            bar.unit = f" {noun}"
            bar.total = all
            bar.update(done - bar.n)

        yield {**words, "progress": told}
