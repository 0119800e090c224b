//! Exposure: which luminance becomes the display's white.

use super::DevelopError;
use relight::xyz::exposure_scale;

/// Which luminance becomes the display's white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Stops: at 0, a radiance of 1 at every wavelength has the luminance of the display's white; each stop halves the
    /// luminance that becomes white ([`exposure_scale`]).
    Stops(f64),
    /// This luminance of the scene, cd/m².
    White(f64),
    /// The luminance that this percentage of the pixels does not exceed: with 99, one pixel in a hundred is too bright.
    Percentile(f64),
}

impl Default for Exposure {
    fn default() -> Self {
        Self::Stops(0.0)
    }
}

impl Exposure {
    /// Returns the factor on XYZ in cd/m² that gives the display's white Y = 1.
    pub(super) fn scale(self, xyz: &[[f32; 3]]) -> Result<f64, DevelopError> {
        match self {
            Self::Stops(stops) => Ok(exposure_scale(stops)),
            Self::White(luminance) => Ok(1.0 / luminance),
            Self::Percentile(percent) => {
                let luminance = percentile(xyz, percent).filter(|&y| y > 0.0);
                Ok(1.0 / luminance.ok_or(DevelopError::NoLight)?)
            }
        }
    }
}

/// Returns the luminance that a percentage of the pixels of finite luminance does not exceed.
fn percentile(xyz: &[[f32; 3]], percent: f64) -> Option<f64> {
    let mut luminances: Vec<f32> = xyz.iter().map(|v| v[1]).filter(|y| y.is_finite()).collect();
    let last = luminances.len().checked_sub(1)?;
    let rank = (percent / 100.0 * last as f64).round() as usize;
    let (_, luminance, _) = luminances.select_nth_unstable_by(rank.min(last), f32::total_cmp);
    Some(f64::from(*luminance))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_way_gives_its_white() {
        let xyz: Vec<[f32; 3]> = (0_u16..=100).map(|y| [0.0, f32::from(y), 0.0]).collect();
        let white = |exposure: Exposure| exposure.scale(&xyz).map(f64::recip);
        assert_eq!(white(Exposure::White(250.0)), Ok(250.0));
        for (percent, luminance) in [(100.0, 100.0), (99.0, 99.0), (50.0, 50.0), (1.0, 1.0)] {
            let found = white(Exposure::Percentile(percent)).unwrap();
            assert!((found - luminance).abs() < 1e-12, "{percent}: {found}");
        }
        let stops = |ev| white(Exposure::Stops(ev)).unwrap();
        assert!((stops(-2.0) / stops(0.0) - 4.0).abs() < 1e-12);
    }

    #[test]
    fn what_has_no_light_has_no_percentile() {
        for xyz in [vec![], vec![[0.0; 3]; 5], vec![[f32::NAN; 3]; 5]] {
            let found = Exposure::Percentile(99.0).scale(&xyz);
            assert_eq!(found, Err(DevelopError::NoLight));
        }
        let with_nan = [[f32::NAN; 3], [3.0; 3], [f32::INFINITY; 3]];
        assert!(Exposure::Percentile(99.0).scale(&with_nan).is_ok());
    }
}
