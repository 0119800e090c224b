//! Finds the thickness of a layer that gives a wanted color.

use crate::response::Angle;
use crate::stack_color::StackColor;
use colorimetry::lab::delta_e_2000;
use colorimetry::{Lab, srgb};

/// What is wanted, and in which range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matching {
    /// The wanted color, XYZ with Y = 1 for the display's white; see [`parse_srgb`](crate::parse_srgb).
    pub wanted: [f64; 3],
    /// Index of the layer that varies, from 0.
    pub layer: usize,
    /// Its smallest thickness, nm.
    pub from_nm: f64,
    /// Its largest thickness, nm; more than `from_nm`.
    pub to_nm: f64,
    /// The films are shown 2^EV times as bright.
    pub exposure_ev: f64,
    /// What has to match.
    pub by: MatchBy,
}

/// What has to match.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MatchBy {
    /// The whole color, including lightness, at the exposure.
    #[default]
    Color,
    /// The color regardless of brightness: every film is first scaled to the brightness of the wanted color. A film reflects little,
    /// so this may be all that can be matched of a light color.
    Chromaticity,
}

/// A thickness that is a local optimum: its color is nearer to the wanted one than those of its neighbors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Match {
    /// Thickness of the layer that varies, nm.
    pub thickness_nm: f64,
    /// Color difference ΔE₀₀ from the wanted color.
    pub delta_e: f64,
    /// XYZ of the film as compared, brightened.
    pub xyz: [f64; 3],
    /// Number of stops by which it was brightened.
    pub exposure_ev: f64,
    /// Where it is in the range.
    pub place: MatchPlace,
}

/// Where a match is in the range of thicknesses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatchPlace {
    /// Within the range: thinner and thicker films are further off.
    Within,
    /// At the thin end: films thinner than the range may be nearer.
    ThinEnd,
    /// At the thick end: thicker films may be nearer, or make no difference.
    ThickEnd,
    /// Anywhere: the color difference does not depend on the thickness.
    Anywhere,
}

/// Smallest depth of a minimum of the color difference. Rounding errors make many shallower ones in the color of a film that
/// no light gets through.
const DEPTH: f64 = 1e-3;

/// Step of the search before it is refined, nm. Colors repeat after half a wavelength of path, which is 20 nm and more of thickness
/// in any medium of index below 10.
pub(crate) const STEP_NM: f64 = 1.0;
/// Minimum and maximum number of steps.
pub(crate) const STEPS: (f64, f64) = (100.0, 100_000.0);

/// Returns the local minima of the color difference over the thickness, best first: the nearest thickness and its runners-up, one
/// per order of interference. Where the color does not depend on the thickness there is one, [`MatchPlace::Anywhere`].
///
/// Both colors are compared as an sRGB display shows them, without adaptation, so CIELAB is relative to the display's white.
///
/// # Panics
/// If the layer does not exist, or `thicknesses_nm` does not have one thickness per layer.
pub fn matches(
    stack: &StackColor,
    thicknesses_nm: &[f64],
    angle: Angle,
    matching: &Matching,
) -> Vec<Match> {
    let set = |nm: f64| {
        let mut thicknesses = thicknesses_nm.to_vec();
        thicknesses[matching.layer] = nm;
        thicknesses
    };
    let at = |nm: f64| matching.judge(nm, stack.at(&set(nm), angle).xyz);
    let range_nm = matching.to_nm - matching.from_nm;
    let steps = (range_nm / STEP_NM).ceil().clamp(STEPS.0, STEPS.1) as usize;
    let nm = |step: usize| {
        let along = step as f64 / steps as f64;
        matching.from_nm + along * range_nm
    };
    let sets: Vec<Vec<f64>> = (0..=steps).map(|step| set(nm(step))).collect();
    let colors = stack.xyz_of_all(&sets, &[angle]).into_iter().enumerate();
    let grid: Vec<f64> = colors
        .map(|(step, xyz)| matching.judge(nm(step), xyz).delta_e)
        .collect();
    let mut found: Vec<Match> = minima(&grid)
        .into_iter()
        .map(|(step, place)| {
            let on_grid = Match {
                place,
                ..at(nm(step))
            };
            let between = (nm(step.saturating_sub(1)), nm((step + 1).min(steps)));
            let refined = at(lowest_between(between, |nm| at(nm).delta_e));
            // An end is its own minimum, unless there is a deeper one next to it.
            let deeper = match place {
                MatchPlace::Within => 0.0,
                MatchPlace::ThinEnd | MatchPlace::ThickEnd => DEPTH,
                MatchPlace::Anywhere => f64::INFINITY,
            };
            if refined.delta_e < on_grid.delta_e - deeper {
                refined
            } else {
                on_grid
            }
        })
        .collect();
    found.sort_by(|a, b| a.delta_e.total_cmp(&b.delta_e));
    found
}

/// Returns the minima from which values rise by more than [`DEPTH`] on both sides. Where they do not rise before an end of the
/// range, that end is the minimum.
pub(crate) fn minima(values: &[f64]) -> Vec<(usize, MatchPlace)> {
    let last = values.len() - 1;
    let mut found = Vec::new();
    // The lowest value since the last fall by more than the depth, or the highest since the last such rise.
    let (mut lowest, mut highest) = (Some(0), 0);
    for (step, &value) in values.iter().enumerate() {
        match lowest {
            Some(low) if value > values[low] + DEPTH => {
                let is_end = found.is_empty() && values[0] <= values[low] + DEPTH;
                found.push(if is_end {
                    (0, MatchPlace::ThinEnd)
                } else {
                    (low, MatchPlace::Within)
                });
                (lowest, highest) = (None, step);
            }
            Some(low) if value < values[low] => lowest = Some(step),
            None if value < values[highest] - DEPTH => lowest = Some(step),
            None if value > values[highest] => highest = step,
            _ => {}
        }
    }
    match lowest {
        Some(low) if found.is_empty() && values[0] <= values[low] + DEPTH => {
            found.push((0, MatchPlace::Anywhere));
        }
        // The last value exceeds the lowest by no more than the depth.
        Some(_) => found.push((last, MatchPlace::ThickEnd)),
        None => {}
    }
    found
}

impl Matching {
    /// Compares the film of this thickness and color with the wanted color.
    fn judge(&self, nm: f64, xyz: [f64; 3]) -> Match {
        let exposure_ev = match self.by {
            MatchBy::Color => self.exposure_ev,
            // Black stays black at any exposure.
            MatchBy::Chromaticity if xyz[1] > 0.0 && self.wanted[1] > 0.0 => {
                (self.wanted[1] / xyz[1]).log2()
            }
            MatchBy::Chromaticity => 0.0,
        };
        let xyz = xyz.map(|v| v * exposure_ev.exp2());
        let lab = |xyz| Lab::from_xyz(xyz, srgb::white_xyz());
        Match {
            thickness_nm: nm,
            delta_e: delta_e_2000(lab(self.wanted), lab(xyz)),
            xyz,
            exposure_ev,
            place: MatchPlace::Within,
        }
    }
}

/// Returns the minimum of a function with a single one, by golden sections (Kiefer, Proc. Amer. Math. Soc. 4, 502 (1953)), to 1e-6
/// of the range: a minimum cannot be located much better than the square root of the rounding error.
pub(crate) fn lowest_between((mut low, mut high): (f64, f64), f: impl Fn(f64) -> f64) -> f64 {
    let section = 0.5 * (5.0_f64.sqrt() - 1.0);
    let enough = 1e-7 * (high - low);
    let (mut a, mut b) = (high - section * (high - low), low + section * (high - low));
    let (mut f_a, mut f_b) = (f(a), f(b));
    while high - low > enough {
        if f_a <= f_b {
            (high, b, f_b) = (b, a, f_a);
            a = high - section * (high - low);
            f_a = f(a);
        } else {
            (low, a, f_a) = (a, b, f_b);
            b = low + section * (high - low);
            f_b = f(b);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Light, Stack, View, parse_srgb};

    fn silica_on_silicon() -> StackColor {
        let stack = Stack::parse("1 | silica 0nm | silicon").unwrap();
        StackColor::new(&stack, Light::named("D65").unwrap(), View::default()).unwrap()
    }

    fn matching(wanted: [f64; 3], by: MatchBy) -> Matching {
        Matching {
            wanted,
            layer: 0,
            from_nm: 20.0,
            to_nm: 700.0,
            exposure_ev: 0.0,
            by,
        }
    }

    /// The color of a known thickness leads back to it.
    #[test]
    fn the_thickness_of_a_known_color_is_found() {
        let stack = silica_on_silicon();
        for nm in [20.4, 87.3, 312.456, 333.3, 699.6] {
            let wanted = stack.at(&[nm], Angle::NORMAL).xyz;
            let found = matches(
                &stack,
                &[0.0],
                Angle::NORMAL,
                &matching(wanted, MatchBy::Color),
            );
            assert!(
                (found[0].thickness_nm - nm).abs() < 1e-4,
                "{nm}: {:?}",
                found[0]
            );
            assert!(found[0].delta_e < 1e-4);
            assert!(
                found.len() > 1 && found[1].delta_e > found[0].delta_e,
                "{found:?}"
            );
        }
    }

    /// By chromaticity, the same film is found for a color eight times as bright, and the exposure says how much brighter.
    #[test]
    fn brightness_can_be_left_out() {
        let stack = silica_on_silicon();
        let wanted = stack.at(&[250.0], Angle::NORMAL).xyz.map(|v| 8.0 * v);
        let found = matches(
            &stack,
            &[0.0],
            Angle::NORMAL,
            &matching(wanted, MatchBy::Chromaticity),
        );
        assert!(
            (found[0].thickness_nm - 250.0).abs() < 1e-4,
            "{:?}",
            found[0]
        );
        assert!((found[0].exposure_ev - 3.0).abs() < 1e-5);
        let by_color = matches(
            &stack,
            &[0.0],
            Angle::NORMAL,
            &matching(wanted, MatchBy::Color),
        );
        assert!(by_color[0].delta_e > 10.0);
    }

    /// Under opaque gold, a layer makes no difference beyond rounding.
    #[test]
    fn roundings_are_no_orders() {
        let stack = Stack::parse("1 | gold 500nm | silica 100nm | 1.5").unwrap();
        let color = StackColor::new(&stack, Light::named("D65").unwrap(), View::default()).unwrap();
        let of_layer = |layer| Matching {
            layer,
            from_nm: 0.0,
            to_nm: 400.0,
            ..matching(parse_srgb("#2e6fd0").unwrap(), MatchBy::Color)
        };
        let thicknesses = stack.thicknesses_nm();
        let below = matches(&color, thicknesses, Angle::NORMAL, &of_layer(1));
        assert_eq!(below.len(), 1, "{below:?}");
        assert_eq!(below[0].place, MatchPlace::Anywhere);
        let gold = matches(&color, thicknesses, Angle::NORMAL, &of_layer(0));
        assert!(gold.len() <= 3, "a thick film does not matter: {gold:?}");
    }

    #[test]
    fn minima_are_deep_or_at_an_end() {
        use MatchPlace::{Anywhere, ThickEnd, ThinEnd, Within};
        assert_eq!(minima(&[1.0, 1.0 + 1e-9, 1.0]), [(0, Anywhere)]);
        assert_eq!(minima(&[3.0, 1.0, 2.0]), [(1, Within)]);
        assert_eq!(
            minima(&[1.0, 3.0, 2.0, 2.0 + 1e-9, 2.0, 4.0, 3.0]),
            [(0, ThinEnd), (2, Within), (6, ThickEnd)]
        );
        assert_eq!(minima(&[3.0, 2.0, 1.0, 1.0 + 1e-9]), [(3, ThickEnd)]);
        assert_eq!(minima(&[1.0, 2.0, 3.0]), [(0, ThinEnd)]);
    }

    #[test]
    fn an_end_of_the_range_can_be_the_best() {
        let stack = silica_on_silicon();
        let wanted = stack.at(&[10.0], Angle::NORMAL).xyz;
        let found = matches(
            &stack,
            &[0.0],
            Angle::NORMAL,
            &matching(wanted, MatchBy::Color),
        );
        assert_eq!(found[0].thickness_nm, 20.0);
        assert_eq!(found[0].place, MatchPlace::ThinEnd);
        let _ = parse_srgb("#000").map(|black| {
            let found = matches(
                &stack,
                &[0.0],
                Angle::NORMAL,
                &matching(black, MatchBy::Chromaticity),
            );
            assert!(found.iter().all(|m| m.delta_e.is_finite()));
        });
    }
}
