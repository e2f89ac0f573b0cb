"""What the symbols of equations mean: coordinate or parameter, unit, and in what order a person writes them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from freebody.symbolic.symbols import Name, Renamed
from freebody.symbolic.tree import Sym


@dataclass(frozen=True)
class SymbolEntry:
    """One symbol: its kind (coordinate, parameter, time, unknown or constant; indeterminate is the one whose powers order a
    polynomial), SI unit, what it is, and, where that is not its own name, how it is ``written``."""

    name: str
    kind: str = "parameter"
    unit: str = ""
    doc: str = ""
    written: Name | None = None


class Nomenclature(dict[str, SymbolEntry]):
    """The symbols of some equations by name, in the order of the model. A name that is not there reads as a parameter. Those
    that are ``renamed`` are not written as usual, because that means something else. ``decimals``: there are decimal numbers, 0.3,
    beside which tenths and fifths are decimal numbers, too."""

    def __init__(
        self,
        table: Mapping[str, SymbolEntry] | None = None,
        renamed: Mapping[str, Renamed] | None = None,
        decimals: bool = False,
    ) -> None:
        super().__init__(table or {})
        self.renamed = dict(renamed or {})
        self.decimals = decimals

    @classmethod
    def read(cls, data: Mapping[str, Mapping[str, Any]]) -> Nomenclature:
        """From JSON: ``{"theta": {"kind": "coordinate", "unit": "rad", "doc": "…"}}``."""
        known = ("kind", "unit", "doc")
        return cls({name: SymbolEntry(name, **{k: entry[k] for k in known if k in entry}) for name, entry in data.items()})

    def write(self) -> dict[str, dict[str, str]]:
        """As JSON data."""
        return {symbol.name: {"kind": symbol.kind, "unit": symbol.unit, "doc": symbol.doc} for symbol in self.values()}

    def kind(self, name: str) -> str:
        """The kind of a name."""
        return self[name].kind if name in self else "parameter"

    def written(self, name: str) -> Name | None:
        """How a symbol is written that is not written by its own name."""
        return self[name].written if name in self else None

    def of_kind(self, *kinds: str) -> list[str]:
        """The names of some kinds, in the order of the model."""
        return [name for name, symbol in self.items() if symbol.kind in kinds]

    def geometric(self) -> list[str]:
        """Coordinates and parameters that are lengths, angles or plain numbers: neither masses, loads, stiffnesses nor g."""
        return [x.name for x in self.values() if x.kind == "coordinate" or (x.kind == "parameter" and not is_heavy(x.unit))]

    def rank(self, symbol: Sym) -> tuple[int, int]:
        """Where a symbol stands among the parameters of a product: pure numbers, masses and loads, then g, then lengths."""
        entry = self.get(symbol.name)
        weight = _OTHER if entry is None else _HEAVY if entry.kind == "unknown" else _weight(entry.unit)
        return weight, self.place(symbol.name)

    def place(self, name: str) -> int:
        """The place of a name in the order of the model; names that are not there come last."""
        return self._places.get(name, len(self._places))

    @cached_property
    def functions(self) -> dict[Any, Any]:
        """Functions, sin(θ₁ − θ₂), as printers have printed them: long equations have few, many times."""
        return {}

    @cached_property
    def _places(self) -> dict[str, int]:
        return {name: place for place, name in enumerate(self)}


def is_heavy(unit: str) -> bool:
    """Whether a unit is that of a mass, a load, a stiffness or an acceleration, and not of a length, an angle or a plain number."""
    return _weight(unit) in (_HEAVY, _GRAVITY)


_PURE, _HEAVY, _GRAVITY, _OTHER = range(4)


def _weight(unit: str) -> int:
    if unit in ("", "1"):
        return _PURE
    return _HEAVY if unit.startswith(("kg", "N")) else _GRAVITY if unit.startswith("m/s") else _OTHER
