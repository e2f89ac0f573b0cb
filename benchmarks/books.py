"""How far ``freebody check`` gets with what students write about mechanisms of textbooks.

    python benchmarks/books.py [NAME …]

The statements are in tests/check/books/, with the verdict that a person came to; those that are judged otherwise are printed.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "check"))

from books import FILES, Book


def main() -> None:
    began, seen = time.perf_counter(), Counter()
    for name in sys.argv[1:] or FILES:
        for said in Book(name).verdicts():
            wanted, found = said.kind, said.verdict.kind
            seen[wanted.value, found.value] += 1
            if wanted is not found:
                print(f"{name}, {said.statement['id']}: {said.statement['says']}\n    {wanted.value} is called {found.value}")
    print(f"{sum(seen.values())} statements in {time.perf_counter() - began:.0f} s")
    for (wanted, found), count in sorted(seen.items()):
        print(f"  {count:4d} {wanted} called {found}")


if __name__ == "__main__":
    main()
