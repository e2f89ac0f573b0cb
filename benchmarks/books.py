"""How far ``freebody check`` gets with what students write about mechanisms of textbooks.

    python benchmarks/books.py [mended | unseen | NAME …] [--slips 200 --seed 1] [--words]

The statements are in tests/check/books/, with which the check was mended, and in tests/check/books_unseen/, with the verdict that a person came to and the correction that a tutor would give; those that
are judged or corrected otherwise are printed. What other people make of statements in their own words is in tests/check/other_words.yaml.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from itertools import groupby
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "check"))

from books import FILES, OTHER_WORDS, UNSEEN, Book


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("names", nargs="*", default=["mended", "unseen"], help="halves or mechanisms")
    arguments.add_argument("--slips", type=int, default=0, help="so many slips instead, made by chance in right statements")
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--words", action="store_true", help="what others make of the statements instead, in their words")
    given, halves = arguments.parse_args(), {"mended": list(FILES), "unseen": list(UNSEEN)}
    if given.slips:
        return slips(given.slips, given.seed, [name for half in given.names for name in halves.get(half, [half])])
    if given.words:
        return words()
    for name in given.names:
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
                places[place := book.place(said.verdict, said.statement["correction"])] += 1
                if place != "first":
                    print(f"{heading}\n    {said.statement['correction']} is {place}")
                    print(*(f"      {each}" for each in said.verdict.mends), sep="\n")
    print(f"{sum(seen.values())} statements in {time.perf_counter() - began:.0f} s")
    for (wanted, found), count in sorted(seen.items()):
        print(f"  {count:4d} {wanted} called {found}")
    print("the correction of a tutor is " + ", ".join(f"{place} {count} times" for place, count in places.most_common()))


def words() -> None:
    """Prints how what others make of statements is judged: what the check was mended with, and what it was not."""
    for half, sections in {"mended": ("read", "missed"), "unseen": ("unseen",)}.items():
        seen = Counter(
            (said.kind.value, said.verdict.kind.value)
            for section in sections
            for name in OTHER_WORDS[section]
            for said in Book(name).in_other_words(section)
        )
        print(f"{half}: {sum(seen.values())} statements in other words")
        for (wanted, found), count in sorted(seen.items()):
            print(f"  {count:4d} {wanted} called {found}")


def slips(count: int, seed: int, names: list[str]) -> None:
    """Prints which slips, made by chance in right statements, are not corrected first, and counts."""
    rng, taken, places = np.random.default_rng(seed), [], Counter()
    said = [(name, i) for name in names for i, each in enumerate(Book(name).data["statements"]) if each["verdict"] == "right"]
    chosen = sorted(said[int(i)] for i in rng.permutation(len(said))[:count])
    for name, which in groupby(chosen, key=lambda each: each[0]):
        book = Book(name)
        for _, i in which:
            if (slip := book.slip(rng, book.data["statements"][i])) is None:
                continue
            taken.append(slip.seconds)
            places[slip.kind, place := book.place(slip.verdict, slip.right)] += 1
            if place != "first":
                print(
                    f"{name}, {slip.kind}, {place}, {slip.seconds:.1f} s: {slip.says}\n    was {slip.right}",
                    slip.verdict.assumption,
                )
                print(*(f"      {each}" for each in slip.verdict.mends), slip.verdict.true, sep="\n", flush=True)
    for kind in dict.fromkeys(kind for kind, _ in places):
        print(f"  {kind}: " + ", ".join(f"{place} {n}" for (k, place), n in places.most_common() if k == kind))
    every = [sum(n for (_, place), n in places.items() if place in those) for those in (("first",), ("first", "among three"))]
    shares = [100 * each / len(taken) for each in every]
    print(f"{len(taken)} slips: first {shares[0]:.1f} %, among three {shares[1]:.1f} %; {max(taken):.1f} s at most")


if __name__ == "__main__":
    main()
