//! The number that writes down what is done with it.

use super::recorder::{Form, FormId, Function, Recorder};
use super::tape::Tape;
use crate::scalar::{DoubleDouble, Scalar};
use std::cell::RefCell;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A number of a formula being recorded: a handle that holds within one [`recorded`], with its value there for decisions.
#[derive(Clone, Copy, Debug)]
pub struct Traced {
    form: FormId,
    value: f64,
}

thread_local! {
    static RECORDER: RefCell<Recorder> = RefCell::new(Recorder::default());
}

fn with<T>(work: impl FnOnce(&mut Recorder) -> T) -> T {
    RECORDER.with(|recorder| work(&mut recorder.borrow_mut()))
}

/// Records a formula of inputs as it is at their values: for a [`Solution`](super::Solution), ẏ of time and y.
///
/// # Errors
/// That of the formula.
pub fn recorded<E>(
    inputs: impl IntoIterator<Item = f64>,
    formula: impl FnOnce(&[Traced]) -> Result<Vec<Traced>, E>,
) -> Result<Tape<DoubleDouble>, E> {
    with(|recorder| *recorder = Recorder::default());
    let inputs: Vec<Traced> = inputs.into_iter().map(|value| Traced { form: with(Recorder::input), value }).collect();
    let results = formula(&inputs);
    let recorder = with(std::mem::take);
    results.map(|results| recorder.tape(inputs.len(), &results.iter().map(|x| x.form).collect::<Vec<_>>()))
}

impl Traced {
    fn exact(constant: DoubleDouble) -> Self {
        Traced { form: with(|recorder| recorder.form(Form::constant(constant))), value: constant.hi }
    }
    fn combined(self, o: Self, factor: f64, value: f64) -> Self {
        Traced { form: with(|recorder| recorder.combine(self.form, o.form, factor)), value }
    }
    /// A function of it; of a constant, another.
    fn apply(self, function: Function, constant: fn(DoubleDouble) -> DoubleDouble, value: f64) -> Self {
        match with(|recorder| recorder.as_constant(self.form)) {
            Some(x) => Traced::exact(constant(x)),
            None => Traced { form: with(|recorder| recorder.apply(function, self.form)), value },
        }
    }
}

impl Add for Traced {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        self.combined(o, 1.0, self.value + o.value)
    }
}
impl Sub for Traced {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self.combined(o, -1.0, self.value - o.value)
    }
}
impl Mul for Traced {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Traced { form: with(|recorder| recorder.multiply(self.form, o.form)), value: self.value * o.value }
    }
}
impl Div for Traced {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        Traced { form: with(|recorder| recorder.divide(self.form, o.form)), value: self.value / o.value }
    }
}
impl Neg for Traced {
    type Output = Self;
    fn neg(self) -> Self {
        Traced::zero().combined(self, -1.0, -self.value)
    }
}
impl AddAssign for Traced {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for Traced {
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl Scalar for Traced {
    fn of(value: f64) -> Self {
        Traced::exact(DoubleDouble::of(value))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Scalar::sin_cos(self.value);
        (self.apply(Function::Sin, |x| x.sin_cos().0, sin), self.apply(Function::Cos, |x| x.sin_cos().1, cos))
    }
    fn sqrt(self) -> Self {
        self.apply(Function::Sqrt, DoubleDouble::sqrt, self.value.sqrt())
    }
    fn exp(self) -> Self {
        self.apply(Function::Exp, DoubleDouble::exp, Scalar::exp(self.value))
    }
    fn ln(self) -> Self {
        self.apply(Function::Ln, DoubleDouble::ln, Scalar::ln(self.value))
    }
    fn atan2(self, x: Self) -> Self {
        Traced { form: with(|recorder| recorder.atan2(self.form, x.form)), value: Scalar::atan2(self.value, x.value) }
    }
    /// By squaring.
    fn powi(self, n: i32) -> Self {
        let (mut power, mut square, mut left) = (Self::one(), self, n.unsigned_abs());
        while left > 0 {
            if left % 2 == 1 {
                power = power * square;
            }
            left /= 2;
            if left > 0 {
                square = square * square;
            }
        }
        if n < 0 {
            Self::one() / power
        } else {
            power
        }
    }
    fn value(self) -> f64 {
        self.value
    }
}
