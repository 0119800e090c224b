//! The tangential field at each boundary of a stack, from the substrate up.

use crate::Layer;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Polarization of the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Polarization {
    S,
    P,
}

impl Polarization {
    /// Admittance η = V/U of a wave that travels downward: q for s, q/n² for p.
    pub(crate) fn admittance(self, medium: &Medium) -> Complex64 {
        match self {
            Self::S => medium.q,
            Self::P => medium.q / medium.squared,
        }
    }

    /// Returns q/η and qη, which are regular where q is 0: 1 and q² for s, n² and q²/n² for p.
    pub(crate) fn regular(self, medium: &Medium) -> (Complex64, Complex64) {
        let q2 = medium.q * medium.q;
        match self {
            Self::S => (Complex64::ONE, q2),
            Self::P => (medium.squared, q2 / medium.squared),
        }
    }
}

/// A medium for light of one direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Medium {
    /// q = n cos θ, the normal component of the wave vector over the vacuum wave number, in the first quadrant: the
    /// wave propagates or decays downward.
    pub(crate) q: Complex64,
    /// n².
    pub(crate) squared: Complex64,
}

impl Medium {
    /// q² = n² − n₀² sin²θ₀ = (n − n₀)(n + n₀) + n₀² cos²θ₀. The cosine itself is used, since the sine loses its digits
    /// near grazing incidence, and a medium equal to the incident one recovers the cosine exactly.
    pub(crate) fn new(index: Complex64, incident: f64, cos_incident: f64) -> Self {
        let q0 = incident * cos_incident;
        Self {
            q: root((index - incident) * (index + incident) + q0 * q0),
            squared: index * index,
        }
    }
}

/// Least |q²|. At the critical angle q² is exactly 0 and U and V stay finite, but there is a division by η. Replacing q by one of
/// this size changes nothing: only sin δ / q and q sin δ matter, which have reached their limits long before.
const LEAST_Q2: f64 = 1e-100;

/// Returns the root in the first quadrant of a number in the upper half plane, to full relative precision in both parts.
fn root(q2: Complex64) -> Complex64 {
    let (re, im) = (q2.re, q2.im.abs());
    let size = re.hypot(im);
    if size < LEAST_Q2 {
        return LEAST_Q2.sqrt().into();
    }
    let large = (0.5 * (size + re.abs())).sqrt();
    let small = 0.5 * im / large;
    if re >= 0.0 {
        Complex64::new(large, small)
    } else {
        Complex64::new(small, large)
    }
}

/// The tangential field at a boundary, in units in which U is 1 at the substrate: U = E and V = H for s, U = H and V = E
/// for p (up to constants). Both follow the same equations, each with its own η.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field {
    pub(crate) u: Complex64,
    pub(crate) v: Complex64,
}

impl Field {
    /// The field of a wave that leaves downward in the substrate.
    pub(crate) fn leaving(admittance: Complex64) -> Self {
        Self {
            u: Complex64::ONE,
            v: admittance,
        }
    }

    /// Re(U* V), the power that crosses the boundary downward, up to a constant.
    pub(crate) fn flux(self) -> f64 {
        (self.u.conj() * self.v).re
    }

    /// Factor that scales a large field down, so that mirrors of thousands of layers stay finite.
    fn rescale(self) -> f64 {
        const LARGE: f64 = 1e100;
        let size = self.u.l1_norm() + self.v.l1_norm();
        if size > LARGE { 1.0 / LARGE } else { 1.0 }
    }
}

/// A layer for light of one wavelength and direction: Abelès' characteristic matrix
/// ((cos δ, −i sin δ / η), (−i η sin δ, cos δ)), δ = 2π q d / λ, times exp(−Im δ), so that no element exceeds 1 by much,
/// however opaque the layer is (Abelès 1950; Born and Wolf, 7th ed., section 1.6.2, equation 39).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    pub(crate) medium: Medium,
    cosine: Complex64,
    /// −i sin δ.
    sine: Complex64,
    decay: f64,
}

impl Slab {
    pub(crate) fn new(layer: &Layer, incident: f64, cos_incident: f64, wavelength_nm: f64) -> Self {
        let medium = Medium::new(layer.index, incident, cos_incident);
        let delta = medium.q * (TAU * layer.thickness_nm / wavelength_nm);
        let (sin, cos) = delta.re.sin_cos();
        // e^−b cosh b and e^−b sinh b, with b = Im δ, without cancellation in the latter.
        let less = -0.5 * (-2.0 * delta.im).exp_m1();
        let (cosh, sinh) = (1.0 - less, less);
        Self {
            medium,
            cosine: Complex64::new(cos * cosh, -sin * sinh),
            sine: Complex64::new(cos * sinh, -sin * cosh),
            decay: (-delta.im).exp(),
        }
    }

    /// Returns the field on top of the layer from the field beneath it, and the factor by which it is smaller than in the
    /// units of the field beneath.
    pub(crate) fn lift(&self, polarization: Polarization, below: Field) -> (Field, f64) {
        let eta = polarization.admittance(&self.medium);
        let field = Field {
            u: self.cosine * below.u + self.sine / eta * below.v,
            v: self.cosine * below.v + self.sine * eta * below.u,
        };
        let rescale = field.rescale();
        let lifted = Field {
            u: field.u * rescale,
            v: field.v * rescale,
        };
        (lifted, self.decay * rescale)
    }

    /// Returns the row vector (a, b) times the matrix. Only its direction matters: it is scaled down where it has grown.
    pub(crate) fn lower(&self, polarization: Polarization, row: Field) -> Field {
        let eta = polarization.admittance(&self.medium);
        let lowered = Field {
            u: row.u * self.cosine + row.v * self.sine * eta,
            v: row.v * self.cosine + row.u * self.sine / eta,
        };
        let rescale = lowered.rescale();
        Field {
            u: lowered.u * rescale,
            v: lowered.v * rescale,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots whose parts differ greatly in size, which a root by modulus and argument loses.
    #[test]
    fn both_parts_of_the_root_keep_their_digits() {
        for (re, im) in [
            (1.5, 1e-12),
            (1e-12, 1.5),
            (3.0, 4.0),
            (2.0, 0.0),
            (0.0, 2.0),
        ] {
            let found = root(Complex64::new((re - im) * (re + im), 2.0 * re * im));
            assert!((found.re - re).abs() <= 1e-15 * re, "{found} for {re} {im}");
            assert!((found.im - im).abs() <= 1e-15 * im, "{found} for {re} {im}");
        }
        // A negative zero does not choose the growing wave.
        assert!(root(Complex64::new(-2.0, -0.0)).im > 0.0);
    }

    #[test]
    fn a_medium_like_the_incident_one_has_its_cosine_exactly() {
        let medium = Medium::new(1.52.into(), 1.52, 1e-4);
        assert!((medium.q - 1.52e-4).norm() < 1e-19);
    }
}
