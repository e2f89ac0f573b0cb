"""Stands in for the compiled core where that is not built: the grammar and the cards, written out by hand."""

from __future__ import annotations

import json
import re
import sys
import types

TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    r"|(?P<name>(?:[^\W\d]\w*|'[^']*')(?:\[[^\]\s]*\])*(?:\.(?:[^\W\d]\w*|'[^']*')(?:\[[^\]\s]*\])*)*)"
    r"|(?P<sign>\*\*|<=|>=|==|!=|[-+*/^<>(),]))"
)
LEVELS = [("or",), ("and",), ("<", "<=", ">", ">=", "==", "!="), ("+", "-"), ("*", "/")]


class ExpressionError(ValueError):
    pass


class ModelError(ValueError):
    pass


class Parser:
    def __init__(self, text):
        self.text, self.at, self.tokens = text, 0, []
        while text[self.at :].strip():
            found = TOKEN.match(text, self.at)
            if not found:
                sign = text[self.at :].strip()[0]
                raise ExpressionError(self.at, self.at + 1, f"`{sign}` has no meaning in an expression", "")
            piece = found[found.lastgroup]
            kind = "sign" if piece in ("and", "or", "not") else found.lastgroup
            self.tokens.append((kind, piece, found.start(found.lastgroup), found.end()))
            self.at = found.end()
        self.tokens.append(("end", "", len(text), len(text)))
        self.i = 0

    def sign(self, *signs):
        kind, piece, *_ = self.tokens[self.i]
        if kind != "sign" or piece not in signs:
            return None
        self.i += 1
        return piece

    def node(self, kind, value, start):
        return {kind: value, "span": [start, self.tokens[self.i - 1][3]]}

    def chain(self, level=0):
        if level == len(LEVELS):
            return self.signed()
        start = self.tokens[self.i][2]
        if level == 2 and self.sign("not"):
            return self.node("not", self.chain(2), start)
        first, rest = self.chain(level + 1), []
        while sign := self.sign(*LEVELS[level]):
            rest.append([sign, self.chain(level + 1)])
        return self.node("chain", [first, rest], start) if rest else first

    def signed(self):
        start = self.tokens[self.i][2]
        if self.sign("+"):
            return self.signed()
        if self.sign("-"):
            return self.node("negate", self.signed(), start)
        base = self.operand()
        if self.sign("^", "**"):
            return self.node("chain", [base, [["^", self.signed()]]], start)
        return base

    def operand(self):
        kind, piece, start, _end = self.tokens[self.i]
        self.i += 1
        if kind == "number":
            return self.node("number", float(piece), start)
        if kind == "name" and self.sign("("):
            arguments = []
            while not self.sign(")"):
                arguments.append(self.chain())
                if not self.sign(",") and self.tokens[self.i][1] != ")":
                    self.fail("a comma or a closing parenthesis")
            return self.node("call", [piece.replace("'", ""), arguments], start)
        if kind == "name":
            return self.node("name", piece.replace("'", ""), start)
        if piece == "(":
            inner = self.chain()
            if not self.sign(")"):
                self.fail("a closing parenthesis")
            return inner
        self.i -= 1
        return self.fail("a number, a name or a parenthesis")

    def fail(self, wanted):
        _kind, piece, start, end = self.tokens[self.i]
        found = f"`{piece}`" if piece else "the end"
        raise ExpressionError(start, end, f"expected {wanted}, found {found}", "")


def parse(text):
    parser = Parser(text)
    tree = parser.chain()
    if parser.tokens[parser.i][0] != "end":
        parser.fail("an operator or the end")
    return json.dumps(tree)


def field(text):
    name, kind, dimension, *default = text.split(" ", 3)
    dimension = {"-": "", "any": None}.get(dimension, dimension)
    return {"name": name, "kind": kind, "dimension": dimension, "default": default[0] if default else None, "doc": f"the {name}"}


def card(word, fields, coordinates=""):
    parts = [c.split() for c in coordinates.split(";") if c]
    return {
        "type": word,
        "doc": f"A {word}.",
        "fields": [field(f.strip()) for f in fields.split(";") if f.strip()],
        "coordinates": [{"name": c[0], "dimension": c[1] if len(c) > 1 else ""} for c in parts],
    }


JOINTS = [
    card("hinge", "of points m", "angle rad"),
    card("weld", "of points m; angle number rad 0"),
    card("slider", "along line m; line line m", "s m"),
    card("rollers", "along line m; points points m", "s m"),
    card("slot", "along line m; point point m", "s m;angle rad"),
    card("curved_slot", "along curve m; point point m", "s;angle rad"),
    card("cam", "along curve m; follower circle m", "s;angle rad"),
    card("link", "of points m; length number m", "direction rad;angle rad"),
    card("rolling", "on line m; circle circle m", "s m"),
    card("rolling_circles", "on circle m; circle circle m; inside flag - false", "direction rad"),
    card("gear", "of points m; radii numbers m; pressure_angle number rad 20 deg; internal flag - false; flank number - 1"),
    card("belt", "of points m; radii numbers m; crossed flag - false; strand number - 1"),
    card("coupling", "zero gauge any"),
    card("free", "of points m", "x m;y m;angle rad"),
    card("polar", "of points m", "r m;direction rad;angle rad"),
]
FORCES = [
    card("force", "at point m; value law N 0; direction law rad 0; x law N 0; y law N 0; frame frame - fixed"),
    card("torque", "on body -; from body - ground; value law N*m"),
    card("spring", "between points m ; along gauge - ; stiffness number N/m; rest_length number m 0; damping number N*s/m 0"),
    card("damper", "between points m ; along gauge - ; damping number N*s/m"),
    card(
        "torsion_spring",
        "on body -; from body - ground; stiffness number N*m/rad; rest_angle number rad 0; damping number N*m*s/rad 0",
    ),
    card("law", "along gauge -; value law -; potential gauge J "),
]
for one in (f for c in FORCES for f in c["fields"] if f["name"] in ("between", "along", "potential") and c["type"] != "law"):
    one["default"] = ""
next(f for f in FORCES[-1]["fields"] if f["name"] == "potential")["default"] = ""


def cards():
    return json.dumps({"joints": JOINTS, "forces": FORCES, "shapes": []})


class Mechanism:
    """Takes any spec; complains about what the test asks it to."""

    complaint = None

    def __init__(self, spec):
        self.spec = json.loads(spec)
        if Mechanism.complaint:
            raise ModelError(*Mechanism.complaint)

    def describe(self):
        parameters = [{"name": p["name"], "unit": p["unit"], "value": p["value"]} for p in self.spec["parameters"]]
        return json.dumps({"parameters": parameters})

    def bind(self, values):
        return [values.get(p["name"], p["value"]) for p in self.spec["parameters"]]


def install():
    """Puts this module in the place of ``freebody._core``, when that is missing or has no cards yet."""
    try:
        from freebody import _core

        if hasattr(_core, "cards"):
            return
    except ImportError:
        pass
    import freebody

    module = types.ModuleType("freebody._core")
    for name in ("ExpressionError", "ModelError", "Mechanism", "parse", "cards"):
        setattr(module, name, globals()[name])
    sys.modules["freebody._core"] = module
    freebody._core = module
