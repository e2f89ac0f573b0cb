"""Writes what the commands print now into README.md and docs/*.md: `.venv/bin/python docs/refresh.py`, or of the pages that it names.

A console block that begins with one `$ ./dev …` and goes on with output is run again; one of commands alone is left as it is.
Output that ends in `…` is cut at as many lines as before.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
JUDGED = 3  # a command that did its work and found something wrong
BLOCK = re.compile(r"^```console\n(\$ (\./dev .*)\n)((?:(?!\$ |```).*\n)+)```$", re.MULTILINE)


def again(block: re.Match[str], program: str) -> str:
    """The block with what its command prints now."""
    prompt, command, before = block.groups()
    wide = os.environ | {"COLUMNS": "80"}
    done = subprocess.run(command.replace("./dev", program, 1), shell=True, cwd=ROOT, env=wide, capture_output=True, text=True)
    if done.returncode not in (0, JUDGED):
        raise SystemExit(f"`{command}` ended with {done.returncode}:\n{done.stderr}")
    lines = [line.rstrip() for line in done.stdout.strip().splitlines()]
    shown = before.splitlines()
    if shown[-1] == "…":
        lines = [*lines[: len(shown) - 1], "…"]
    return "\n".join(["```console", prompt + lines[0], *lines[1:], "```"])


def printed(text: str, program: str = "./dev") -> str:
    """A page with what its commands print now, run by a program."""
    return BLOCK.sub(lambda block: again(block, program), text)


if __name__ == "__main__":
    for path in map(Path, sys.argv[1:] or (ROOT / "README.md", *sorted(ROOT.glob("docs/*.md")))):
        print(path.name)
        path.write_text(printed(path.read_text(encoding="utf-8")), encoding="utf-8")
