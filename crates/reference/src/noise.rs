//! Gradient noise, and the streaks that a flow makes of it.

use crate::random::{pcg4d, unit_interval};
use glam::DVec3;
use scene::{Shape, Swirls};

/// Number of steps of the flow that carries the streaks.
const WARP_STEPS: u32 = 3;
/// Gain before the noise is bounded: the root mean square of the noise is about a fifth.
const GAIN: f64 = 5.0;
/// Offset of the seed that separates the noise of the stream function from the noise of the streaks.
const STREAM: u32 = 0x9e37_79b9;

/// Noise and its gradient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// The value, within ±1.5.
    pub value: f64,
    /// The derivatives.
    pub gradient: DVec3,
}

/// Returns gradient noise with a quintic blend (Perlin, Improving Noise, 2002): at each point of the integer lattice it is 0 and
/// has a gradient drawn from the cube [−1, 1)³. `cells` is added to the third coordinate of the lattice, and `seed` selects the
/// gradients.
pub fn gradient_noise(place: DVec3, cells: u32, seed: u32) -> Noise {
    let floor = place.floor();
    let within = place - floor;
    let [x, y, z] = floor.to_array().map(|c| c as i32 as u32);
    let corner = [x, y, z.wrapping_add(cells)];
    let mut sum = Noise {
        value: 0.0,
        gradient: DVec3::ZERO,
    };
    for index in 0..8 {
        let step = [index & 1, (index >> 1) & 1, index >> 2];
        let side = DVec3::from_array(step.map(f64::from));
        let slope = lattice_gradient(
            std::array::from_fn(|i| corner[i].wrapping_add(step[i])),
            seed,
        );
        let distance = within - side;
        // Distance from the corner along each axis, in [0, 1]; its blend falls from 1 to 0.
        let away = distance.abs();
        let weights = away.to_array().map(blend);
        let falls = away
            .to_array()
            .map(|t| -30.0 * t * t * (1.0 - t) * (1.0 - t));
        let signs = DVec3::ONE - 2.0 * side;
        let weight = weights[0] * weights[1] * weights[2];
        let weight_gradient = signs
            * DVec3::new(
                falls[0] * weights[1] * weights[2],
                weights[0] * falls[1] * weights[2],
                weights[0] * weights[1] * falls[2],
            );
        let ramp = slope.dot(distance);
        sum.value += weight * ramp;
        sum.gradient += weight * slope + weight_gradient * ramp;
    }
    sum
}

/// Returns 1 − (6t⁵ − 15t⁴ + 10t³).
fn blend(t: f64) -> f64 {
    1.0 - t * t * t * (t * (6.0 * t - 15.0) + 10.0)
}

fn lattice_gradient([x, y, z]: [u32; 3], seed: u32) -> DVec3 {
    let [u, v, w, _] = unit_interval(pcg4d([x, y, z, seed]));
    2.0 * DVec3::new(u, v, w) - 1.0
}

/// Returns the value of swirls at a point of a surface.
pub fn swirls(swirls: &Swirls, shape: &Shape, position: DVec3) -> f64 {
    let time = swirls.phase * DVec3::Z;
    let size = swirls.cells_per_unit;
    let is_sphere = matches!(shape, Shape::Sphere { .. });
    let (mut place, mut normal) = match *shape {
        Shape::Sphere { center, .. } => {
            let normal = (position - center).normalize();
            (size * normal, normal)
        }
        Shape::Plane {
            point: origin,
            tangent,
            bitangent,
            ..
        }
        | Shape::Rectangle {
            center: origin,
            tangent,
            bitangent,
            ..
        }
        | Shape::Disk {
            center: origin,
            tangent,
            bitangent,
            ..
        } => {
            let local = position - origin;
            let across = DVec3::new(local.dot(tangent), local.dot(bitangent), 0.0);
            (size * across, DVec3::Z)
        }
    };
    for _ in 0..WARP_STEPS {
        let stream = gradient_noise(place + time, swirls.cells, swirls.seed ^ STREAM);
        // n × ∇ψ runs along the lines of equal ψ, so the flow is free of divergence on the surface.
        let moved = place - swirls.warp / f64::from(WARP_STEPS) * normal.cross(stream.gradient);
        place = moved;
        if is_sphere {
            normal = moved.normalize();
            place = size * normal;
        }
    }
    swirls.mean + swirls.amplitude * bounded(GAIN * octaves(swirls, place, time))
}

/// Returns x / √(1 + x²): bounded by ±1 and smooth.
fn bounded(x: f64) -> f64 {
    x / (1.0 + x * x).sqrt()
}

fn octaves(swirls: &Swirls, place: DVec3, time: DVec3) -> f64 {
    (0..swirls.octaves)
        .map(|octave| {
            let finer = f64::from(1_u32 << octave);
            let seed = swirls.seed.wrapping_add(octave);
            gradient_noise(finer * place + time, swirls.cells, seed).value / finer
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The gradient agrees with central differences, and neither it nor the value jumps where cells meet.
    #[test]
    fn the_gradient_is_the_derivative() {
        let step = 1e-5;
        for i in 0..300 {
            let t = f64::from(i);
            let place = DVec3::new(
                (0.7 * t).sin() * 9.0,
                (1.3 * t).cos() * 7.0,
                f64::from(i % 7) - 3.0,
            );
            let at = |offset: DVec3| gradient_noise(place + offset, 11, 5).value;
            let found = gradient_noise(place, 11, 5).gradient;
            let axes = [DVec3::X, DVec3::Y, DVec3::Z];
            let expected = axes.map(|a| (at(step * a) - at(-step * a)) / (2.0 * step));
            assert!(
                (found - DVec3::from_array(expected)).length() < 1e-7,
                "{place}"
            );
        }
    }

    /// The flow is free of divergence: ∇·(n × ∇ψ) by central differences on a plane.
    #[test]
    fn the_flow_has_no_sources() {
        let step = 1e-5;
        let flow =
            |x: f64, y: f64| DVec3::Z.cross(gradient_noise(DVec3::new(x, y, 0.3), 0, 1).gradient);
        for i in 0..200 {
            let (x, y) = (f64::from(i) * 0.37, f64::from(i) * 0.21);
            let sources = (flow(x + step, y).x - flow(x - step, y).x + flow(x, y + step).y
                - flow(x, y - step).y)
                / (2.0 * step);
            let strength = (flow(x + step, y) - flow(x - step, y)).length() / (2.0 * step);
            assert!(sources.abs() < 1e-8 + 1e-8 * strength, "{sources}");
        }
    }

    /// The values stay within the bound, both signs alike, and half of all positions are beyond about half of it, as documented.
    #[test]
    fn the_amplitude_is_a_bound_that_is_used() {
        let plane = Shape::Plane {
            point: DVec3::ZERO,
            normal: DVec3::Z,
            tangent: DVec3::X,
            bitangent: DVec3::Y,
        };
        for octaves in [1, 3, 6] {
            let field = Swirls {
                mean: 0.0,
                amplitude: 1.0,
                cells_per_unit: 1.0,
                seed: 3,
                octaves,
                warp: 1.0,
                cells: 0,
                phase: 0.25,
            };
            let found: Vec<f64> = (0..40_000)
                .map(|i| {
                    swirls(
                        &field,
                        &plane,
                        DVec3::new(f64::from(i % 200) * 0.37, f64::from(i / 200) * 0.41, 0.0),
                    )
                })
                .collect();
            let mean = found.iter().sum::<f64>() / 40_000.0;
            assert!(mean.abs() < 0.03, "{mean}");
            let mut found: Vec<f64> = found.into_iter().map(f64::abs).collect();
            found.sort_by(f64::total_cmp);
            assert!(found[39_999] < 1.0);
            assert!(
                (0.4..0.65).contains(&found[20_000]),
                "{octaves}: {}",
                found[20_000]
            );
        }
    }
}
