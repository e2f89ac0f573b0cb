"""A plate that slides and turns on a rough table, seen from above: Coulomb friction of every point of its area, or of its rim."""

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipe, ellipk

import freebody as fb

M, MU, G, R = 2.0, 0.3, 9.81, 0.25
MOST = MU * M * G
PLATE = """
freebody: 1
gravity: none
parameters: {m: 2 kg, mu: 0.3, g: 9.81 m/s^2, r: 0.25 m}
bodies: {plate: {%s, mass: m}}
joints: {plane: {type: free, of: [ground.O, plate.G], coordinates: [x, y, theta]}}
forces: {rub: {type: plate_friction, area: plate, friction: mu, load: m*g%s}}
initial: {x: 0, y: 0, theta: 0.3}
run: {until: 9 s, rtol: 1e-12}
"""
ARROW = [(0.0, 0.0), (0.5, 0.05), (0.35, 0.45), (0.2, 0.15), (-0.1, 0.4)]
SHAPES = {
    "disk": "shape: disk, radius: r",
    "rectangle": "shape: rectangle, width: 2*r, height: r/3",
    "triangle": "shape: triangle, corners: [[0, 0], [2*r, 0], [0, r]]",
    "arrow": f"shape: polygon, corners: {[list(corner) for corner in ARROW]}",
    "ring": "shape: ring, radius: r",
}
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def plate(shape, more=""):
    return fb.Mechanism.loads(PLATE % (SHAPES[shape], more))


def friction(model, v, spin):
    """Fx, Fy, and the couple about the mass centre, at a velocity (a complex number) of the mass centre and a spin."""
    found = model.solve(rates={"x": v.real, "y": v.imag, "theta": spin})
    return np.array([found["rub.Fx"], found["rub.Fy"], found["rub.M"]])


def by_rays(corners, v, spin):
    """The same of a polygon, corners about the mass centre as complex numbers: every ray from the instantaneous centre has one
    direction of sliding, so what is left is an integral over the sides, here by many panels of Gauss's rule."""
    centre, total, area = 1j * v / spin, np.zeros(3), 0.0
    for start, end in zip(corners, np.roll(corners, -1), strict=True):
        near = np.clip(((centre - start) * np.conj(end - start)).real / abs(end - start) ** 2, 0, 1)
        fine = np.geomspace(1e-14, 1, 60)
        cuts = np.concatenate([near - near * fine[::-1], [near], near + (1 - near) * fine])
        low, high = cuts[:-1, None], cuts[1:, None]
        at = start + (end - start) * ((low + high) / 2 + (high - low) / 2 * NODES)
        swept = (np.conj(at - centre) * (end - start)).imag * WEIGHTS * (high - low) / 2
        way = 1j * np.sign(spin) * np.exp(1j * np.angle(at - centre))
        couple = (np.conj(centre) * way).imag / 2 + (np.conj(at - centre) * way).imag / 3
        total += [(swept * way.real).sum() / 2, (swept * way.imag).sum() / 2, (swept * couple).sum()]
        area += swept.sum() / 2
    return -MOST * total / area


def of_disk(ratio):
    """Force over μN and couple over μNR of a disk at v/(ωR) (Farkas, Bartels, Unger & Wolf, Phys. Rev. Lett. 90, 248302, 2003)."""
    if ratio <= 1:
        k, e = ellipk(ratio**2), ellipe(ratio**2)
        force = 4 / (3 * np.pi * ratio) * ((ratio**2 + 1) * e + (ratio**2 - 1) * k)
        return force, 4 / (9 * np.pi) * ((4 - 2 * ratio**2) * e + (ratio**2 - 1) * k)
    k, e = ellipk(ratio**-2), ellipe(ratio**-2)
    force = 4 / (3 * np.pi) * ((ratio**2 + 1) * e - (ratio**2 - 1) * k)
    return force, 4 * ratio / (9 * np.pi) * ((4 - 2 * ratio**2) * e + (2 * ratio**2 - 5 + 3 / ratio**2) * k)


@pytest.mark.parametrize("shape", SHAPES)
def test_pure_slide_has_no_couple_and_the_whole_force(shape):
    direction = np.exp(0.7j)
    for speed in (1e-9, 1.0, 1e6):
        whole = [-MOST * direction.real, -MOST * direction.imag, 0]
        np.testing.assert_allclose(friction(plate(shape), speed * direction, 0.0), whole, atol=1e-14 * MOST)


@pytest.mark.parametrize(("shape", "lever"), [("disk", 2 / 3 * R), ("ring", R)])
def test_pure_turn_has_no_force_and_the_whole_couple(shape, lever):
    for spin in (-1e-9, 1.0, 1e6):
        whole = [0, 0, -np.sign(spin) * MOST * lever]
        np.testing.assert_allclose(friction(plate(shape), 0j, spin), whole, atol=1e-14 * MOST)


def test_a_disk_is_that_of_elliptic_integrals():
    for ratio in (1e-3, 0.3, 0.653, 0.999999, 1.0000001, 1.5, 10):
        found = friction(plate("disk"), ratio * R * 2.0, 2.0)
        force, couple = of_disk(ratio)
        np.testing.assert_allclose(found, [-MOST * force, 0, -MOST * R * couple], atol=1e-13 * MOST)


@pytest.mark.parametrize("shape", ["rectangle", "triangle", "arrow"])
def test_polygons_are_summed_by_rays_wherever_they_turn_about(shape):
    """The instantaneous centre within, far away, on a side, and at a corner, where |V| is not smooth."""
    model, rng = plate(shape), np.random.default_rng(1)
    corners = {"rectangle": [(-R, -R / 6), (R, -R / 6), (R, R / 6), (-R, R / 6)], "triangle": [(0, 0), (2 * R, 0), (0, R)]}
    own = np.array([complex(*corner) for corner in corners.get(shape, ARROW)])
    swept = (np.conj(own) * np.roll(own, -1)).imag
    own = (own - (swept * (own + np.roll(own, -1))).sum() / (3 * swept.sum())) * np.exp(0.3j)
    centres = [*(rng.normal(size=4) + 1j * rng.normal(size=4)) * R, 300j * R, own[0], (own[1] + own[2]) / 2, own[1] * (1 + 1e-9)]
    for centre in centres:
        for spin in (3.0, -0.2):
            v = -1j * spin * centre
            # Of a far centre the sum by rays loses digits, as |centre|² does.
            near = 1e-12 if abs(centre) < 10 * R else 1e-9
            np.testing.assert_allclose(friction(model, v, spin), by_rays(own, v, spin), atol=near * MOST)


@pytest.mark.parametrize("shape", SHAPES)
def test_no_other_friction_of_the_limit_surface_takes_more_power(shape):
    """Maximal dissipation: the limit surface is convex, and motion is normal to it (Goyal, Ruina & Papadopoulos 1991)."""
    model, rng = plate(shape), np.random.default_rng(2)
    motions = [(complex(*rng.normal(size=2)), rng.normal() / R) for _ in range(6)]
    loads = [friction(model, *motion) for motion in motions]
    for i, (v, spin) in enumerate(motions):
        powers = [load @ [v.real, v.imag, spin] for load in loads]
        assert min(powers) == powers[i] < 0


@pytest.mark.parametrize("shape", ["rectangle", "disk", "ring"])
def test_derivatives_by_motion_and_size_are_exact(shape):
    """Against differences of two steps, extrapolated."""
    model, rates, r = plate(shape), {"x": 0.4, "y": -0.1, "theta": 3.0}, R
    found = model.solve(rates=rates).derivatives("rub.M")

    def couple(name, step):
        if name == "r":
            return model.solve(rates=rates, r=r + step)["rub.M"]
        return model.solve(rates=rates | {name: rates[name] + step})["rub.M"]

    for name in ("x", "y", "theta", "r"):
        wide, narrow = ((couple(name, h) - couple(name, -h)) / (2 * h) for h in (2e-3, 1e-3))
        assert found[name if name == "r" else f"rate({name})"] == pytest.approx((4 * narrow - wide) / 3, rel=1e-6, abs=1e-8)


def test_a_spinning_disk_ends_slide_and_turn_together_at_a_ratio_of_its_own():
    """Against its equations in v and ω with elliptic integrals; v/(ωR) tends to 0.653 (Farkas & al. 2003) from any start."""
    inertia = M * R**2 / 2

    def rate(_, y):
        force, couple = of_disk(y[1] / (y[2] * R))
        return [y[1], -MOST * force / M, -MOST * R * couple / inertia]

    for v, spin in ((0.5, 6.0), (1.0, 2.0)):
        done = plate("disk").simulate(initial={"theta": 0}, rates={"x": v, "theta": spin})
        assert done.events[-1].name == "rub rests" and done.outcome.name == "StoppedByEvent"
        end = done.outcome.t
        found = solve_ivp(rate, (0, 0.98 * end), [0, v, spin], method="DOP853", rtol=1e-13, atol=1e-15, dense_output=True)
        for t in (0.3 * end, 0.9 * end, 0.98 * end):
            mine = [float(done.evaluate(each, [t])[0]) for each in ("x", "rate(x)", "rate(theta)")]
            np.testing.assert_allclose(mine, found.sol(t), atol=1e-10)
        last = [float(done.evaluate(each, [end - 1e-7])[0]) for each in ("rate(x)", "rate(theta)")]
        assert last[0] / (last[1] * R) == pytest.approx(0.653, abs=1e-3)
        start = (M * v**2 + inertia * spin**2) / 2
        assert done.energy.entries["work of rub"][-1] == pytest.approx(-start, rel=1e-10)
        assert abs(done.energy.balance).max() < 1e-11
        assert (np.diff(done.energy.entries["work of rub"]) <= 0).all(), "friction takes power all the way"


def test_an_area_of_points_and_another_route_give_the_same():
    corners = "points: {P: [-r, -r/6], Q: [r, -r/6], R: [r, r/6], S: [-r, r/6]}, "
    named = (PLATE % (corners + "inertia: 1, centre: [0, 0]", "")).replace(
        "area: plate", "area: [plate.P, plate.Q, plate.R, plate.S]"
    )
    moving = (0.3 - 0.2j, 2.0)
    same = friction(plate("rectangle"), *moving)
    np.testing.assert_allclose(friction(fb.Mechanism.loads(named), *moving), same, atol=1e-14)
    turned = named.replace("[plate.P, plate.Q, plate.R, plate.S]", "[plate.S, plate.R, plate.Q, plate.P]")
    np.testing.assert_allclose(friction(fb.Mechanism.loads(turned), *moving), same, atol=1e-14)
    rates = {"x": 0.3, "y": -0.2, "theta": 2.0}
    routes = [plate("arrow").solve(rates=rates, route=route)["accel(theta)"] for route in ("minimal", "constraints")]
    assert routes[0] == pytest.approx(routes[1], rel=1e-13)


def test_equations_hold_its_friction():
    made = fb.Mechanism.loads((PLATE % (SHAPES["disk"], "")).replace("theta: 0.3", "theta: 0.3, rates: {x: 1, y: 0.2, theta: 1}"))
    assert made.check("m*accel(x) = rub.Fx").ok and made.check("m*r^2/2*accel(theta) = rub.M").ok
    assert not made.check("m*accel(x) = -mu*m*g").ok
    text = made.equations().text()
    assert "M_rub" in text and "mean of V/|V|" in text
    gun = fb.Mechanism.load(Path(__file__).parents[1] / "examples/new_gun.yaml")
    assert "V/|V|" not in gun.equations().text(), "the couple of a motor is none of friction"


@pytest.mark.parametrize(
    ("area", "said"),
    [
        ("[plate.A, plate.C, plate.B, plate.D]", "cross"),
        ("[plate.A, plate.B, plate.M]", "straight back"),
        ("[ground.O, ground.E, ground.F]", "ground"),
        ("bead", "no area"),
        ("nobody", "no body"),
        ("rod", "no outline"),
        ("{centre: plate.A, radius: -1}", "negative"),
        ("[plate.A, plate.B]", "three corners"),
    ],
)
def test_what_is_no_area_is_refused(area, said):
    text = f"""
freebody: 1
gravity: none
ground: {{points: {{E: [1, 0], F: [0, 1]}}}}
bodies:
  plate: {{mass: 1, inertia: 1, points: {{A: [0, 0], B: [2, 0], C: [2, 1], D: [0, 1], M: [1, 0]}}}}
  bead: {{shape: particle, mass: 1}}
  rod: {{shape: rod, length: 1, mass: 1}}
joints: {{plane: {{type: free, of: [ground.O, plate.G]}}}}
forces: {{rub: {{type: plate_friction, area: {area}, friction: 0.2, load: 1}}}}
"""
    with pytest.raises(fb.ModelFileError, match=said):
        fb.Mechanism.loads(text).compile()


def test_at_rest_there_is_no_sliding_friction_and_it_is_said():
    with pytest.raises(fb.MotionError, match="rub"):
        fb.Mechanism.loads((PLATE % (SHAPES["disk"], "")).replace("theta: 0.3", "theta: 0.3, at_rest: true")).solve()
