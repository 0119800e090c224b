//! The output of a renderer: radiance per pixel and band.

use crate::{BandGrid, LightGroup, Stokes};
use thiserror::Error;

mod layer;

pub use layer::{ImageLayer, LayerKey, Quantity, Values};

/// Radiance per pixel and band, with variance and XYZ, in total and by light group: a list of layers.
///
/// The layers of [`LayerKey::all`] are always there; others may follow, such as those of [`LayerKey::polarized`]. Row 0 is at the top. Per-band data is pixel-major: the value
/// of band `b` at (x, y) has the index `(y·width + x)·bands + b`.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralImage {
    width: u32,
    height: u32,
    bands: BandGrid,
    light_groups: Vec<LightGroup>,
    layers: Vec<ImageLayer>,
}

/// What the pixels of an image hold, which decides over their size.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct PixelContent {
    /// Number of bands.
    pub bands: u32,
    /// Number of light groups.
    pub light_groups: usize,
    /// Whether all components of the Stokes vector are there, or the radiance alone.
    pub is_polarized: bool,
}

/// Why layers do not make an image.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum LayerError {
    /// Every image has this layer.
    #[error("the image lacks the layer {0:?}")]
    Missing(LayerKey),
    /// A layer is there twice.
    #[error("the image has the layer {0:?} twice")]
    Repeated(LayerKey),
    /// A layer is of a light group that the image does not have, or of the only one, which is the total.
    #[error("the layer {0:?} is of no light group that the image keeps apart")]
    LightGroup(LayerKey),
    /// A layer has another number or kind of values than its pixels need.
    #[error("the values of the layer {0:?} do not fit the size and bands of the image")]
    Shape(LayerKey),
}

/// One row of an image, mutably borrowed.
#[derive(Debug)]
pub struct RowMut<'a> {
    /// What each layer of the image holds, and its values in this row. Counts are not among them.
    pub layers: Vec<(LayerKey, &'a mut [f32])>,
}

impl<'a> RowMut<'a> {
    /// Takes the values of a layer out of the row; none if it has no such layer.
    pub fn take(&mut self, key: LayerKey) -> &'a mut [f32] {
        let mut layers = self.layers.iter_mut();
        let found = layers.find(|(own, _)| *own == key);
        found.map_or(&mut [], |(_, values)| std::mem::take(values))
    }
}

impl SpectralImage {
    /// Creates a black image without samples, with a single light group whose illuminant is unknown.
    pub fn new(width: u32, height: u32, bands: BandGrid) -> Self {
        Self::with_light_groups(width, height, bands, vec![LightGroup::unknown()])
    }

    /// Creates a black image without samples.
    ///
    /// # Panics
    /// When `light_groups` is empty.
    pub fn with_light_groups(
        width: u32,
        height: u32,
        bands: BandGrid,
        light_groups: Vec<LightGroup>,
    ) -> Self {
        assert!(!light_groups.is_empty(), "an image has a light group");
        let pixels = width as usize * height as usize;
        let zeros = |key| ImageLayer::zeros(key, bands.count() as usize, pixels);
        Self {
            width,
            height,
            bands,
            layers: LayerKey::all(light_groups.len()).map(zeros).collect(),
            light_groups,
        }
    }

    /// Adds black layers of S1, S2 and S3, for polarized light.
    #[must_use]
    pub fn with_polarization(mut self) -> Self {
        let (bands, pixels) = (self.bands.count() as usize, self.samples().len());
        let missing = LayerKey::polarized(self.light_groups.len())
            .filter(|key| self.layer(*key).is_none())
            .map(|key| ImageLayer::zeros(key, bands, pixels));
        let missing: Vec<_> = missing.collect();
        self.layers.extend(missing);
        self
    }

    /// Removes the layers of S1, S2 and S3.
    pub fn remove_polarization(&mut self) {
        self.layers.retain(|layer| layer.key().stokes == Stokes::S0);
    }

    /// Whether it holds all components of polarized light.
    pub fn is_polarized(&self) -> bool {
        LayerKey::polarized(self.light_groups.len()).all(|key| self.layer(key).is_some())
    }

    /// Creates an image from its layers: those of [`LayerKey::all`], and any others, in any order.
    ///
    /// # Errors
    /// When a layer is missing or there twice, is of an unknown light group, or does not fit the size and the bands.
    ///
    /// # Panics
    /// When `light_groups` is empty.
    pub fn from_layers(
        [width, height]: [u32; 2],
        bands: BandGrid,
        light_groups: Vec<LightGroup>,
        layers: Vec<ImageLayer>,
    ) -> Result<Self, LayerError> {
        assert!(!light_groups.is_empty(), "an image has a light group");
        let pixels = width as usize * height as usize;
        let apart = LayerKey::groups_apart(light_groups.len());
        for (i, layer) in layers.iter().enumerate() {
            let key = layer.key();
            if layers[..i].iter().any(|other| other.key() == key) {
                return Err(LayerError::Repeated(key));
            }
            if key.light_group.is_some_and(|group| group >= apart) {
                return Err(LayerError::LightGroup(key));
            }
            if !layer.fits(bands.count() as usize, pixels) {
                return Err(LayerError::Shape(key));
            }
        }
        let lacks = |key: &LayerKey| layers.iter().all(|layer| layer.key() != *key);
        if let Some(key) = LayerKey::all(light_groups.len()).find(lacks) {
            return Err(LayerError::Missing(key));
        }
        Ok(Self {
            width,
            height,
            bands,
            light_groups,
            layers,
        })
    }

    /// Bytes of memory that an image of this size takes.
    pub fn bytes(width: u32, height: u32, content: PixelContent) -> u128 {
        let values = |key: LayerKey| key.quantity.values_per_pixel(content.bands as usize) as u128;
        let groups = content.light_groups;
        let mut per_pixel: u128 = LayerKey::all(groups).map(values).sum();
        if content.is_polarized {
            per_pixel += LayerKey::polarized(groups).map(values).sum::<u128>();
        }
        u128::from(width) * u128::from(height) * 4 * per_pixel
    }

    /// What its pixels hold.
    pub fn content(&self) -> PixelContent {
        PixelContent {
            bands: self.bands.count(),
            light_groups: self.light_groups.len(),
            is_polarized: self.is_polarized(),
        }
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The bands of each pixel.
    pub fn bands(&self) -> &BandGrid {
        &self.bands
    }

    /// All layers.
    pub fn layers(&self) -> &[ImageLayer] {
        &self.layers
    }

    /// The layer that holds this, if there is one.
    pub fn layer(&self, key: LayerKey) -> Option<&ImageLayer> {
        self.layers.iter().find(|layer| layer.key() == key)
    }

    /// Mean radiance over each band, W m⁻² sr⁻¹ nm⁻¹ up to the scale of the scene; pixel-major.
    pub fn radiance(&self) -> &[f32] {
        self.floats(LayerKey::RADIANCE)
    }

    /// Variance of the mean for each value of [`Self::radiance`]; 0 if fewer than two samples were taken.
    pub fn variance(&self) -> &[f32] {
        self.floats(LayerKey::VARIANCE)
    }

    /// CIE 1931 2° XYZ of each pixel, summed at the exact wavelengths sampled: Y in cd/m² up to the scale of the scene.
    pub fn xyz(&self) -> &[[f32; 3]] {
        self.floats(LayerKey::XYZ).as_chunks().0
    }

    /// Number of samples of each pixel.
    pub fn samples(&self) -> &[u32] {
        let layer = self.layer(LayerKey::SAMPLES);
        layer.map_or(&[], ImageLayer::counts)
    }

    /// The spectrum of pixel (x, y), one value per band.
    ///
    /// # Panics
    /// When the pixel lies outside the image.
    pub fn pixel(&self, x: u32, y: u32) -> &[f32] {
        let bands = self.bands.count() as usize;
        let start = self.pixel_index(x, y) * bands;
        &self.radiance()[start..start + bands]
    }

    /// The light groups, at least one. Their radiances add up to the total.
    pub fn light_groups(&self) -> &[LightGroup] {
        &self.light_groups
    }

    /// What holds a quantity of a light group: the total if there is only one group.
    ///
    /// # Panics
    /// When there is no such light group.
    pub fn key_of(&self, quantity: Quantity, light_group: usize) -> LayerKey {
        let groups = self.light_groups.len();
        assert!(light_group < groups, "one of the {groups} light groups");
        if groups > 1 {
            LayerKey::of_light(quantity, light_group)
        } else {
            LayerKey::total(quantity)
        }
    }

    /// Radiance due to the emitters of a group; otherwise as [`Self::radiance`].
    ///
    /// # Panics
    /// When there is no such light group.
    pub fn group_radiance(&self, light_group: usize) -> &[f32] {
        self.floats(self.key_of(Quantity::Radiance, light_group))
    }

    /// XYZ due to the emitters of a group; otherwise as [`Self::xyz`].
    ///
    /// # Panics
    /// When there is no such light group.
    pub fn group_xyz(&self, light_group: usize) -> &[[f32; 3]] {
        let key = self.key_of(Quantity::Xyz, light_group);
        self.floats(key).as_chunks().0
    }

    /// Writes pixel (x, y) of an image with one light group: the mean and the variance of the mean per band, XYZ and
    /// sample count.
    ///
    /// # Panics
    /// When the pixel lies outside the image, a slice does not have one value per band, or there are several light groups.
    pub fn set_pixel(
        &mut self,
        at: (u32, u32),
        radiance: &[f32],
        variance: &[f32],
        xyz: [f32; 3],
        samples: u32,
    ) {
        self.set_pixel_by_light(at, radiance, variance, &[xyz], samples);
    }

    /// Writes pixel (x, y): the mean radiance as `[light group][band]`, the variance of the mean of the total per band, XYZ
    /// of each light group, and the sample count. The totals are the sums over the light groups in their order. Layers that only some
    /// images have keep their values.
    ///
    /// # Panics
    /// When the pixel lies outside the image, or a slice has the wrong length.
    pub fn set_pixel_by_light(
        &mut self,
        (x, y): (u32, u32),
        radiance: &[f32],
        variance: &[f32],
        xyz: &[[f32; 3]],
        samples: u32,
    ) {
        let groups = self.light_groups.len();
        let bands = self.bands.count() as usize;
        assert_eq!(radiance.len(), groups * bands, "one value per band");
        assert_eq!(variance.len(), bands, "one variance per band");
        assert_eq!(xyz.len(), groups, "one color per light group");
        let pixel = self.pixel_index(x, y);
        for layer in &mut self.layers {
            let values = layer.values_of(pixel);
            match layer.key() {
                LayerKey::VARIANCE => layer.floats_mut()[values].copy_from_slice(variance),
                LayerKey::SAMPLES => layer.counts_mut()[pixel] = samples,
                _ => {}
            }
        }
        self.put_component(pixel, Stokes::S0, radiance, xyz);
    }

    /// Writes a component of the Stokes vector of pixel (x, y): its radiance as `[light group][band]`, and XYZ of each light group. The
    /// totals are the sums over the light groups in their order. Nothing is written if the image does not hold the component.
    ///
    /// # Panics
    /// When the pixel lies outside the image, or a slice has the wrong length.
    pub fn set_component_by_light(
        &mut self,
        (x, y): (u32, u32),
        stokes: Stokes,
        radiance: &[f32],
        xyz: &[[f32; 3]],
    ) {
        let groups = self.light_groups.len();
        let bands = self.bands.count() as usize;
        assert_eq!(radiance.len(), groups * bands, "one value per band");
        assert_eq!(xyz.len(), groups, "one color per light group");
        self.put_component(self.pixel_index(x, y), stokes, radiance, xyz);
    }

    fn put_component(&mut self, pixel: usize, stokes: Stokes, radiance: &[f32], xyz: &[[f32; 3]]) {
        for layer in &mut self.layers {
            let (key, values) = (layer.key(), layer.values_of(pixel));
            let given = match key.quantity {
                _ if key.stokes != stokes => continue,
                Quantity::Radiance => radiance,
                Quantity::Xyz => xyz.as_flattened(),
                Quantity::Variance | Quantity::Samples => continue,
            };
            let own = &mut layer.floats_mut()[values];
            match key.light_group {
                None => sum(own, given),
                Some(group) => own.copy_from_slice(&given[group * own.len()..][..own.len()]),
            }
        }
    }

    /// Mean radiance of a component of the Stokes vector due to the emitters of a group; otherwise as [`Self::radiance`]. Empty if the
    /// image does not hold the component.
    ///
    /// # Panics
    /// When there is no such light group.
    pub fn group_component(&self, light_group: usize, stokes: Stokes) -> &[f32] {
        self.floats(
            self.key_of(Quantity::Radiance, light_group)
                .component(stokes),
        )
    }

    /// XYZ of a component of the Stokes vector due to the emitters of a group. Empty if the image does not hold the component.
    ///
    /// # Panics
    /// When there is no such light group.
    pub fn group_component_xyz(&self, light_group: usize, stokes: Stokes) -> &[[f32; 3]] {
        let key = self.key_of(Quantity::Xyz, light_group).component(stokes);
        self.floats(key).as_chunks().0
    }

    /// Number of samples of each pixel, to be changed.
    pub fn samples_mut(&mut self) -> &mut [u32] {
        let mut layers = self.layers.iter_mut();
        let layer = layers.find(|layer| layer.key() == LayerKey::SAMPLES);
        layer.map_or(&mut [], ImageLayer::counts_mut)
    }

    /// A light group, to be changed together with the values of [`Self::rows_mut`].
    ///
    /// # Panics
    /// When there is no such light group.
    pub fn light_group_mut(&mut self, light_group: usize) -> &mut LightGroup {
        &mut self.light_groups[light_group]
    }

    /// All rows from the top, to be changed independently. A caller that changes layers of light groups must keep their sum equal to
    /// the total.
    pub fn rows_mut(&mut self) -> Vec<RowMut<'_>> {
        let width = (self.width as usize).max(1);
        let row = || RowMut { layers: Vec::new() };
        let mut rows: Vec<_> = (0..self.height).map(|_| row()).collect();
        for layer in &mut self.layers {
            let (key, values) = (layer.key(), width * layer.values_per_pixel());
            for (row, own) in rows.iter_mut().zip(layer.floats_mut().chunks_mut(values)) {
                row.layers.push((key, own));
            }
        }
        rows
    }

    /// The values of a layer that every image has.
    fn floats(&self, key: LayerKey) -> &[f32] {
        self.layer(key).map_or(&[], ImageLayer::floats)
    }

    fn pixel_index(&self, x: u32, y: u32) -> usize {
        assert!(
            x < self.width && y < self.height,
            "pixel ({x}, {y}) lies outside the image of {}×{}",
            self.width,
            self.height
        );
        y as usize * self.width as usize + x as usize
    }
}

/// Adds up values of one or several light groups, one group after the other.
fn sum(total: &mut [f32], groups: &[f32]) {
    let (first, more) = groups.split_at(total.len());
    total.copy_from_slice(first);
    for group in more.chunks_exact(total.len()) {
        for (sum, value) in total.iter_mut().zip(group) {
            *sum += value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(names: &[&str]) -> SpectralImage {
        let group = |name: &&str| LightGroup {
            name: (*name).to_owned(),
            lamp: None,
        };
        let groups = names.iter().map(group).collect();
        SpectralImage::with_light_groups(3, 2, BandGrid::visible(2).unwrap(), groups)
    }

    #[test]
    fn the_total_is_the_sum_of_the_light_groups() {
        let mut image = image(&["key", "sky"]);
        let xyz = [[1.0, 2.0, 3.0], [0.5, 0.25, 0.125]];
        image.set_pixel_by_light((2, 1), &[1.0, 2.0, 0.5, 4.0], &[0.1, 0.2], &xyz, 7);
        assert_eq!(image.pixel(2, 1), [1.5, 6.0]);
        assert_eq!(image.xyz()[5], [1.5, 2.25, 3.125]);
        assert_eq!(image.group_radiance(1)[10..], [0.5, 4.0]);
        assert_eq!(image.group_xyz(0)[5], xyz[0]);
        assert_eq!((image.variance()[11], image.samples()[5]), (0.2, 7));
        let rows = image.rows_mut();
        assert_eq!(rows.len(), 2);
        let (key, values) = &rows[1].layers[5];
        assert_eq!(*key, LayerKey::of_light(Quantity::Radiance, 1));
        assert_eq!(**values, [0.0, 0.0, 0.0, 0.0, 0.5, 4.0]);
    }

    #[test]
    fn a_polarized_image_has_all_components_of_all_light_groups() {
        for names in [&["a"][..], &["a", "b"]] {
            let plain = image(names);
            let mut polarized = plain.clone().with_polarization();
            assert!(polarized.is_polarized() && !plain.is_polarized());
            assert_eq!(polarized.clone().with_polarization(), polarized);
            let groups = if names.len() > 1 { names.len() } else { 0 };
            assert_eq!(
                polarized.layers().len(),
                plain.layers().len() + 3 * (2 + 2 * groups)
            );
            let key = LayerKey::RADIANCE.component(Stokes::S2);
            assert_eq!(polarized.layer(key).unwrap().floats().len(), 12);
            // Setting S0 leaves the others.
            let (values, xyz) = (vec![1.0; 2 * names.len()], vec![[1.0; 3]; names.len()]);
            polarized.set_pixel_by_light((0, 0), &values, &[0.0; 2], &xyz, 1);
            assert_eq!(polarized.layer(key).unwrap().floats(), [0.0; 12]);
        }
    }

    #[test]
    fn one_light_group_is_the_total_and_is_kept_once() {
        let mut image = SpectralImage::new(3, 2, BandGrid::visible(2).unwrap());
        image.set_pixel((0, 0), &[1.0, -0.0], &[0.0; 2], [1.0; 3], 1);
        assert_eq!(image.group_radiance(0).as_ptr(), image.radiance().as_ptr());
        assert_eq!(image.group_xyz(0), image.xyz());
        assert_eq!(
            (image.layers().len(), image.rows_mut()[0].layers.len()),
            (4, 3)
        );
        assert_eq!(image.pixel(0, 0)[1].to_bits(), (-0.0_f32).to_bits());
    }

    #[test]
    fn the_bytes_are_those_of_the_lists() {
        for names in [&["a"][..], &["a", "b", "c"]] {
            for image in [image(names), image(names).with_polarization()] {
                let lists: usize = image.layers.iter().map(|l| 4 * l.values().len()).sum();
                assert_eq!(SpectralImage::bytes(3, 2, image.content()), lists as u128);
            }
        }
    }

    /// The layers of a black image of 3×2 pixels, two bands and two light groups, after a change.
    fn made(change: impl Fn(&mut Vec<ImageLayer>)) -> Result<SpectralImage, LayerError> {
        let image = image(&["key", "sky"]);
        let mut layers = image.layers;
        change(&mut layers);
        SpectralImage::from_layers([3, 2], image.bands, image.light_groups, layers)
    }

    #[test]
    fn a_list_of_layers_describes_an_image() {
        assert_eq!(made(|_| {}), Ok(image(&["key", "sky"])));
        let of_sky = LayerKey::of_light(Quantity::Variance, 1);
        let mut more = made(|layers| {
            layers.reverse();
            layers.push(ImageLayer::zeros(of_sky, 2, 6));
        })
        .unwrap();
        let xyz = [[1.0; 3], [2.0; 3]];
        more.set_pixel_by_light((1, 0), &[1.0, 2.0, 4.0, 8.0], &[0.5; 2], &xyz, 3);
        assert_eq!(more.pixel(1, 0), [5.0, 10.0]);
        assert_eq!((more.xyz()[1], more.samples()[1]), ([3.0; 3], 3));
        assert_eq!(more.layer(of_sky).unwrap().floats(), [0.0; 12]);
        assert_eq!(more.layers().len(), 9);
        let units: Vec<_> = more
            .layers()
            .iter()
            .map(|l| l.key().quantity.unit())
            .collect();
        assert_eq!(units[8], "W^2.m^-4.sr^-2.nm^-2");
        let mut row = more.rows_mut().remove(1);
        assert_eq!(row.take(of_sky).len(), 6);
        assert!(row.take(of_sky).is_empty());
    }

    #[test]
    fn layers_that_do_not_fit_are_refused() {
        let radiance = LayerKey::RADIANCE;
        let variance = LayerKey::VARIANCE;
        let with = |key, bands, values| {
            move |layers: &mut Vec<ImageLayer>| {
                layers[1] = ImageLayer::new(key, bands, Values::Floats(vec![0.0; values]));
            }
        };
        assert_eq!(
            made(with(radiance, 2, 12)),
            Err(LayerError::Repeated(radiance))
        );
        assert_eq!(
            made(with(variance, 2, 11)),
            Err(LayerError::Shape(variance))
        );
        assert_eq!(
            made(with(variance, 3, 18)),
            Err(LayerError::Shape(variance))
        );
        let third = LayerKey::of_light(Quantity::Radiance, 2);
        assert_eq!(made(with(third, 2, 12)), Err(LayerError::LightGroup(third)));
        let missing = made(|layers| drop(layers.remove(6)));
        let sky = LayerKey::of_light(Quantity::Radiance, 1);
        assert_eq!(missing, Err(LayerError::Missing(sky)));
        let counts = |layers: &mut Vec<ImageLayer>| {
            layers[1] = ImageLayer::new(variance, 2, Values::Counts(vec![0; 12]));
        };
        assert_eq!(made(counts), Err(LayerError::Shape(variance)));
        // The only light group is the total.
        let one = image(&["key"]);
        let mut layers = one.layers;
        let own = LayerKey::of_light(Quantity::Xyz, 0);
        layers.push(ImageLayer::zeros(own, 2, 6));
        let found = SpectralImage::from_layers([3, 2], one.bands, one.light_groups, layers);
        assert_eq!(found, Err(LayerError::LightGroup(own)));
    }
}
