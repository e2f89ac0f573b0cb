"""The representative models are a sample of everything that a model can hold."""

from store import MODELS, REPRESENTATIVE, mechanism, sample


def parts(spec):
    """The kinds of everything in a model: joints, forces, motions, contacts, strings, stops, events, bodies and their pieces."""
    for word in ("joints", "forces"):
        for each in spec[word]:
            yield f"{word} of type {each['type']}"
            yield f"{word} in place: {each['engaged']}"
            yield from (f"{word} with {key}" for key in ("friction",) if each.get(key))
            yield from (f"absolute: {c['absolute']}" for c in each.get("coordinates", ()) if "absolute" in c)
    for word in ("motions", "contacts", "strings", "stops", "events"):
        for each in spec[word]:
            yield from (f"{word} with {key}" for key, value in each.items() if value)
    yield from (f"motions of {each['level']}" for each in spec["motions"])
    for contact in spec["contacts"]:
        yield " on ".join(sorted(next(iter(side)) for side in contact["of"]))
    for string in spec["strings"]:
        yield from (f"string with {next(iter(each))}" for each in (*string["ends"], *string["over"]))
    for event in spec["events"]:
        does = event["then"] if isinstance(event["then"], list) else [event["then"]]
        yield from (f"then {next(iter(each)) if isinstance(each, dict) else each}" for each in does)
    for body in spec["bodies"]:
        yield f"particle: {body['particle']}"
        yield from (f"piece of shape {piece['shape']}, without mass: {piece['mass'] == 0}" for piece in body["pieces"])
    yield from (word for word in ("gravity", "tables", "gauges", "curves", "lines") if spec[word])


def test_what_is_representative_holds_every_kind_of_part():
    found = {name: set(parts(mechanism(name).source().spec)) for name in MODELS}
    missing = set.union(*found.values()) - set.union(*(found[name] for name in REPRESENTATIVE))
    assert not missing, {part: [name for name in MODELS if part in found[name]] for part in missing}


def test_another_seed_draws_other_members():
    assert len({frozenset(sample(set(MODELS), seed)) for seed in range(10)}) == 10
    assert set(REPRESENTATIVE) < {name for law in range(20) for name in sample(set(MODELS), 1, where=str(law))}
    assert len(sample({"a", "b", "c", "d"}, 1)) == 3
