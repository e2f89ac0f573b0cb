"""pymunk: contacts by impulses, a step at a time."""

import numpy as np
import problems
import pymunk
from entry import Entry, steps


def block():
    def solve(h):
        space = pymunk.Space()
        space.gravity = problems.PULL
        floor = pymunk.Segment(space.static_body, (-50, -1), (50, -1), 1)
        body = pymunk.Body(1, (0.4**2 + 0.2**2) / 12)
        box = pymunk.Poly.create_box(body, (0.4, 0.2))
        floor.friction, box.friction = problems.FRICTION, 1  # they are multiplied
        body.position, body.velocity = (0, 0.1), (problems.SPEED, 0)
        space.add(body, box, floor)
        places = []
        for span in np.diff([0, *problems.PLACES]):
            for _ in range(round(span / h)):
                space.step(h)
            places.append(body.position.x)
        return np.array(places)

    yield Entry("pymunk", solve, steps(problems.PLACES[0], 25, 17), "impulses; fixed steps, looped in Python")
