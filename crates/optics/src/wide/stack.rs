//! Stacks of layers, evaluated one layer at a time.
//!
//! The equations are those of [`stack`](crate::stack): the tangential field (U, V) is carried from the substrate up by Abelès'
//! characteristic matrix times exp(−Im δ). For a clear layer the matrix has four real or imaginary elements and determinant 1.
//! A layer therefore costs ten operations per polarization plus one sine and cosine for both, without a division, and the
//! transmittance needs no product over the layers. Carrying the ratio A/B of the waves that travel up and down would cost fourteen
//! operations and a product, and would lose its digits where q → 0, at a layer's critical angle.

use super::elementary::{decay, sin_cos_half_turns};
use super::{PolarizedPowers, Real, WideComplex};

/// Least q²; smaller values are replaced by it (as in [`stack`](crate::stack)).
const LEAST_Q2: f64 = 1e-100;

/// Number of layers after which [`Sweep::rescale`] is due, before a field can overflow: a layer multiplies it by less than some 10⁴.
pub const SCALED_AFTER: usize = 32;

/// A medium before its direction is known.
#[derive(Clone, Copy, Debug)]
pub struct Index<T: Real> {
    /// n².
    squared: WideComplex<T>,
    /// 1/n².
    inverse: WideComplex<T>,
    /// (n − n₀)(n + n₀).
    above: WideComplex<T>,
    /// The smallest (n − n₀)(n + n₀) of the lanes, if k = 0 in every lane.
    clear: Option<f64>,
}

impl<T: Real> Index<T> {
    /// A medium of index n + ik (n ≥ 0, k ≥ 0, not both 0) below a medium of index `incident`. `clear` says that k is 0 in every lane.
    #[inline(always)]
    pub fn new(n: T, k: T, clear: bool, incident: T) -> Self {
        if clear {
            let squared = n * n;
            let above = (n - incident) * (n + incident);
            return Self {
                squared: WideComplex::real(squared),
                inverse: WideComplex::real(squared.recip()),
                above: WideComplex::real(above),
                clear: Some(above.least()),
            };
        }
        let index = WideComplex::new(n, k);
        let squared = index * index;
        let below = WideComplex::new(n - incident, k);
        Self {
            squared,
            inverse: squared.recip(),
            above: below * WideComplex::new(n + incident, k),
            clear: None,
        }
    }

    /// The medium for light of one direction, given by q₀² = n₀² cos²θ₀ in lanes, the smallest of these, and 2/λ.
    #[inline(always)]
    pub fn wave(&self, q0_squared: T, least_q0_squared: f64, half_waves_per_nm: T) -> Wave<T> {
        let q2 = self.above.re + q0_squared;
        if self
            .clear
            .is_some_and(|least| least + least_q0_squared >= 0.0)
        {
            let q = q2.at_least(LEAST_Q2).sqrt();
            let over_q = q.recip();
            return Wave(Path::Clear(Normal {
                q,
                over_q,
                p: q * self.inverse.re,
                over_p: over_q * self.squared.re,
                half_turns_per_nm: q * half_waves_per_nm,
            }));
        }
        let (q, over_q) = root(WideComplex::new(q2, self.above.im));
        Wave(Path::Lossy(Normal {
            q,
            over_q,
            p: q * self.inverse,
            over_p: over_q * self.squared,
            half_turns_per_nm: q.scale(half_waves_per_nm),
        }))
    }
}

/// Returns the root q in the first quadrant of a q² in the upper half plane, and 1/q.
#[inline(always)]
fn root<T: Real>(q2: WideComplex<T>) -> (WideComplex<T>, WideComplex<T>) {
    let (re, im) = (q2.re, q2.im.abs());
    let size = WideComplex::new(re, im).norm_sqr().sqrt();
    let half = re.constant(0.5);
    let large = ((size + re.abs()) * half).at_least(LEAST_Q2).sqrt();
    let small = im * half * large.recip();
    let q = WideComplex::new(re.choose(large, small), re.choose(small, large));
    let over_size = q.norm_sqr().recip();
    (q, WideComplex::new(q.re * over_size, -(q.im * over_size)))
}

/// A medium for light of one direction.
#[derive(Clone, Copy, Debug)]
pub struct Wave<T: Real>(Path<T>);

#[derive(Clone, Copy, Debug)]
enum Path<T: Real> {
    /// Light propagates without loss in every lane.
    Clear(Normal<T>),
    /// Any lane may have losses or light that only tunnels.
    Lossy(Normal<WideComplex<T>>),
}

/// Quantities derived from the normal component of the wave vector.
#[derive(Clone, Copy, Debug)]
pub(super) struct Normal<N> {
    /// η for s: q = n cos θ.
    q: N,
    over_q: N,
    /// η for p: q/n².
    p: N,
    over_p: N,
    /// 2q/λ: the phase δ of one nanometer, over π.
    half_turns_per_nm: N,
}

/// The field of one polarization at a boundary.
#[derive(Clone, Copy, Debug)]
struct Field<T: Real> {
    u: WideComplex<T>,
    v: WideComplex<T>,
}

impl<T: Real> Field<T> {
    #[inline(always)]
    fn leaving(admittance: WideComplex<T>) -> Self {
        let u = WideComplex::real(admittance.re.constant(1.0));
        Self { u, v: admittance }
    }

    /// U ← cU − i(s/η)V, V ← cV − i(sη)U with real c, s and η.
    #[inline(always)]
    fn lift_clear(self, cos: T, over: T, times: T) -> Self {
        let Self { u, v } = self;
        Self {
            u: WideComplex::new(
                over.mul_add(v.im, cos * u.re),
                over.negate_mul_add(v.re, cos * u.im),
            ),
            v: WideComplex::new(
                times.mul_add(u.im, cos * v.re),
                times.negate_mul_add(u.re, cos * v.im),
            ),
        }
    }

    #[inline(always)]
    fn lift(self, cos: WideComplex<T>, over: WideComplex<T>, times: WideComplex<T>) -> Self {
        Self {
            u: over.mul_add(self.v, cos * self.u),
            v: times.mul_add(self.u, cos * self.v),
        }
    }

    /// Returns R, and the 4η₀ / |η₀U + V|² from which T follows.
    #[inline(always)]
    fn end(self, eta: T) -> (T, T) {
        let Self { u, v } = self;
        let (re, im) = (eta * u.re, eta * u.im);
        let over = WideComplex::new(re + v.re, im + v.im).norm_sqr().recip();
        let reflectance = WideComplex::new(re - v.re, im - v.im).norm_sqr() * over;
        (reflectance, over * eta * eta.constant(4.0))
    }

    /// Returns r, and the 1 / (η₀U + V) from which t follows.
    #[inline(always)]
    fn amplitudes(self, eta: T) -> (WideComplex<T>, WideComplex<T>) {
        let Self { u, v } = self;
        let (re, im) = (eta * u.re, eta * u.im);
        let over = WideComplex::new(re + v.re, im + v.im).recip();
        (WideComplex::new(re - v.re, im - v.im) * over, over)
    }

    #[inline(always)]
    fn size(self) -> T {
        self.u.norm_sqr() + self.v.norm_sqr()
    }

    #[inline(always)]
    fn scale(self, factor: T) -> Self {
        Self {
            u: self.u.scale(factor),
            v: self.v.scale(factor),
        }
    }
}

/// The fields of both polarizations, carried from the substrate up.
#[derive(Clone, Copy, Debug)]
pub struct Sweep<T: Real> {
    s: Field<T>,
    p: Field<T>,
    /// |exp(−Σ Im δ)|² times the squares of the factors by which the fields were scaled, for s and p.
    passing_s: T,
    passing_p: T,
    /// Re η of the substrate.
    leaving_s: T,
    leaving_p: T,
}

impl<T: Real> Sweep<T> {
    /// Starts at the substrate.
    #[inline(always)]
    pub fn new(substrate: &Wave<T>) -> Self {
        let (s, p) = match &substrate.0 {
            Path::Clear(normal) => (WideComplex::real(normal.q), WideComplex::real(normal.p)),
            Path::Lossy(normal) => (normal.q, normal.p),
        };
        let one = s.re.constant(1.0);
        Self {
            s: Field::leaving(s),
            p: Field::leaving(p),
            passing_s: one,
            passing_p: one,
            leaving_s: s.re,
            leaving_p: p.re,
        }
    }

    /// Carries the fields up through a layer.
    #[inline(always)]
    pub fn pass(&mut self, wave: &Wave<T>, thickness_nm: T) {
        match &wave.0 {
            Path::Clear(normal) => self.pass_clear(normal, thickness_nm),
            Path::Lossy(normal) => self.pass_lossy(normal, thickness_nm),
        }
    }

    #[inline(always)]
    fn pass_clear(&mut self, wave: &Normal<T>, thickness_nm: T) {
        let (sin, cos) = sin_cos_half_turns(wave.half_turns_per_nm * thickness_nm);
        self.s = self.s.lift_clear(cos, sin * wave.over_q, sin * wave.q);
        self.p = self.p.lift_clear(cos, sin * wave.over_p, sin * wave.p);
    }

    #[inline(always)]
    fn pass_lossy(&mut self, wave: &Normal<WideComplex<T>>, thickness_nm: T) {
        let half_turns = wave.half_turns_per_nm.scale(thickness_nm);
        let (sin, cos) = sin_cos_half_turns(half_turns.re);
        let (passing, less) = decay(half_turns.im);
        // exp(−b) cosh b and exp(−b) sinh b with b = Im δ.
        let half = cos.constant(0.5);
        let (cosh, sinh) = (half.mul_add(passing, half), half * less);
        let cosine = WideComplex::new(cos * cosh, -(sin * sinh));
        let sine = WideComplex::new(cos * sinh, -(sin * cosh));
        self.s = self.s.lift(cosine, sine * wave.over_q, sine * wave.q);
        self.p = self.p.lift(cosine, sine * wave.over_p, sine * wave.p);
        self.passing_s = self.passing_s * passing;
        self.passing_p = self.passing_p * passing;
    }

    /// Scales both fields to size 1, so that they stay finite in mirrors of thousands of layers.
    #[inline(always)]
    pub fn rescale(&mut self) {
        let over_s = self.s.size().recip();
        self.s = self.s.scale(over_s.sqrt());
        self.passing_s = self.passing_s * over_s;
        let over_p = self.p.size().recip();
        self.p = self.p.scale(over_p.sqrt());
        self.passing_p = self.passing_p * over_p;
    }

    /// Returns R_s, R_p, T_s and T_p, from η of the incident medium.
    #[inline(always)]
    pub fn powers(&self, eta_s: T, eta_p: T) -> [T; 4] {
        let (r_s, over_s) = self.s.end(eta_s);
        let (r_p, over_p) = self.p.end(eta_p);
        [
            r_s,
            r_p,
            over_s * self.passing_s * self.leaving_s,
            over_p * self.passing_p * self.leaving_p,
        ]
    }

    /// Returns what is reflected and what is transmitted of polarized light, from η of the incident medium.
    ///
    /// Powers are those of [`powers`](Self::powers). The phase between s and p is that of r = (η₀U − V) / (η₀U + V) and of
    /// t ∝ 1 / (η₀U + V), with the sign by which r_p = −r_s at normal incidence. For p, U is the magnetic field; in a clear substrate
    /// the phase of t is that of the electric field too. (In an absorbing substrate the two differ.)
    #[inline(always)]
    pub fn polarized(&self, eta_s: T, eta_p: T) -> [PolarizedPowers<T>; 2] {
        let (r_s, over_s) = self.s.amplitudes(eta_s);
        let (r_p, over_p) = self.p.amplitudes(eta_p);
        let t_s = (eta_s * self.passing_s * self.leaving_s).times(4.0);
        let t_p = (eta_p * self.passing_p * self.leaving_p).times(4.0);
        let (r, t) = (r_s.times_conj(r_p), over_s.times_conj(over_p));
        let between = (t_s * t_p).sqrt();
        [
            PolarizedPowers {
                s: r_s.norm_sqr(),
                p: r_p.norm_sqr(),
                re: r.re,
                im: r.im,
            },
            PolarizedPowers {
                s: over_s.norm_sqr() * t_s,
                p: over_p.norm_sqr() * t_p,
                re: t.re * between,
                im: t.im * between,
            },
        ]
    }
}
