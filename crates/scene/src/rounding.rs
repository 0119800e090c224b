//! Numbers as a GPU receives them: rounded to the nearest `f32`. Each type of a scene says in its own file how it is rounded.

use glam::DVec3;

/// Rounds every `f64` of a value to the nearest `f32` and keeps the rest.
pub(crate) trait RoundToF32 {
    fn rounded(&self) -> Self;
}

impl RoundToF32 for f64 {
    fn rounded(&self) -> Self {
        f64::from(*self as f32)
    }
}

impl RoundToF32 for DVec3 {
    fn rounded(&self) -> Self {
        self.as_vec3().as_dvec3()
    }
}

impl<T: RoundToF32> RoundToF32 for Vec<T> {
    fn rounded(&self) -> Self {
        self.iter().map(T::rounded).collect()
    }
}

impl RoundToF32 for spectra::BandTable {
    fn rounded(&self) -> Self {
        self.map(|value| value.rounded())
    }
}
