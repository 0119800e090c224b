//! The numbers that a shader is made for.

use crate::layout::constant;

/// Declares a struct of numbers, each with the name of its constant in WGSL.
macro_rules! counts {
    ($(
        #[doc = $about:literal]
        pub struct $type:ident {
            $(#[doc = $doc:literal] $field:ident = $name:literal,)*
        }
    )*) => {$(
        #[doc = $about]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $type {
            $(#[doc = $doc] pub $field: u32,)*
        }

        impl $type {
            /// The smallest value of each.
            pub const MIN: Self = Self { $($field: 1,)* };

            /// Returns the constants as WGSL.
            pub(crate) fn wgsl(self) -> String {
                [$(constant($doc, $name, "u32", &format!("{}u", self.$field)),)*].concat()
            }
        }
    )*};
}

counts! {
    /// Numbers of passes of the loops over all things of a kind.
    pub struct Counts {
        /// Objects that rays meet.
        objects = "OBJECT_COUNT",
        /// Rows of the hierarchy of boxes around the objects.
        hierarchy_rows = "HIERARCHY_ROWS",
        /// Emitters that are chosen from.
        emitters = "EMITTER_COUNT",
        /// Parts of the environment, including disks in the sky.
        environment_parts = "ENVIRONMENT_COUNT",
        /// Groups of four bands; the last may be padded with dark bands.
        groups = "GROUPS",
        /// Maximum number of segments of a path.
        max_path_segments = "MAX_PATH_SEGMENTS",
        /// Segments after which Russian roulette may end a path.
        roulette_after = "ROULETTE_AFTER",
    }

    /// The maximum length of a path's record, and the number of light groups.
    pub struct RecordLimits {
        /// Vertices of a path.
        vertices = "MAX_VERTICES",
        /// Films that all emitter samples of a path cross together.
        crossings = "MAX_CROSSINGS",
        /// Thicknesses of layers that vary over a surface, for all vertices and crossings together; 1 where none varies.
        thicknesses = "MAX_THICKNESSES",
        /// Light groups.
        light_groups = "LIGHT_GROUPS",
        /// Films at which a path is split, 1 where it is never split.
        splits = "MAX_SPLITS",
    }
}
