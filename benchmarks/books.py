"""How far ``freebody check`` gets with what students write about mechanisms of textbooks.

    python benchmarks/books.py [mended | unseen | NAME …]

The statements are in tests/check/books/, with which the check was mended, and in tests/check/books_unseen/, with the verdict that a person came to and the correction that a tutor would give; those that
are judged or corrected otherwise are printed.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "check"))

from books import FILES, UNSEEN, Book, Said


def main() -> None:
    names = sys.argv[1:] or ["mended", "unseen"]
    halves = {"mended": list(FILES), "unseen": list(UNSEEN)}
    for name in names:
        print(f"{name}:")
        score(halves.get(name, [name]))


def score(names: list[str]) -> None:
    """Prints what is judged or corrected otherwise than a person did, and counts."""
    began, seen, places = time.perf_counter(), Counter(), Counter()
    for name in names:
        book = Book(name)
        for said in book.verdicts():
            wanted, found = said.kind, said.verdict.kind
            seen[wanted.value, found.value] += 1
            heading = f"{name}, {said.statement['id']}: {said.statement['says']}"
            if wanted is not found:
                print(f"{heading}\n    {wanted.value} is called {found.value} {said.verdict.assumption}")
            if "correction" in said.statement:
                places[place := _place(book, said)] += 1
                if place != "first":
                    print(f"{heading}\n    {said.statement['correction']} is {place}")
                    print(*(f"      {each}" for each in said.verdict.mends), sep="\n")
    print(f"{sum(seen.values())} statements in {time.perf_counter() - began:.0f} s")
    for (wanted, found), count in sorted(seen.items()):
        print(f"  {count:4d} {wanted} called {found}")
    print("the correction of a tutor is " + ", ".join(f"{place} {count} times" for place, count in places.most_common()))


def _place(book: Book, said: Said) -> str:
    """At which place the correction of a tutor stands."""
    text = said.statement["correction"]
    found = [i for i, each in enumerate(said.verdict.mends) if book.says_the_same(each.equation, text)]
    return "missing" if not found else "first" if found[0] == 0 else "among three" if found[0] < 3 else "behind the third"


if __name__ == "__main__":
    main()
