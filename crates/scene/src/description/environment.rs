//! The surroundings as written.

use super::Emission;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What surrounds the objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
#[expect(clippy::large_enum_variant, reason = "a scene has one of them")]
pub enum Environment {
    /// The same radiance from every direction.
    Constant {
        /// The radiance.
        emission: Emission,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, that of all such lights
        /// with this spectrum.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
    /// A mixture by the height of the direction over the horizon.
    Gradient {
        /// Radiance from straight above.
        zenith: Emission,
        /// Radiance from the horizon.
        horizon: Emission,
        /// Radiance from straight below; that of the horizon when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ground: Option<Emission>,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, each of
        /// the three belongs to that of all such lights with its spectrum.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
}
