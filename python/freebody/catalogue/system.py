"""A folder of the catalogue."""

from __future__ import annotations

import importlib.util
import re
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from freebody.catalogue.answers import Question

FOLDER = Path(__file__).parent.parent / "systems"


@dataclass(frozen=True)
class System:
    """A system of the catalogue: a folder with model files and ``questions.py``."""

    folder: Path

    @property
    def id(self) -> str:
        """Name of the folder up to its words, ``S19.17`` of ``S19.17-new-gun``."""
        return re.split("-(?=[a-z])", self.folder.name)[0]

    @property
    def title(self) -> str:
        """First line of the questions' docstring, without the id."""
        return (self._module().__doc__ or self.id).splitlines()[0].rstrip(".").removeprefix(f"{self.id}: ")

    @property
    def models(self) -> list[Path]:
        """Its model files, the main one first."""
        found = (path for path in self.folder.glob("*.yaml") if path != self.statements)
        return sorted(found, key=lambda path: (path.name != "model.yaml", path.name))

    @property
    def statements(self) -> Path:
        """The file of what is stated about it, which not every system has."""
        return self.folder / "statements.yaml"

    def questions(self) -> list[Question]:
        """Its questions, in the order in which they stand in the file."""
        return [item for item in vars(self._module()).values() if isinstance(item, Question)]

    def _module(self) -> ModuleType:
        path = self.folder / "questions.py"
        spec = importlib.util.spec_from_file_location(f"freebody_system_{abs(hash(path))}", path)
        assert spec and spec.loader
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module


def systems() -> list[System]:
    """All systems, in the order of their names."""
    return [System(path.parent) for path in sorted(FOLDER.glob("*/questions.py"))]


def find(identity: str) -> System:
    """A system by its id or its folder's name; capitals do not matter."""
    there = systems()
    known = {name.lower(): system for system in there for name in (system.id, system.folder.name)}
    try:
        return known[identity.lower()]
    except KeyError:
        raise KeyError(f"no system is called {identity!r}; there are {', '.join(system.id for system in there)}") from None


def model_file(name: str) -> Path:
    """The file of a model of the catalogue, by its system and its own name: ``S19.17/flight``."""
    identity, _, stem = name.partition("/")
    return find(identity).folder / f"{stem}.yaml"
