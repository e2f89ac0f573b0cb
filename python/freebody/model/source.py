"""Texts of model files: YAML 1.2 (and so JSON) as plain data, in which every key knows its line and column."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from pathlib import Path as FilePath
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from .errors import ModelFileError, Path, Problem, Where, path_text

MAX_BYTES = 64 * 2**20
MAX_NODES = 4_000_000
MAX_DEPTH = 64

Mark = tuple[int, int]


@dataclass
class Source:
    """A model file as it was written: its name, its text, its plain data, and where each item stands."""

    file: str
    text: str = ""
    data: Any = None
    keys: dict[Path, Mark] = field(default_factory=dict)
    values: dict[Path, Mark] = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)

    def where(self, path: Path, at_key: bool = False) -> Where:
        """The place of an item, or of the nearest that holds it."""
        mark = None
        for length in range(len(path), -1, -1):
            marks = (self.keys, self.values) if at_key or length < len(path) else (self.values, self.keys)
            mark = marks[0].get(path[:length]) or marks[1].get(path[:length])
            if mark:
                break
        line, column = mark or (0, 0)
        return Where(self.file, line, column, path_text(path), self.excerpt(line))

    def excerpt(self, line: int) -> str:
        """The text of a line, counted from 1; empty when there is none or it is very long."""
        lines = self._lines()
        text = lines[line - 1] if 0 < line <= len(lines) else ""
        return text if len(text) <= 160 else ""

    def _lines(self) -> list[str]:
        if not hasattr(self, "_split"):
            self._split = self.text.splitlines()
        return self._split

    def complain(self, path: Path, what: str, hint: str = "", at_key: bool = False) -> None:
        """Adds a problem."""
        self.problems.append(Problem(self.where(path, at_key), what, hint))

    def check(self) -> None:
        """Raises ``ModelFileError`` when there are problems."""
        if self.problems:
            raise ModelFileError(self.problems)


def open_file(path: FilePath) -> Source:
    """Reads a file. Raises ``ModelFileError``, also when it cannot be read."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise _refused(
                str(path), f"the file is larger than {MAX_BYTES // 2**20} MiB", "use repetition, e.g. `link[i = 1 .. N]`"
            )
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise _refused(str(path), "there is no such file", _neighbours(path)) from None
    except UnicodeDecodeError as error:
        raise _refused(str(path), f"this is no text in UTF-8 (byte {error.start})", "save it as UTF-8") from None
    except OSError as error:
        raise _refused(str(path), f"it cannot be read: {error.strerror}") from None
    return read_text(text, str(path))


def read_text(text: str, file: str = "model") -> Source:
    """Reads the text of a model. Raises ``ModelFileError`` when it is no YAML mapping."""
    if len(text.encode()) > MAX_BYTES:
        raise _refused(file, f"the model is larger than {MAX_BYTES // 2**20} MiB")
    if text.lstrip().startswith("{"):
        text = text.replace("\t", " ")  # JSON may be indented with tabs, and has none inside its texts
    source = Source(file, text)
    try:
        node = YAML(typ="safe", pure=True).compose(text)
    except (YAMLError, ValueError, RecursionError) as error:
        raise ModelFileError([_syntax(source, error)]) from None
    if not isinstance(node, MappingNode):
        raise _refused(file, "a model file is a mapping of sections", "begin with `freebody: 1`, then `bodies:`, `joints:` …")
    source.data = _Reader(source).read(node, ())
    return source


def _refused(file: str, what: str, hint: str = "") -> ModelFileError:
    return ModelFileError([Problem(Where(file), what, hint)])


def _neighbours(path: FilePath) -> str:
    from .names import nearest

    near = nearest(path.name, (p.name for p in path.parent.glob("*.*"))) if path.parent.is_dir() else None
    return f"did you mean `{near}`?" if near else "check the name and the folder"


class _Reader:
    """Turns nodes to plain data, notes their places, and finds keys that are used twice."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.count = 0

    def read(self, node: Node, path: Path) -> Any:
        self.count += 1
        if self.count > MAX_NODES or len(path) > MAX_DEPTH:
            limit = f"more than {MAX_NODES} items" if self.count > MAX_NODES else f"nested more than {MAX_DEPTH} deep"
            raise ModelFileError(
                [Problem(self.source.where(path[:-1]), f"the model is too large: {limit}", "aliases (`*name`) count each time")]
            )
        self.source.values[path] = (node.start_mark.line + 1, node.start_mark.column + 1)
        if isinstance(node, MappingNode):
            return self._mapping(node, path)
        if isinstance(node, SequenceNode):
            return [self.read(item, (*path, i)) for i, item in enumerate(node.value)]
        return _scalar(node.tag.rpartition(":")[2], _paired(node.value))

    def _mapping(self, node: MappingNode, path: Path) -> dict[str, Any]:
        out: dict[str, Any] = {}
        for key, value in node.value:
            mark = (key.start_mark.line + 1, key.start_mark.column + 1)
            if not isinstance(key, ScalarNode):
                self._complain(
                    mark,
                    path,
                    "a key must be a plain name",
                    "in flow style write `{name: value}`; expressions in braces need quotes",
                )
                continue
            name = _paired(key.value)
            inner = (*path, name)
            if name in out:
                first = self.source.keys[inner][0]
                self._complain(mark, inner, f"`{name}` is used twice (first in line {first})", "give one of them another name")
                continue
            self.source.keys[inner] = mark
            out[name] = self.read(value, inner)
        return out

    def _complain(self, mark: Mark, path: Path, what: str, hint: str) -> None:
        where = Where(self.source.file, *mark, path_text(path), self.source.excerpt(mark[0]))
        self.source.problems.append(Problem(where, what, hint))


def _paired(text: str) -> str:
    """The text with the two halves of a sign joined that JSON writes as ``\\ud83d\\ude00``; a lone half becomes a mark."""
    return text if text.isascii() else text.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "replace")


def _scalar(kind: str, text: str) -> Any:
    """The value of a scalar whose tag ends so."""
    if kind == "null":
        return None
    if kind == "bool":
        return text.lower() == "true"
    if kind == "int":
        digits = text.replace("_", "")
        if len(digits) > 400:
            return math.inf
        return int(digits, 0) if digits.lstrip("+-")[:2].lower() in ("0x", "0o") else int(digits)
    if kind == "float":
        return _float(text.replace("_", "").lower())
    return text


def _float(text: str) -> float:
    if text.endswith(".nan"):
        return math.nan
    return -math.inf if text == "-.inf" else math.inf if text.endswith(".inf") else float(text)


_WORDS = (
    (re.compile(r"character '\\t'|tab", re.I), "a tab character stands here", "YAML is indented with spaces"),
    (
        re.compile("mapping values are not allowed"),
        "a second `:` on this line",
        "put quotes around a text that holds `: `, or check the indentation",
    ),
    (re.compile("expected ',' or"), "a bracket or brace is not closed, or a comma is missing", ""),
    (
        re.compile("did not find expected|expected <block end>|could not find expected"),
        "the indentation does not fit, or a `:` is missing",
        "",
    ),
    (
        re.compile("undefined alias"),
        "`*` begins an alias that is not defined",
        "put quotes around an expression that begins with `*`",
    ),
    (re.compile("cannot start any token"), "a text cannot begin with this character", "put quotes around it"),
    (
        re.compile("while scanning a quoted scalar|unexpected end of stream"),
        "a quotation is not closed",
        "close it with the quote it begins with",
    ),
)
_BRACKET_NAME = re.compile(r"[\[{,].*\w\[")


def _syntax(source: Source, error: Exception) -> Problem:
    """What a newcomer can make of a complaint of the YAML reader."""
    if not isinstance(error, MarkedYAMLError):
        what = "it is nested too deep" if isinstance(error, RecursionError) else str(error).splitlines()[0]
        return Problem(Where(source.file), f"this is no YAML: {what}")
    mark = error.problem_mark or error.context_mark
    line, column = (mark.line + 1, mark.column + 1) if mark else (0, 0)
    excerpt = source.excerpt(line)
    said = " ".join(str(part) for part in (error.context, error.problem) if part)
    what, hint = next(((w, h) for pattern, w, h in _WORDS if pattern.search(said)), (f"this is no YAML: {said}", ""))
    if excerpt[column - 1 : column] == "\t" or excerpt[: column - 1].strip(" ").startswith("\t"):
        _, what, hint = _WORDS[0]
    elif _BRACKET_NAME.search(excerpt):
        what, hint = "a name with brackets needs quotes inside [ ] and { }", 'write "link[1].end"'
    return Problem(Where(source.file, line, column, "", excerpt), what, hint)
