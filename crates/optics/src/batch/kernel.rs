//! One layer, one boundary and one result, on lanes.
//!
//! The equations are those of [`stack`](crate::stack): the tangential field (U, V) is carried from the substrate up by Abelès'
//! characteristic matrix times exp(−Im δ). For a clear layer the matrix has four real or imaginary elements and determinant 1,
//! so that a layer costs ten operations per polarisation beside one sine and cosine for both, nothing is divided, and the
//! transmittance needs no product over the layers. Carrying A/B of the waves that run up and down instead costs fourteen and a
//! product, and loses its digits where q → 0, at a layer's critical angle.

use super::elementary::{decay, sin_cos_half_turns};
use super::lanes::{ComplexLanes, Lanes};
use pulp::Simd;

/// Below this q² stands for 0 (as in [`stack`](crate::stack)).
const LEAST_Q2: f64 = 1e-100;

/// What is known of a medium before the direction is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Index<S: Simd> {
    /// n².
    squared: ComplexLanes<S>,
    /// 1/n².
    inverse: ComplexLanes<S>,
    /// (n − n₀)(n + n₀).
    above: ComplexLanes<S>,
    /// k = 0 in every lane, and then the least of (n − n₀)(n + n₀).
    clear: Option<f64>,
}

impl<S: Simd> Index<S> {
    #[inline(always)]
    pub(super) fn new(n: Lanes<S>, k: Lanes<S>, clear: bool, incident: Lanes<S>) -> Self {
        if clear {
            let squared = n * n;
            let above = (n - incident) * (n + incident);
            return Self {
                squared: ComplexLanes::real(squared),
                inverse: ComplexLanes::real(squared.recip()),
                above: ComplexLanes::real(above),
                clear: Some(above.least()),
            };
        }
        let index = ComplexLanes::new(n, k);
        let squared = index * index;
        let below = ComplexLanes::new(n - incident, k);
        Self {
            squared,
            inverse: squared.recip(),
            above: below * ComplexLanes::new(n + incident, k),
            clear: None,
        }
    }

    /// The medium in light of a direction, given by q₀² = n₀² cos²θ₀ in lanes and as a number, the least of them, and 2/λ.
    #[inline(always)]
    pub(super) fn wave(
        &self,
        q0_squared: Lanes<S>,
        least_q0_squared: f64,
        half_waves_per_nm: Lanes<S>,
    ) -> Wave<S> {
        let q2 = self.above.re + q0_squared;
        if self
            .clear
            .is_some_and(|least| least + least_q0_squared >= 0.0)
        {
            let q = q2.at_least(LEAST_Q2).sqrt();
            let over_q = q.recip();
            return Wave::Clear(Normal {
                q,
                over_q,
                p: q * self.inverse.re,
                over_p: over_q * self.squared.re,
                half_turns_per_nm: q * half_waves_per_nm,
            });
        }
        let (q, over_q) = root(ComplexLanes::new(q2, self.above.im));
        Wave::Lossy(Normal {
            q,
            over_q,
            p: q * self.inverse,
            over_p: over_q * self.squared,
            half_turns_per_nm: q.scale(half_waves_per_nm),
        })
    }
}

/// The root q in the first quadrant of a q² in the upper half plane, and 1/q.
#[inline(always)]
fn root<S: Simd>(q2: ComplexLanes<S>) -> (ComplexLanes<S>, ComplexLanes<S>) {
    let (re, im) = (q2.re, q2.im.abs());
    let size = ComplexLanes::new(re, im).norm_sqr().sqrt();
    let half = re.constant(0.5);
    let large = ((size + re.abs()) * half).at_least(LEAST_Q2).sqrt();
    let small = im * half * large.recip();
    let q = ComplexLanes::new(re.choose(large, small), re.choose(small, large));
    let over_size = q.norm_sqr().recip();
    (q, ComplexLanes::new(q.re * over_size, -(q.im * over_size)))
}

/// A medium in light of one direction.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wave<S: Simd> {
    /// Light runs without loss in every lane.
    Clear(Normal<Lanes<S>>),
    /// Anything: losses, and light that only tunnels.
    Lossy(Normal<ComplexLanes<S>>),
}

/// What the normal component of the wave vector makes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Normal<T> {
    /// η for s: q = n cos θ.
    q: T,
    over_q: T,
    /// η for p: q/n².
    p: T,
    over_p: T,
    /// 2q/λ: the phase δ of a nanometre over π.
    half_turns_per_nm: T,
}

/// The field of one polarisation at a boundary.
#[derive(Clone, Copy, Debug)]
struct Field<S: Simd> {
    u: ComplexLanes<S>,
    v: ComplexLanes<S>,
}

impl<S: Simd> Field<S> {
    #[inline(always)]
    fn leaving(admittance: ComplexLanes<S>) -> Self {
        let u = ComplexLanes::real(admittance.re.constant(1.0));
        Self { u, v: admittance }
    }

    /// U ← cU − i(s/η)V, V ← cV − i(sη)U with real c, s and η.
    #[inline(always)]
    fn lift_clear(self, cos: Lanes<S>, over: Lanes<S>, times: Lanes<S>) -> Self {
        let Self { u, v } = self;
        Self {
            u: ComplexLanes::new(
                over.mul_add(v.im, cos * u.re),
                over.negate_mul_add(v.re, cos * u.im),
            ),
            v: ComplexLanes::new(
                times.mul_add(u.im, cos * v.re),
                times.negate_mul_add(u.re, cos * v.im),
            ),
        }
    }

    #[inline(always)]
    fn lift(self, cos: ComplexLanes<S>, over: ComplexLanes<S>, times: ComplexLanes<S>) -> Self {
        Self {
            u: over.mul_add(self.v, cos * self.u),
            v: times.mul_add(self.u, cos * self.v),
        }
    }

    /// R, and 4η₀ / |η₀U + V|² of which T is made.
    #[inline(always)]
    fn end(self, eta: Lanes<S>) -> (Lanes<S>, Lanes<S>) {
        let Self { u, v } = self;
        let (re, im) = (eta * u.re, eta * u.im);
        let over = ComplexLanes::new(re + v.re, im + v.im).norm_sqr().recip();
        let reflectance = ComplexLanes::new(re - v.re, im - v.im).norm_sqr() * over;
        (reflectance, over * eta * eta.constant(4.0))
    }

    #[inline(always)]
    fn size(self) -> Lanes<S> {
        self.u.norm_sqr() + self.v.norm_sqr()
    }

    #[inline(always)]
    fn scale(self, factor: Lanes<S>) -> Self {
        Self {
            u: self.u.scale(factor),
            v: self.v.scale(factor),
        }
    }
}

/// Both polarisations on their way from the substrate up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep<S: Simd> {
    s: Field<S>,
    p: Field<S>,
    /// |exp(−Σ Im δ)|² and the squares of what the fields were scaled by, for s and p.
    passing_s: Lanes<S>,
    passing_p: Lanes<S>,
    /// Re η of the substrate.
    leaving_s: Lanes<S>,
    leaving_p: Lanes<S>,
}

impl<S: Simd> Sweep<S> {
    #[inline(always)]
    pub(super) fn new(substrate: &Wave<S>) -> Self {
        let (s, p) = match substrate {
            Wave::Clear(normal) => (ComplexLanes::real(normal.q), ComplexLanes::real(normal.p)),
            Wave::Lossy(normal) => (normal.q, normal.p),
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

    #[inline(always)]
    pub(super) fn pass(&mut self, wave: &Wave<S>, thickness_nm: Lanes<S>) {
        match wave {
            Wave::Clear(normal) => self.pass_clear(normal, thickness_nm),
            Wave::Lossy(normal) => self.pass_lossy(normal, thickness_nm),
        }
    }

    #[inline(always)]
    fn pass_clear(&mut self, wave: &Normal<Lanes<S>>, thickness_nm: Lanes<S>) {
        let (sin, cos) = sin_cos_half_turns(wave.half_turns_per_nm * thickness_nm);
        self.s = self.s.lift_clear(cos, sin * wave.over_q, sin * wave.q);
        self.p = self.p.lift_clear(cos, sin * wave.over_p, sin * wave.p);
    }

    #[inline(always)]
    fn pass_lossy(&mut self, wave: &Normal<ComplexLanes<S>>, thickness_nm: Lanes<S>) {
        let half_turns = wave.half_turns_per_nm.scale(thickness_nm);
        let (sin, cos) = sin_cos_half_turns(half_turns.re);
        let (passing, less) = decay(half_turns.im);
        // exp(−b) cosh b and exp(−b) sinh b with b = Im δ.
        let half = cos.constant(0.5);
        let (cosh, sinh) = (half.mul_add(passing, half), half * less);
        let cosine = ComplexLanes::new(cos * cosh, -(sin * sinh));
        let sine = ComplexLanes::new(cos * sinh, -(sin * cosh));
        self.s = self.s.lift(cosine, sine * wave.over_q, sine * wave.q);
        self.p = self.p.lift(cosine, sine * wave.over_p, sine * wave.p);
        self.passing_s = self.passing_s * passing;
        self.passing_p = self.passing_p * passing;
    }

    /// Scales both fields to a size of 1, so that they stay finite in mirrors of thousands of layers.
    #[inline(always)]
    pub(super) fn rescale(&mut self) {
        let over_s = self.s.size().recip();
        self.s = self.s.scale(over_s.sqrt());
        self.passing_s = self.passing_s * over_s;
        let over_p = self.p.size().recip();
        self.p = self.p.scale(over_p.sqrt());
        self.passing_p = self.passing_p * over_p;
    }

    /// R_s, R_p, T_s, T_p, from η of the incident medium.
    #[inline(always)]
    pub(super) fn powers(&self, eta_s: Lanes<S>, eta_p: Lanes<S>) -> [Lanes<S>; 4] {
        let (r_s, over_s) = self.s.end(eta_s);
        let (r_p, over_p) = self.p.end(eta_p);
        [
            r_s,
            r_p,
            over_s * self.passing_s * self.leaving_s,
            over_p * self.passing_p * self.leaving_p,
        ]
    }
}
