//! The state of a render between two rounds of samples.

use crate::{
    BandGrid, KM_LUMENS_PER_WATT, LayerKey, LightGroup, PixelContent, Quantity, SpectralImage,
    Stokes, Window,
};
use rayon::prelude::*;
use std::ops::Range;

/// Where the running means of a pixel are in its values.
///
/// All are means of the samples taken so far, but for the deviations: the sums of squared differences from the mean (Welford, Note on
/// a method for calculating corrected sums of squares and products, Technometrics 4, 1962).
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct SumLayout {
    bands: usize,
    light_groups: usize,
    is_polarized: bool,
}

impl SumLayout {
    /// The layout for this content.
    pub fn new(content: PixelContent) -> Self {
        Self {
            bands: content.bands as usize,
            light_groups: content.light_groups,
            is_polarized: content.is_polarized,
        }
    }

    /// Number of values of one light group and one component of its Stokes vector beyond S0.
    fn of_component(&self) -> usize {
        self.bands + 3
    }

    /// Number of values without S1, S2 and S3.
    fn unpolarized(&self) -> usize {
        self.bands * (2 + self.apart()) + 3 * self.light_groups
    }

    /// Whether S1, S2 and S3 are kept.
    pub fn is_polarized(&self) -> bool {
        self.is_polarized
    }

    /// Number of light groups whose means are kept apart: a single one is the total.
    fn apart(&self) -> usize {
        if self.light_groups > 1 {
            self.light_groups
        } else {
            0
        }
    }

    /// Number of values of a pixel.
    pub fn len(&self) -> usize {
        let polarized = if self.is_polarized {
            Stokes::POLARIZED.len()
        } else {
            0
        };
        self.unpolarized() + polarized * self.light_groups * self.of_component()
    }

    /// Never: a pixel has values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Mean radiance of all light, by band.
    pub fn mean(&self) -> Range<usize> {
        0..self.bands
    }

    /// Squared deviations of the radiance of all light, by band.
    pub fn deviation(&self) -> Range<usize> {
        self.bands..2 * self.bands
    }

    /// Mean radiance of a light group, by band.
    pub fn group_mean(&self, light_group: usize) -> Range<usize> {
        if self.apart() == 0 {
            return self.mean();
        }
        let start = self.bands * (2 + light_group);
        start..start + self.bands
    }

    /// Mean X, Y and Z of a light group per nm of band width and without the factor of lm/W.
    pub fn xyz(&self, light_group: usize) -> Range<usize> {
        let start = self.bands * (2 + self.apart()) + 3 * light_group;
        start..start + 3
    }

    /// Mean of a component of the Stokes vector of a light group, by band.
    ///
    /// # Panics
    /// When it is not S0 and the light is not kept as polarized.
    pub fn component(&self, light_group: usize, stokes: Stokes) -> Range<usize> {
        match self.beyond_s0(light_group, stokes) {
            None => self.group_mean(light_group),
            Some(start) => start..start + self.bands,
        }
    }

    /// As [`Self::xyz`], of a component of the Stokes vector.
    ///
    /// # Panics
    /// When it is not S0 and the light is not kept as polarized.
    pub fn component_xyz(&self, light_group: usize, stokes: Stokes) -> Range<usize> {
        match self.beyond_s0(light_group, stokes) {
            None => self.xyz(light_group),
            Some(start) => start + self.bands..start + self.of_component(),
        }
    }

    /// Where the values of a component beyond S0 begin.
    fn beyond_s0(&self, light_group: usize, stokes: Stokes) -> Option<usize> {
        let before = stokes.index().checked_sub(1)?;
        assert!(self.is_polarized, "polarized light is kept");
        let place = before * self.light_groups + light_group;
        Some(self.unpolarized() + place * self.of_component())
    }
}

/// The unit of work of a render: all pixels of a window are advanced from one number of samples to another.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct Round {
    /// The pixels, in the whole picture.
    pub window: Window,
    /// The number of samples before, and after.
    pub samples: Range<u32>,
}

impl Round {
    /// Number of samples of all pixels together.
    pub fn work(&self) -> u64 {
        self.window.pixels() as u64 * self.samples.len() as u64
    }
}

/// Running means of the samples of each pixel of a window of a picture.
///
/// A pixel's samples are added one after the other, in the order of their numbers, to values that are kept exactly as the renderer
/// computes with them. So the result does not depend on how a render was cut into rounds, nor on whether it was interrupted.
#[derive(Clone, Debug, PartialEq)]
pub struct Accumulation {
    window: Window,
    first_sample: u32,
    bands: BandGrid,
    light_groups: Vec<LightGroup>,
    layout: SumLayout,
    counts: Vec<u32>,
    sums: Vec<f64>,
}

impl Accumulation {
    /// Begins a render: no samples, all sums 0. Its samples are numbered from `first_sample` on. Of polarized light, all components of the
    /// Stokes vector are kept.
    ///
    /// # Panics
    /// When `light_groups` is empty.
    pub fn new(
        window: Window,
        first_sample: u32,
        bands: BandGrid,
        light_groups: Vec<LightGroup>,
        is_polarized: bool,
    ) -> Self {
        assert!(!light_groups.is_empty(), "an image has a light group");
        let layout = SumLayout::new(PixelContent {
            bands: bands.count(),
            light_groups: light_groups.len(),
            is_polarized,
        });
        let pixels = window.pixels();
        Self {
            window,
            first_sample,
            bands,
            light_groups,
            layout,
            counts: vec![0; pixels],
            sums: vec![0.0; pixels * layout.len()],
        }
    }

    /// Bytes of memory that a pixel takes.
    pub fn bytes_per_pixel(content: PixelContent) -> u64 {
        let values = SumLayout::new(content).len();
        (size_of::<u32>() + values * size_of::<f64>()) as u64
    }

    /// The pixels, in the whole picture.
    pub fn window(&self) -> Window {
        self.window
    }

    /// The number of the first sample of each pixel.
    pub fn first_sample(&self) -> u32 {
        self.first_sample
    }

    /// The bands of each pixel.
    pub fn bands(&self) -> &BandGrid {
        &self.bands
    }

    /// The light groups, at least one.
    pub fn light_groups(&self) -> &[LightGroup] {
        &self.light_groups
    }

    /// Where the values of a pixel are.
    pub fn layout(&self) -> SumLayout {
        self.layout
    }

    /// Number of samples of each pixel so far, row by row.
    pub fn counts(&self) -> &[u32] {
        &self.counts
    }

    /// All values, pixel by pixel.
    pub fn sums(&self) -> &[f64] {
        &self.sums
    }

    /// All counts and values, to be filled by whoever has kept them.
    pub fn state_mut(&mut self) -> (&mut [u32], &mut [f64]) {
        (&mut self.counts, &mut self.sums)
    }

    /// The values of a pixel, counted row by row.
    ///
    /// # Panics
    /// When there is no such pixel.
    pub fn pixel(&self, index: usize) -> &[f64] {
        &self.sums[index * self.layout.len()..][..self.layout.len()]
    }

    /// The indices of the pixels of each row of a window.
    ///
    /// # Panics
    /// When a part of it lies outside.
    pub fn row_indices(&self, window: Window) -> impl Iterator<Item = Range<usize>> + use<> {
        let own = self.window;
        assert!(own.contains(&window), "{window} of {own}");
        let left = (window.origin[0] - own.origin[0]) as usize;
        let top = window.origin[1] - own.origin[1];
        let (columns, all) = (window.size[0] as usize, own.size[0] as usize);
        (top..top + window.size[1]).map(move |row| {
            let start = row as usize * all + left;
            start..start + columns
        })
    }

    /// Lends the values of the pixels of some windows, to be changed on several threads: for each window a list of its rows.
    /// [`Accumulation::set_counts`] then records what was done.
    ///
    /// # Panics
    /// When a part of a window lies outside, or two overlap.
    pub fn lend(&mut self, windows: &[Window]) -> Vec<Vec<&mut [f64]>> {
        let len = self.layout.len();
        let rows = |(index, window): (usize, &Window)| {
            let rows = self.row_indices(*window);
            rows.map(move |row| (row, index)).collect::<Vec<_>>()
        };
        let mut rows: Vec<_> = windows.iter().enumerate().flat_map(rows).collect();
        rows.sort_by_key(|(row, index)| (row.start, *index));
        let mut lent: Vec<Vec<&mut [f64]>> = windows.iter().map(|_| Vec::new()).collect();
        let (mut rest, mut place) = (&mut self.sums[..], 0);
        for (row, index) in rows {
            assert!(place <= row.start, "windows do not overlap");
            let (_, from_row) = rest.split_at_mut((row.start - place) * len);
            let (own, behind) = from_row.split_at_mut(row.len() * len);
            lent[index].push(own);
            (rest, place) = (behind, row.end);
        }
        lent
    }

    /// Records that the pixels of a window, whose values were lent and advanced, have this number of samples.
    ///
    /// # Panics
    /// When a part of it lies outside.
    pub fn set_counts(&mut self, window: Window, samples: u32) {
        for row in self.row_indices(window) {
            self.counts[row].fill(samples);
        }
    }

    /// Puts back the values of the pixels of a window, which have this number of samples now.
    ///
    /// # Panics
    /// When a part of it lies outside, or there are more or fewer values.
    pub fn store(&mut self, window: Window, values: &[f64], samples: u32) {
        let len = self.layout.len();
        assert_eq!(values.len(), window.pixels() * len, "values of {window}");
        self.set_counts(window, samples);
        let mut rows = values.chunks_exact((window.size[0] as usize * len).max(1));
        for row in self.row_indices(window) {
            if let Some(values) = rows.next() {
                self.sums[row.start * len..row.end * len].copy_from_slice(values);
            }
        }
    }

    /// The rounds that bring all pixels of a window to a number of samples: one for each rectangle of pixels with the same number of
    /// samples, which has fewer.
    ///
    /// # Panics
    /// When a part of the window lies outside.
    pub fn rounds_to(&self, window: Window, samples: u32) -> Vec<Round> {
        let mut rounds: Vec<Round> = Vec::new();
        // Where the rounds of the row before begin.
        let mut above = 0;
        for (row, indices) in self.row_indices(window).enumerate() {
            let of_row = self.runs(indices, samples);
            let y = window.origin[1] + row as u32;
            let made: Vec<Round> = of_row
                .into_iter()
                .map(|(run, count)| Round {
                    window: Window {
                        origin: [window.origin[0] + run.start, y],
                        size: [run.end - run.start, 1],
                    },
                    samples: count..samples,
                })
                .collect();
            let goes_on = rounds[above..].len() == made.len()
                && rounds[above..].iter().zip(&made).all(|(a, b)| {
                    let side = |round: &Round| (round.window.origin[0], round.window.size[0]);
                    side(a) == side(b)
                        && a.samples == b.samples
                        && a.window.end()[1] == u64::from(y)
                });
            if goes_on {
                for round in &mut rounds[above..] {
                    round.window.size[1] += 1;
                }
            } else {
                above = rounds.len();
                rounds.extend(made);
            }
        }
        rounds
    }

    /// Neighbors in a row with the same count below `samples`: their columns and their count.
    fn runs(&self, row: Range<usize>, samples: u32) -> Vec<(Range<u32>, u32)> {
        let mut runs: Vec<(Range<u32>, u32)> = Vec::new();
        for (column, &count) in (0..).zip(&self.counts[row]) {
            if count >= samples {
                continue;
            }
            match runs.last_mut() {
                Some((run, last)) if *last == count && run.end == column => run.end += 1,
                _ => runs.push((column..column + 1, count)),
            }
        }
        runs
    }

    /// The image of some rows, counted from the window's own first one.
    ///
    /// # Panics
    /// When there are no such rows.
    pub fn image(&self, rows: Range<u32>) -> SpectralImage {
        let ([width, height], groups) = (self.window.rows(rows.clone()).size, &self.light_groups);
        let mut image = SpectralImage::with_light_groups(width, height, self.bands, groups.clone());
        if self.layout.is_polarized {
            image = image.with_polarization();
        }
        let start = rows.start as usize * width as usize;
        let counts = &self.counts[start..start + image.samples().len()];
        image.samples_mut().copy_from_slice(counts);
        let rows = image.rows_mut().into_par_iter().enumerate();
        rows.for_each(|(row, mut to)| {
            let first = start + row * width as usize;
            for (key, values) in &mut to.layers {
                self.write_layer(*key, first, values);
            }
        });
        image
    }

    /// Writes a layer of as many pixels as there is room for, from the pixel `first` on.
    fn write_layer(&self, key: LayerKey, first: usize, to: &mut [f32]) {
        let (layout, groups) = (self.layout, self.light_groups.len());
        let to_xyz = KM_LUMENS_PER_WATT * self.bands.width_nm();
        let per_pixel = key.quantity.values_per_pixel(layout.bands);
        for (pixel, to) in (first..).zip(to.chunks_exact_mut(per_pixel)) {
            let sums = self.pixel(pixel);
            let of = |group: usize| match key.quantity {
                Quantity::Xyz => (&sums[layout.component_xyz(group, key.stokes)], to_xyz),
                _ => (&sums[layout.component(group, key.stokes)], 1.0),
            };
            match (key.quantity, key.light_group) {
                (Quantity::Variance, _) => {
                    let factor = variance_of_mean(self.counts[pixel]);
                    write(to, (&sums[layout.deviation()], factor));
                }
                (_, Some(group)) => write(to, of(group)),
                // The total is the sum of the groups as an image holds them.
                (_, None) => (0..groups).for_each(|group| match group {
                    0 => write(to, of(0)),
                    _ => add(to, of(group)),
                }),
            }
        }
    }

    /// XYZ of all pixels, row by row, as in the image.
    pub fn colors(&self) -> Vec<[f32; 3]> {
        let mut colors = vec![[0.0; 3]; self.window.pixels()];
        let some = 4096;
        let chunks = colors.par_chunks_mut(some).enumerate();
        chunks.for_each(|(i, chunk)| {
            self.write_layer(LayerKey::XYZ, i * some, chunk.as_flattened_mut());
        });
        colors
    }

    /// The image of all rows.
    pub fn whole_image(&self) -> SpectralImage {
        self.image(0..self.window.size[1])
    }
}

/// The factor from squared deviations to the variance of the mean, as if samples were independent; 0 below two samples.
pub fn variance_of_mean(samples: u32) -> f64 {
    let n = f64::from(samples);
    if n > 1.0 { 1.0 / (n * (n - 1.0)) } else { 0.0 }
}

fn write(to: &mut [f32], (values, factor): (&[f64], f64)) {
    for (to, value) in to.iter_mut().zip(values) {
        *to = (value * factor) as f32;
    }
}

fn add(to: &mut [f32], (values, factor): (&[f64], f64)) {
    for (to, value) in to.iter_mut().zip(values) {
        *to += (value * factor) as f32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn accumulation(light_groups: usize) -> Accumulation {
        let window = Window {
            origin: [10, 20],
            size: [4, 3],
        };
        let groups = (0..light_groups).map(|i| LightGroup {
            name: format!("g{i}"),
            lamp: None,
        });
        Accumulation::new(
            window,
            0,
            BandGrid::visible(2).unwrap(),
            groups.collect(),
            false,
        )
    }

    fn window(origin: [u32; 2], size: [u32; 2]) -> Window {
        Window { origin, size }
    }

    fn layout(light_groups: usize, is_polarized: bool) -> SumLayout {
        SumLayout::new(PixelContent {
            bands: 5,
            light_groups,
            is_polarized,
        })
    }

    /// The image has each component where the layers say, and the total of the light groups.
    #[test]
    fn the_components_of_polarized_light_reach_the_image() {
        let groups = accumulation(2).light_groups;
        let bands = BandGrid::visible(2).unwrap();
        let mut all = Accumulation::new(Window::whole([1, 1]), 0, bands, groups, true);
        let layout = all.layout();
        let (counts, sums) = all.state_mut();
        counts[0] = 1;
        for (group, stokes) in (0..2).flat_map(|g| Stokes::ALL.map(|s| (g, s))) {
            let value = 10.0 * group as f64 + stokes.index() as f64;
            sums[layout.component(group, stokes)].fill(value);
            sums[layout.component_xyz(group, stokes)].fill(value);
        }
        let image = all.whole_image();
        assert!(image.is_polarized());
        for stokes in Stokes::ALL {
            let of = |key: LayerKey| image.layer(key.component(stokes)).unwrap().floats()[0];
            let own = stokes.index() as f32;
            assert_eq!(of(LayerKey::of_light(Quantity::Radiance, 1)), 10.0 + own);
            assert_eq!(of(LayerKey::RADIANCE), 10.0 + 2.0 * own);
            let factor = (KM_LUMENS_PER_WATT * bands.width_nm()) as f32;
            assert!((of(LayerKey::XYZ) / factor - (10.0 + 2.0 * own)).abs() < 1e-5);
        }
    }

    #[test]
    fn the_values_of_a_pixel_do_not_overlap() {
        for (groups, is_polarized) in [1, 2, 3].into_iter().flat_map(|g| [(g, false), (g, true)]) {
            let layout = layout(groups, is_polarized);
            let mut uses = vec![0; layout.len()];
            let mut used = vec![layout.mean(), layout.deviation()];
            if groups > 1 {
                used.extend((0..groups).map(|group| layout.group_mean(group)));
            }
            used.extend((0..groups).map(|group| layout.xyz(group)));
            if is_polarized {
                for (group, stokes) in (0..groups).flat_map(|g| Stokes::POLARIZED.map(|s| (g, s))) {
                    used.push(layout.component(group, stokes));
                    used.push(layout.component_xyz(group, stokes));
                }
            }
            used.into_iter()
                .flatten()
                .for_each(|index| uses[index] += 1);
            assert!(uses.iter().all(|&count| count == 1), "{groups}: {uses:?}");
        }
        assert_eq!(layout(1, false).group_mean(0), 0..5);
        assert_eq!(layout(1, true).component(0, Stokes::S0), 0..5);
    }

    #[test]
    fn windows_are_lent_and_put_back() {
        let mut all = accumulation(2);
        let len = all.layout().len();
        let inner = window([11, 21], [2, 2]);
        let values: Vec<f64> = (0..4 * len).map(|value| value as f64).collect();
        all.store(inner, &values, 7);
        let mut lent = all.lend(&[window([10, 20], [4, 1]), inner]);
        assert_eq!(lent.remove(1).concat(), values);
        assert!(lent.remove(0).concat().iter().all(|&value| value == 0.0));
        assert_eq!(all.counts(), [0, 0, 0, 0, 0, 7, 7, 0, 0, 7, 7, 0]);
        assert_eq!(all.pixel(6), &values[len..2 * len]);
        assert!(all.pixel(7).iter().all(|&value| value == 0.0));
    }

    /// What is written to a lent row is in its pixels, also where windows are neighbors and out of order.
    #[test]
    fn lent_rows_are_those_of_the_pixels() {
        let mut all = accumulation(1);
        let len = all.layout().len();
        let windows = [
            window([12, 20], [2, 3]),
            window([10, 21], [2, 1]),
            window([10, 20], [2, 1]),
        ];
        let lent = all.lend(&windows);
        for (value, rows) in (1..).zip(lent) {
            for row in rows {
                row.fill(f64::from(value));
            }
        }
        let firsts: Vec<f64> = all.sums().iter().step_by(len).copied().collect();
        let expected = [3, 3, 1, 1, 2, 2, 1, 1, 0, 0, 1, 1].map(f64::from);
        assert_eq!(firsts, expected);
    }

    #[test]
    #[should_panic(expected = "windows do not overlap")]
    fn a_pixel_is_lent_once() {
        let mut all = accumulation(1);
        all.lend(&[window([10, 20], [2, 2]), window([11, 21], [2, 2])]);
    }

    /// Every pixel below the number is in one round, with its own count.
    #[test]
    fn rounds_cover_what_is_missing() {
        let mut all = accumulation(1);
        let whole = all.window();
        let one = all.rounds_to(whole, 4);
        let expected = Round {
            window: whole,
            samples: 0..4,
        };
        assert_eq!(one, [expected]);
        assert_eq!(one[0].work(), 48);
        all.state_mut()
            .0
            .copy_from_slice(&[4, 4, 1, 1, 4, 4, 1, 1, 0, 0, 9, 2]);
        let rounds = all.rounds_to(whole, 4);
        let found: Vec<_> = rounds
            .iter()
            .map(|r| (r.window, r.samples.clone()))
            .collect();
        let expected = [
            (window([12, 20], [2, 2]), 1..4),
            (window([10, 22], [2, 1]), 0..4),
            (window([13, 22], [1, 1]), 2..4),
        ];
        assert_eq!(found, expected);
        assert!(all.rounds_to(window([10, 20], [2, 2]), 4).is_empty());
    }

    /// The same spans in rows that are not neighbors are no rectangle.
    #[test]
    fn rounds_leave_out_finished_rows_between() {
        let mut all = accumulation(1);
        all.state_mut().0[4..8].fill(4);
        let rounds = all.rounds_to(all.window(), 4);
        let rows: Vec<_> = rounds.iter().map(|r| r.window.origin[1]).collect();
        assert_eq!(rows, [20, 22]);
    }

    #[test]
    fn an_image_holds_means_and_variances() {
        let mut all = accumulation(2);
        let layout = all.layout();
        let mut values = vec![0.0; layout.len()];
        values[layout.deviation()].copy_from_slice(&[12.0, 24.0]);
        values[layout.group_mean(0)].copy_from_slice(&[1.0, 2.0]);
        values[layout.group_mean(1)].copy_from_slice(&[0.5, 4.0]);
        values[layout.xyz(1)].copy_from_slice(&[0.0, 1.0, 0.0]);
        all.store(window([13, 22], [1, 1]), &values, 4);
        let image = all.image(2..3);
        assert_eq!((image.width(), image.height()), (4, 1));
        assert_eq!(image.pixel(3, 0), [1.5, 6.0]);
        assert_eq!(image.variance()[6..], [1.0, 2.0]);
        let y = KM_LUMENS_PER_WATT * image.bands().width_nm();
        assert_eq!(image.group_xyz(1)[3], [0.0, y as f32, 0.0]);
        assert_eq!(image.samples(), [0, 0, 0, 4]);
        assert_eq!(all.whole_image().pixel(3, 2), [1.5, 6.0]);
        assert_eq!(all.colors(), all.whole_image().xyz());
        assert_eq!((variance_of_mean(1), variance_of_mean(0)), (0.0, 0.0));
    }

    #[test]
    fn the_bytes_are_those_of_the_lists() {
        for groups in [1, 3] {
            let all = accumulation(groups);
            let bytes = 4 * all.counts().len() + 8 * all.sums().len();
            assert_eq!(
                12 * Accumulation::bytes_per_pixel(all.whole_image().content()),
                bytes as u64
            );
        }
    }
}
