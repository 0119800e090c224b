//! The instruction sets with which spectra are computed.

use pulp::Arch;

/// A level of a machine's instructions.
///
/// All levels with a fused multiply-add (AVX2 with FMA, AVX-512, NEON) do the same operations in the same order and give the same
/// bits, with one exception: layers with n < 1 at an angle at which only some of neighboring bands are totally reflected, where the
/// number of lanes decides between two forms of the same matrix. In this case, and with the baseline, which rounds twice, the last
/// digits of an `f64` differ.
#[derive(Clone, Copy, Debug)]
pub struct SimdLevel(pub(crate) Arch);

impl SimdLevel {
    /// Returns the highest level that the machine has.
    pub fn best() -> Self {
        Self(Arch::new())
    }

    /// Returns the level that every machine has.
    pub fn baseline() -> Self {
        Self(Arch::Scalar)
    }

    /// Whether products and sums are rounded once: such levels give the same bits.
    pub fn has_fused_multiply_add(&self) -> bool {
        !matches!(self.0, Arch::Scalar)
    }

    /// Returns the name of the level.
    pub fn name(&self) -> &'static str {
        match self.0 {
            Arch::Scalar => "baseline",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Arch::V3(_) => "AVX2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Arch::V4(_) => "AVX-512",
            #[cfg(target_arch = "aarch64")]
            Arch::Neon(_) => "NEON",
            _ => "other",
        }
    }
}
