//! Indices into the lists of a validated scene.

/// Index of a spectrum in [`Scene::spectra`](crate::Scene::spectra).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SpectrumId(pub(crate) u32);

impl SpectrumId {
    /// The spectrum at this position in the list.
    pub fn new(index: usize) -> Self {
        Self(index as u32)
    }

    /// The position in the list.
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The spectrum this many positions after this one.
    #[must_use]
    pub fn after(self, places: usize) -> Self {
        Self(self.0 + places as u32)
    }
}

/// Index of a light group in [`Scene::light_groups`](crate::Scene::light_groups).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LightGroupId(pub(crate) u32);

impl LightGroupId {
    /// The light group at this position in the list.
    pub fn new(index: usize) -> Self {
        Self(index as u32)
    }

    /// The position in the list.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Index of a material in [`Scene::materials`](crate::Scene::materials).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MaterialId(pub(crate) u32);

impl MaterialId {
    /// The material at this position in the list.
    pub fn new(index: usize) -> Self {
        Self(index as u32)
    }

    /// The position in the list.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}
