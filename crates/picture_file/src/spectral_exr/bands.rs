//! The bands of a file's channels, and the band grid onto which they are read.

use spectra::{BandGrid, Stokes};

use super::wavelength::SpectralPosition;
use crate::exr_file::BandLayoutError;

/// How far a band may be from its position, as a fraction of the band width: names have few decimals.
const UNIFORM_WITHIN: f64 = 1e-3;

/// The visible range. A band that extends beyond [`BandGrid::LIMITS_NM`] is left out unless part of it is in this range.
const SEEN_NM: (f64, f64) = (380.0, 780.0);

/// Formats a wavelength as in the layout: `385,000000nm`.
pub(super) fn wavelength_text(nm: f64) -> String {
    format!("{nm:.6}nm").replace('.', ",")
}

/// Returns the band whose center is this text, in the format of [`wavelength_text`].
pub(super) fn band_of_text(text: &str, grid: &BandGrid) -> Option<usize> {
    let nm: f64 = text.strip_suffix("nm")?.replace(',', ".").parse().ok()?;
    let band = ((nm - grid.min_nm()) / grid.width_nm()).floor();
    // A cast turns negative values and NaN into 0, and the text then differs.
    let band = (band as u32).min(grid.count() - 1);
    (wavelength_text(grid.center_nm(band)) == text).then_some(band as usize)
}

/// Returns the name of the channel of a component of the emissive radiance in the band with center `nm`.
pub(super) fn radiance_name(stokes: Stokes, nm: f64) -> String {
    format!("{}.{}", stokes.name(), wavelength_text(nm))
}

/// The grid onto which a file's bands are read.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bands {
    /// The grid.
    pub(super) grid: BandGrid,
    /// The file's bands that are used, counted from the shortest wavelength.
    pub(super) used: std::ops::Range<usize>,
    /// How the grid's bands are computed from them; `None` if they are the grid's bands.
    pub(super) shares: Option<BandMix>,
    /// The ends of the file's bands, nm, if [`Bands::reaching_the_ends`] extended them.
    pub(super) ends_nm: Option<(f64, f64)>,
}

/// For each band of the grid the bands from which it is computed, counted from the first one used, and their weights. The
/// integral over wavelength is preserved.
pub(super) type BandMix = Vec<Vec<(usize, f32)>>;

impl Bands {
    /// Creates the grid for bands in order of their wavelengths. `range_nm` gives the ends of a uniform grid if the file has them.
    pub(super) fn new(
        places: &[SpectralPosition],
        range_nm: Option<(f64, f64)>,
    ) -> Result<Self, BandLayoutError> {
        let centers: Vec<f64> = places.iter().map(|place| place.center_nm()).collect();
        if let Some(pair) = centers.windows(2).find(|p| p[1] - p[0] <= 1e-9 * p[1]) {
            return Err(BandLayoutError::Duplicate(pair[1]));
        }
        if let Some((min_nm, max_nm)) = range_nm {
            let grid = BandGrid::new(min_nm, max_nm, centers.len() as u32)?;
            return match furthest_off(&grid, &centers) {
                Some((nm, off_nm)) => Err(BandLayoutError::NotUniform { nm, off_nm }),
                None => Ok(Self {
                    grid,
                    used: 0..centers.len(),
                    shares: None,
                    ends_nm: None,
                }),
            };
        }
        let edges = edges(places, &centers)?;
        let used = used(&edges)?;
        Self::of_edges(&edges[used.start..=used.end], used)
    }

    fn of_edges(edges: &[f64], used: std::ops::Range<usize>) -> Result<Self, BandLayoutError> {
        let (low, high) = BandGrid::LIMITS_NM;
        let cut: Vec<f64> = edges.iter().map(|nm| nm.clamp(low, high)).collect();
        let (first, last) = (cut[0], cut[cut.len() - 1]);
        let grid = BandGrid::new(first, last, used.len() as u32)?;
        let centers: Vec<f64> = cut.windows(2).map(|e| f64::midpoint(e[0], e[1])).collect();
        if furthest_off(&grid, &centers).is_none() {
            return Ok(Self {
                grid,
                used,
                shares: None,
                ends_nm: None,
            });
        }
        let narrowest = cut
            .windows(2)
            .map(|e| e[1] - e[0])
            .fold(f64::INFINITY, f64::min);
        // Slightly less, so that a whole number of bands is not rounded up.
        let count = ((last - first) / narrowest - 1e-6).ceil();
        let grid = BandGrid::new(first, last, (count as u32).clamp(1, BandGrid::MAX_COUNT))?;
        Ok(Self {
            shares: Some(shares(&cut, &grid)),
            ends_nm: None,
            grid,
            used,
        })
    }
}

/// How far from the ends of [`SEEN_NM`] bands may begin and end, nm: less than 0.1 % of any lamp's X, Y or Z lies beyond.
const NEAR_ENDS_NM: f64 = 5.0;
/// The most parts into which bands are split to come that near.
const MAX_PARTS: u32 = 8;

impl Bands {
    /// Extends or cuts the bands so that they reach from one end of [`SEEN_NM`] to the other, which reflectances need to be shown
    /// under lamps. If the file's bands end before, the last one is continued; bands beyond are left out. Bands are split if that
    /// brings them nearer to the ends.
    pub(super) fn reaching_the_ends(self) -> Result<Self, BandLayoutError> {
        let (low, high) = SEEN_NM;
        let (count, width_nm) = (f64::from(self.grid.count()), self.grid.width_nm());
        let lattice = |parts: u32| {
            let step = width_nm / f64::from(parts);
            let first = ((low - self.grid.min_nm()) / step - 1e-6).ceil();
            let end = ((high - self.grid.min_nm()) / step + 1e-6).floor();
            (step, first, end)
        };
        let is_near = |parts: &u32| {
            let (step, first, end) = lattice(*parts);
            let from_nm = self.grid.min_nm() + first * step;
            let to_nm = self.grid.min_nm() + end * step;
            from_nm - low <= NEAR_ENDS_NM && high - to_nm <= NEAR_ENDS_NM
        };
        let parts = (1..=MAX_PARTS).find(is_near).unwrap_or(MAX_PARTS);
        let (step, first, end) = lattice(parts);
        if parts == 1 && first == 0.0 && end == count {
            return Ok(self);
        }
        let (from_nm, to_nm) = (
            self.grid.min_nm() + first * step,
            self.grid.min_nm() + end * step,
        );
        let grid = BandGrid::new(
            from_nm.max(low),
            to_nm.min(high),
            (end - first).max(0.0) as u32,
        )?;
        let last = self.grid.count() - 1;
        let source = |band: u32| {
            let old = ((first + f64::from(band)) / f64::from(parts) + 1e-6).floor();
            // A cast turns negative values into 0.
            let old = (old as u32).min(last) as usize;
            match &self.shares {
                Some(shares) => shares[old].clone(),
                None => vec![(old, 1.0)],
            }
        };
        let goes_on = first < 0.0 || end > count * f64::from(parts);
        Ok(Self {
            ends_nm: goes_on.then(|| (self.grid.min_nm(), self.grid.max_nm())),
            shares: Some((0..grid.count()).map(source).collect()),
            grid,
            used: self.used,
        })
    }
}

/// Returns the center that is furthest off the grid, and its distance; `None` if all are on the grid.
fn furthest_off(grid: &BandGrid, centers: &[f64]) -> Option<(f64, f64)> {
    let off = (0..)
        .zip(centers)
        .map(|(band, &nm)| (nm, (nm - grid.center_nm(band)).abs()));
    let off = off.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (off.1 > UNIFORM_WITHIN * grid.width_nm()).then_some(off)
}

/// Returns the edges of the bands. Between two centers the edge is halfway, as the layout specifies for channels without a response
/// curve; the first and the last band are symmetrical.
fn edges(places: &[SpectralPosition], centers: &[f64]) -> Result<Vec<f64>, BandLayoutError> {
    if let [SpectralPosition::Range(first, _), ..] = places {
        let mut edges = vec![*first];
        for place in places {
            let (low, high) = match *place {
                SpectralPosition::Range(low, high) => (low, high),
                SpectralPosition::Center(nm) => (nm, nm),
            };
            let end_nm = edges[edges.len() - 1];
            // Names have two decimals.
            if (low - end_nm).abs() > 0.02 {
                let start_nm = low;
                return Err(BandLayoutError::NotConnected { end_nm, start_nm });
            }
            edges.push(high);
        }
        return Ok(edges);
    }
    let &[first, second, ..] = centers else {
        let nm = centers.first().copied().unwrap_or_default();
        return Err(BandLayoutError::SingleBand(nm));
    };
    let (before, last) = (centers[centers.len() - 2], centers[centers.len() - 1]);
    let mut edges = vec![first - 0.5 * (second - first)];
    edges.extend(
        centers
            .windows(2)
            .map(|pair| f64::midpoint(pair[0], pair[1])),
    );
    edges.push(last + 0.5 * (last - before));
    Ok(edges)
}

/// Returns the bands that are within the limits, or that cross them from the visible range.
fn used(edges: &[f64]) -> Result<std::ops::Range<usize>, BandLayoutError> {
    let (low, high) = BandGrid::LIMITS_NM;
    let is_used = |band: &usize| {
        let (from, to) = (edges[*band], edges[*band + 1]);
        (from >= low && to <= high) || (from < SEEN_NM.1 && to > SEEN_NM.0)
    };
    let mut used = (0..edges.len() - 1).filter(is_used);
    let Some(first) = used.next() else {
        return Err(BandLayoutError::OutOfRange {
            first_nm: edges[0],
            last_nm: edges[edges.len() - 1],
        });
    };
    Ok(first..used.next_back().unwrap_or(first) + 1)
}

/// Returns weights that make each band of the grid the mean over its width of a spectrum that is constant between the edges.
fn shares(edges: &[f64], grid: &BandGrid) -> BandMix {
    let share = |band: u32| {
        let (low, high) = (grid.wavelength_nm(band, 0.0), grid.wavelength_nm(band, 1.0));
        let of_source = |(source, pair): (usize, &[f64])| {
            let common = pair[1].min(high) - pair[0].max(low);
            (common > 0.0).then_some((source, (common / grid.width_nm()) as f32))
        };
        edges.windows(2).enumerate().filter_map(of_source).collect()
    };
    (0..grid.count()).map(share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectral_exr::wavelength::spectral_channel;

    fn centers(nm: &[f64]) -> Vec<SpectralPosition> {
        nm.iter().copied().map(SpectralPosition::Center).collect()
    }

    fn uniform(min_nm: f64, max_nm: f64, used: std::ops::Range<usize>) -> Bands {
        Bands {
            grid: BandGrid::new(min_nm, max_nm, used.len() as u32).unwrap(),
            used,
            shares: None,
            ends_nm: None,
        }
    }

    #[test]
    fn names_are_those_of_the_layout() {
        assert_eq!(radiance_name(Stokes::S0, 550.0), "S0.550,000000nm");
        let nm = 380.0 + 400.0 / 48.0;
        assert_eq!(radiance_name(Stokes::S3, nm), "S3.388,333333nm");
    }

    #[test]
    fn even_centers_give_their_grid_back() {
        for count in [2, 31, 40, 48, 61] {
            let grid = BandGrid::visible(count).unwrap();
            let place = |band| {
                let name = radiance_name(Stokes::S0, grid.center_nm(band));
                spectral_channel(&name).unwrap().unwrap().1
            };
            let places: Vec<SpectralPosition> = (0..count).map(place).collect();
            let range = (grid.min_nm(), grid.max_nm());
            let found = Bands::new(&places, Some(range)).unwrap();
            assert_eq!(found, uniform(380.0, 780.0, 0..count as usize));
            // Without the range there are only the six decimals of the name.
            let found = Bands::new(&places, None).unwrap();
            assert!(found.shares.is_none());
            assert!((found.grid.min_nm() - 380.0).abs() < 2e-6);
            assert!((found.grid.max_nm() - 780.0).abs() < 2e-6);
        }
    }

    #[test]
    fn bands_beyond_vision_are_left_out() {
        // 300 to 900 nm by 5: half of 357.5 to 362.5 nm is beyond the limit, and the band is invisible.
        let nm: Vec<f64> = (60..=180).map(|i| 5.0 * f64::from(i)).collect();
        let found = Bands::new(&centers(&nm), None).unwrap();
        assert_eq!(found, uniform(362.5, 827.5, 13..106));
        let beyond = Bands::new(&centers(&[900.0, 910.0]), None);
        assert!(matches!(beyond, Err(BandLayoutError::OutOfRange { .. })));
    }

    /// A wide band that reaches into the violet is cut at the limit and keeps its radiance there.
    #[test]
    fn a_wide_band_is_cut_at_the_limit() {
        let found = Bands::new(&centers(&[350.0, 450.0, 550.0]), None).unwrap();
        assert_eq!((found.grid.min_nm(), found.grid.max_nm()), (360.0, 600.0));
        assert_eq!(found.grid.count(), 6);
        let shares = found.shares.unwrap();
        assert_eq!(shares[0], [(0, 1.0)]);
        assert_eq!(shares[1], [(1, 1.0)]);
        assert_eq!(shares[3].len(), 2);
    }

    #[test]
    fn uneven_bands_keep_their_integral() {
        let nm = [400.0, 410.0, 430.0, 435.0, 500.0];
        let found = Bands::new(&centers(&nm), None).unwrap();
        let edges = [395.0, 405.0, 420.0, 432.5, 467.5, 532.5];
        let values = [1.0, 3.0, 0.5, 7.0, 2.0];
        let integral: f64 = (0..5).map(|i| values[i] * (edges[i + 1] - edges[i])).sum();
        let shares = found.shares.unwrap();
        assert_eq!(shares.len(), 14);
        let band = |shares: &Vec<(usize, f32)>| -> f64 {
            shares
                .iter()
                .map(|&(i, share)| values[i] * f64::from(share))
                .sum()
        };
        let sum: f64 = shares.iter().map(band).sum::<f64>() * found.grid.width_nm();
        assert!((sum / integral - 1.0).abs() < 1e-6, "{sum} {integral}");
        for shares in &shares {
            let total: f32 = shares.iter().map(|(_, share)| share).sum();
            assert!((total - 1.0).abs() < 1e-5, "light is neither lost nor made");
        }
    }

    /// 400 to 700 nm by 20 are 390 to 710 nm, ten short of the violet end: halves of 10 nm reach it. 380 to 780 nm by 20 extend
    /// beyond both ends by half a band. 400 to 700 nm by 10 begin at 395.
    #[test]
    fn reflectances_go_on_to_where_people_see() {
        for (from, step, count, grid, ends) in [
            (400.0, 20.0, 16, (380.0, 780.0, 40), Some((390.0, 710.0))),
            (380.0, 20.0, 21, (380.0, 780.0, 40), None),
            (400.0, 10.0, 31, (385.0, 775.0, 39), Some((395.0, 705.0))),
            (360.0, 5.0, 95, (382.5, 777.5, 79), None),
        ] {
            let nm: Vec<f64> = (0..count).map(|i| from + step * f64::from(i)).collect();
            let found = Bands::new(&centers(&nm), None).unwrap();
            let places = found.used.len() - 1;
            let found = found.reaching_the_ends().unwrap();
            let (low, high, bands) = grid;
            assert!((found.grid.min_nm() - low).abs() < 1e-9, "{found:?}");
            assert!((found.grid.max_nm() - high).abs() < 1e-9, "{found:?}");
            assert_eq!((found.grid.count(), found.ends_nm), (bands, ends));
            // Each band is the band of the file that contains it, or the nearest.
            for (band, shares) in (0..).zip(found.shares.unwrap()) {
                let place = (found.grid.center_nm(band) - nm[found.used.start]) / step;
                let place = place.round().clamp(0.0, places as f64) as usize;
                assert_eq!(shares, [(place, 1.0)], "{band}");
            }
        }
        let whole: Vec<f64> = (0..40).map(|i| 385.0 + 10.0 * f64::from(i)).collect();
        let whole = Bands::new(&centers(&whole), None).unwrap();
        assert_eq!(whole.clone().reaching_the_ends().unwrap(), whole);
    }

    #[test]
    fn ranges_are_taken_as_they_are() {
        let range = |low, high| SpectralPosition::Range(low, high);
        let found = Bands::new(&[range(400.0, 410.0), range(410.0, 420.0)], None).unwrap();
        assert_eq!(found, uniform(400.0, 420.0, 0..2));
        assert!(Bands::new(&[range(400.0, 500.0)], None).is_ok());
        for second in [range(412.0, 420.0), range(405.0, 420.0)] {
            let found = Bands::new(&[range(400.0, 410.0), second], None);
            assert!(matches!(found, Err(BandLayoutError::NotConnected { .. })));
        }
    }

    #[test]
    fn bands_that_make_no_grid_are_refused() {
        use BandLayoutError as E;
        let of = |nm: &[f64], range| Bands::new(&centers(nm), range);
        assert_eq!(of(&[400.0, 400.0, 410.0], None), Err(E::Duplicate(400.0)));
        assert_eq!(of(&[400.0], None), Err(E::SingleBand(400.0)));
        assert!(of(&[400.0], Some((395.0, 405.0))).is_ok());
        // The channels contradict the range.
        assert!(matches!(
            of(&[400.0, 410.0], Some((400.0, 420.0))),
            Err(E::NotUniform { .. })
        ));
        assert!(matches!(of(&[1.0, 2.0], Some((0.5, 2.5))), Err(E::Grid(_))));
    }
}
