//! Vectors, poses, twists and wrenches in the plane. Knows no bodies.
//!
//! x right, y up, angles counter-clockwise. The angle of a pose is carried additively (it never
//! wraps), with its cosine and sine beside it, taken once.

use crate::scalar::Scalar;
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// A vector in the plane.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Vec2<S = f64> {
    /// Component along x.
    pub x: S,
    /// Component along y.
    pub y: S,
}

/// A vector from its components.
#[inline(always)]
pub fn vec2<S>(x: S, y: S) -> Vec2<S> {
    Vec2 { x, y }
}

impl<S: Scalar> Vec2<S> {
    /// The plain values.
    pub fn value(self) -> Vec2 {
        vec2(self.x.value(), self.y.value())
    }
    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        vec2(S::zero(), S::zero())
    }
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> S {
        self.x * o.x + self.y * o.y
    }
    /// Out-of-plane component of the cross product `self × o`.
    #[inline(always)]
    pub fn cross(self, o: Self) -> S {
        self.x * o.y - self.y * o.x
    }
    /// `k × self`: turned by +90°.
    #[inline(always)]
    pub fn perp(self) -> Self {
        vec2(-self.y, self.x)
    }
    /// Euclidean length.
    pub fn norm(self) -> S {
        self.dot(self).sqrt()
    }
    /// The unit vector along it.
    pub fn unit(self) -> Self {
        self * (S::one() / self.norm())
    }
}

impl<S: Scalar> Add for Vec2<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        vec2(self.x + o.x, self.y + o.y)
    }
}
impl<S: Scalar> Sub for Vec2<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        vec2(self.x - o.x, self.y - o.y)
    }
}
impl<S: Scalar> Mul<S> for Vec2<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, k: S) -> Self {
        vec2(self.x * k, self.y * k)
    }
}
impl<S: Scalar> Neg for Vec2<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        vec2(-self.x, -self.y)
    }
}
impl<S: Scalar> AddAssign for Vec2<S> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<S: Scalar> SubAssign for Vec2<S> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

/// A direction with its angle: turning by it costs no further sine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn<S = f64> {
    /// Cosine of the angle.
    pub cos: S,
    /// Its sine.
    pub sin: S,
    /// Angle in radians, unwrapped.
    pub angle: S,
}

impl<S: Scalar> Turn<S> {
    /// The turn by an angle.
    #[inline(always)]
    pub fn by(angle: S) -> Self {
        let (sin, cos) = angle.sin_cos();
        Turn { angle, cos, sin }
    }
    /// No turn.
    #[inline(always)]
    pub fn none() -> Self {
        Turn { angle: S::zero(), cos: S::one(), sin: S::zero() }
    }
    /// The plain values.
    pub fn value(self) -> Turn {
        Turn { angle: self.angle.value(), cos: self.cos.value(), sin: self.sin.value() }
    }
    /// A vector given in the turned axes, in the fixed axes.
    #[inline(always)]
    pub fn apply(&self, v: Vec2<S>) -> Vec2<S> {
        vec2(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }
    /// A vector given in the fixed axes, in the turned axes.
    #[inline(always)]
    pub fn undo(&self, v: Vec2<S>) -> Vec2<S> {
        vec2(self.cos * v.x + self.sin * v.y, self.cos * v.y - self.sin * v.x)
    }
}

/// Where a body is: the place of its reference point and its turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<S = f64> {
    /// Place of the reference point.
    pub at: Vec2<S>,
    /// Turn of the body's axes.
    pub turn: Turn<S>,
}

impl<S: Scalar> Pose<S> {
    /// At the origin, not turned.
    pub fn identity() -> Self {
        Pose { at: Vec2::zero(), turn: Turn::none() }
    }
    /// The place of a point given in the body's axes from its reference point.
    #[inline(always)]
    pub fn place(&self, local: Vec2<S>) -> Vec2<S> {
        self.at + self.turn.apply(local)
    }
}

/// A rate of a pose, or its second derivative: of the reference point and of the angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<S = f64> {
    /// Velocity (or acceleration) of the reference point.
    pub v: Vec2<S>,
    /// Angular velocity (or acceleration).
    pub w: S,
}

impl<S: Scalar> Twist<S> {
    /// No motion.
    #[inline(always)]
    pub fn zero() -> Self {
        Twist { v: Vec2::zero(), w: S::zero() }
    }
    /// Velocity of the body point at `arm` from the reference point.
    #[inline(always)]
    pub fn at(&self, arm: Vec2<S>) -> Vec2<S> {
        self.v + arm.perp() * self.w
    }
    /// Acceleration of the body point at `arm`, where these are the accelerations of the reference point and the angle, of
    /// a body that turns at `w`.
    #[inline(always)]
    pub fn acceleration_at(&self, arm: Vec2<S>, w: S) -> Vec2<S> {
        self.at(arm) - arm * (w * w)
    }
    /// The three components (vx, vy, ω).
    pub fn parts(&self) -> [S; 3] {
        [self.v.x, self.v.y, self.w]
    }
    /// From three components.
    pub fn from_parts(p: [S; 3]) -> Self {
        Twist { v: vec2(p[0], p[1]), w: p[2] }
    }
}

impl<S: Scalar> Add for Twist<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Twist { v: self.v + o.v, w: self.w + o.w }
    }
}
impl<S: Scalar> Sub for Twist<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Twist { v: self.v - o.v, w: self.w - o.w }
    }
}
impl<S: Scalar> Mul<S> for Twist<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, k: S) -> Self {
        Twist { v: self.v * k, w: self.w * k }
    }
}

/// A force at the reference point, with a couple.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<S = f64> {
    /// Force in fixed axes.
    pub f: Vec2<S>,
    /// Moment about the reference point, counter-clockwise.
    pub m: S,
}

impl<S: Scalar> Wrench<S> {
    /// No load.
    pub fn zero() -> Self {
        Wrench { f: Vec2::zero(), m: S::zero() }
    }
    /// A force that acts at `arm` from the reference point.
    #[inline(always)]
    pub fn force(f: Vec2<S>, arm: Vec2<S>) -> Self {
        Wrench { f, m: arm.cross(f) }
    }
    /// The same load expressed about another reference point, from which this one lies at `arm`.
    #[inline(always)]
    pub fn seen_from(self, arm: Vec2<S>) -> Self {
        Wrench { f: self.f, m: self.m + arm.cross(self.f) }
    }
    /// Power of the load on a motion of the same reference point.
    #[inline(always)]
    pub fn power(self, t: Twist<S>) -> S {
        self.f.dot(t.v) + self.m * t.w
    }
    /// The three components (Fx, Fy, M).
    pub fn parts(&self) -> [S; 3] {
        [self.f.x, self.f.y, self.m]
    }
    /// From three components.
    pub fn from_parts(p: [S; 3]) -> Self {
        Wrench { f: vec2(p[0], p[1]), m: p[2] }
    }
}

impl<S: Scalar> Add for Wrench<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Wrench { f: self.f + o.f, m: self.m + o.m }
    }
}
impl<S: Scalar> Sub for Wrench<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Wrench { f: self.f - o.f, m: self.m - o.m }
    }
}
impl<S: Scalar> Neg for Wrench<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Wrench { f: -self.f, m: -self.m }
    }
}
impl<S: Scalar> Mul<S> for Wrench<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, k: S) -> Self {
        Wrench { f: self.f * k, m: self.m * k }
    }
}
impl<S: Scalar> AddAssign for Wrench<S> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

/// A short list of at most three scalars.
#[derive(Clone, Copy, Debug)]
pub struct Rows3<S> {
    items: [S; 3],
    len: usize,
}

impl<S: Scalar> Rows3<S> {
    /// From up to three scalars.
    pub fn of(values: &[S]) -> Self {
        let mut items = [S::zero(); 3];
        items[..values.len()].copy_from_slice(values);
        Rows3 { items, len: values.len() }
    }
}

impl<S> std::ops::Deref for Rows3<S> {
    type Target = [S];
    fn deref(&self) -> &[S] {
        &self.items[..self.len]
    }
}
