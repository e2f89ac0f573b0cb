"""The ``dev`` script: it parses, it explains itself at once, and it names the commands that there are."""

from __future__ import annotations

import subprocess
from pathlib import Path

from freebody import cli

ROOT = Path(__file__).parents[2]


def usage(*words: str, **how) -> str:
    return subprocess.run([ROOT / "dev", *words], capture_output=True, text=True, check=True, **how).stdout


def test_both_scripts_parse():
    subprocess.run(["sh", "-n", ROOT / "dev"], check=True)
    subprocess.run(["bash", "-n", ROOT / ".ci" / "run"], check=True)


def test_help_names_every_command_of_freebody():
    own = ["test", "bench", "accuracy", "check", "wheel"]
    names = [command.name or command.callback.__name__ for command in cli.app.registered_commands]
    assert all(name in usage() for name in own + names)


def test_help_is_the_same_whatever_it_is_called():
    assert usage() == usage("help") == usage("--help") == usage("-h")


def test_it_finds_its_folder_through_a_link_and_from_anywhere(tmp_path):
    link = tmp_path / "link"
    link.symlink_to(ROOT / "dev")
    stated = subprocess.run([link], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert stated == usage()
