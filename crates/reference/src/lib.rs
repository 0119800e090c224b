//! The renderer on the CPU, in `f64`: an oracle for the shader, and fast.
//!
//! It computes what the GPU renderer computes, from the same random numbers, but independently: it shares no formula with the
//! shader. A comparison of the two therefore checks both. Its films are in turn compared with `optics::stack`, which neither
//! renderer uses for spectral values.
//!
//! ```text
//! Scene -> PreparedScene        spectra in chunks of bands, materials by their BSDFs, emitters by number
//!   -> path::PathTracer         rays, BSDF sampling, next-event estimation; never sees a band
//!        -> Transport           the interface: the events of the path
//!   -> spectral::SpectralPath   throughput and radiance in all bands at once
//!   -> spectral::Pixel          means and variances
//!   -> SpectralImage
//! ```

#![expect(
    clippy::inline_always,
    reason = "code that works on lanes must be inlined into the caller that was compiled for them"
)]

mod bands;
mod bsdf;
mod camera;
mod emitter;
mod emitter_choice;
mod emitter_shape;
mod environment;
mod environment_picture;
mod hit;
mod intersect;
mod layers;
mod lifting;
mod mis;
mod noise;
mod path;
mod picture;
mod polarization;
mod prepared;
mod random;
mod render;
mod sampling;
mod simd_level;
mod sobol;
mod spectral;
mod split;
mod surface;
mod surface_function;
mod thickness;
mod tiles;
mod transport;

pub use bsdf::{CookFacets, FacetEval, Facets, coat_probability, cook_facets, sample_cook_facet};
pub use camera::{Ray, camera_ray, sampled_camera_ray};
pub use emitter::Emitter;
pub use emitter_choice::{EmitterChoice, choose_emitter};
pub use emitter_shape::{sample_shape, shape_pdf};
pub use environment::{environment_pdf, environment_strength, sample_environment};
pub use environment_picture::environment_pixel;
pub use hit::{Hit, nearest_hit};
pub use intersect::{intersect_plane, intersect_sphere};
pub use lifting::smooth_value;
pub use mis::{mis_weight_bsdf, mis_weight_emitter};
pub use noise::{Noise, gradient_noise, swirls};

pub use polarization::{Turn, axis_across, emitted_stokes};
pub use prepared::PreparedScene;
pub use random::{pcg4d, random4, unit_interval};
pub use render::{PathSample, Session, Stopped, render, render_at};
pub use sampling::{cone_height, frame_of, sample_cone, sample_cosine_hemisphere};
pub use simd_level::SimdLevel;
pub use sobol::{scrambled_reversed, sobol_point, sobol4};
pub use split::{reflection_probability, rr_survival_probability};
pub use surface::{Reflectance, SurfacePoint, pattern_reflectance, surface_frame, surface_point};
pub use surface_function::SurfaceFunction;
pub use thickness::layer_thickness;
