//! Exact rational numbers that say when they no longer fit.

use std::cmp::Ordering;

/// `n/d` in lowest terms, d > 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ratio {
    n: i64,
    d: i64,
}

impl Ratio {
    pub(super) const ZERO: Self = Ratio::whole(0);
    pub(super) const ONE: Self = Ratio::whole(1);
    pub(super) const HALF: Self = Ratio { n: 1, d: 2 };

    pub(crate) const fn whole(n: i64) -> Self {
        Ratio { n, d: 1 }
    }
    /// `n/d`; `None` when d is 0 or a part does not fit.
    pub(super) fn new(n: i128, d: i128) -> Option<Self> {
        if d == 0 {
            return None;
        }
        let common = gcd(n.unsigned_abs(), d.unsigned_abs()) as i128 * d.signum();
        let fits = |x: i128| i64::try_from(x).ok().filter(|&x| x != i64::MIN);
        Some(Ratio { n: fits(n / common)?, d: fits(d / common)? })
    }
    /// The fraction p/q, q ≤ `limit`, that as a double is `x`, by continued fractions.
    pub(super) fn near(x: f64, limit: i64) -> Option<Self> {
        const LARGE: f64 = 9.0e15;
        let (mut before, mut last) = ((0_i64, 1_i64), (1_i64, 0_i64));
        let mut rest = x;
        while rest.abs() < LARGE {
            let whole = rest.floor();
            let next = |a: i64, b: i64| (whole as i64).checked_mul(b)?.checked_add(a);
            let (p, q) = (next(before.0, last.0)?, next(before.1, last.1)?);
            if q > limit || (p as f64).abs() > LARGE {
                return None;
            }
            if p as f64 / q as f64 == x {
                return Self::new(p.into(), q.into());
            }
            (before, last, rest) = (last, (p, q), 1.0 / (rest - whole));
        }
        None
    }
    pub(crate) fn parts(self) -> (i64, i64) {
        (self.n, self.d)
    }
    pub(crate) fn value(self) -> f64 {
        self.n as f64 / self.d as f64
    }
    pub(super) fn is_whole(self) -> bool {
        self.d == 1
    }
    pub(super) fn is_even(self) -> bool {
        self.d == 1 && self.n % 2 == 0
    }
    pub(super) fn is_zero(self) -> bool {
        self.n == 0
    }
    pub(super) fn signum(self) -> i64 {
        self.n.signum()
    }
    pub(super) fn floor(self) -> i64 {
        self.n.div_euclid(self.d)
    }
    pub(super) fn plus(self, o: Self) -> Option<Self> {
        let (a, b, c, d) = (self.n as i128, self.d as i128, o.n as i128, o.d as i128);
        Self::new(a * d + c * b, b * d)
    }
    pub(super) fn times(self, o: Self) -> Option<Self> {
        Self::new(self.n as i128 * o.n as i128, self.d as i128 * o.d as i128)
    }
    pub(super) fn over(self, o: Self) -> Option<Self> {
        Self::new(self.n as i128 * o.d as i128, self.d as i128 * o.n as i128)
    }
    pub(super) fn negated(self) -> Self {
        Ratio { n: -self.n, d: self.d }
    }
    pub(super) fn abs(self) -> Self {
        Ratio { n: self.n.abs(), d: self.d }
    }
    /// The largest number of which both are whole multiples.
    pub(super) fn common(self, o: Self) -> Option<Self> {
        let shared = gcd(self.d.unsigned_abs().into(), o.d.unsigned_abs().into()) as i128;
        let above = gcd(
            (self.n as i128 * (o.d as i128 / shared)).unsigned_abs(),
            (o.n as i128 * (self.d as i128 / shared)).unsigned_abs(),
        );
        Self::new(above as i128, self.d as i128 / shared * o.d as i128)
    }
    /// A whole power.
    pub(super) fn power(self, n: i64) -> Option<Self> {
        let base = if n < 0 { Ratio::ONE.over(self)? } else { self };
        let exponent = u32::try_from(n.unsigned_abs()).ok()?;
        Some(Ratio { n: base.n.checked_pow(exponent)?, d: base.d.checked_pow(exponent)? })
    }
}

impl PartialOrd for Ratio {
    fn partial_cmp(&self, o: &Self) -> Option<Ordering> {
        Some(self.cmp(o))
    }
}
impl Ord for Ratio {
    fn cmp(&self, o: &Self) -> Ordering {
        (self.n as i128 * o.d as i128).cmp(&(o.n as i128 * self.d as i128))
    }
}

impl std::fmt::Display for Ratio {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.d {
            1 => write!(f, "{}", self.n),
            d => write!(f, "{}/{d}", self.n),
        }
    }
}

fn gcd(a: u128, b: u128) -> u128 {
    match b {
        0 => a,
        _ => gcd(b, a % b),
    }
}
