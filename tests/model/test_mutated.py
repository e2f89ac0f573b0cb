"""Broken model files: whatever is done to one, it is read or refused with a place."""

import random
from pathlib import Path

import pytest

from freebody.mechanism import Mechanism
from freebody.model.errors import ModelFileError

ROOT = Path(__file__).parents[2]
FILES = sorted([*(ROOT / "examples").glob("*.yaml"), *(ROOT / "python/freebody/systems").glob("*/*.yaml")])
FILES = [path for path in FILES if "\nfreebody: 1" in f"\n{path.read_text(encoding='utf-8')}"]
ODD = [
    "[]", "{}", "[1, [2]]", "{a: b}", "2024-01-01", ".nan", "-.inf", "1e400", "-0.0", "1e-320", "''", "null", "~", "yes", '"\\ud83d"',
    '"\\e[1m"', '"\\0"', "9" * 400, "9" * 5000, "!!int abc", "!!python/object:os.system x", "!!binary aGk=", "!!set {a}", "&a [*a]", "*b",
    "|\n  text", "?", "@", "`x`", "%", "0x1F", "0o17", "1_000", "1:30", "'a b'.c", "x" * 3000, "(" * 300, "-" * 200 + "1", "a[i = 1 .. 3]",
    "a[1", "1 m/", "3 m kg", "if(1)", "rate()", "sin(1, 2)", "1/0", "t", "ground", "ground.O", "O.O", "💥", "2^2^2^2^2", "é\u0301", "<<",
]  # fmt: skip


def mutated(seed):
    """A file with one to three slips: lines lost, doubled, swapped, indented, cut; values and words replaced."""
    rng = random.Random(seed)
    path = rng.choice(FILES)
    lines = path.read_text(encoding="utf-8").splitlines()
    for _ in range(rng.choice([1, 1, 2])):
        i, j = (rng.randrange(len(lines)) for _ in range(2))
        match rng.randrange(7):
            case 0 if len(lines) > 2:
                del lines[i]
            case 1:
                lines.insert(j, lines[i])
            case 2:
                lines[i], lines[j] = lines[j], lines[i]
            case 3:
                key, colon, _ = lines[i].partition(": ")
                lines[i] = f"{key}{colon}{rng.choice(ODD)}"
            case 4:
                words = lines[i].split(" ")
                words[rng.randrange(len(words))] = rng.choice([*ODD, *lines[j].split()])
                lines[i] = " ".join(words)
            case 5:
                at = rng.randrange(len(lines[i]) + 1)
                lines[i] = (
                    lines[i][:at] + rng.choice([*ODD, "", ",", ":", "]", "}", '"', "\t", " "]) + lines[i][at + rng.randrange(4) :]
                )
            case 6:
                lines[i] = "  " * rng.randrange(4) + lines[i].lstrip()
    return path, "\n".join(lines) + "\n"


@pytest.mark.parametrize("seed", range(60))
def test_a_mutated_file_is_read_or_refused_with_a_place(seed, monkeypatch):
    path, text = mutated(seed)
    monkeypatch.chdir(path.parent)
    try:
        Mechanism.loads(text, path.name).compile()
    except ModelFileError as error:
        whole = ("this is no YAML", "a model file is a mapping")
        assert error.problems and all(
            each.what and (each.where.line > 0 or each.what.startswith(whole)) for each in error.problems
        )
