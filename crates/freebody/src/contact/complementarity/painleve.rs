//! Painlevé's paradox at one sliding contact.

use crate::solve::Matrix;

/// The normal acceleration aN = A λN + b of a contact that slides.
///
/// A > 0 is regular. With A < 0 there are two motions if b > 0 and none if b < 0
/// (Painlevé 1895; Champneys & Várkonyi, *IMA J. Appl. Math.* 81, 2016).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Painleve {
    /// A = gNN − μ s gNT, since λT = −μ s λN.
    pub leading: f64,
    /// b, the normal acceleration without contact force.
    pub free: f64,
    /// The smallest coefficient μ ≥ 0 with A = 0, if there is one.
    pub critical: Option<f64>,
}

/// A and b of `touch`, which slides with the sense s = ±1 under the coefficient `mu`, all other contacts
/// being without force; `g` and `free` as in [`Problem`](super::Problem).
pub fn painleve(g: &Matrix, free: &[f64], contact: usize, sense: f64, mu: f64) -> Painleve {
    let (normal, coupling) = (g[(contact, contact)], sense * g[(contact, g.rows() / 2 + contact)]);
    Painleve {
        leading: normal - mu * coupling,
        free: free[contact],
        critical: (coupling > 0.0).then(|| normal / coupling),
    }
}
