"""Where a model was written: texts of YAML 1.2 (and so JSON) as plain data, in which every key knows its line and column, and calls
in Python."""

from __future__ import annotations

import linecache
import math
import re
import sys
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate
from pathlib import Path as FilePath
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from .errors import ModelFileError, Path, Problem, Where, path_text
from .names import nearest

MAX_BYTES = 64 * 2**20
MAX_NODES = 4_000_000
MAX_DEPTH = 64
MAX_DIGITS = 308  # of a whole number: what has more is beyond all floating-point numbers

Mark = tuple[int, int]
_OWN = str(FilePath(__file__).parent.parent)


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
        for length in range(len(path), -1, -1):
            marks = (self.keys, self.values) if at_key or length < len(path) else (self.values, self.keys)
            if mark := marks[0].get(path[:length]) or marks[1].get(path[:length]):
                return self.at(mark, path)
        return self.at((0, 0), path)

    def at(self, mark: Mark, path: Path = ()) -> Where:
        """A place by its line and column, with the text of the line unless it is very long."""
        text = self._lines[mark[0] - 1] if 0 < mark[0] <= len(self._lines) else ""
        return Where(self.file, *mark, path_text(path), text if len(text) <= 160 else "")

    @cached_property
    def _lines(self) -> list[str]:
        return self.text.splitlines()

    def complain(self, path: Path, what: str, hint: str = "", at_key: bool = False) -> None:
        """Adds a problem."""
        self.problems.append(Problem(self.where(path, at_key), what, hint))

    def check(self) -> None:
        """Raises ``ModelFileError`` when there are problems."""
        if self.problems:
            raise ModelFileError(self.problems)

    def read(self, node: Node, path: Path = ()) -> Any:
        """The plain data of a node, whose places are noted; keys that are used twice are complained about."""
        if len(path) > MAX_DEPTH:
            raise self._too_large(self.where(path[:-1]), f"nested more than {MAX_DEPTH} deep")
        self.values[path] = _mark(node.start_mark)
        if isinstance(node, (MappingNode, SequenceNode)) and node.flow_style:
            self._whole(node, path)
        if isinstance(node, MappingNode):
            return self._mapping(node, path)
        if isinstance(node, SequenceNode):
            return [self.read(item, (*path, i)) for i, item in enumerate(node.value)]
        kind, text = node.tag.rpartition(":")[2], _paired(node.value)
        try:
            return _scalar(kind, text)
        except ValueError:
            what = f"`{text}` is no {'whole number' if kind == 'int' else 'number'}"
            self.complain(path, what, f"leave out the tag `!!{kind}`")
            return 0

    def measure(self, node: MappingNode) -> None:
        """Raises ``ModelFileError`` where the sections of a model have too many items, before these are made."""
        counts: dict[int, float] = {}
        for (_, section), total in zip(node.value, accumulate(_count(value, counts) for _, value in node.value), strict=True):
            if total > MAX_NODES:
                limit = f"more than {MAX_NODES} items" if total < math.inf else f"nested more than {MAX_DEPTH} deep"
                raise self._too_large(self.at(_mark(section.start_mark)), limit)

    def _too_large(self, where: Where, limit: str) -> ModelFileError:
        return ModelFileError([Problem(where, f"the model is too large: {limit}", "aliases (`*name`) count each time")])

    def _whole(self, node: MappingNode | SequenceNode, path: Path) -> None:
        """Raises ``ModelFileError`` where a comma between the parentheses of an expression has ended its text."""
        inside = [one for item in node.value for one in (item if isinstance(item, tuple) else (item,))]
        for one in inside[:-1]:
            if isinstance(one, ScalarNode) and one.style is None and one.value.count("(") > one.value.count(")"):
                what = f"the text `{one.value}` ends at a comma, which parts items in {{ }} and [ ]"
                where = self.at(_mark(one.start_mark), path)
                raise ModelFileError([Problem(where, what, "put quotes around the whole expression")])

    def _mapping(self, node: MappingNode, path: Path) -> dict[str, Any]:
        out: dict[str, Any] = {}
        for key, value in node.value:
            mark, name = _mark(key.start_mark), _paired(key.value) if isinstance(key, ScalarNode) else ""
            inner = (*path, name)
            if not isinstance(key, ScalarNode):
                hint = "in flow style write `{name: value}`; expressions in braces need quotes"
                self.problems.append(Problem(self.at(mark, path), "a key must be a plain name", hint))
            elif name in out:
                what = f"`{name}` is used twice (first in line {self.keys[inner][0]})"
                self.problems.append(Problem(self.at(mark, inner), what, "give one of them another name"))
            else:
                self.keys[inner] = mark
                out[name] = self.read(value, inner)
        return out


def _count(node: Node, known: dict[int, float]) -> float:
    """How many items a node is, aliases written out; infinitely many where it holds itself."""
    if id(node) not in known:
        known[id(node)] = math.inf
        inside = node.value if isinstance(node, (MappingNode, SequenceNode)) else []
        known[id(node)] = 1 + sum(_count(item[1] if isinstance(item, tuple) else item, known) for item in inside)
    return known[id(node)]


def _mark(place: Any) -> Mark:
    return place.line + 1, place.column + 1


class SourceLocations:
    """Where items were made: in the file that was loaded, or by a Python call."""

    def __init__(self, source: Source | None = None) -> None:
        self.source = source
        self.made: dict[Path, tuple[str, int]] = {}

    def note(self, path: Path) -> None:
        """Remembers the line outside freebody that is being executed."""
        self.made[path] = caller()

    def where(self, path: Path, at_key: bool = False) -> Where:
        """The place of an item, or of the nearest that holds it."""
        for length in range(len(path), 0 if self.source else -1, -1):
            if path[:length] in self.made:
                return called(*self.made[path[:length]], path)
        return self.source.where(path, at_key) if self.source else Where("", 0, 0, path_text(path))


def called(file: str, line: int, path: Path) -> Where:
    """The place of a Python call."""
    return Where(file, line, 0, path_text(path), linecache.getline(file, line).strip())


def caller() -> tuple[str, int]:
    """The file and line outside freebody that is being executed."""
    frame = sys._getframe(1)
    while frame.f_back and frame.f_code.co_filename.startswith(_OWN):
        frame = frame.f_back
    return frame.f_code.co_filename, frame.f_lineno


def open_file(path: FilePath) -> Source:
    """Reads a file. Raises ``ModelFileError``, also when it cannot be read."""
    try:
        if "\0" in str(path) or (path.exists() and not path.is_file()):
            raise _refused(str(path), "this is no regular file", "give the name of a model file")
        if path.stat().st_size > MAX_BYTES:
            hint = "use repetition, e.g. `link[i = 1 .. N]`"
            raise _refused(str(path), f"the file is larger than {MAX_BYTES // 2**20} MiB", hint)
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        near = nearest(path.name, (p.name for p in path.parent.glob("*.*")))
        hint = f"did you mean `{near}`?" if near else "check the name and the folder"
        raise _refused(str(path), "there is no such file", hint) from None
    except UnicodeDecodeError as error:
        raise _refused(str(path), f"this is no text in UTF-8 (byte {error.start})", "save it as UTF-8") from None
    except OSError as error:
        raise _refused(str(path), f"it cannot be read: {error.strerror}") from None
    return read_text(text, str(path))


def read_text(text: str, file: str = "model") -> Source:
    """Reads the text of a model. Raises ``ModelFileError`` when it is no YAML mapping."""
    text = _paired(text)
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
    source.measure(node)
    source.data = source.read(node)
    return source


def _refused(file: str, what: str, hint: str = "") -> ModelFileError:
    return ModelFileError([Problem(Where(file), what, hint)])


def _paired(text: str) -> str:
    """The text with the two halves of a sign joined that JSON writes as ``\\ud83d\\ude00``; a lone half becomes a mark."""
    return text if text.isascii() else text.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "replace")


def _scalar(kind: str, text: str) -> Any:
    """The value of a scalar whose tag ends so."""
    plain = text.replace("_", "").lower()
    match kind:
        case "null":
            return None
        case "bool":
            return plain == "true"
        case "int" if len(plain) > MAX_DIGITS:
            return math.inf
        case "int":
            return int(plain, 0 if plain.lstrip("+-").startswith(("0x", "0o")) else 10)
        case "float":
            return float(plain.replace(".inf", "inf").replace(".nan", "nan"))
    return text


_WORDS = (
    (r"(?i)character '\\t'|tab", "a tab character stands here", "YAML is indented with spaces"),
    ("mapping values are not allowed", "a second `:` on this line", "put quotes around a text that holds `: `, or check the indentation"),
    ("expected ',' or", "a bracket or brace is not closed, or a comma is missing", ""),
    ("did not find expected|expected <block end>|could not find expected", "the indentation does not fit, or a `:` is missing", ""),
    ("undefined alias", "`*` begins an alias that is not defined", "put quotes around an expression that begins with `*`"),
    ("cannot start any token", "a text cannot begin with this character", "put quotes around it"),
    ("while scanning a quoted scalar|unexpected end", "a quotation is not closed", "close it with the quote it begins with"),
)  # fmt: skip
"""What the YAML reader says, with what a newcomer can make of it and what to try."""
_BRACKET_NAME = re.compile(r"[\[{,].*\w\[")


def _syntax(source: Source, error: Exception) -> Problem:
    """A complaint of the YAML reader."""
    if not isinstance(error, MarkedYAMLError):
        what = "it is nested too deep" if isinstance(error, RecursionError) else str(error).splitlines()[0]
        return Problem(Where(source.file), f"this is no YAML: {what}")
    mark = error.problem_mark or error.context_mark
    where = source.at(_mark(mark) if mark else (0, 0))
    said = " ".join(str(part) for part in (error.context, error.problem) if part)
    what, hint = next(((w, h) for pattern, w, h in _WORDS if re.search(pattern, said)), (f"this is no YAML: {said}", ""))
    before = where.excerpt[: where.column - 1]
    if where.excerpt[len(before) :].startswith("\t") or before.strip(" ").startswith("\t"):
        _, what, hint = _WORDS[0]
    elif _BRACKET_NAME.search(where.excerpt):
        what, hint = "a name with brackets needs quotes inside [ ] and { }", 'write "link[1].end"'
    return Problem(where, what, hint)
