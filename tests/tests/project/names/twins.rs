//! Checks that a shader module and its Rust twin have the same stem, and their functions the same names.
//!
//! The twin of `shaders/…/stem.wgsl` is the code of `crates/reference` and `crates/optics` in files `stem.rs` or in a folder `stem`. The
//! twin of a function `name` is a function `name` there, or a method `name` of a type that the name of the shader function begins with:
//! `emitter_pdf` is `Emitter::pdf`, and `coated_eval` is `eval` in `coated.rs`.

use pellicle_tests::sources::sources;
use pellicle_tests::wgsl::functions;
use std::collections::{BTreeMap, BTreeSet};

/// Modules that have no twin, with the reason.
const ALONE: &[(&str, &str)] = &[
    ("bindings", "generated: data that the host uploads"),
    ("features", "generated: features of a scene"),
    ("layout", "generated from the structs of the host"),
    ("records", "generated from the structs of the host"),
    ("table_data", "textures of the host"),
    (
        "record",
        "the reference evaluates spectra along the path, without a record",
    ),
    (
        "stack_batch",
        "the entry point of batches; the reference's is `optics::batch`",
    ),
    ("phase", "precision of f32; the reference uses `exp`"),
    (
        "trig",
        "precision of f32; the reference uses the standard library's functions",
    ),
];

/// Functions without a twin of their name, with the reason.
const WITHOUT_TWIN: &[(&str, &[&str], &str)] = &[
    ("bsdf", &["bsdf_factor"], "the record"),
    (
        "coated",
        &["coated_of", "coated_factor"],
        "lists of the host and the record",
    ),
    (
        "coated",
        &["coat_transmittance_scale"],
        "a table of `scene::CoatedBody`",
    ),
    (
        "coated",
        &["coat_transmittance", "rough_coat_transmittance"],
        "inline in `Coated::value`",
    ),
    (
        "cook",
        &["cook_of", "cook_factor"],
        "lists of the host and the record",
    ),
    (
        "diffuse",
        &["diffuse_factor", "reflectance_spectrum"],
        "the record; `surface::pattern_reflectance`",
    ),
    (
        "facets",
        &["over_facets", "facets_albedo"],
        "a table of `scene::FacetTable`",
    ),
    ("facets", &["microsurface_of"], "lists of the host"),
    (
        "facets",
        &["multiple_color"],
        "`optics::multiple_color`, for the tables of `bsdf/rough.rs`",
    ),
    ("interface", &["interface_factor"], "the record"),
    (
        "interface",
        &["bare_value", "coating_value", "with_multiple"],
        "the cases of `InterfaceAt::value`",
    ),
    ("camera", &["filter_offset"], "`scene::Filter`"),
    (
        "complex",
        &["complex_add", "complex_sub", "complex_div", "complex_sqrt"],
        "operators in Rust",
    ),
    (
        "emitter",
        &["is_delta", "is_environment"],
        "variants of an enum in Rust",
    ),
    (
        "emitter",
        &["plane_area", "sphere_surrounds"],
        "inline in `emitter_shape.rs`",
    ),
    (
        "emitter_choice",
        &["weigh_tree", "choose_in_tree", "tree_pmf"],
        "the reference has one function for few and many emitters",
    ),
    ("emitter_choice", &["rest_of"], "inline in `pick`"),
    ("emitter_sampling", &["record_lit"], "the record"),
    ("environment", &["environment_part"], "lists of the host"),
    (
        "environment_picture",
        &["direction_table", "interval_of", "position_in_interval"],
        "lists of the host; a search of the standard library",
    ),
    (
        "film",
        &["film_powers", "film_of_boundary"],
        "a film that absorbs is a stack of one layer in the reference",
    ),
    (
        "hit",
        &["is_met", "meets_box"],
        "distances below 0 are misses in the shader; a closure in Rust",
    ),
    ("intersect", &["intersect_large_sphere"], "precision of f32"),
    (
        "layers",
        &[
            "record_layers",
            "air_above",
            "with_layers",
            "film_value",
            "stack_value",
        ],
        "the record, and four bands in place of all",
    ),
    (
        "microfacet",
        &["log_one_minus"],
        "precision of f32; `ln_1p`",
    ),
    (
        "microsurface",
        &["scaled_erfc", "visible_cdf"],
        "precision of f32; `erfc_and_gauss`",
    ),
    (
        "bsdf",
        &["scattering_axes"],
        "`Scattering::axes` of `transport.rs`",
    ),
    (
        "emitter",
        &["emitter_polarization"],
        "`scene::Emission::polarization`",
    ),
    (
        "emitter_sampling",
        &["emission_behind_films"],
        "inline in `StokesPath::connect`",
    ),
    (
        "interface",
        &[
            "bare_mueller",
            "coating_mueller",
            "coating_cosines",
            "mueller_with_multiple",
        ],
        "the cases of `InterfaceAt::mueller`",
    ),
    (
        "mueller",
        &[
            "mueller_depolarizer",
            "mueller_identity",
            "mueller_sum",
            "selected_powers",
            "stokes_scaled",
            "stokes_sum",
        ],
        "kinds of matrices in the reference; operators in Rust",
    ),
    ("mueller", &["stokes_turned"], "`Bands::turned`"),
    ("polarization", &["turned_axis"], "`Turn::turned`"),
    (
        "polarized",
        &["film_polarized", "boundary_amplitudes"],
        "a film that absorbs is a stack of one layer in the reference",
    ),
    (
        "polarized",
        &["amplitude_powers", "scaled_powers"],
        "inline in Rust",
    ),
    (
        "polarized",
        &["stack_polarized", "top_amplitudes"],
        "`Sweep::polarized` of `wide/stack.rs`",
    ),
    (
        "polarized",
        &["film_polarized_value"],
        "the record, and four bands in place of all",
    ),
    (
        "render",
        &["add_components", "add_polarized_colors", "observed_color"],
        "`spectral::Pixel`",
    ),
    (
        "stokes_path",
        &[
            "path_stokes",
            "emission_stokes",
            "light_after",
            "light_through_crossings",
            "film_of_vertex",
            "sensed",
            "sensed_radiance",
        ],
        "reads a record vertex by vertex; `StokesPath` has the matrices of its events",
    ),
    (
        "path",
        &["first_ray", "record_onward"],
        "inline in `PathTracer::trace_path`; the record",
    ),
    (
        "path_state",
        &["numbers_of", "random_at"],
        "methods of `PathTracer`, which knows the sample",
    ),
    (
        "path_state",
        &["mirrored_at"],
        "inline in `PathState::mirror`",
    ),
    (
        "render",
        &["accumulate", "loops_run"],
        "`spectral::Pixel`; a check of the driver",
    ),
    (
        "sobol",
        &["scrambled", "bit_of"],
        "the reference stores the digits in reverse",
    ),
    (
        "spectral_path",
        &[
            "path_radiance",
            "emission_value",
            "crossings_transmittance",
            "film_factor",
        ],
        "reads a record vertex by vertex; `SpectralPath` receives each vertex when it is met",
    ),
    (
        "spectral_path",
        &["factor_value", "with_emission", "dimming"],
        "the record; `SpectralPath::dim`",
    ),
    (
        "spectrum",
        &["wavelengths_at", "spectrum_at"],
        "lists of the host; `Tables`",
    ),
    ("split", &["reflected_at"], "`scene::Estimate`"),
    ("split", &["wait", "resume"], "a `Vec` in `PathTracer`"),
    (
        "stack",
        &[
            "medium_q2",
            "substrate_admittances",
            "stack_on",
            "stack_layer",
            "layer_phase",
            "exponential_quotient",
            "fields_above",
            "powers_of",
        ],
        "the shader keeps a film's fields in another form, for the precision of f32",
    ),
    (
        "thickness",
        &["layer_varies", "combined_fields"],
        "fields are a tree in Rust, a list in postfix order in the shader",
    ),
    (
        "two_beam",
        &[
            "two_beam_reflectance",
            "two_beams",
            "two_beam_transmittance",
            "two_beam_boundary",
        ],
        "`two_beam` and `wide::two_beam_powers` return both at once",
    ),
];

/// A type's name in the shader's style.
fn snake(name: &str) -> String {
    let mut snake = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(c.to_lowercase());
    }
    snake
}

/// The type that a line begins an implementation for.
fn implemented(line: &str) -> Option<String> {
    let rest = line.strip_prefix("impl")?;
    let rest = match rest.strip_prefix('<') {
        Some(parameters) => parameters.split_once("> ")?.1,
        None => rest.trim_start(),
    };
    let rest = rest.split_once(" for ").map_or(rest, |(_, of)| of);
    let name: String = rest
        .trim_start_matches('&')
        .chars()
        .take_while(|c| c.is_alphanumeric())
        .collect();
    (!name.is_empty()).then_some(name)
}

/// Names of the functions of a Rust file; methods also with their type in front.
fn rust_functions(source: &str) -> BTreeSet<String> {
    let code = source.split("#[cfg(test)]").next().unwrap_or(source);
    let mut names = BTreeSet::new();
    let mut of_type = None;
    for line in code.lines() {
        if let Some(name) = implemented(line) {
            of_type = Some(snake(&name));
        } else if line.starts_with('}') {
            of_type = None;
        }
        let Some((head, rest)) = line.split_once("fn ") else {
            continue;
        };
        if head.contains("//") || !(head.is_empty() || head.ends_with(' ')) {
            continue;
        }
        let name: String = rest
            .chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect();
        if let Some(of_type) = &of_type {
            names.insert(format!("{of_type}_{name}"));
        }
        names.insert(name);
    }
    names
}

/// The functions of the Rust files of each stem.
fn twins() -> BTreeMap<String, BTreeSet<String>> {
    let mut twins = BTreeMap::<String, BTreeSet<String>>::new();
    for source in sources() {
        let below = ["crates/reference/src/", "crates/optics/src/"]
            .iter()
            .find_map(|folder| source.path.strip_prefix(folder));
        let Some(stems) = below.and_then(|path| path.strip_suffix(".rs")) else {
            continue;
        };
        for stem in stems.split('/').filter(|stem| *stem != "mod") {
            twins
                .entry(stem.to_owned())
                .or_default()
                .extend(rust_functions(&source.text));
        }
    }
    twins
}

/// Errors in the twins of a module.
fn wrong(
    stem: &str,
    names: &BTreeSet<String>,
    twins: &BTreeMap<String, BTreeSet<String>>,
) -> Vec<String> {
    let is_alone = ALONE.iter().any(|(alone, _)| *alone == stem);
    let Some(twin) = twins.get(stem) else {
        return if is_alone {
            Vec::new()
        } else {
            vec![format!("{stem}.wgsl has no twin in Rust")]
        };
    };
    if is_alone {
        return vec![format!(
            "{stem}.wgsl has a twin, and is listed as having none"
        )];
    }
    let listed: BTreeSet<&str> = WITHOUT_TWIN
        .iter()
        .filter(|entry| entry.0 == stem)
        .flat_map(|entry| entry.1)
        .copied()
        .collect();
    let has_twin = |name: &str| {
        let method = name
            .strip_prefix(stem)
            .and_then(|rest| rest.strip_prefix('_'));
        twin.contains(name) || method.is_some_and(|method| twin.contains(method))
    };
    let mut wrong = Vec::new();
    for name in names {
        match (has_twin(name), listed.contains(name.as_str())) {
            (false, false) => wrong.push(format!(
                "{name} of {stem}.wgsl has no twin of that name in Rust"
            )),
            (true, true) => wrong.push(format!(
                "{name} of {stem}.wgsl has a twin, and is listed as having none"
            )),
            _ => {}
        }
    }
    wrong.extend(
        listed
            .iter()
            .filter(|name| !names.contains(**name))
            .map(|name| format!("{stem}.wgsl has no function {name}")),
    );
    wrong
}

#[test]
fn modules_and_functions_have_twins_with_their_names() {
    let twins = twins();
    let mut stems = BTreeSet::new();
    let mut found = Vec::new();
    for source in sources().iter().filter(|source| source.ends_in("wgsl")) {
        let stem = source
            .path
            .rsplit('/')
            .next()
            .and_then(|file| file.strip_suffix(".wgsl"))
            .expect("the path ends in .wgsl");
        found.extend(wrong(stem, &functions(&source.text), &twins));
        stems.insert(stem.to_owned());
    }
    assert!(stems.len() > 30, "few shaders found: {stems:?}");
    let listed = ALONE
        .iter()
        .map(|entry| entry.0)
        .chain(WITHOUT_TWIN.iter().map(|entry| entry.0));
    found.extend(
        listed
            .filter(|stem| !stems.contains(*stem))
            .map(|stem| format!("there is no {stem}.wgsl")),
    );
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_different_name_is_noticed() {
    let twins = twins();
    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    assert_eq!(
        wrong(
            "mis",
            &names(&["mis_weight_bsdf", "mis_weight_emitter"]),
            &twins
        ),
        [""; 0]
    );
    assert_eq!(wrong("mis", &names(&["weight_of_light"]), &twins).len(), 1);
    assert_eq!(wrong("light", &names(&[]), &twins).len(), 1);
    assert_eq!(
        wrong(
            "phase",
            &names(&[]),
            &BTreeMap::from([("phase".to_owned(), BTreeSet::new())])
        )
        .len(),
        1
    );
}
