"""Where the command line writes, and what it says where that cannot be: files, terminals, libraries that are not there."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest
from small_models import FALLING
from typer.testing import CliRunner

from freebody import cli
from freebody.cli.terminal import spelt

ROOT = Path(__file__).parents[2]
GUN = str(ROOT / "examples" / "new_gun.yaml")
PROGRAM = [sys.executable, "-c", "from freebody.cli import app; app()"]
WRITING = {
    "run": ".csv",
    "validate": ".svg",
    "diagram": ".pdf",
    "equations": ".html",
    "code": ".c",
    "animate": ".gif",
}
"""The commands that write a file, and a kind of it."""
SPEAKING = [
    ["run", "--no-report"], ["solve", "--route", "all", "--balance"], ["validate"], ["equations"], ["certify"], ["code"],
    ["equations", "--form", "lagrange"], ["check", "theta' = 1"], ["run", "--no-report", "--until", "soon"],
]  # fmt: skip


@pytest.fixture
def falling(tmp_path):
    path = tmp_path / "falling.yaml"
    path.write_text(FALLING.replace("until: 1 s", "until: 0.1 s"))
    return str(path)


# -- files -----------------------------------------------------------------------------------------


def places(folder, ending):
    """Where nothing can be written: a folder, within a file, in a folder that is not there."""
    (folder / f"taken{ending}").mkdir()
    (folder / "file").write_text("")
    return [folder / f"taken{ending}", folder / f"file/x{ending}", folder / f"nowhere/x{ending}"]


@pytest.mark.parametrize("word", WRITING)
def test_a_file_that_cannot_be_written_is_named_before_anything_is_computed(command, tmp_path, monkeypatch, falling, word):
    monkeypatch.chdir(tmp_path)
    for path in places(tmp_path, WRITING[word]):
        done = command(word, "no_model.yaml", "-o", str(path))
        assert done.exit_code == 2 and done.output.startswith(f"{path}: ") and len(done.output.splitlines()) == 1
    assert command("run", falling, "--report", str(tmp_path)).output.startswith(f"{tmp_path}: ")


def test_a_report_goes_into_no_file_of_another_kind(command, tmp_path, falling):
    before = Path(falling).read_text()
    for path in (falling, str(tmp_path / "page.pdf")):
        done = command("run", falling, "--report", path)
        assert done.exit_code == 2 and done.output.startswith(f"a report is .html, not {Path(path).suffix!r}\n")
    assert Path(falling).read_text() == before


@pytest.mark.parametrize("word", WRITING)
def test_what_fails_midway_leaves_the_old_file(command, tmp_path, monkeypatch, falling, word):
    def full(self, target):
        raise OSError(28, "No space left on device", str(self))

    path = tmp_path / f"old{WRITING[word]}"
    path.write_text("old")
    before = sorted(tmp_path.iterdir())
    monkeypatch.setattr(Path, "replace", full)
    done = command(word, falling, *(["--no-report"] if word == "run" else []), "-o", str(path))
    assert done.exit_code == 2 and done.output.splitlines()[-1] == f"{path}: No space left on device"
    assert path.read_text() == "old" and sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize(("word", "ending"), {"run": ".csv", "equations": ".txt", "code": ".c"}.items())
def test_what_was_written_is_told_by_its_name(command, tmp_path, monkeypatch, falling, word, ending):
    monkeypatch.chdir(tmp_path)
    done = command(word, falling, *(["--no-report"] if word == "run" else []), "-o", f"made{ending}")
    told = [line.removeprefix("wrote ") for line in done.output.splitlines() if line.startswith("wrote ")]
    assert done.exit_code == 0 and told == [f"made{ending}"] and Path(told[0]).is_file()


def test_a_summary_is_printed_before_files_are_written(command, tmp_path, falling):
    done = command("run", falling, "--report", "/dev/full")
    assert done.exit_code == 2
    assert done.output.index("the end time was reached") < done.output.index("/dev/full: No space left on device")


@pytest.mark.parametrize(
    "words",
    [
        ("run", "nowhere.yaml"),
        ("run", GUN, "--until", "soon"),
        ("run", GUN, "--rtol"),
        ("solve", GUN, "--at", "omega=1"),
        ("solve",),
    ],
)
def test_errors_are_json_where_json_was_asked_for(command, words):
    done = command(*words, "--json")
    (problem,) = json.loads(done.stdout)["problems"]
    assert done.exit_code == 2 and problem["what"] and {"where", "what", "hint", "also"} == problem.keys()


# -- standard output ---------------------------------------------------------------------------------


def spoken(words, target):
    """What a command says on standard error, and its exit status, with standard output to a file."""
    with open(target, "w") as out:
        done = subprocess.run([*PROGRAM, *words], stdout=out, stderr=subprocess.PIPE, text=True)
    return done.stderr, done.returncode


@pytest.mark.parametrize("words", [["solve", GUN], ["solve", GUN, "--json"], ["version"]], ids=" ".join)
def test_a_full_disk_behind_standard_output_is_said_once(words):
    assert spoken(words, "/dev/full") == ("No space left on device\n", 2)


@pytest.mark.parametrize("words", [["validate", GUN], ["schema"]], ids=" ".join)
def test_a_reader_that_goes_away_is_no_error(words):
    running = subprocess.Popen([*PROGRAM, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    running.stdout.close()
    said = running.stderr.read()
    running.stderr.close()
    assert said == b"" and running.wait() == 1


# -- terminals ---------------------------------------------------------------------------------------


def printed(words, columns, charset="utf-8"):
    """What a command prints on a terminal, and how it ends."""
    place = 1 if words[0] == "check" else len(words)
    done = CliRunner(charset=charset, env={"COLUMNS": str(columns), "TERM": "dumb"}).invoke(
        cli.app, [*words[:place], GUN, *words[place:]]
    )
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.output, done.exit_code


@pytest.mark.parametrize("words", SPEAKING, ids=" ".join)
def test_a_terminal_of_ascii_gets_the_same_in_plain_spelling(words):
    plain, wide = printed(words, 100, "ascii"), printed(words, 100)
    assert plain[1] == wide[1] and plain[0].isascii()
    assert "?" not in plain[0].replace("[default: ?]", "")
    assert Counter(re.findall(r"\d+\.\d+", plain[0])) == Counter(re.findall(r"\d+\.\d+", wide[0]))


@pytest.mark.parametrize(
    ("text", "plain"),
    [("kg·m²", "kg*m^2"), ("θ̈₁ = −½ ẍ⁻¹⁰", "theta''1 = -1/2 x''^-10"), ("30° → ∞", "30 deg -> inf"), ("é 漢", "e ?")],
)
def test_signs_are_spelt_as_people_write_them(text, plain):
    assert spelt(text) == plain


@pytest.mark.parametrize("words", SPEAKING[:5], ids=" ".join)
def test_a_narrow_terminal_cuts_no_figure(words):
    narrow, wide = (Counter(re.findall(r"\d\S*", printed(words, width)[0])) for width in (60, 300))
    assert narrow == wide


# -- libraries ---------------------------------------------------------------------------------------

WITHOUT = """
import json, sys
from typer.testing import CliRunner
model, folder, *hidden = sys.argv[1:]
class Hidden:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in hidden:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Hidden())
from freebody import cli
commands = [["run", model, "--no-report", "-o", f"{folder}/r.nc"], ["run", model, "--report", f"{folder}/r.html"], ["solve", model],
            ["validate", model], ["diagram", model, "-o", f"{folder}/d.svg"], ["equations", model], ["code", model],
            ["check", model, "h' = 1"], ["animate", model, "-o", f"{folder}/a.svg", "--until", "0.01"], ["compare", model, model],
            ["certify", model], ["systems"], ["schema"], ["version"], ["--help"]]
for words in commands:
    done = CliRunner().invoke(cli.app, words)
    own = done.exception is None or isinstance(done.exception, SystemExit)
    print(json.dumps([words, done.exit_code, own, done.output]))
"""


@pytest.mark.parametrize("hidden", ["pandas xarray", "scipy", "flint", "numpy"])
def test_a_library_that_is_missing_is_brought_by_one_line(hidden, falling, tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT, falling, str(tmp_path), *hidden.split()], capture_output=True, text=True, cwd=tmp_path
    )
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert answers[-1][0] == ["--help"], done.stderr
    for words, code, own, output in answers:
        assert own and "No module named" not in output, (words, output)
        if code == 2:
            assert any(module in output for module in hidden.split()) and "pip install" in output, (words, output)
    refused = [words[0] for words, code, *_ in answers if code == 2]
    assert not {"--help", "version"} & {*refused}
    if hidden == "pandas xarray":
        assert refused == ["run"], "the extras are for tables only"
