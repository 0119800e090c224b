//! Gravity drainage of a soap film with rigid surfaces.
//!
//! The flux through a film of thickness h between two surfaces that do not move is K h³ sin β with K = ρ g / (12 η), where β is the slope
//! (Reynolds 1886; Mysels, Shinoda and Frankel, Soap Films, 1959). Conservation of volume on a sphere of radius R is
//!
//! ∂h/∂t + 1 / (R sin θ) ∂/∂θ (sin²θ K h³) = 0.
//!
//! Along its characteristics dθ/dt = 3 K h² sin θ / R, the product h sin^(2/3) θ is constant. From h = h₀ everywhere, with τ = 3 K h₀² t /
//! R and I(θ) = ∫₀^θ sin^(1/3) u du, the characteristic that began at θ₀ is, at time t, at the θ with
//!
//! I(θ) = I(θ₀) + τ sin^(4/3) θ₀, and h = h₀ (sin θ₀ / sin θ)^(2/3) there.
//!
//! Exactly one characteristic reaches every θ < π. At the top h⁻² = h₀⁻² + 4 K t / R. At late times h² = R / (3 K t) sin^(−4/3) θ I(θ), the
//! similarity solution of Takagi and Huppert (J. Fluid Mech. 647, 221, 2010) for the outside of a sphere. At the bottom the solution ends
//! at τ = 3/4: the liquid that arrives there gathers in a drop.

use std::f64::consts::{FRAC_PI_2, PI};

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.806_65;
/// Number of panels of the quadrature.
const PANELS: u32 = 16;

/// A liquid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Liquid {
    pub(crate) viscosity_pa_s: f64,
    pub(crate) density_kg_m3: f64,
}

impl Liquid {
    /// 3 K t / `length_m`, in 1/nm²: 1/h² of a film that has drained along this length to its similarity shape.
    pub(crate) fn thinning(self, time_s: f64, length_m: f64) -> f64 {
        let k = self.density_kg_m3 * GRAVITY / (12.0 * self.viscosity_pa_s);
        3.0 * k * time_s / length_m * 1e-18
    }
}

/// (h / h₀)² on a sphere at a polar angle from the top, at time τ; `f64::INFINITY` at the bottom from τ = 3/4 on.
pub(crate) fn sphere_profile2(theta: f64, tau: f64) -> f64 {
    if theta <= 0.0 {
        return 1.0 / (1.0 + 4.0 / 3.0 * tau);
    }
    if theta >= PI {
        let left = 1.0 - 4.0 / 3.0 * tau;
        return if left > 0.0 {
            1.0 / left
        } else {
            f64::INFINITY
        };
    }
    let sine = sphere_start(theta, tau).sin();
    (sine / theta.sin()).powf(4.0 / 3.0)
}

/// The start of the characteristic that is at `theta` at time τ: by Newton's method, or bisection if a step leaves the bracket. The arrival
/// increases with the start up to the solution.
fn sphere_start(theta: f64, tau: f64) -> f64 {
    let wanted = sine_integral(theta);
    let (mut low, mut high) = (0.0, theta);
    // Near the top, where I = 3/4 θ^(4/3), this is the exact solution.
    let mut start = theta * (0.75 / (0.75 + tau)).powf(0.75);
    for _ in 0..60 {
        let root = start.sin().cbrt();
        let excess = sine_integral(start) + tau * root.powi(4) - wanted;
        if excess.abs() <= 1e-14 * wanted {
            break;
        }
        if excess < 0.0 {
            low = start;
        } else {
            high = start;
        }
        let next = start - excess / (root * (1.0 + 4.0 / 3.0 * tau * start.cos()));
        start = if low < next && next < high {
            next
        } else {
            f64::midpoint(low, high)
        };
    }
    start
}

/// I(θ) = ∫₀^θ sin^(1/3) u du for θ in \[0, π\], to 1e-9.
fn sine_integral(theta: f64) -> f64 {
    if theta > FRAC_PI_2 {
        return 2.0 * sine_integral(FRAC_PI_2) - sine_integral(PI - theta);
    }
    // With u = v³ the integrand 3 v² sin^(1/3) v³ is smooth; Boole's rule.
    let step = theta.cbrt() / f64::from(4 * PANELS);
    let integrand = |i: u32| {
        let v = f64::from(i) * step;
        3.0 * v * v * (v * v * v).sin().cbrt()
    };
    let panel = |i: u32| {
        let ends = integrand(i) + integrand(i + 4);
        let between = integrand(i + 1) + integrand(i + 3);
        7.0 * ends + 32.0 * between + 12.0 * integrand(i + 2)
    };
    let sum: f64 = (0..PANELS).map(|i| panel(4 * i)).sum();
    2.0 / 45.0 * step * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// I(π) = √π Γ(2/3) / Γ(7/6) = 2.587 109 559 (Gradshteyn and Ryzhik, 3.621.1 with 8.384.1).
    #[test]
    fn the_integral_is_the_tabulated_one() {
        assert!(
            (sine_integral(PI) - 2.587_109_559).abs() < 2e-9,
            "{}",
            sine_integral(PI)
        );
        let small = 1e-4_f64;
        let leading = 0.75 * small.powf(4.0 / 3.0);
        assert!((sine_integral(small) / leading - 1.0).abs() < 1e-8);
    }

    #[test]
    fn the_limits_are_those_of_the_equation() {
        for tau in [0.0, 0.1, 1.0, 30.0] {
            let pole = sphere_profile2(0.0, tau);
            assert!(
                (sphere_profile2(1e-5, tau) / pole - 1.0).abs() < 1e-6,
                "{tau}"
            );
        }
        for theta in [0.3, 1.0, 2.0, 3.0] {
            assert!((sphere_profile2(theta, 0.0) - 1.0).abs() < 1e-12);
            // Late: the similarity solution.
            let tau = 1e7;
            let similar = sine_integral(theta) / (tau * theta.sin().powf(4.0 / 3.0));
            assert!(
                (sphere_profile2(theta, tau) / similar - 1.0).abs() < 1e-4,
                "{theta}"
            );
        }
        assert!((sphere_profile2(PI - 1e-6, 0.3) - sphere_profile2(PI, 0.3)).abs() < 1e-3);
        assert_eq!(sphere_profile2(PI, 0.75), f64::INFINITY);
    }

    /// The differential equation itself, by central differences. With H = h/h₀ and τ it is 3 ∂H/∂τ + 1/sin θ ∂/∂θ (sin²θ H³) = 0.
    #[test]
    fn the_equation_holds_everywhere() {
        let h = |theta: f64, tau: f64| sphere_profile2(theta, tau).sqrt();
        let flux = |theta: f64, tau: f64| theta.sin().powi(2) * h(theta, tau).powi(3);
        let step = 1e-4;
        for theta in [0.05, 0.4, 1.0, 1.6, 2.2, 2.8, 3.05] {
            for tau in [0.05, 0.5, 0.74, 2.0, 20.0] {
                let rate =
                    (h(theta, tau + step * tau) - h(theta, tau - step * tau)) / (2.0 * step * tau);
                let outflow = (flux(theta + step, tau) - flux(theta - step, tau))
                    / (2.0 * step * theta.sin());
                let size = 3.0 * rate.abs() + outflow.abs();
                assert!(
                    (3.0 * rate + outflow).abs() < 1e-4 * size,
                    "{theta} {tau}: {rate} {outflow}"
                );
            }
        }
    }

    /// An independent method: first-order upwind finite volumes, which conserve the liquid to rounding.
    #[test]
    fn finite_volumes_come_to_the_same_thickness() {
        const CELLS: usize = 1000;
        const END: f64 = 2.0;
        let width = PI / CELLS as f64;
        let edge = |i: usize| i as f64 * width;
        let area: Vec<f64> = (0..CELLS)
            .map(|i| edge(i).cos() - edge(i + 1).cos())
            .collect();
        let mut h = vec![1.0_f64; CELLS];
        let (mut tau, mut gathered) = (0.0, 0.0);
        while tau < END {
            // Liquid that leaves through the bottom cells joins the drop and no longer belongs to the film.
            let fastest = h[..CELLS - CELLS / 50]
                .iter()
                .fold(0.0_f64, |a, &b| a.max(b));
            let step = (0.4 * width / (fastest * fastest)).min(END - tau);
            let flux: Vec<f64> = (0..CELLS)
                .map(|i| edge(i + 1).sin().powi(2) * h[i].powi(3) / 3.0)
                .collect();
            for i in 0..CELLS - CELLS / 50 {
                let inflow = if i == 0 { 0.0 } else { flux[i - 1] };
                h[i] += step * (inflow - flux[i]) / area[i];
            }
            gathered += step * flux[CELLS - CELLS / 50 - 1];
            tau += step;
        }
        let kept: f64 = h[..CELLS - CELLS / 50]
            .iter()
            .zip(&area)
            .map(|(h, a)| h * a)
            .sum();
        let whole: f64 = area[..CELLS - CELLS / 50].iter().sum();
        assert!(
            (kept + gathered - whole).abs() < 1e-9,
            "{kept} + {gathered} of {whole}"
        );
        for theta in [0.2, 0.7, 1.2, 1.8, 2.4, 2.9] {
            let cell = (theta / width) as usize;
            let exact = sphere_profile2((cell as f64 + 0.5) * width, END).sqrt();
            assert!(
                (h[cell] / exact - 1.0).abs() < 8e-3,
                "{theta}: {} {exact}",
                h[cell]
            );
        }
    }

    /// Jeffreys 1930: water after 100 s, 1 cm below the edge: √(4 η z / (ρ g t)) = 6.397 µm.
    #[test]
    fn a_vertical_film_has_the_thickness_of_jeffreys() {
        let water = Liquid {
            viscosity_pa_s: 1.002e-3,
            density_kg_m3: 998.2,
        };
        let nm = water.thinning(100.0, 0.01).powf(-0.5);
        let jeffreys: f64 = 4.0 * 1.002e-3 * 0.01 / (998.2 * 9.806_65 * 100.0);
        assert!((nm - 1e9 * jeffreys.sqrt()).abs() < 1e-6, "{nm}");
        assert!((nm - 6398.7).abs() < 1.0, "{nm}");
    }
}
