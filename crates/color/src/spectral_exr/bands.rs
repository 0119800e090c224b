//! Names of spectral channels, and the band grid that they describe.

use spectra::{BandGrid, BandGridError};
use thiserror::Error;

/// Why the spectral channels of a file do not make a band grid.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BandLayoutError {
    /// A channel's name starts like a spectral one but does not end in a wavelength in nm.
    #[error("channel {0:?} does not name a wavelength in nm, such as `S0.550,000000nm`")]
    NotNanometres(String),
    /// Two channels of the same wavelength.
    #[error("two channels have the wavelength {0} nm")]
    Duplicate(f64),
    /// A single band, whose width nothing tells.
    #[error("a single band at {0} nm, and no attribute that gives its width")]
    SingleBand(f64),
    /// The wavelengths are not evenly spaced.
    #[error("bands must be evenly spaced, but {nm} nm lies {off_nm} nm off its place")]
    NotUniform {
        /// The channel's wavelength.
        nm: f64,
        /// How far it lies from where an even spacing puts it.
        off_nm: f64,
    },
    /// The bands make no grid that this program works with.
    #[error("the bands of the file cannot be used")]
    Grid(#[from] BandGridError),
}

/// How far a band centre may lie from its place, as a share of the band width: names have few decimals.
const UNIFORM_WITHIN: f64 = 1e-3;

/// The layer of the emissive, unpolarised radiance: the first Stokes component.
const PREFIX: &str = "S0.";

/// A wavelength as the layout writes it: `385,000000nm`.
pub(super) fn wavelength_text(nm: f64) -> String {
    format!("{nm:.6}nm").replace('.', ",")
}

/// The name of the channel of the band with centre `nm`.
pub(super) fn radiance_name(nm: f64) -> String {
    format!("{PREFIX}{}", wavelength_text(nm))
}

/// The wavelength in nm that a channel's name gives, `None` when the channel is not a radiance.
pub(super) fn wavelength_of(name: &str) -> Option<Result<f64, BandLayoutError>> {
    let text = name.strip_prefix(PREFIX)?;
    let number = text
        .strip_suffix("nm")
        .map(|number| number.replace(',', "."));
    let nm = number.and_then(|number| number.parse::<f64>().ok());
    Some(match nm {
        Some(nm) if nm.is_finite() && nm > 0.0 => Ok(nm),
        _ => Err(BandLayoutError::NotNanometres(name.to_owned())),
    })
}

/// The grid with these band centres, rising. `range_nm` gives the ends where the file tells them.
pub(super) fn grid_of(
    centres_nm: &[f64],
    range_nm: Option<(f64, f64)>,
) -> Result<BandGrid, BandLayoutError> {
    if let Some(pair) = centres_nm.windows(2).find(|pair| pair[0] >= pair[1]) {
        return Err(BandLayoutError::Duplicate(pair[1]));
    }
    let count = centres_nm.len() as u32;
    let (min_nm, max_nm) = match (range_nm, centres_nm) {
        (Some(range), _) => range,
        (None, &[first, .., last]) => {
            let half_width = (last - first) / f64::from(count - 1) / 2.0;
            (first - half_width, last + half_width)
        }
        (None, rest) => {
            let nm = rest.first().copied().unwrap_or_default();
            return Err(BandLayoutError::SingleBand(nm));
        }
    };
    let grid = BandGrid::new(min_nm, max_nm, count)?;
    for (band, &nm) in (0..).zip(centres_nm) {
        let off_nm = (nm - grid.centre_nm(band)).abs();
        if off_nm > UNIFORM_WITHIN * grid.width_nm() {
            return Err(BandLayoutError::NotUniform { nm, off_nm });
        }
    }
    Ok(grid)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_layout() {
        assert_eq!(radiance_name(550.0), "S0.550,000000nm");
        assert_eq!(radiance_name(380.0 + 400.0 / 48.0), "S0.388,333333nm");
        assert_eq!(wavelength_of("S0.550,000000nm"), Some(Ok(550.0)));
        assert_eq!(wavelength_of("S0.5,5e2nm"), Some(Ok(550.0)));
        for other in ["R", "S1.550,0nm", "T.550,0nm", "pellicle.variance.550,0nm"] {
            assert_eq!(wavelength_of(other), None);
        }
        for bad in [
            "S0.550,0um",
            "S0.nm",
            "S0.x",
            "S0.NaNnm",
            "S0.-5nm",
            "S0.1,2,3nm",
        ] {
            assert!(wavelength_of(bad).unwrap().is_err(), "{bad}");
        }
    }

    #[test]
    fn even_centres_give_their_grid_back() {
        for count in [2, 31, 40, 48, 61] {
            let grid = BandGrid::visible(count).unwrap();
            let name = |band| radiance_name(grid.centre_nm(band));
            let centres: Vec<f64> = (0..count)
                .map(|band| wavelength_of(&name(band)).unwrap().unwrap())
                .collect();
            let range = (grid.min_nm(), grid.max_nm());
            assert_eq!(grid_of(&centres, Some(range)), Ok(grid));
            // Six decimals of the name are all that is left without the range.
            let found = grid_of(&centres, None).unwrap();
            assert!((found.min_nm() - 380.0).abs() < 2e-6 && (found.max_nm() - 780.0).abs() < 2e-6);
        }
    }

    #[test]
    fn uneven_bands_are_refused() {
        use BandLayoutError as E;
        assert!(matches!(
            grid_of(&[400.0, 410.0, 421.0], None),
            Err(E::NotUniform { .. })
        ));
        assert_eq!(
            grid_of(&[400.0, 400.0, 410.0], None),
            Err(E::Duplicate(400.0))
        );
        assert_eq!(grid_of(&[400.0], None), Err(E::SingleBand(400.0)));
        assert!(grid_of(&[400.0], Some((395.0, 405.0))).is_ok());
        assert!(matches!(grid_of(&[900.0, 910.0], None), Err(E::Grid(_))));
        // A range that the channels contradict.
        assert!(grid_of(&[400.0, 410.0], Some((400.0, 420.0))).is_err());
    }
}
