//! Tables that both renderers look up, computed with [`optics`] from the materials of a scene.
//!
//! What both renderers share cannot be checked by comparing them, so it is little, and proved by itself: estimates that steer sampling
//! and cancel in the result, the albedo of facets, and the reflectance of rough coats.

mod coats;
mod energy;
mod estimate;

pub use coats::RoughCoat;
pub use energy::energy;
pub use estimate::estimates;

use scene::Distribution;

fn distribution_of(distribution: Distribution) -> optics::Distribution {
    match distribution {
        Distribution::Beckmann => optics::Distribution::Beckmann,
        Distribution::Ggx => optics::Distribution::Ggx,
    }
}
