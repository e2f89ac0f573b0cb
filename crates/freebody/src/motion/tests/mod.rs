//! Systems with known motions, and the tests on them.

use super::*;

mod accuracy;
mod adaptive_lanes;
mod endings;
mod events;
mod orders;
mod stiff;
mod symplectic;
mod taylor;

type Rate<'a> = Box<dyn FnMut(f64, &[f64], &mut [f64]) + 'a>;
type Switches<'a> = Box<dyn FnMut(f64, &[f64], &mut [f64]) + 'a>;
type Act<'a> = Box<dyn FnMut(usize, f64, &mut [f64]) -> After + 'a>;

/// A system made of closures.
struct Plain<'a> {
    scale: Vec<f64>,
    rate: Rate<'a>,
    watches: Vec<EventSpec>,
    switches: Switches<'a>,
    act: Act<'a>,
}

impl<'a> Plain<'a> {
    fn new(scale: &[f64], rate: impl FnMut(f64, &[f64], &mut [f64]) + 'a) -> Self {
        Self {
            scale: scale.to_vec(),
            rate: Box::new(rate),
            watches: Vec::new(),
            switches: Box::new(|_, _, _| ()),
            act: Box::new(|_, _, _| After::Continue),
        }
    }

    fn watching(mut self, directions: &[i8], switches: impl FnMut(f64, &[f64], &mut [f64]) + 'a) -> Self {
        let spec = |&direction| EventSpec::event(direction);
        self.watches = directions.iter().map(spec).collect();
        self.switches = Box::new(switches);
        self
    }

    fn acting(mut self, act: impl FnMut(usize, f64, &mut [f64]) -> After + 'a) -> Self {
        self.act = Box::new(act);
        self
    }

    fn run(&mut self, name: &str, from: (f64, &[f64]), t_end: f64, options: &Options) -> Run {
        run(self, method(name).unwrap(), from, t_end, options, &mut |_| true)
    }
}

impl System for Plain<'_> {
    fn dim(&self) -> usize {
        self.scale.len()
    }
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), DynamicsError> {
        (self.rate)(t, y, dy);
        Ok(())
    }
    fn scale(&self, out: &mut [f64]) {
        out.copy_from_slice(&self.scale);
    }
    fn switches(&self) -> usize {
        self.watches.len()
    }
    fn switch_values(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> Result<(), DynamicsError> {
        (self.switches)(t, y, out);
        Ok(())
    }
    fn switch(&self, i: usize) -> EventSpec {
        self.watches[i]
    }
    fn act(&mut self, i: usize, t: f64, y: &mut [f64]) -> Result<After, DynamicsError> {
        Ok((self.act)(i, t, y))
    }
}

/// H = p²/2 + V(q) with q̇ = p, so y = z.
struct Hamiltonian {
    force: fn(f64) -> f64,
}

impl System for Hamiltonian {
    fn dim(&self) -> usize {
        2
    }
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), DynamicsError> {
        self.flow(t, y, dy)
    }
    fn canonical(&mut self) -> Option<&mut dyn Canonical> {
        Some(self)
    }
}

impl Canonical for Hamiltonian {
    fn enter(&mut self, _: f64, y: &[f64], z: &mut [f64]) -> Result<(), DynamicsError> {
        z.copy_from_slice(y);
        Ok(())
    }
    fn leave(&mut self, _: f64, z: &[f64], y: &mut [f64]) -> Result<(), DynamicsError> {
        y.copy_from_slice(z);
        Ok(())
    }
    fn flow(&mut self, _: f64, z: &[f64], dz: &mut [f64]) -> Result<(), DynamicsError> {
        (dz[0], dz[1]) = (z[1], (self.force)(z[0]));
        Ok(())
    }
}

fn rtol(rtol: f64) -> Options {
    Options { rtol, ..Options::default() }
}

fn fixed(h: f64) -> Options {
    Options { first_step: Some(h), ..Options::default() }
}
