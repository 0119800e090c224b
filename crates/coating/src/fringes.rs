//! Colors of films whose fringes are finer than the steps of the CIE's sums.
//!
//! A film of 95 µm has a fringe every half nanometer, and a filter of many layers has a line narrower than that: sums at 1 nm undersample
//! them. Here the weights of a sum are linear between its wavelengths, and each step in which R or T is not smooth is divided in
//! four repeatedly until it is. Where all steps are smooth at 1 nm, the result is the CIE's own sum, digit by digit. At 5 nm
//! the weights contain the lines of a lamp, and the integral is always used.

use crate::response::{Angle, Sampled};
use crate::{Light, View};

/// Maximum number of times that a step is divided in four: into 4096 parts. Finer fringes, in stacks thicker than some 10 mm, are
/// sampled at random phases, but at so many positions that the mean of R and T is right to 1e-3.
const MAX_DIVISIONS: u32 = 6;

/// Position on the grid of a rule, in parts of a step from the start; a step has [`PARTS`] of them.
type Position = u32;

/// Number of parts of a step.
const PARTS: u32 = 4_u32.pow(MAX_DIVISIONS);

/// Largest change between neighbors of the round-trip phase of light through all layers, in radians: a fringe then has at least
/// seven points.
const MAX_PHASE: f64 = 0.9;
/// The same on the grid of the CIE's sums at 1 nm. The sums stay within ΔE₀₀ 0.005 of the integral far beyond this.
const MOST_PHASE_AT_1_NM: f64 = 0.55;
/// One of three second differences belongs to a corner where the other two are below this fraction of it.
const CORNER: f64 = 0.125;
/// Contribution of the fourth difference of a step to X, Y or Z that is negligible, however it compares with the second differences.
const NEGLIGIBLE: f64 = 1e-6;
/// Largest error that a span may add to X, Y or Z.
const ERROR: f64 = 5e-9;
/// Number of indices in memory at a time.
const MAX_INDICES: usize = 1 << 21;

/// A film at an angle, for the integration of its color.
pub(crate) struct Fringes<'a> {
    pub(crate) light: &'a Light,
    pub(crate) view: View,
    /// The film at every nm from the first wavelength of the light's sums to the last.
    pub(crate) fine: &'a Sampled,
    /// The largest index of each layer there.
    pub(crate) largest: &'a [f64],
    pub(crate) thicknesses_nm: &'a [f64],
    pub(crate) angle: Angle,
}

/// A part of a step with R or T at its ends.
struct Span {
    start: Position,
    length: u32,
    ends: [f64; 2],
}

/// R or T at a position, and its weight in the sum.
struct Node {
    position: Position,
    weight: [f64; 3],
    share: f64,
}

/// The positions and weights of the sum for a color.
pub(crate) struct Places {
    pub(crate) sampled: Sampled,
    pub(crate) weights: Vec<[f64; 3]>,
}

impl Fringes<'_> {
    /// Returns XYZ, given R or T at the wavelengths of the light's sums.
    pub(crate) fn xyz(&self, values: &[f64]) -> [f64; 3] {
        let mut xyz = self.light.xyz(values.iter().copied());
        self.integrate(values, |node| add(&mut xyz, node.weight, node.share));
        xyz
    }

    /// Returns the positions that [`Self::xyz`] sums over, for sums of other quantities of the same stack.
    pub(crate) fn positions(&self, values: &[f64]) -> Places {
        let own = (0..).step_by(PARTS as usize);
        let mut positions: Vec<_> = own
            .zip(self.light.per_wavelength().iter().copied())
            .collect();
        self.integrate(values, |node| positions.push((node.position, node.weight)));
        positions.sort_by_key(|&(position, _)| position);
        positions.dedup_by(|next, kept| {
            let is_same = next.0 == kept.0;
            if is_same {
                add(&mut kept.1, next.1, 1.0);
            }
            is_same
        });
        let (positions, weights): (Vec<Position>, _) = positions.into_iter().unzip();
        Places {
            sampled: self.sampled(&positions),
            weights,
        }
    }

    /// Calls `node` with what turns the CIE's sum into the integral: nothing at 1 nm where all steps are smooth.
    fn integrate(&self, values: &[f64], mut node: impl FnMut(Node)) {
        let is_rough = self.rough_steps(values);
        if self.light.step_nm() == 1.0 && !is_rough.contains(&true) {
            return;
        }
        let mut open = Vec::new();
        for (step, &is_rough) in is_rough.iter().enumerate() {
            if is_rough {
                open.push(Span::of_step(step, values));
            }
            self.corrections(step, is_rough, values).for_each(&mut node);
        }
        while !open.is_empty() {
            let inner: Vec<Position> = open.iter().flat_map(Span::inner).collect();
            let found = self.values(&inner);
            let mut rough = Vec::new();
            for (span, inner) in open.iter().zip(found.chunks_exact(3)) {
                let values = [span.ends[0], inner[0], inner[1], inner[2], span.ends[1]];
                if span.length > 4 && !self.is_smooth(span, &values) {
                    rough.extend(span.quarters(&values));
                } else {
                    self.nodes(span, &values).into_iter().for_each(&mut node);
                }
            }
            open = rough;
        }
    }

    /// Returns for each step of the rule whether R or T is not smooth in it.
    fn rough_steps(&self, values: &[f64]) -> Vec<bool> {
        let Some(last) = values.len().checked_sub(5) else {
            return Vec::new();
        };
        let is_thin = self.most_phase() <= MOST_PHASE_AT_1_NM;
        let is_rough = |step: usize| {
            let around = step.saturating_sub(2).min(last);
            let five = std::array::from_fn(|i| values[around + i]);
            let is_thick = || self.phase(step as u32 * PARTS, PARTS) > MOST_PHASE_AT_1_NM;
            !is_thin && is_thick() || self.is_bent(step, &five)
        };
        let rough: Vec<bool> = (0..values.len()).map(is_rough).collect();
        rough.windows(2).map(|ends| ends[0] || ends[1]).collect()
    }

    /// Corrections of the CIE's sum over a step, half of the products at both ends, toward the integral over it. For a rough step they
    /// remove the sum. For a smooth one, with linear weights w and R of third order, they add −(w₁ − w₀)(R₁ − R₀)/6 −
    /// (w₀ + w₁)(R₋₁ − R₀ − R₁ + R₂)/48.
    fn corrections(
        &self,
        step: usize,
        is_rough: bool,
        values: &[f64],
    ) -> impl Iterator<Item = Node> {
        let weights = self.light.per_wavelength();
        let mut added = [[0.0; 3]; 4];
        for i in 0..3 {
            let [w0, w1] = [step, step + 1].map(|at| weights[at][i]);
            let (linear, bent) = ((w1 - w0) / 6.0, (w0 + w1) / 48.0);
            let of_ends = if is_rough {
                [0.0, -0.5 * w0, -0.5 * w1, 0.0]
            } else if step == 0 || step + 2 == values.len() {
                [0.0, linear, -linear, 0.0]
            } else {
                [-bent, linear + bent, bent - linear, -bent]
            };
            for (added, weight) in added.iter_mut().zip(of_ends) {
                added[i] = weight;
            }
        }
        let around = [
            step.saturating_sub(1),
            step,
            step + 1,
            (step + 2).min(values.len() - 1),
        ];
        let values = around.map(|at| (at as u32 * PARTS, values[at]));
        values
            .into_iter()
            .zip(added)
            .map(|((position, share), weight)| Node {
                position,
                weight,
                share,
            })
    }

    /// The five nodes of a span by Boole's rule.
    fn nodes(&self, span: &Span, values: &[f64; 5]) -> [Node; 5] {
        const BOOLE: [f64; 5] = [
            7.0 / 90.0,
            32.0 / 90.0,
            12.0 / 90.0,
            32.0 / 90.0,
            7.0 / 90.0,
        ];
        let width = f64::from(span.length) / f64::from(PARTS);
        [0, 1, 2, 3, 4].map(|quarter: usize| {
            let position = span.start + quarter as u32 * (span.length / 4);
            Node {
                position,
                weight: self.weight(position).map(|w| w * width * BOOLE[quarter]),
                share: values[quarter],
            }
        })
    }

    /// Returns whether Boole's rule is accurate over a span: it differs from Simpson's by 1/180 of the fourth difference.
    fn is_smooth(&self, span: &Span, values: &[f64; 5]) -> bool {
        let width = f64::from(span.length) / f64::from(PARTS);
        let (_, fourth) = differences(values);
        self.phase(span.start, span.length / 4) <= MAX_PHASE
            && self.largest_weight(span.start) * width * fourth / 180.0 <= ERROR
    }

    /// Returns whether the fourth difference of five neighbors on the grid of the sums matters. For a fringe whose phase changes by φ
    /// between neighbors, it is 4 sin²(φ/2) times the second differences. A corner in the table of an index shows in only one of
    /// those, and costs the sum no accuracy.
    fn is_bent(&self, step: usize, values: &[f64; 5]) -> bool {
        let (second, fourth) = differences(values);
        let [x, y, z] = self.light.per_wavelength()[step];
        if x.max(y).max(z) * fourth <= NEGLIGIBLE {
            return false;
        }
        let mut sizes = second.map(f64::abs);
        sizes.sort_by(f64::total_cmp);
        let [_, middle, largest] = sizes;
        let is_corner = middle < CORNER * largest;
        !is_corner && fourth > MOST_PHASE_AT_1_NM.powi(2) * largest
    }

    fn largest_weight(&self, position: Position) -> f64 {
        self.weight(position).into_iter().fold(0.0, f64::max)
    }

    /// Change of the round-trip phase of light through all layers over a number of parts of a step.
    fn phase(&self, position: Position, parts: u32) -> f64 {
        let (step, _) = self.fine_step(position);
        let optical: f64 = self
            .fine
            .layers()
            .iter()
            .zip(self.thicknesses_nm)
            .map(|(indices, d)| indices[step].re * d)
            .sum();
        let nm = self.nm(position);
        let width = self.light.step_nm() * f64::from(parts) / f64::from(PARTS);
        4.0 * std::f64::consts::PI * optical / (nm * nm) * width
    }

    /// Upper bound of [`Self::phase`] over a step.
    fn most_phase(&self) -> f64 {
        let optical: f64 = self
            .largest
            .iter()
            .zip(self.thicknesses_nm)
            .map(|(n, d)| n * d)
            .sum();
        let shortest = self.nm(0);
        4.0 * std::f64::consts::PI * optical / (shortest * shortest) * self.light.step_nm()
    }

    /// R or T at positions between the wavelengths of the sums.
    fn values(&self, positions: &[Position]) -> Vec<f64> {
        let at_once = (MAX_INDICES / (self.thicknesses_nm.len() + 1)).max(256);
        let mut values = Vec::with_capacity(positions.len());
        for positions in positions.chunks(at_once) {
            let set = [self.thicknesses_nm.to_vec()];
            let powers = self.sampled(positions).powers_of_all(&set, &[self.angle]);
            let seen = powers
                .iter()
                .map(|powers| self.view.of(powers.reflectance, powers.transmittance));
            values.extend(seen);
        }
        values
    }

    fn sampled(&self, positions: &[Position]) -> Sampled {
        let fine = |&position| (self.nm(position), self.fine_step(position));
        self.fine.between(positions.iter().map(fine))
    }

    /// The wavelength of a position.
    fn nm(&self, position: Position) -> f64 {
        let first = self.fine.wavelengths_nm().first().copied();
        first.unwrap_or_default() + f64::from(position) / f64::from(PARTS) * self.light.step_nm()
    }

    /// Returns the whole nm before a position, counted from the first, and the fraction of the way to the next.
    fn fine_step(&self, position: Position) -> (usize, f64) {
        let along = f64::from(position) / f64::from(PARTS) * self.light.step_nm();
        let step = (along as usize).min(self.fine.wavelengths_nm().len().saturating_sub(2));
        (step, along - step as f64)
    }

    /// The weights of the light's sums, interpolated linearly between their wavelengths.
    fn weight(&self, position: Position) -> [f64; 3] {
        let weights = self.light.per_wavelength();
        let step = ((position / PARTS) as usize).min(weights.len().saturating_sub(2));
        let along = f64::from(position) / f64::from(PARTS) - step as f64;
        std::array::from_fn(|i| weights[step][i] * (1.0 - along) + weights[step + 1][i] * along)
    }
}

impl Span {
    fn of_step(step: usize, values: &[f64]) -> Self {
        Self {
            start: step as u32 * PARTS,
            length: PARTS,
            ends: [values[step], values[step + 1]],
        }
    }

    /// The positions at one, two and three quarters of the span.
    fn inner(&self) -> [Position; 3] {
        [1, 2, 3].map(|quarter| self.start + quarter * (self.length / 4))
    }

    fn quarters(&self, values: &[f64; 5]) -> [Self; 4] {
        let length = self.length / 4;
        [0, 1, 2, 3].map(|quarter: usize| Self {
            start: self.start + quarter as u32 * length,
            length,
            ends: [values[quarter], values[quarter + 1]],
        })
    }
}

/// Returns the second differences of five values, and the magnitude of the fourth.
fn differences([a, b, c, d, e]: &[f64; 5]) -> ([f64; 3], f64) {
    let second = [a - 2.0 * b + c, b - 2.0 * c + d, c - 2.0 * d + e];
    let fourth = second[0] - 2.0 * second[1] + second[2];
    (second, fourth.abs())
}

fn add(sum: &mut [f64; 3], weight: [f64; 3], share: f64) {
    for (sum, weight) in sum.iter_mut().zip(weight) {
        *sum += weight * share;
    }
}
