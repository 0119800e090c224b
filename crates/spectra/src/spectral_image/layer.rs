//! The layers of a spectral image: what each holds, and its values.

use crate::Stokes;

/// What the values of a layer are.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Quantity {
    /// Mean radiance over each band, up to the scale of the scene.
    Radiance,
    /// Variance of the mean radiance of each band; 0 if fewer than two samples were taken.
    Variance,
    /// CIE 1931 2° XYZ, summed at the exact wavelengths sampled; Y is a luminance up to the scale of the scene.
    Xyz,
    /// Number of samples.
    Samples,
}

impl Quantity {
    /// The unit, in the spelling of spectral `OpenEXR` files.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Radiance => "W.m^-2.sr^-1.nm^-1",
            Self::Variance => "W^2.m^-4.sr^-2.nm^-2",
            Self::Xyz => "cd.m^-2",
            Self::Samples => "1",
        }
    }

    /// Number of values of each pixel of an image with this number of bands.
    pub fn values_per_pixel(self, bands: usize) -> usize {
        match self {
            Self::Radiance | Self::Variance => bands,
            Self::Xyz => 3,
            Self::Samples => 1,
        }
    }
}

/// What a layer holds, and whose light it is.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct LayerKey {
    /// What its values are.
    pub quantity: Quantity,
    /// Index of the light group whose light it is; `None` for all light.
    pub light_group: Option<usize>,
    /// The component of the Stokes vector. Variances and samples are only those of S0.
    pub stokes: Stokes,
}

impl LayerKey {
    /// Radiance of all light.
    pub const RADIANCE: Self = Self::total(Quantity::Radiance);
    /// Variance of the radiance of all light.
    pub const VARIANCE: Self = Self::total(Quantity::Variance);
    /// XYZ of all light.
    pub const XYZ: Self = Self::total(Quantity::Xyz);
    /// Number of samples.
    pub const SAMPLES: Self = Self::total(Quantity::Samples);

    /// A quantity of all light.
    pub const fn total(quantity: Quantity) -> Self {
        Self {
            quantity,
            light_group: None,
            stokes: Stokes::S0,
        }
    }

    /// A quantity of the light of one light group.
    pub fn of_light(quantity: Quantity, light_group: usize) -> Self {
        Self {
            quantity,
            light_group: Some(light_group),
            stokes: Stokes::S0,
        }
    }

    /// The same quantity of a component of the Stokes vector.
    #[must_use]
    pub const fn component(self, stokes: Stokes) -> Self {
        Self { stokes, ..self }
    }

    /// The number of light groups with layers of their own.
    pub(super) fn groups_apart(light_groups: usize) -> usize {
        if light_groups > 1 { light_groups } else { 0 }
    }

    /// The layers that every image with this number of light groups has, in order. A single light group has none of its own: it is
    /// the total.
    pub fn all(light_groups: usize) -> impl Iterator<Item = Self> {
        let of_group = |group| {
            [Quantity::Radiance, Quantity::Xyz].map(|quantity| Self::of_light(quantity, group))
        };
        let totals = [Self::RADIANCE, Self::VARIANCE, Self::XYZ, Self::SAMPLES];
        totals
            .into_iter()
            .chain((0..Self::groups_apart(light_groups)).flat_map(of_group))
    }

    /// The layers that an image of polarized light has besides those of [`Self::all`]: radiance and XYZ of S1, S2 and S3, component by
    /// component, in total and of each light group.
    pub fn polarized(light_groups: usize) -> impl Iterator<Item = Self> {
        Stokes::POLARIZED.into_iter().flat_map(move |stokes| {
            let of_s0 = Self::all(light_groups).filter(|key| key.has_components());
            of_s0.map(move |key| key.component(stokes))
        })
    }

    /// Whether the quantity has all components of the Stokes vector.
    pub fn has_components(self) -> bool {
        matches!(self.quantity, Quantity::Radiance | Quantity::Xyz)
    }
}

/// Values of pixels.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Of every quantity but [`Quantity::Samples`].
    Floats(Vec<f32>),
    /// Of [`Quantity::Samples`].
    Counts(Vec<u32>),
}

impl Values {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Floats(values) => values.len(),
            Self::Counts(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A quantity of every pixel of an image.
///
/// Row 0 is at the top. The values of a pixel are neighbors: value `i` of the pixel at (x, y) has the index
/// `(y·width + x)·values_per_pixel + i`.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageLayer {
    key: LayerKey,
    values_per_pixel: usize,
    values: Values,
}

impl ImageLayer {
    /// Creates a layer for an image with this number of bands. [`SpectralImage::from_layers`](crate::SpectralImage::from_layers)
    /// checks the values.
    pub fn new(key: LayerKey, bands: usize, values: Values) -> Self {
        Self {
            key,
            values_per_pixel: key.quantity.values_per_pixel(bands),
            values,
        }
    }

    /// Creates a layer of zeros.
    pub fn zeros(key: LayerKey, bands: usize, pixels: usize) -> Self {
        let count = pixels * key.quantity.values_per_pixel(bands);
        let values = match key.quantity {
            Quantity::Samples => Values::Counts(vec![0; count]),
            _ => Values::Floats(vec![0.0; count]),
        };
        Self::new(key, bands, values)
    }

    /// What it holds, and whose light it is.
    pub fn key(&self) -> LayerKey {
        self.key
    }

    /// Number of values of each pixel.
    pub fn values_per_pixel(&self) -> usize {
        self.values_per_pixel
    }

    /// All values.
    pub fn values(&self) -> &Values {
        &self.values
    }

    /// All values; none if they are counts.
    pub fn floats(&self) -> &[f32] {
        match &self.values {
            Values::Floats(values) => values,
            Values::Counts(_) => &[],
        }
    }

    /// All values; none if they are not counts.
    pub fn counts(&self) -> &[u32] {
        match &self.values {
            Values::Counts(values) => values,
            Values::Floats(_) => &[],
        }
    }

    /// All values, to be changed; none if they are counts.
    pub fn floats_mut(&mut self) -> &mut [f32] {
        match &mut self.values {
            Values::Floats(values) => values,
            Values::Counts(_) => &mut [],
        }
    }

    /// All values, to be changed; none if they are not counts.
    pub fn counts_mut(&mut self) -> &mut [u32] {
        match &mut self.values {
            Values::Counts(values) => values,
            Values::Floats(_) => &mut [],
        }
    }

    /// The indices of the values of a pixel, counted row by row.
    pub fn values_of(&self, pixel: usize) -> std::ops::Range<usize> {
        pixel * self.values_per_pixel..(pixel + 1) * self.values_per_pixel
    }

    /// Whether the values are of the right kind, and as many as the pixels need.
    pub(super) fn fits(&self, bands: usize, pixels: usize) -> bool {
        let per_pixel = self.key.quantity.values_per_pixel(bands);
        let are_counts = matches!(self.values, Values::Counts(_));
        self.values_per_pixel == per_pixel
            && self.values.len() == pixels * per_pixel
            && are_counts == (self.key.quantity == Quantity::Samples)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_light_group_has_no_layers_of_its_own() {
        assert_eq!(LayerKey::all(1).count(), 4);
        let keys: Vec<_> = LayerKey::all(2).collect();
        assert_eq!(keys.len(), 8);
        assert_eq!(keys[0], LayerKey::RADIANCE);
        assert_eq!(keys[7], LayerKey::of_light(Quantity::Xyz, 1));
        for (i, key) in keys.iter().enumerate() {
            assert!(!keys[..i].contains(key));
        }
    }

    #[test]
    fn a_layer_describes_its_values() {
        let layer = ImageLayer::zeros(LayerKey::XYZ, 5, 4);
        assert_eq!((layer.values_per_pixel(), layer.values().len()), (3, 12));
        assert_eq!(layer.values_of(2), 6..9);
        assert_eq!((layer.floats().len(), layer.counts().len()), (12, 0));
        let samples = ImageLayer::zeros(LayerKey::SAMPLES, 5, 4);
        assert_eq!((samples.floats().len(), samples.counts().len()), (0, 4));
        let radiance = ImageLayer::zeros(LayerKey::RADIANCE, 5, 4);
        assert!(radiance.fits(5, 4) && !radiance.fits(4, 5) && !radiance.fits(5, 3));
    }
}
