//! Factoring by collecting: the same terms, grouped by what they share, in the way that leaves the
//! least to read.

use super::super::arena::{Arena, SumId};
use super::super::atom::{inverted, joined, Atom, AtomId, Factor};
use super::super::coefficient::Coefficient;
use super::super::ratio::Ratio;
use super::form::{number_cost, Form, Poly, Product};
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Relative difference of two coefficients, sums of rounded numbers, that are equal: some fifty roundings.
const SAME: f64 = 1e-14;
/// Up to this number of terms every variable is tried as what to collect by.
const FEW_TERMS: usize = 12;

/// A sum as Σ (Σ numbers · keys) · rest.
type Collected = Vec<(Poly, Poly)>;

/// How many of the most promising ways to collect a sum are followed to their end.
fn followed(terms: usize) -> usize {
    match terms {
        0..=5 => usize::MAX,
        6..=16 => 3,
        17..=60 => 2,
        _ => 1,
    }
}

/// What kind of thing an atom is to a reader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    Parameter,
    Function,
    Rate,
}

/// What has been written in this session.
#[derive(Default)]
pub(in super::super) struct Known {
    factored: FxHashMap<Poly, Rc<Product>>,
    pub(super) whole: FxHashMap<SumId, Rc<Product>>,
    costs: FxHashMap<AtomId, usize>,
}

pub(super) struct Writer<'a> {
    pub(super) arena: &'a mut Arena,
}

impl Writer<'_> {
    pub(super) fn kind(&self, id: AtomId) -> Kind {
        match self.arena.atom(id) {
            Atom::Variable(variable) if variable.dots > 0 => Kind::Rate,
            Atom::Cos(_) | Atom::Sin(_) | Atom::Call(..) => Kind::Function,
            _ => Kind::Parameter,
        }
    }

    /// The factored form of a sum.
    pub(super) fn factor(&mut self, poly: &Poly) -> Rc<Product> {
        if let Some(known) = self.arena.known.factored.get(poly) {
            return known.clone();
        }
        let content = common_factors(poly);
        let bare = divided(poly, &content, Coefficient::ONE);
        let product = match self.square(&bare) {
            Some(square) => self.single(&content, Coefficient::ONE).times(square),
            None => {
                let number = best_number(&bare);
                let outer = self.single(&content, number);
                let rest = divided(&bare, &[], number);
                if rest.len() == 1 {
                    outer
                } else {
                    outer.times(self.best(&rest))
                }
            }
        };
        let product = Rc::new(product);
        self.arena.known.factored.insert(poly.clone(), product.clone());
        product
    }

    /// A single term.
    pub(super) fn single(&mut self, factors: &[Factor], number: Coefficient) -> Product {
        let mut product = Product { number, factors: vec![], cost: number_cost(number) };
        for &(id, e) in factors {
            product = match *self.arena.atom(id) {
                Atom::Group(of) if e.is_whole() => product.times((*self.whole(of)).clone().raised(e)),
                _ => {
                    product.factors.push((Form::Atom(id), e));
                    product.cost += self.atom_cost(id) + usize::from(e != Ratio::ONE);
                    product
                }
            };
        }
        product
    }
    fn atom_cost(&mut self, id: AtomId) -> usize {
        if let Some(&cost) = self.arena.known.costs.get(&id) {
            return cost;
        }
        let inside = match self.arena.atom(id) {
            Atom::Group(of) | Atom::Cos(of) | Atom::Sin(of) => vec![*of],
            Atom::Call(_, of) => of.clone(),
            _ => vec![],
        };
        let mut cost = 1;
        for of in inside {
            let terms = self.arena.terms(of);
            let factors =
                terms.iter().map(|term| (self.arena.factors(term.0), number_cost(term.1))).collect::<Vec<_>>();
            cost += terms.len() - 1;
            for (factors, number) in factors {
                cost += number + factors.iter().map(|f| self.atom_cost(f.0)).sum::<usize>();
            }
        }
        self.arena.known.costs.insert(id, cost);
        cost
    }

    /// The cheapest of the ways to write a sum of several terms without common factor.
    fn best(&mut self, poly: &Poly) -> Product {
        let terms = poly.iter().map(|(factors, c)| self.single(factors, *c)).collect();
        let mut best = Product::of_sum(terms);
        let ways = self.groupings(poly).into_iter().filter_map(|keys| collected(poly, &keys)).enumerate();
        let mut ways: Vec<(usize, usize, Collected)> = ways.map(|(at, way)| (self.outlook(&way), at, way)).collect();
        ways.sort_by_key(|way| way.0);
        ways.truncate(followed(poly.len()));
        ways.sort_by_key(|way| way.1);
        for (_, _, way) in ways {
            let gathered = self.gathered(&way);
            if gathered.cost < best.cost {
                best = gathered;
            }
        }
        best
    }

    /// The sets of atoms to collect by.
    fn groupings(&self, poly: &Poly) -> Vec<BTreeSet<AtomId>> {
        use Kind::{Function, Parameter, Rate};
        let atoms: BTreeSet<AtomId> = poly.iter().flat_map(|term| term.0.iter().map(|f| f.0)).collect();
        let sets: [&[Kind]; 6] =
            [&[Rate], &[Rate, Function], &[Function], &[Parameter], &[Parameter, Function], &[Parameter, Rate]];
        let of_kinds = |kinds: &&[Kind]| atoms.iter().copied().filter(|&id| kinds.contains(&self.kind(id))).collect();
        let mut all: Vec<BTreeSet<AtomId>> = sets.iter().map(of_kinds).collect();
        if poly.len() <= FEW_TERMS {
            for &atom in &atoms {
                all.push(BTreeSet::from([atom]));
                all.push(atoms.iter().copied().filter(|&other| other != atom).collect());
            }
        }
        all.retain(|keys| !keys.is_empty() && keys.len() < atoms.len());
        all.sort();
        all.dedup();
        all
    }

    /// What a way to collect costs when nothing more is collected.
    fn outlook(&mut self, way: &Collected) -> usize {
        way.iter().map(|(sum, rest)| self.flat_cost(sum) + self.flat_cost(rest) + 1).sum()
    }
    /// What a sum costs with nothing but the common factors of its terms pulled out.
    pub(super) fn flat_cost(&mut self, poly: &Poly) -> usize {
        let again = poly.len() - 1;
        let all: usize = poly.iter().map(|term| self.factors_cost(&term.0) + number_cost(term.1)).sum();
        all + again - again * self.factors_cost(&common_factors(poly)).min(all / poly.len())
    }
    fn factors_cost(&mut self, factors: &[Factor]) -> usize {
        factors.iter().map(|f| self.atom_cost(f.0) + usize::from(f.1 != Ratio::ONE)).sum()
    }
    fn gathered(&mut self, way: &Collected) -> Product {
        let mut terms = Vec::new();
        for (sum, rest) in way {
            let product = (*self.factor(rest)).clone().times((*self.factor(sum)).clone());
            terms.extend(product.into_terms());
        }
        Product::of_sum(terms)
    }

    /// n (a² + 2ab + b²) = n (a + b)², with any number of variables; n is such that the first square of what moves is
    /// bare.
    fn square(&mut self, poly: &Poly) -> Option<Product> {
        let even = |term: &&(Vec<Factor>, Coefficient)| term.0.iter().all(|f| f.1.is_even());
        let moves = |term: &&(Vec<Factor>, Coefficient)| term.0.iter().map(|f| self.kind(f.0)).max();
        let number = poly.iter().filter(even).rev().max_by_key(moves)?.1;
        let root = square_root(&divided(poly, &[], number))?;
        let inner = (*self.factor(&root)).clone();
        let cost = inner.cost + 1 + number_cost(number);
        Some(Product { number, factors: vec![(Form::Sum(inner.into_terms().into()), Ratio::whole(2))], cost })
    }
}

/// r of r² = a sum.
fn square_root(poly: &Poly) -> Option<Poly> {
    let root_of = |c: Coefficient| {
        let (n, d) = c.exact()?.parts();
        let root = |x: i64| Some((x as f64).sqrt().round() as i64).filter(|r| r.checked_mul(*r) == Some(x));
        Ratio::new(root(n)?.into(), root(d)?.into())
    };
    let mut root: Poly = Vec::new();
    for (factors, c) in poly {
        if factors.iter().all(|f| f.1.is_even()) {
            let halves = factors.iter().map(|f| Some((f.0, f.1.times(Ratio::HALF)?))).collect::<Option<_>>()?;
            root.push((halves, Coefficient::Exact(root_of(*c)?)));
        }
    }
    if root.len() < 2 || root.len() * (root.len() + 1) / 2 != poly.len() {
        return None;
    }
    let cross = |a: &[Factor], b: &[Factor]| {
        let product = joined(a, b)?;
        poly.iter().find(|term| term.0 == product).map(|term| term.1)
    };
    for i in 1..root.len() {
        if cross(&root[0].0, &root[i].0)?.is_negative() {
            root[i].1 = root[i].1.negated();
        }
    }
    let two = Coefficient::whole(2);
    for i in 0..root.len() {
        for j in i + 1..root.len() {
            if cross(&root[i].0, &root[j].0)? != root[i].1.times(root[j].1).times(two) {
                return None;
            }
        }
    }
    Some(root)
}

/// The sum collected by some of its atoms; `None` when nothing meets.
fn collected(poly: &Poly, keys: &BTreeSet<AtomId>) -> Option<Collected> {
    let mut by_key: BTreeMap<Vec<Factor>, Poly> = BTreeMap::new();
    for (factors, c) in poly {
        let (key, rest): (Vec<Factor>, Vec<Factor>) = factors.iter().partition(|f| keys.contains(&f.0));
        by_key.entry(key).or_default().push((rest, *c));
    }
    let mut by_rest: BTreeMap<Vec<Vec<Factor>>, Vec<Alike>> = BTreeMap::new();
    let mut count = 0;
    for (mut key, mut rest) in by_key {
        rest.sort_by(|a, b| a.0.cmp(&b.0));
        let common = if rest.len() > 1 { common_factors(&rest) } else { vec![] };
        let lead = rest[0].1;
        let whole = divided(&rest, &common, Coefficient::ONE);
        rest = divided(&whole, &[], lead);
        key = joined(&key, &common)?;
        let same = by_rest.entry(rest.iter().map(|term| term.0.clone()).collect()).or_default();
        match same.iter_mut().find(|other| proportional(&other.rest, &rest)) {
            Some(other) => other.sum.push((key, lead)),
            None => {
                count += 1;
                same.push(Alike { sum: vec![(key, lead)], rest, whole });
            }
        }
    }
    (count < poly.len()).then(|| by_rest.into_values().flatten().map(Alike::written).collect())
}

/// Products with one `rest`, compared without the number of its first term; `whole` is that of the first product.
struct Alike {
    sum: Poly,
    rest: Poly,
    whole: Poly,
}

impl Alike {
    /// What stands alone keeps its numbers.
    fn written(self) -> (Poly, Poly) {
        match &self.sum[..] {
            [(key, _)] => (vec![(key.clone(), Coefficient::ONE)], self.whole),
            _ => (self.sum, self.rest),
        }
    }
}

fn common_factors(poly: &Poly) -> Vec<Factor> {
    let mut common = poly[0].0.clone();
    for (factors, _) in poly {
        let exponent = |id| factors.iter().find(|f| f.0 == id).map_or(Ratio::ZERO, |f| f.1);
        common.iter_mut().for_each(|f| f.1 = shared(f.1, exponent(f.0)));
    }
    common.retain(|f| !f.1.is_zero());
    common
}

/// The sum over a single term.
fn divided(poly: &Poly, factors: &[Factor], number: Coefficient) -> Poly {
    let inverse = inverted(factors);
    let less = |factors: &[Factor]| joined(factors, &inverse).unwrap_or_default();
    let mut rest: Poly = poly.iter().map(|(f, c)| (less(f), c.over(number))).collect();
    rest.sort_by(|a, b| a.0.cmp(&b.0));
    rest
}

/// The exponent that can be pulled out of two.
fn shared(a: Ratio, b: Ratio) -> Ratio {
    match (a.signum(), b.signum()) {
        (1, 1) => a.min(b),
        (-1, -1) => a.max(b),
        _ => Ratio::ZERO,
    }
}

fn proportional(a: &Poly, b: &Poly) -> bool {
    let near = |x: Coefficient, y: Coefficient| x == y || (x.value() - y.value()).abs() <= SAME * x.value().abs();
    a.iter().zip(b).all(|(x, y)| near(x.1, y.1))
}

/// The number that, pulled out, leaves the least to read; negative where all terms are.
fn best_number(poly: &Poly) -> Coefficient {
    if let [only] = &poly[..] {
        return only.1;
    }
    let sign = if poly.iter().all(|term| term.1.is_negative()) { -1 } else { 1 };
    let mut candidates = vec![Coefficient::ONE];
    let exact: Option<Vec<Ratio>> = poly.iter().map(|term| term.1.exact().map(Ratio::abs)).collect();
    let common = exact.and_then(|all| all.into_iter().try_fold(Ratio::ZERO, Ratio::common));
    candidates.extend(common.map(Coefficient::Exact));
    for (_, c) in poly {
        if candidates.len() < 10 && !candidates.contains(&c.abs()) {
            candidates.push(c.abs());
        }
    }
    let cost = |by: &Coefficient| {
        number_cost(*by) + poly.iter().map(|term| number_cost(term.1.abs().over(*by))).sum::<usize>()
    };
    // A half pulled out of what then holds a 2 was better left in.
    let comes_back = |by: &Coefficient| {
        let below = by.exact().map_or(1, |ratio| ratio.parts().1);
        let meets =
            |left: Ratio| Ratio::new(left.parts().0.into(), below.into()).is_some_and(|ratio| ratio.parts().1 < below);
        poly.iter().any(|term| term.1.abs().over(*by).exact().is_some_and(meets))
    };
    candidates.retain(|by| !comes_back(by));
    let best = candidates.into_iter().min_by_key(cost).unwrap_or(Coefficient::ONE);
    best.times(Coefficient::whole(sign))
}
