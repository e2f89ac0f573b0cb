"""From a text to a ``Model``: the schema's complaints become problems with a place in the file."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path as FilePath
from typing import Any

from pydantic import ValidationError

from . import source
from .errors import ModelFileError, Path
from .names import suggestion
from .schema import VERSION, Model
from .source import Source

_QUOTED = re.compile(r"'([^']*)'")
_WORDS = {
    "dict_type": ("a mapping is needed here", "write `name: …` lines under it, or `{…}`"),
    "model_type": ("a mapping is needed here", "write `{key: value, …}`"),
    "model_attributes_type": ("a mapping is needed here", "write `{key: value, …}`"),
    "list_type": ("a list is needed here", "write `[…, …]`"),
    "string_type": ("a text is needed here", "put quotes around it"),
    "bool_type": ("`true` or `false` is needed here", ""),
    "bool_parsing": ("`true` or `false` is needed here", ""),
}


def read(path: str | FilePath) -> tuple[Model, Source]:
    """The model of a file, with the file as it was written. Raises ``ModelFileError``."""
    return model_of(source.open_file(FilePath(path)))


def reads(text: str, file: str = "model") -> tuple[Model, Source]:
    """The model of a text; ``file`` names it in errors. Raises ``ModelFileError``."""
    return model_of(source.read_text(text, file))


def model_of(origin: Source) -> tuple[Model, Source]:
    """The model of data that has been read. Raises ``ModelFileError`` with all that is wrong."""
    _check_version(origin)
    try:
        model = Model.model_validate(origin.data)
    except ValidationError as error:
        for path, what, hint, at_key in complaints(error):
            origin.complain(path, what, hint, at_key)
        raise ModelFileError(origin.problems) from None
    origin.check()
    return model, origin


def _check_version(origin: Source) -> None:
    version = origin.data.get("freebody")
    if isinstance(version, int) and version > VERSION:
        what = f"this file is written in version {version} of the language; this freebody reads {VERSION}"
        origin.complain(("freebody",), what, "update freebody")
        raise ModelFileError(origin.problems)
    if "freebody" not in origin.data:
        origin.complain((), "the version of the language is missing", f"begin the file with `freebody: {VERSION}`")
    elif version != VERSION or isinstance(version, bool):
        origin.complain(("freebody",), f"`{version}` is no version of the language", f"write `freebody: {VERSION}`")
    origin.data["freebody"] = VERSION


def complaints(error: ValidationError) -> Iterable[tuple[Path, str, str, bool]]:
    """What the schema says, as path, sentence, hint, and whether the key itself is meant."""
    for line in error.errors(include_url=False):
        path = place(line["loc"])
        what, hint = _sentence(line, path)
        yield path, what, hint, what.startswith("unknown key")


def place(location: tuple[str | int, ...]) -> Path:
    """The path of an item without the marks of unions: the type of a joint or force, and ``<pair>`` and the like."""
    tagged = location[:1] in (("joints",), ("forces",)) and len(location) > 2
    kept = location[:2] + location[3:] if tagged else location
    unions = ("list[", "dict[", "literal[", "function-")
    return tuple(s for s in kept if isinstance(s, int) or not (s.startswith("<") or s.startswith(unions)))


def _sentence(line: Any, path: Path) -> tuple[str, str]:
    kind, context = line["type"], line.get("ctx", {})
    if kind == "freebody":
        return context["what"], context["hint"]
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        what = "joint" if path[0] == "joints" else "force"
        if kind == "union_tag_not_found":
            example = "hinge" if what == "joint" else "spring"
            return f"the {what} `{path[-1]}` has no `type`", f"add `type:`, e.g. `type: {example}`"
        return f"there is no {what} `{context['tag']}`", suggestion(context["tag"], _QUOTED.findall(context["expected_tags"]))
    if kind == "literal_error":
        known = _QUOTED.findall(context["expected"]) or [context["expected"]]
        hint = suggestion(str(line["input"]), known)
        what = f"`{line['input']}` is none of {', '.join(f'`{k}`' for k in known)}"
        return what, hint if hint.startswith("did you mean") else "choose one of them"
    if line["input"] is None:
        return f"`{path[-1]}` is empty" if path else "the model is empty", "give it a value, or leave the key out"
    return _WORDS.get(kind, (line["msg"][:1].lower() + line["msg"][1:], ""))
