//! The contents of uniform buffers, and of the tables of a batch of stacks.

use super::declare::{Body, Declaration, Member, Shared, larger};

structs! { STRUCTS, Struct;
    /// Values for a whole render.
    pub struct Frame {
        /// Position of the camera.
        pub camera_origin: [f32; 3],
        /// Chooses the sequence of random numbers.
        pub seed: u32,
        /// +X of camera space: to the right in the picture.
        pub camera_right: [f32; 3],
        /// Half the picture's height: at distance 1, or in scene units when orthographic.
        pub half_height: f32,
        /// +Y of camera space: up in the picture.
        pub camera_up: [f32; 3],
        /// Lower end of the first band, nm.
        pub band_min_nm: f32,
        /// +Z of camera space: opposite to the direction of view.
        pub camera_back: [f32; 3],
        /// Width of a band, nm.
        pub band_width_nm: f32,
        /// Width and height of the picture in pixels.
        pub image_size: [u32; 2],
        /// Number of steps between the spectra's knots in a band.
        pub steps: u32,
        /// 1 where each sample draws its wavelengths, 0 where they are at the bands' centers.
        pub draws_wavelengths: u32,
        /// First of the numbers that are the emitter indices of the parts of the environment, including disks in the sky.
        pub first_environment: u32,
        /// Index of the first of the observer's three spectra.
        pub observer: u32,
        /// Number of film hits, the first of a path, at which it is split.
        pub film_splits: u32,
        /// The largest radiance of a sample in any band.
        pub clamp: f32,
        /// Number of bands.
        pub bands: u32,
        /// Radius of the camera's lens.
        pub lens_radius: f32,
        /// Distance of the plane in focus, along the direction of view.
        pub focus_distance: f32,
        /// First of the numbers that distribute a pixel's samples by its filter.
        pub first_filter: u32,
        /// Row of the first node of the tree of emitters.
        pub first_emitter_node: u32,
        /// Row after the last node of the tree of emitters.
        pub end_emitter_node: u32,
        /// Padding to the alignment.
        pub padding_1: [u32; 2],
        /// Weights of S1, S2 and S3 in what the camera's polarizer transmits, without those that depend on the retarder's phase.
        pub analyzer: [f32; 3],
        /// Path difference of the retarder, nm: its phase is 2π times this over the wavelength.
        pub retarder_nm: f32,
        /// The weights times the cosine of that phase.
        pub analyzer_cosine: [f32; 3],
        /// Padding to the alignment.
        pub padding_2: u32,
        /// The weights times its sine.
        pub analyzer_sine: [f32; 3],
        /// Padding to the alignment.
        pub padding_3: u32,
    }

    /// Values for one dispatch: a run of samples of one tile.
    pub struct Batch {
        /// The tile's first pixel in the picture.
        pub tile_origin: [u32; 2],
        /// Width and height of the tile.
        pub tile_size: [u32; 2],
        /// The number of the first sample to take now.
        pub first_sample: u32,
        /// Samples to take now.
        pub sample_count: u32,
        /// Passes of the loop by which an invocation detects whether the driver has ended its loops.
        pub passes: u32,
        /// How many samples the sums hold already.
        pub taken: u32,
    }

    /// Values for one run over a part of a batch of stacks.
    pub struct StackRun {
        /// Number of wavelengths.
        pub wavelength_count: u32,
        /// Groups of four wavelengths for which each medium has its index: all of them, or 1.
        pub media_groups: u32,
        /// First stack of this run.
        pub first_stack: u32,
        /// Number of stacks of this run.
        pub stack_count: u32,
        /// Index of the incident medium.
        pub incident: f32,
        /// Padding to the size that a uniform buffer requires.
        pub padding_1: u32,
        /// Padding.
        pub padding_2: [u32; 2],
    }

    /// A layer of a stack of a batch.
    pub struct RunLayer {
        /// Its medium.
        pub medium: u32,
        /// Its thickness, nm.
        pub thickness_nm: f32,
    }

    /// A stack of a batch.
    pub struct RunStack {
        /// The medium below its layers.
        pub substrate: u32,
        /// First of its layers, the outermost.
        pub first_layer: u32,
        /// Number of its layers.
        pub layer_count: u32,
    }
}
