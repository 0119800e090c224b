//! The scenes that the suites render.

use crate::sources::root;
use scene::Scene;
use scene_file::SceneFile;
use scene_file::description::Environment;
use std::sync::LazyLock;

/// Scenes in `scenes/`.
pub const SHIPPED: &[&str] = &[
    "soap_bubble",
    "floating_bubble",
    "draining_bubble",
    "film_wedge",
    "paper_wedge",
    "oil_on_water",
    "silicon_steps",
    "metamers",
    "anodized_titanium",
    "tempered_steel",
    "dichroic_ball",
    "gold_visor",
    "metal_spheres",
    "paper_figure_5",
    "figure_5_exact",
    "metals",
    "brushed_disk",
    "bubble_in_room",
    "bubble_under_sky",
    "room",
    "studio",
    "furnace",
    "bench/bubble",
    "bench/metals",
    "bench/wedge",
];

/// Scenes in `scenes/` whose light is traced with its polarization.
const SHIPPED_POLARIZED: &[&str] = &[
    "polarized_bubble",
    "polarized_sky",
    "brewster",
    "elliptical_metals",
];

/// A scene with every kind of surface, pattern, thickness, light and environment.
pub const EVERYTHING: &str = include_str!("everything.toml");

/// A scene with Cook's model in every form and with every kind of base below a coat.
pub const EVERYTHING_BODIES: &str = include_str!("everything_bodies.toml");

/// What the other two lack: an environment from a picture, and a panorama.
pub const EVERYTHING_PICTURED: &str = include_str!("everything_pictured.toml");

/// A scene whose films split a path into branches of which most find nothing.
const OPEN_FILMS: &str = include_str!("open_films.toml");

/// The names of the scenes that were written for the suites.
pub const MADE: &[&str] = &[
    "everything",
    "everything_bodies",
    "everything_pictured",
    "open_films",
];

/// All scenes: [`SHIPPED`] and [`MADE`].
pub fn all() -> Vec<&'static str> {
    SHIPPED.iter().chain(MADE).copied().collect()
}

/// What follows a scene's name where its light is traced with polarization.
const POLARIZED: &str = ", polarized";

static ALL_POLARIZED: LazyLock<Vec<String>> = LazyLock::new(|| {
    all()
        .iter()
        .map(|name| format!("{name}{POLARIZED}"))
        .collect()
});

/// All scenes, with light that is traced with its polarization; also those that are so in `scenes/`.
pub fn all_polarized() -> Vec<&'static str> {
    let others = ALL_POLARIZED.iter().map(String::as_str);
    SHIPPED_POLARIZED.iter().copied().chain(others).collect()
}

/// [`MADE`], with light that is traced with its polarization.
pub fn made_polarized() -> Vec<&'static str> {
    let is_made = |name: &&str| {
        MADE.iter()
            .any(|made| *name == format!("{made}{POLARIZED}"))
    };
    all_polarized().into_iter().filter(is_made).collect()
}

/// Number of bands in the suites that compare whole scenes: three groups, the last one half empty. It is the same in all, so that a
/// driver with a cache of compiled shaders compiles each scene once.
pub const BANDS: u32 = 10;

/// A scene in `scenes/`, or one of [`MADE`], as a file that can still be changed; one of [`all_polarized`] by its name there.
///
/// # Panics
/// When it cannot be read.
pub fn file(name: &str) -> SceneFile {
    if let Some(name) = name.strip_suffix(POLARIZED) {
        let mut file = file(name);
        let described = &mut file.description;
        described.render.polarization = true;
        if let Some(Environment::Sky {
            polarization_degree,
            ..
        }) = &mut described.environment
        {
            *polarization_degree = Some(0.8);
        }
        return file;
    }
    let made = |text| SceneFile::parse(&format!("{name}.toml"), text, &root());
    let read = match name {
        "everything" => made(EVERYTHING),
        "everything_bodies" => made(EVERYTHING_BODIES),
        "everything_pictured" => made(EVERYTHING_PICTURED),
        "open_films" => made(OPEN_FILMS),
        _ => SceneFile::read(root().join("scenes").join(format!("{name}.toml"))),
    };
    read.unwrap_or_else(|problems| panic!("{problems}"))
}

/// The same scene with the given settings, rounded to f32 so that both renderers get the same numbers.
///
/// # Panics
/// When it is not valid.
pub fn small(name: &str, size: [u32; 2], samples: u32, bands: u32, seed: u32) -> Scene {
    let mut file = file(name);
    let render = &mut file.description.render;
    (render.size, render.samples, render.bands, render.seed) = (size, samples, bands, seed);
    file.validate()
        .unwrap_or_else(|problems| panic!("{problems}"))
        .rounded_to_f32()
}

/// WGSL functions that make sense only within a path; the single paths of the suite `frames` prove them.
pub const PROVED_ON_PATHS: &[&str] = &[
    "add_emission",
    "air_above",
    "is_visible",
    "bsdf_sample",
    "bsdf_specular_probability",
    "coated_sample",
    "coated_specular_probability",
    "connect",
    "cook_sample",
    "crossings_transmittance",
    "diffuse_sample",
    "dimming",
    "environment_pixel",
    "extend_path",
    "film_at",
    "film_factor",
    "first_ray",
    "interface_sample",
    "interface_specular_probability",
    "has_arrived",
    "layer_varies",
    "light_group_of",
    "emission_spectrum",
    "emission_value",
    "mis_weight_of_hit",
    "numbers_of",
    "pass_through",
    "path_radiance",
    "russian_roulette",
    "push_crossing",
    "push_thickness",
    "random_at",
    "record_layers",
    "resume",
    "sample_emitter",
    "scatter",
    "shade_environment",
    "shade_film",
    "shade_object",
    "shade_surface",
    "stack_value",
    "trace_path",
    "wait",
    "lobes_sum",
    "with_layers",
    "with_emission",
];

/// WGSL functions that make sense only within a path of polarized light; the polarized pictures of the suite `frames` prove them.
pub const PROVED_ON_POLARIZED: &[&str] = &[
    "add_components",
    "add_polarized_colors",
    "bare_mueller",
    "bsdf_mueller",
    "coated_mueller",
    "coating_cosines",
    "coating_mueller",
    "cook_mueller",
    "emission_behind_films",
    "emission_stokes",
    "emitted_stokes",
    "emitter_polarization",
    "film_of_vertex",
    "film_polarized_value",
    "interface_mueller",
    "light_after",
    "light_through_crossings",
    "load_polarization",
    "mueller_with_multiple",
    "observed_color",
    "path_stokes",
    "scattering_axes",
    "selected_powers",
    "sensed",
    "sensed_radiance",
    "turn_axis",
];

/// WGSL functions that `stack_batches` of the suite `films` proves: batches of film stacks.
pub const PROVED_ON_STACKS: &[&str] = &["evaluate_stacks", "run_index", "run_stack"];

/// WGSL functions that whole pictures prove: the accumulation of samples in the suite `frames`, the order of coincident surfaces in
/// the closed forms of `images`.
pub const PROVED_ON_FRAMES: &[&str] = &["accumulate", "is_outward", "loops_run", "render"];
