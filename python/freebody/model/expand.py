"""Repetition: a key ``link[i = 1 .. N]`` becomes ``link[1]`` … ``link[N]``, and brackets in names are worked out."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING, Any

from .errors import ModelFileError, ModelProblem, Path
from .names import replace_names, work_out_indices

if TYPE_CHECKING:
    from .scope import Scope

MAX_ITEMS = 100_000
"""That the repetitions of a whole model make, parts included."""
MAX_NODES = 4_000_000
"""Names and values of a whole model, written out, parts included."""

_SHIFTED = re.compile(r"\s*([^\W\d]\w*)\s*(?:([+-])\s*(\d{1,9}))?\s*")
_REPEAT = re.compile(r"\[\s*([^\W\d]\w*)\s*=\s*(.+?)\s*\.\.\s*([^\]]+?)\s*\]")
_AS_WRITTEN = {("name",), ("freebody",)}


@dataclass
class Size:
    """How large a whole model has become: its items from repetitions, and all its names and values."""

    items: int = 0
    nodes: int = 0

    def grow(self, scope: Scope, path: Path, items: int, nodes: int) -> None:
        """Raises ``ModelFileError`` where it is too large, with what made it so."""
        self.items, self.nodes = self.items + items, self.nodes + nodes
        for what, made, most in (("items by repetition", self.items, MAX_ITEMS), ("names and values", self.nodes, MAX_NODES)):
            if made > most:
                stated = f"the model has more than {most} {what}, parts included"
                scope.complain(path, stated, "repeat fewer, or smaller items", True)
                raise ModelFileError(scope.problems)


class Expansion:
    """Plain data with repetitions written out.

    ``whole`` works out a whole number of parameters. ``origin`` leads from the path of a written-out item to that of the
    item that made it. What is wrong is noted in ``scope``; too many items raise ``ModelFileError``.
    """

    def __init__(self, whole: Callable[[str], int], scope: Scope, size: Size) -> None:
        self.whole, self.scope, self.size = whole, scope, size
        self.origin: dict[Path, Path] = {}

    def of(self, data: Any, path: Path = (), source: Path = (), index: dict[str, int] | None = None) -> Any:
        """The data written out; ``index`` holds the values of the indices around it."""
        index = index or {}
        self.size.grow(self.scope, source, 0, 1)
        if isinstance(data, dict):
            return self._mapping(data, path, source, index)
        if isinstance(data, list):
            return [self.of(item, (*path, i), (*source, i), index) for i, item in enumerate(data)]
        if not isinstance(data, str) or source in _AS_WRITTEN or (source[:1] == ("parts",) and source[-1] == "file"):
            return data
        with self.scope.noting(source):
            return _with_index(self._worked_out(data, index), index)
        return data

    def _mapping(self, data: dict[str, Any], path: Path, source: Path, index: dict[str, int]) -> dict[str, Any]:
        out: dict[str, Any] = {}
        for key, value in data.items():
            inner, names = (*source, key), [(key, index)]
            with self.scope.noting(inner, True):
                names = list(islice(self._repeated(key, index), MAX_ITEMS + 1))
            for name, inside in names:
                if name in out:
                    what = f"`{name}` is used twice, once from a repetition"
                    self.scope.complain(inner, what, "give one of them another name", True)
                    continue
                if name != key:
                    self.origin[(*path, name)] = inner
                    self.size.grow(self.scope, inner, 1, 0)
                out[name] = self.of(value, (*path, name), inner, inside)
        return out

    def _repeated(self, key: str, index: dict[str, int]) -> Iterator[tuple[str, dict[str, int]]]:
        found = _REPEAT.search(key)
        if not found:
            yield self._worked_out(key, index), index
            return
        first, last = (self._index(text, index) for text in found.group(2, 3))
        if last - first >= MAX_ITEMS:
            raise ModelProblem(f"`{key}` makes {last - first + 1} items", f"at most {MAX_ITEMS} are allowed")
        for i in range(first, last + 1):
            yield from self._repeated(f"{key[: found.start()]}[{i}]{key[found.end() :]}", index | {found[1]: i})

    def _worked_out(self, text: str, index: dict[str, int]) -> str:
        return work_out_indices(text, lambda inside: self._index(inside, index))

    def _index(self, text: str, index: dict[str, int]) -> int:
        if text.strip().lstrip("-").isdecimal():
            return int(text)
        # What nearly all indices are, `i - 1`; anything else is worked out as an expression.
        if (found := _SHIFTED.fullmatch(text)) and found[1] in index:
            return index[found[1]] + int(f"{found[2] or ''}{found[3] or 0}")
        return self.whole(_with_index(text, index))


def repeats(data: Any) -> bool:
    """Whether anything in the data must be written out."""
    if isinstance(data, dict):
        return any("[" in key or repeats(value) for key, value in data.items())
    if isinstance(data, list):
        return any(repeats(item) for item in data)
    return isinstance(data, str) and "[" in data


def _with_index(text: str, index: dict[str, int]) -> str:
    def number(name: str, is_call: bool) -> str:
        if is_call or name not in index:
            return name
        return str(index[name]) if index[name] >= 0 else f"({index[name]})"

    return replace_names(text, number) if index else text
