"""Which edition of the models there is: what is made of a model holds until something in one of them is changed."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any


class Edition:
    """``now`` is another object after every change of any model, wherever and by whichever thread it was made."""

    now = object()

    @classmethod
    def changing(cls, method: Callable[..., Any]) -> Callable[..., Any]:
        """Of a method that changes what it belongs to: behind it is another edition, also where it fails midway."""

        @wraps(method)
        def changed(*args: Any, **words: Any) -> Any:
            try:
                return method(*args, **words)
            finally:
                cls.now = object()

        return changed


def _watched(kind: type, *methods: str) -> type:
    made = {name: Edition.changing(getattr(kind, name)) for name in methods}
    return type(f"Watched{kind.__name__.capitalize()}", (kind,), made | {"__slots__": (), "__module__": __name__})


_EITHER = ("__setitem__", "__delitem__", "pop", "clear")
WatchedDict = _watched(dict, *_EITHER, "popitem", "setdefault", "update", "__ior__")
WatchedList = _watched(list, *_EITHER, "append", "extend", "insert", "remove", "reverse", "sort", "__iadd__", "__imul__")


def watched(value: Any) -> Any:
    """Dicts and lists, and those in them, as such that make another edition when they are changed; anything else as it is."""
    if type(value) is dict:
        return WatchedDict({key: watched(inner) for key, inner in value.items()})
    return WatchedList(map(watched, value)) if type(value) is list else value
