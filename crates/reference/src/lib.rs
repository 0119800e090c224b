//! The renderer on the CPU, in `f64`, written to be read.
//!
//! It computes what the GPU renderer computes, from the same random numbers, but by its own road: a path
//! carries the whole spectrum with it from surface to surface, optics come from the crate `optics` (complex amplitudes,
//! recursion), and no formula is shared with the shader. Comparing the two proves both.

mod camera;
mod cook;
mod environment;
mod environment_picture;
mod facets;
mod interference;
mod intersect;
mod light;
mod light_choice;
mod noise;
mod path;
mod picture;
mod random;
mod render;
mod sampling;
mod scatter;
mod sobol;
mod spectra;
mod split;
mod surface;
mod surface_function;
mod thickness;

pub use camera::{Ray, camera_ray, sampled_camera_ray};
pub use cook::{CookFacets, cook_facets, sample_cook_facet};
pub use environment::{environment_pdf, environment_share, sample_environment};
pub use environment_picture::environment_pixel;
pub use facets::{FacetScattering, Facets};
pub use intersect::{Hit, intersect_plane, intersect_sphere, nearest_hit};
pub use light::{light_pdf, sample_light};
pub use light_choice::{
    Choice, Source, choice_probabilities, choose_light, scattering_share, sending_share,
};
pub use noise::{Noise, gradient_noise, swirls};
pub use path::{PathSample, radiance};
pub use picture::smooth_value;
pub use random::{pcg4d, random4, unit_interval};
pub use render::{Stopped, render};
pub use sampling::{cone_height, frame_of, sample_cone, sample_cosine_hemisphere};
pub use scatter::coat_share;
pub use sobol::{owen_scrambled, scrambled_reversed, sobol_point, sobol4};
pub use split::{chance_to_go_on, reflected_share};
pub use surface::{Reflectance, SurfacePoint, pattern_reflectance, surface_frame, surface_point};
pub use surface_function::SurfaceFunction;
pub use thickness::layer_thickness;
