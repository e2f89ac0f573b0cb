"""A folder of the catalogue."""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from freebody.catalogue.answers import Question


@dataclass(frozen=True)
class System:
    """A system of the catalogue: a folder with model files and ``questions.py``."""

    folder: Path

    @property
    def id(self) -> str:
        """Name of the folder."""
        return self.folder.name

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
