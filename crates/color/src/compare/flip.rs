//! FLIP: how different two pictures look when a viewer flips between them, from 0 (identical) to 1.
//!
//! LDR-FLIP of Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, FLIP: A Difference Evaluator for
//! Alternating Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020; the constants are those of the paper. Arithmetic is
//! `f64`. All its filters are sums of products of a function of x and one of y, and are applied as separable filters.

use std::f64::consts::PI;

use colorimetry::srgb::{linear_from_xyz, xyz_from_linear};
use rayon::prelude::*;

use super::{CompareError, Picture};

/// Pixels per degree of a 0.7 m wide screen of 3840 pixels seen from 0.7 m, the paper's default.
const PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;

/// Returns the difference at each pixel, ΔE_c^(1 − ΔE_f), of color and features (equation 15 of the paper). Colors outside the
/// display's gamut are clipped, and NaN is black.
///
/// # Errors
/// When the pictures differ in size or are empty.
pub fn flip(reference: &Picture, test: &Picture) -> Result<Vec<f64>, CompareError> {
    reference.check_alike(test)?;
    let size = reference.size();
    // One picture after the other: the planes of both at once would take half as much memory again.
    let [(a, features_a), (b, features_b)] = [reference, test].map(|picture| {
        let planes = opponent_planes(picture);
        let seen = as_seen(&planes, size);
        let [y, chroma @ ..] = planes;
        drop(chroma);
        (seen, features(&y, size))
    });
    let at = |i: usize| {
        let color = redistributed(hyab(a[i], b[i]).powf(0.7));
        let edge = (features_a[i][0] - features_b[i][0]).abs();
        let point = (features_a[i][1] - features_b[i][1]).abs();
        let feature = (edge.max(point) / 2.0_f64.sqrt()).sqrt();
        color.powf(1.0 - feature)
    };
    let pixels = reference.linear().len();
    Ok((0..pixels).into_par_iter().map(at).collect())
}

/// XYZ relative to the display's white.
fn relative_xyz(linear: [f64; 3]) -> [f64; 3] {
    let (xyz, white) = (xyz_from_linear(linear), xyz_from_linear([1.0; 3]));
    [xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2]]
}

/// The planes Y, Cx and Cz of a linearized L*a*b* (section 4.1.1).
fn opponent_planes(picture: &Picture) -> [Vec<f64>; 3] {
    let pixels: Vec<[f64; 3]> = picture
        .shown()
        .map(|linear| {
            let [x, y, z] = relative_xyz(linear);
            [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
        })
        .collect();
    std::array::from_fn(|plane| pixels.iter().map(|p| p[plane]).collect())
}

/// A filter over 2 · radius + 1 pixels: a function of the distance along one axis.
type Filter = Vec<f64>;

fn filter(radius: i32, weight: impl Fn(f64) -> f64) -> Filter {
    (-radius..=radius).map(|x| weight(f64::from(x))).collect()
}

/// Scales a filter so that its positive weights add up to 1 and its negative ones to −1.
fn balanced(mut filter: Filter) -> Filter {
    let positive: f64 = filter.iter().filter(|&&w| w > 0.0).sum();
    let negative: f64 = filter.iter().filter(|&&w| w < 0.0).sum();
    for w in &mut filter {
        *w /= if *w > 0.0 { positive } else { -negative };
    }
    filter
}

/// Filters a plane along x, then along y; the border values continue outside the plane.
fn filtered(
    plane: &[f64],
    [width, height]: [usize; 2],
    along_x: &Filter,
    along_y: &Filter,
) -> Vec<f64> {
    let radius = along_x.len() / 2;
    let mut across = vec![0.0; plane.len()];
    let rows = across.par_chunks_mut(width).zip(plane.par_chunks(width));
    rows.for_each(|(out, row)| {
        let mut padded = vec![row[0]; radius];
        padded.extend_from_slice(row);
        padded.resize(width + 2 * radius, row[width - 1]);
        for (offset, weight) in along_x.iter().enumerate() {
            add_times(out, &padded[offset..offset + width], *weight);
        }
    });
    let radius = along_y.len() / 2;
    let mut down = vec![0.0; plane.len()];
    down.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
        for (offset, weight) in along_y.iter().enumerate() {
            let from = (y + offset).saturating_sub(radius).min(height - 1);
            add_times(out, &across[from * width..(from + 1) * width], *weight);
        }
    });
    down
}

fn add_times(out: &mut [f64], values: &[f64], weight: f64) {
    for (out, value) in out.iter_mut().zip(values) {
        *out += weight * value;
    }
}

/// Filters a plane with a contrast sensitivity that is a sum of two Gaussians a √(π/b) exp(−π² r²/b), r in degrees (table 1,
/// equation 3). The weights add up to 1.
fn sensed(plane: &[f64], size: [usize; 2], terms: [(f64, f64); 2]) -> Vec<f64> {
    // Three standard deviations of the widest Gaussian: b = 0.04.
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
    let gauss = |b: f64| {
        filter(radius, |x| {
            (-PI * PI * x * x / (PIXELS_PER_DEGREE * PIXELS_PER_DEGREE) / b).exp()
        })
    };
    let amount = |(a, b): (f64, f64)| a * (PI / b).sqrt();
    let volume = |(_, b): (f64, f64)| gauss(b).iter().sum::<f64>().powi(2);
    let total: f64 = terms
        .into_iter()
        .map(|term| amount(term) * volume(term))
        .sum();
    let mut sum = vec![0.0; plane.len()];
    for term in terms.into_iter().filter(|term| term.0 > 0.0) {
        let along = gauss(term.1);
        add_times(
            &mut sum,
            &filtered(plane, size, &along, &along),
            amount(term) / total,
        );
    }
    sum
}

/// The picture blurred as the eye blurs it, in L*a*b* with Hunt's adjustment (sections 4.1.1 and 4.1.2).
fn as_seen(planes: &[Vec<f64>; 3], size: [usize; 2]) -> Vec<[f64; 3]> {
    let sensitivities = [
        [(1.0, 0.0047), (0.0, 1e-5)],
        [(1.0, 0.0053), (0.0, 1e-5)],
        [(34.1, 0.04), (13.5, 0.025)],
    ];
    let [y, cx, cz] = std::array::from_fn(|i| sensed(&planes[i], size, sensitivities[i]));
    (0..y.len())
        .into_par_iter()
        .map(|i| hunt_lab(linear_of_opponents([y[i], cx[i], cz[i]])))
        .collect()
}

/// Linear sRGB, clipped to the display.
fn linear_of_opponents([y, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (y + 16.0) / 116.0;
    let white = xyz_from_linear([1.0; 3]);
    let xyz = [
        (y + cx / 500.0) * white[0],
        y * white[1],
        (y - cz / 200.0) * white[2],
    ];
    linear_from_xyz(xyz).map(|v| v.clamp(0.0, 1.0))
}

/// CIE L*a*b*, a* and b* times L*/100: colors of dark pixels count less (equation 7).
fn hunt_lab(linear: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let [x, y, z] = relative_xyz(linear).map(|t| {
        if t > DELTA.powi(3) {
            t.cbrt()
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    });
    let lightness = 116.0 * y - 16.0;
    [
        lightness,
        5.0 * lightness * (x - y),
        2.0 * lightness * (y - z),
    ]
}

/// |ΔL*| + √(Δa*² + Δb*²) (equation 8).
fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// Differences up to 0.4 of the largest (green to blue) use 0.95 of the scale (section 4.1.4).
fn redistributed(difference: f64) -> f64 {
    let largest = hyab(hunt_lab([0.0, 1.0, 0.0]), hunt_lab([0.0, 0.0, 1.0])).powf(0.7);
    let knee = 0.4 * largest;
    if difference < knee {
        0.95 * difference / knee
    } else {
        0.95 + 0.05 * (difference - knee) / (largest - knee)
    }
}

/// Returns the strength of edges and of points at each pixel of the plane Y (section 4.2).
fn features(y: &[f64], size: [usize; 2]) -> Vec<[f64; 2]> {
    let lightness: Vec<f64> = y.iter().map(|y| (y + 16.0) / 116.0).collect();
    // Half of a feature's width of 0.082°.
    let deviation = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    let radius = (3.0 * deviation).ceil() as i32;
    let gauss = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
    // Along the other axis all weights are positive, so `balanced` makes them add up to 1.
    let smooth = balanced(filter(radius, gauss));
    let edge = balanced(filter(radius, |x| -x * gauss(x)));
    let point = balanced(filter(radius, |x| {
        (x * x / (deviation * deviation) - 1.0) * gauss(x)
    }));
    let strength = |derivative: &Filter| -> Vec<f64> {
        let across = filtered(&lightness, size, derivative, &smooth);
        let down = filtered(&lightness, size, &smooth, derivative);
        across.iter().zip(down).map(|(a, d)| a.hypot(d)).collect()
    };
    let points = strength(&point).into_iter();
    strength(&edge)
        .into_iter()
        .zip(points)
        .map(|(e, p)| [e, p])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(size: [u32; 2], code: impl Fn(usize) -> [u8; 3]) -> Picture {
        let codes = (0..(size[0] * size[1]) as usize).flat_map(code).collect();
        Picture::of_codes(&picture_file::RgbImage8::new(size[0], size[1], codes).unwrap())
    }

    fn filled(code: [u8; 3]) -> Picture {
        picture([24, 16], |_| code)
    }

    fn striped(codes: [[u8; 3]; 2]) -> Picture {
        picture([24, 16], |i| codes[(i / 6) % 2])
    }

    fn mean(a: &Picture, b: &Picture) -> f64 {
        let values = flip(a, b).unwrap();
        values.iter().sum::<f64>() / values.len() as f64
    }

    #[test]
    fn a_picture_does_not_differ_from_itself() {
        let picture = striped([[20, 90, 200], [240, 180, 30]]);
        assert!(mean(&picture, &picture) < 1e-12);
    }

    #[test]
    fn the_largest_difference_is_from_green_to_blue() {
        let found = mean(&filled([0, 255, 0]), &filled([0, 0, 255]));
        assert!((found - 1.0).abs() < 1e-9, "{found}");
    }

    /// Without features, FLIP is only the redistributed color difference: 100 in L* is 100^0.7 = 25.1189 of the largest
    /// 203.36^0.7 = 41.28, so FLIP is 0.95 + 0.05 (25.1189 − 16.51) / 24.77 = 0.9674.
    #[test]
    fn black_and_white_differ_as_computed_by_hand() {
        let found = mean(&filled([0; 3]), &filled([255; 3]));
        assert!((found - 0.9674).abs() < 5e-4, "{found}");
    }

    #[test]
    fn either_picture_may_be_the_reference() {
        let (a, b) = (
            striped([[20, 90, 200], [240, 180, 30]]),
            striped([[240, 60, 30], [20, 200, 90]]),
        );
        assert!((mean(&a, &b) - mean(&b, &a)).abs() < 1e-12);
        assert!(mean(&a, &b) > 0.1);
    }

    #[test]
    fn a_change_of_hue_is_noticed_and_more_of_it_more() {
        let base = filled([180, 120, 60]);
        let little = mean(&base, &filled([170, 125, 60]));
        let much = mean(&base, &filled([60, 120, 180]));
        assert!(little > 0.02 && much > 4.0 * little, "{little} {much}");
    }

    /// The same color difference counts more where it forms an edge (section 4.2).
    #[test]
    fn a_feature_raises_the_difference() {
        let base = filled([100; 3]);
        let lined = picture([24, 16], |i| [if i % 24 == 12 { 200 } else { 100 }; 3]);
        let values = flip(&base, &lined).unwrap();
        assert!(values[12] > 2.0 * values[1] && values[1] >= 0.0);
    }

    #[test]
    fn pictures_of_different_sizes_do_not_compare() {
        let other = picture([16, 24], |_| [0; 3]);
        assert!(flip(&filled([0; 3]), &other).is_err());
        let none = picture([0, 0], |_| [0; 3]);
        assert!(flip(&none, &none).is_err());
    }

    /// Filtering along both axes equals filtering with the product of the filters: checked on a single bright pixel in a corner.
    #[test]
    fn filters_go_on_beyond_the_border() {
        let mut plane = vec![0.0; 5 * 4];
        plane[0] = 1.0;
        let (x, y) = (vec![0.25, 0.5, 0.25], vec![0.1, 0.7, 0.2]);
        let found = filtered(&plane, [5, 4], &x, &y);
        // To the left of the corner and above it the plane is 1 too.
        assert!((found[0] - 0.75 * 0.8).abs() < 1e-15);
        assert!((found[1] - 0.25 * 0.8).abs() < 1e-15);
        assert!((found[5] - 0.75 * 0.1).abs() < 1e-15);
        assert!(found[2] == 0.0 && found[10] == 0.0);
    }
}
