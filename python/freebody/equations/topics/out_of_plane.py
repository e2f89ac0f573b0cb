"""Out of the plane: what the plane exerts on bodies that it keeps."""

from __future__ import annotations

from typing import Any

from freebody.document.blocks import Block, Bullets, Equation, Heading, Paragraph, Written
from freebody.document.document import Document
from freebody.equations.topics.common import Asked, document, own
from freebody.model.start import quantity
from freebody.symbolic.formula import typed
from freebody.symbolic.tree import ZERO, Sym, add, is_zero, mul

_COUPLES = (
    "The plane also holds the bodies against tipping. In the model all forces act in one plane through the mass centres, and bodies "
    "are alike on both of its sides; then these couples are 0. If forces act at another height h than the mass centre, the plane takes "
    "their moment, force × h; a body that is not alike on both sides takes couples with its products of inertia, in ω² and α."
)


def out_of_plane(asked: Asked, *, gravity: Any = None) -> Document:
    """Forces normal to the plane: what it exerts on the bodies.

    ``gravity`` into the plane, ``9.81 m/s^2``, of a model on a table or a slope."""
    subject = asked.subject
    downward = own(subject, "constant", "m/s^2", "gravity into the plane", "g_z")
    masses = [(motion.body, motion.mass) for motion in subject.motions if not is_zero(motion.mass)]
    made: list[Block] = [Heading("Balance normal to the plane")]
    made.append(Paragraph("Nothing moves out of the plane, so along k = i × j what acts on each body adds up to 0."))
    if gravity is None:
        said = "The model has no force out of the plane: gravity acts in it or not at all. So the plane exerts none, N = 0 on each of"
        made.append(Paragraph(f"{said} {', '.join(name for name, _ in masses)}."))
    else:
        across, value = Sym(downward.name), quantity("gravity", gravity, "m/s^2")
        each = [[f"{name}: N = ", mul(mass, across)] for name, mass in masses]
        whole = mul(add(*(mass for _, mass in masses)) if masses else ZERO, across)
        lead = [
            "Gravity into the plane is ",
            across,
            f" = {value:g} m/s². Each body that lies on the plane by itself is carried by",
        ]
        shared = "It acts below the common mass centre. How joined bodies share it depends on how the joints take such forces."
        total = Equation(Written("Σ N", typed("∑N")), whole, "All together")
        made += [Paragraph(lead), Bullets(each), total, Paragraph(shared)]
    made += [Heading("Couples about axes in the plane"), Paragraph(_COUPLES)]
    return document(subject, "out of the plane", made, [downward])
