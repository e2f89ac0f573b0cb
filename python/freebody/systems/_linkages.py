"""Four-bars and crank-sliders by hand, for checks. A vector of the plane is a complex number; i v is v turned left."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass


def dot(a: complex, b: complex) -> float:
    return (a.conjugate() * b).real


def cross(a: complex, b: complex) -> float:
    return (a.conjugate() * b).imag


def nearest_turn(angle: float, other: float) -> float:
    """The angle with as many whole turns added as bring it nearest to another."""
    return angle - math.tau * round((angle - other) / math.tau)


@dataclass(frozen=True)
class Motion:
    """Of the three bars: angles, rates, angular accelerations; velocity and acceleration of their centres."""

    angle: tuple[float, float, float]
    rate: tuple[float, float, float]
    turning: tuple[float, float, float]
    centre: tuple[complex, complex, complex]
    velocity: tuple[complex, complex, complex]
    acceleration: tuple[complex, complex, complex]


@dataclass(frozen=True)
class FourBar:
    """Uniform bars AB, BC and DC; A is the origin. ``side``: +1 where C lies to the left of the line from B to D."""

    l1: float
    l2: float
    l3: float
    d: float
    masses: tuple[float, float, float]
    side: int = 1
    gravity: float = 0.0

    def angles(self, theta: float) -> tuple[float, float]:
        """β and φ: C is where two circles meet, by the law of cosines in the triangle BCD."""
        base = self.d - self.l1 * cmath.exp(1j * theta)
        r, heading = cmath.polar(base)
        at_b = math.acos((self.l2**2 + r**2 - self.l3**2) / (2 * self.l2 * r))
        beta = heading + self.side * at_b
        return beta, cmath.phase(self.l2 * cmath.exp(1j * beta) - base)

    def motion(self, theta: float, rate: float, turning: float) -> Motion:
        """All rates and accelerations from the loop l1 λ1 + l2 λ2 = D + l3 λ3, differentiated once and twice."""
        beta, phi = self.angles(theta)
        e1, e2, e3 = (cmath.exp(1j * a) for a in (theta, beta, phi))

        def others(known: complex) -> tuple[float, float]:
            """x, y with known + x l2 i λ2 − y l3 i λ3 = 0: across bar 3, then across bar 2."""
            return -dot(known, e3) / (self.l2 * dot(1j * e2, e3)), dot(known, e2) / (self.l3 * dot(1j * e3, e2))

        w2, w3 = others(self.l1 * rate * 1j * e1)
        tip1 = self.l1 * (1j * turning - rate**2) * e1
        a2, a3 = others(tip1 - self.l2 * w2**2 * e2 + self.l3 * w3**2 * e3)
        b, vb = self.l1 * e1, self.l1 * 1j * rate * e1
        return Motion(
            angle=(theta, beta, phi),
            rate=(rate, w2, w3),
            turning=(turning, a2, a3),
            centre=(b / 2, b + self.l2 / 2 * e2, self.d + self.l3 / 2 * e3),
            velocity=(vb / 2, vb + self.l2 / 2 * 1j * w2 * e2, self.l3 / 2 * 1j * w3 * e3),
            acceleration=(tip1 / 2, tip1 + self.l2 / 2 * (1j * a2 - w2**2) * e2, self.l3 / 2 * (1j * a3 - w3**2) * e3),
        )

    def forces(self, motion: Motion) -> tuple[float, complex, complex, complex, complex]:
        """T and the forces at A (on AB), B (on BC), C (on BC) and D (on DC).

        Moments of BC and DC about B, and of DC about C, hold nothing unknown but the force at D; those of the whole
        about A then give T.
        """
        lengths = (self.l1, self.l2, self.l3)
        b, c = self.l1 * cmath.exp(1j * motion.angle[0]), self.d + self.l3 * cmath.exp(1j * motion.angle[2])
        need = [m * (a + 1j * self.gravity) for m, a in zip(self.masses, motion.acceleration, strict=True)]
        spin = [m * l**2 / 12 * t for m, l, t in zip(self.masses, lengths, motion.turning, strict=True)]

        def moments(about: complex, bars: range) -> float:
            return sum(cross(motion.centre[i] - about, need[i]) + spin[i] for i in bars)

        about_b, about_c = moments(b, range(1, 3)), moments(c, range(2, 3))
        arm_b, arm_c = self.d - b, self.d - c
        # (D − B) × F = about_b and (D − C) × F = about_c: F in terms of the two arms.
        at_d = (arm_c * about_b - arm_b * about_c) / cross(arm_b, arm_c)
        torque = moments(0, range(3)) - cross(self.d, at_d)
        on_dc = need[2] - at_d
        on_bc = need[1] + on_dc
        return torque, need[0] + on_bc, on_bc, -on_dc, at_d

    def torque_by_power(self, motion: Motion) -> float:
        """T from the power that the motion takes."""
        power = 0.0
        for m, length, w, t, v, a in zip(
            self.masses,
            (self.l1, self.l2, self.l3),
            motion.rate,
            motion.turning,
            motion.velocity,
            motion.acceleration,
            strict=True,
        ):
            power += m * dot(a + 1j * self.gravity, v) + m * length**2 / 12 * t * w
        return power / motion.rate[0]

    def kinetic(self, motion: Motion) -> float:
        """Kinetic energy."""
        rows = zip(self.masses, (self.l1, self.l2, self.l3), motion.rate, motion.velocity, strict=True)
        return sum(m * abs(v) ** 2 / 2 + m * length**2 / 24 * w**2 for m, length, w, v in rows)

    def potential(self, motion: Motion) -> float:
        """Potential energy, 0 at the height of A."""
        return sum(m * self.gravity * c.imag for m, c in zip(self.masses, motion.centre, strict=True))

    def free(self, theta: float, rate: float, torque: float = 0.0) -> float:
        """θ̈ under a torque on AB: the power balance of the whole is linear in θ̈."""
        unit = self.motion(theta, 1.0, 0.0)  # T = J θ̈ + h θ̇² + V′, and at unit speed h + V′ is what it takes
        lift = sum(m * self.gravity * v.imag for m, v in zip(self.masses, unit.velocity, strict=True))
        h = self.torque_by_power(unit) - lift
        return (torque - h * rate**2 - lift) / (2 * self.kinetic(unit))


@dataclass(frozen=True)
class CrankSlider:
    """Uniform crank OB and rod BC, slider C on the x axis to the right of O."""

    r: float
    l: float
    masses: tuple[float, float, float]
    gravity: float = 9.81

    def motion(self, theta: float, rate: float, turning: float) -> Motion:
        """The rod's angle from r sin θ + l sin β = 0, differentiated once and twice. Third: the slider, which never turns."""
        beta = -math.asin(self.r * math.sin(theta) / self.l)
        e1, e2 = cmath.exp(1j * theta), cmath.exp(1j * beta)
        w2 = -self.r * rate * e1.real / (self.l * e2.real)
        tip = self.r * (1j * turning - rate**2) * e1
        a2 = (self.l * w2**2 * e2.imag - tip.imag) / (self.l * e2.real)
        b, vb = self.r * e1, self.r * 1j * rate * e1
        arm, v_arm, a_arm = self.l * e2, self.l * 1j * w2 * e2, self.l * (1j * a2 - w2**2) * e2
        return Motion(
            angle=(theta, beta, 0.0),
            rate=(rate, w2, 0.0),
            turning=(turning, a2, 0.0),
            centre=(b / 2, b + arm / 2, b + arm),
            velocity=(vb / 2, vb + v_arm / 2, vb + v_arm),
            acceleration=(tip / 2, tip + a_arm / 2, tip + a_arm),
        )

    def forces(self, motion: Motion) -> tuple[float, complex, complex, complex, float]:
        """T, the forces at O (on the crank), B (on the rod), C (on the slider), and the guide's on the slider.

        The slider along x gives the force at C along x; the rod about B that along y; the rest follows backwards.
        """
        need = [m * (a + 1j * self.gravity) for m, a in zip(self.masses, motion.acceleration, strict=True)]
        b, arm = 2 * motion.centre[0], motion.centre[2] - 2 * motion.centre[0]
        along = need[2].real
        moment = cross(arm / 2, need[1]) + self.masses[1] * self.l**2 / 12 * motion.turning[1]
        at_c = complex(along, (arm.imag * along - moment) / arm.real)
        at_b = need[1] + at_c
        torque = cross(b / 2, need[0]) + self.masses[0] * self.r**2 / 12 * motion.turning[0] + cross(b, at_b)
        return torque, need[0] + at_b, at_b, at_c, need[2].imag - at_c.imag

    def kinetic(self, motion: Motion) -> float:
        """Kinetic energy."""
        inertias = (self.masses[0] * self.r**2 / 12, self.masses[1] * self.l**2 / 12, 0.0)
        rows = zip(self.masses, inertias, motion.velocity, motion.rate, strict=True)
        return sum(m * abs(v) ** 2 / 2 + i * w**2 / 2 for m, i, v, w in rows)

    def free(self, theta: float, rate: float) -> float:
        """θ̈ with no torque: T = J θ̈ + h θ̇² + V′ of θ, read off at two motions."""
        unit = self.motion(theta, 1.0, 0.0)
        lift = sum(m * self.gravity * v.imag for m, v in zip(self.masses, unit.velocity, strict=True))
        h = self.forces(unit)[0] - lift
        return (-h * rate**2 - lift) / (2 * self.kinetic(unit))
