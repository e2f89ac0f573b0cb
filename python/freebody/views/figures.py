"""How the figures of derivations are drawn."""

from __future__ import annotations

from freebody.document.drawings import ConfigurationDrawing, FreeBodyDrawing, ImpulseDrawing, Picture, drawn


@drawn.register
def configuration(drawing: ConfigurationDrawing) -> Picture:
    """The sketch of a mechanism with its coordinates."""
    from freebody.views.diagram.configuration import Configuration

    return Configuration(drawing.source, drawing.state, drawing.each_body)


@drawn.register
def free_bodies(drawing: FreeBodyDrawing) -> Picture:
    """The free-body diagram of some bodies together."""
    from freebody.views.diagram import diagram
    from freebody.views.diagram.configuration import opened

    state = drawing.state if drawing.given else opened(drawing.source, drawing.state)
    return diagram(drawing.source, state, drawing.given or drawing.source.free_bodies(state), [drawing.bodies])


@drawn.register
def impulses(drawing: ImpulseDrawing) -> Picture:
    """Impulse diagrams, one for each body."""
    from freebody.views.diagram.impulses import impulse_diagram

    return impulse_diagram(drawing.impact)
