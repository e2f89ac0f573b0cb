"""Repetition: a key ``link[i = 1 .. N]`` becomes ``link[1]`` … ``link[N]``, and brackets in names are worked out."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from .errors import ModelProblem, Path
from .names import replace_names, work_out_indices

MAX_ITEMS = 100_000

_REPEAT = re.compile(r"\[\s*([^\W\d]\w*)\s*=\s*(.+?)\s*\.\.\s*([^\]]+?)\s*\]")
_AS_WRITTEN = {("name",), ("freebody",)}

Whole = Callable[[str], int]
Complain = Callable[[Path, str, str, bool], None]


class Expansion:
    """Plain data with repetitions written out.

    ``whole`` works out a whole number of parameters. ``origin`` leads from the path of a written-out item to that of the
    item that made it. Problems go to ``complain`` with the path of the item as it stands in the file and whether its key is
    meant; too many items raise ``ModelProblem``.
    """

    def __init__(self, whole: Whole, complain: Complain) -> None:
        self.whole = whole
        self.complain = complain
        self.origin: dict[Path, Path] = {}
        self.items = 0

    def of(self, data: Any, path: Path = (), source: Path = (), index: dict[str, int] | None = None) -> Any:
        """The data written out; ``index`` holds the values of the indices around it."""
        index = index or {}
        if isinstance(data, dict):
            return self._mapping(data, path, source, index)
        if isinstance(data, list):
            return [self.of(item, (*path, i), (*source, i), index) for i, item in enumerate(data)]
        if not isinstance(data, str) or source in _AS_WRITTEN or (source[:1] == ("parts",) and source[-1] == "file"):
            return data
        return self._guarded(source, lambda: self._text(data, index), data)

    def _mapping(self, data: dict[str, Any], path: Path, source: Path, index: dict[str, int]) -> dict[str, Any]:
        out: dict[str, Any] = {}
        for key, value in data.items():
            inner = (*source, key)
            for name, inside in self._guarded(inner, lambda key=key: list(self._repeated(key, index)), [(key, index)], True):
                if name in out:
                    self.complain(inner, f"`{name}` is used twice, once from a repetition", "give one of them another name", True)
                    continue
                if name != key:
                    self._count()
                    self.origin[(*path, name)] = inner
                out[name] = self.of(value, (*path, name), inner, inside)
        return out

    def _repeated(self, key: str, index: dict[str, int]) -> Any:
        found = _REPEAT.search(key)
        if not found:
            yield (work_out_indices(key, lambda inside: self._index(inside, index)) if "[" in key else key), index
            return
        variable = found[1]
        first, last = (self._index(text, index) for text in found.group(2, 3))
        if last - first >= MAX_ITEMS:
            raise ModelProblem(f"`{key}` makes {last - first + 1} items", f"at most {MAX_ITEMS} are allowed")
        for i in range(first, last + 1):
            yield from self._repeated(f"{key[: found.start()]}[{i}]{key[found.end() :]}", index | {variable: i})

    def _count(self) -> None:
        self.items += 1
        if self.items > MAX_ITEMS:
            raise ModelProblem(f"repetitions make more than {MAX_ITEMS} items", "repeat fewer")

    def _index(self, text: str, index: dict[str, int]) -> int:
        return int(text) if text.strip().lstrip("-").isdecimal() else self.whole(_with_index(text, index))

    def _text(self, text: str, index: dict[str, int]) -> str:
        worked = work_out_indices(text, lambda inside: self._index(inside, index))
        return _with_index(worked, index)

    def _guarded(self, source: Path, work: Callable[[], Any], otherwise: Any, at_key: bool = False) -> Any:
        try:
            return work()
        except ModelProblem as complaint:
            self.complain(source, complaint.what, complaint.hint, at_key)
            return otherwise


def repeats(data: Any) -> bool:
    """Whether anything in the data must be written out."""
    if isinstance(data, dict):
        return any("[" in key or repeats(value) for key, value in data.items())
    if isinstance(data, list):
        return any(repeats(item) for item in data)
    return isinstance(data, str) and "[" in data


def _with_index(text: str, index: dict[str, int]) -> str:
    if not index:
        return text

    def number(name: str, is_call: bool) -> str:
        if is_call or name not in index:
            return name
        return str(index[name]) if index[name] >= 0 else f"({index[name]})"

    return replace_names(text, number)
