"""Model files, written with the comments of those that they came from."""

from __future__ import annotations

import io
import json
from contextlib import suppress
from pathlib import Path as FilePath
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq

from freebody.formats import write

from . import reading
from .errors import ModelFileError
from .schema import Model

_LINE = 100
# Sections that stand in one line where they fit; the items of the others have a line each.
_FLAT = ("parameters", "gravity", "initial", "run")


def save(model: Model, path: str | FilePath, written: str = "") -> None:
    """Writes the model: as JSON when the name ends so, otherwise as YAML.

    ``written`` is the text that the model came from; its comments, order and spelling stay where the model is unchanged. What fails
    midway leaves the old file as it was.
    """
    path = FilePath(path)
    text = json.dumps(model.written(), indent=2, ensure_ascii=False) + "\n" if path.suffix == ".json" else dumps(model, written)
    write(path, text)


def dumps(model: Model, written: str = "") -> str:
    """The model as YAML, in the words of ``written`` where they still hold."""
    data = model.written()
    if written.strip() and not written.lstrip().startswith("{"):
        text = _text(_updated(_yaml().load(written), data))
        with suppress(ModelFileError):  # comments in odd places can mislead the writer; they are given up rather than the model
            if reading.reads(text)[0] == model:
                return text
    return _text(_sections(data))


def _yaml() -> YAML:
    yaml = YAML(typ="rt", pure=True)
    yaml.width = 4096
    yaml.indent(mapping=2, sequence=4, offset=2)
    yaml.preserve_quotes = True
    return yaml


def _text(data: Any) -> str:
    out = io.StringIO()
    _yaml().dump(data, out)
    return out.getvalue()


def _updated(old: Any, new: Any) -> Any:
    """The old tree with the new data; what is equal stays as it is written."""
    if isinstance(old, CommentedMap) and isinstance(new, dict):
        keys = {str(key): key for key in old}
        for word, key in keys.items():
            if word not in new:
                del old[key]
        for word, value in new.items():
            old[keys.get(word, word)] = _updated(old[keys[word]], value) if word in keys else _styled(value)
        return old
    if isinstance(old, CommentedSeq) and isinstance(new, list) and len(old) == len(new):
        for i, value in enumerate(new):
            old[i] = _updated(old[i], value)
        return old
    return old if type(new) in (str, int, float, bool) and old == new else _styled(new)


def _sections(data: dict[str, Any]) -> CommentedMap:
    out = CommentedMap()
    for section, content in data.items():
        if isinstance(content, dict) and section not in _FLAT:
            out[section] = CommentedMap({key: _styled(value) for key, value in content.items()})
            if not content:
                out[section].fa.set_flow_style()
        else:
            out[section] = _styled(content)
    return out


def _styled(value: Any) -> Any:
    """Plain data in one line where it fits, else in a line for each entry."""
    if not isinstance(value, (dict, list)):
        return value
    of_mapping = isinstance(value, dict)
    styled: Any = CommentedMap({k: _styled(v) for k, v in value.items()}) if of_mapping else CommentedSeq(map(_styled, value))
    if len(json.dumps(value, ensure_ascii=False)) <= _LINE:
        styled.fa.set_flow_style()
    return styled
