//! Polarization: of rendering, of the camera's polarizer, of emitters and of skies.

use crate::CAMERA;
use glam::DVec3;
use scene::{EmittedPolarization, Environment, LightShape, Material, Scene};
use spectra::stokes::{
    Polarizer, Retardance, Retarder, angle_of_linear_polarization_deg, degree_of_polarization,
};

const TRACED: &str = "render = { polarization = true }\n";

fn scene(rest: &str) -> Scene {
    crate::read(&format!("{CAMERA}{rest}"), "").unwrap_or_else(|problems| panic!("{problems:#}"))
}

#[test]
fn light_is_traced_with_its_polarization_only_if_the_scene_says_so() {
    assert!(!scene("").settings().polarization);
    assert!(scene(TRACED).settings().polarization);
    assert!(!scene("").content().is_polarized);
    assert!(scene(TRACED).content().is_polarized);
}

/// The polarizer of a camera with these fields.
fn polarizer(camera: &str) -> Option<Polarizer> {
    let text = format!("{TRACED}camera = {{ {camera} }}\n");
    let scene = crate::read(&text, "").unwrap_or_else(|problems| panic!("{problems:#}"));
    assert_eq!(
        scene.content().is_polarized,
        scene.camera().polarizer.is_none()
    );
    scene.camera().polarizer
}

#[test]
fn every_camera_takes_a_polarizer() {
    let position = "position = [0, 0, 5]";
    for camera in [
        "type = 'perspective', fov_deg = 40, look_at = [0, 0, 0]",
        "type = 'orthographic', height = 2, look_at = [0, 0, 0]",
        "type = 'panorama'",
    ] {
        assert_eq!(polarizer(&format!("{camera}, {position}")), None);
        let with = |retarder: &str| {
            let polarizer = format!("polarizer = {{ angle_deg = 30{retarder} }}");
            self::polarizer(&format!("{camera}, {position}, {polarizer}"))
        };
        let expected = |retarder| {
            Some(Polarizer {
                angle_deg: 30.0,
                retarder,
            })
        };
        assert_eq!(with(""), expected(None));
        for (written, fast_axis_deg, retardance) in [
            (
                "fast_axis_deg = 45, retardance_deg = 90",
                45.0,
                Retardance::Phase { deg: 90.0 },
            ),
            (
                "fast_axis_deg = -45, retardance_nm = 137.5",
                -45.0,
                Retardance::Path { nm: 137.5 },
            ),
        ] {
            let retarder = Retarder {
                fast_axis_deg,
                retardance,
            };
            let found = with(&format!(", retarder = {{ {written} }}"));
            assert_eq!(found, expected(Some(retarder)));
        }
    }
}

/// As docs/sampling.md says: with its fast axis 45° above the polarizer, a quarter-wave plate passes left-handed light alone.
#[test]
fn a_polarizer_behind_a_quarter_wave_plate_is_a_circular_one() {
    let camera = "type = 'panorama', position = [0, 0, 0]";
    let polarizer = polarizer(&format!(
        "{camera}, polarizer = {{ angle_deg = 30, retarder = {{ fast_axis_deg = 75, retardance_deg = 90 }} }}"
    ));
    let analyzer = polarizer.unwrap().analyzer();
    for (s3, passes) in [(-1.0, 1.0), (1.0, 0.0), (0.0, 0.5)] {
        let found = analyzer.transmitted([1.0, 0.0, 0.0, s3], 550.0);
        assert!((found - passes).abs() < 1e-12, "{s3}: {found}");
    }
}

/// The Stokes vector and the axis of a point light.
fn emitted(polarization: &str) -> Option<([f64; 3], DVec3)> {
    let light = format!(
        "[[lights]]\ntype = 'point'\nposition = [0, 1, 0]\nemission = {{ constant = 1, polarization = {{ {polarization} }} }}\n"
    );
    stokes(scene(&light).lights()[0].emission.polarization)
}

fn stokes(polarization: Option<EmittedPolarization>) -> Option<([f64; 3], DVec3)> {
    polarization.map(|polarization| match polarization {
        EmittedPolarization::Stokes { stokes, axis } => (stokes, axis),
        sky @ EmittedPolarization::Sky { .. } => panic!("{sky:?}"),
    })
}

#[test]
fn an_axis_is_normalized() {
    let found = emitted("stokes = [0.5, -0.25, 0.125], axis = [0, 3, 4]");
    let (stokes, axis) = found.unwrap();
    assert_eq!(stokes, [0.5, -0.25, 0.125]);
    assert!((axis - DVec3::new(0.0, 0.6, 0.8)).length() < 1e-15);
}

#[test]
fn rounding_of_a_stokes_vector_is_allowed_and_removed() {
    let found = emitted("stokes = [0.6000004, 0.8, 0], axis = [1, 0, 0]");
    let ([s1, s2, s3], _) = found.unwrap();
    assert!(DVec3::new(s1, s2, s3).length() <= 1.0 + 1e-15);
    assert!((s1 - 0.6).abs() < 1e-6 && (s2 - 0.8).abs() < 1e-6 && s3 == 0.0);
}

#[test]
fn unpolarized_light_has_no_polarization() {
    assert_eq!(emitted("stokes = [0, 0, 0], axis = [1, 0, 0]"), None);
    let none = emitted("degree = 0, angle_deg = 30, axis = [1, 0, 0]");
    assert_eq!(none, None);
}

/// The ellipse of a field E = a cos(ωt − φ) has its axes where |E| is extreme: found here along the ellipse itself, without formulas of
/// Stokes vectors.
fn ellipse(stokes: [f64; 3]) -> (f64, f64) {
    let [s1, s2, s3] = stokes;
    // A field with this Stokes vector: Ex is real, and S2 + iS3 = 2 Ex Ey*.
    let x = f64::midpoint(1.0, s1).sqrt();
    let (re, im) = (s2 / (2.0 * x), -s3 / (2.0 * x));
    // The real part of E exp(−iωt).
    let at = |turn: f64| {
        let (sin, cos) = turn.sin_cos();
        (x * cos, re * cos + im * sin)
    };
    let times = (0..360_000).map(|step| f64::from(step).to_radians() / 1000.0);
    let size = |turn: f64| at(turn).0.hypot(at(turn).1);
    let longest = times.clone().max_by(|a, b| size(*a).total_cmp(&size(*b)));
    let shortest = times.map(size).fold(f64::INFINITY, f64::min);
    let longest = longest.unwrap();
    let (along_x, along_y) = at(longest);
    // Seen by who receives the light, x points to the right and y = d × x up if d points to the eye.
    let (next_x, next_y) = at(longest + 1e-3);
    let is_clockwise = along_x * next_y - along_y * next_x < 0.0;
    let ellipticity = (shortest / size(longest)).atan().to_degrees();
    let sign = if is_clockwise { 1.0 } else { -1.0 };
    (
        along_y.atan2(along_x).to_degrees().rem_euclid(180.0),
        sign * ellipticity,
    )
}

#[test]
fn angles_are_those_of_the_ellipse() {
    for (angle, ellipticity) in [
        (0.0, 10.0),
        (30.0, 20.0),
        (30.0, -20.0),
        (100.0, -40.0),
        (135.0, 5.0),
    ] {
        let written = format!(
            "degree = 1, angle_deg = {angle}, ellipticity_deg = {ellipticity}, axis = [1, 0, 0]"
        );
        let (stokes, axis) = emitted(&written).unwrap();
        assert_eq!(axis, DVec3::X);
        let (found_angle, found_ellipticity) = ellipse(stokes);
        let off = (found_angle - angle + 90.0).rem_euclid(180.0) - 90.0;
        assert!(off.abs() < 0.1, "{written}: {found_angle}");
        let off = found_ellipticity - ellipticity;
        assert!(off.abs() < 0.1, "{written}: {found_ellipticity}");
    }
}

#[test]
fn a_degree_needs_no_angles() {
    let (stokes, _) = emitted("degree = 0.25, axis = [0, 1, 0]").unwrap();
    assert_eq!(stokes, [0.25, 0.0, 0.0]);
    let ([s1, s2, s3], _) =
        emitted("degree = 0.5, angle_deg = 60, ellipticity_deg = 12, axis = [0, 1, 0]").unwrap();
    let whole = [1.0, s1, s2, s3];
    assert!((degree_of_polarization(whole) - 0.5).abs() < 1e-12);
    assert!((angle_of_linear_polarization_deg(whole) - 60.0).abs() < 1e-12);
    let ([s1, s2, s3], _) = emitted("degree = 1, ellipticity_deg = -45, axis = [0, 1, 0]").unwrap();
    assert!(s1.hypot(s2) < 1e-15 && s3 == -1.0);
}

const POLARIZATION: &str = "polarization = { stokes = [0, 0, 1], axis = [0, 0, 1] }";

/// Each of these polarizations is the one above.
fn assert_all_right_circular(found: &[Option<EmittedPolarization>]) {
    let expected = Some(EmittedPolarization::Stokes {
        stokes: [0.0, 0.0, 1.0],
        axis: DVec3::Z,
    });
    assert!(found.iter().all(|found| *found == expected), "{found:?}");
}

#[test]
fn every_light_and_emitting_material_may_be_polarized() {
    let lights = [
        "type = 'distant'\ndirection = [1, 1, 0]",
        "type = 'distant'\ndirection = [1, 1, 0]\ndiameter_deg = 0",
        "type = 'point'\nposition = [1, 1, 0]",
        "type = 'spot'\nposition = [1, 1, 0]\ndirection = [0, -1, 0]\nangle_deg = 30",
    ];
    let emission = format!("emission = {{ constant = 1, {POLARIZATION} }}");
    let mut text = format!("[materials.x]\ntype = 'emitter'\n{emission}\n");
    for light in lights {
        text += &format!("[[lights]]\n{light}\n{emission}\n");
    }
    let scene = scene(&text);
    let of_lights = scene.lights().iter().map(|light| light.emission);
    let found: Vec<_> = of_lights.map(|emission| emission.polarization).collect();
    assert_eq!(found.len(), 4);
    assert_all_right_circular(&found);
    let Material::Emitter { emission, .. } = scene.materials()[0] else {
        panic!("{:?}", scene.materials());
    };
    assert_all_right_circular(&[emission.polarization]);
}

fn environment(text: &str) -> Environment {
    scene(&format!("environment = {{ {text} }}\n"))
        .environment()
        .clone()
}

#[test]
fn environments_may_be_polarized() {
    let emission = format!("{{ constant = 1, {POLARIZATION} }}");
    let constant = environment(&format!("type = 'constant', emission = {emission}"));
    assert_all_right_circular(&[constant.parts()[0].emission.polarization]);

    let gradient = format!("type = 'gradient', zenith = {{ constant = 1 }}, horizon = {emission}");
    let Environment::Gradient {
        zenith,
        horizon,
        ground,
    } = environment(&gradient)
    else {
        panic!("no gradient");
    };
    assert_eq!(zenith.polarization, None);
    assert_all_right_circular(&[horizon.polarization, ground.polarization]);

    let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let text =
        format!("{CAMERA}environment = {{ type = 'image', image = 'room.exr', {POLARIZATION} }}\n");
    let scene = crate::read(&text, scenes).unwrap_or_else(|problems| panic!("{problems:#}"));
    assert_all_right_circular(&[scene.environment().parts()[0].emission.polarization]);
}

#[test]
fn a_sky_is_polarized_about_its_sun_and_the_sun_is_not() {
    let sky = "type = 'sky', sun_elevation_deg = 30, sun_azimuth_deg = 90";
    assert_eq!(
        environment(sky).parts()[0].emission.polarization,
        None,
        "by default"
    );
    let none = format!("{sky}, polarization_degree = 0");
    assert_eq!(environment(&none).parts()[0].emission.polarization, None);

    let scene = scene(&format!(
        "environment = {{ {sky}, polarization_degree = 0.75 }}\n"
    ));
    let Some(EmittedPolarization::Sky { sun, most }) =
        scene.environment().parts()[0].emission.polarization
    else {
        panic!("unpolarized");
    };
    assert_eq!(most, 0.75);
    // Azimuth 90° is +X.
    let expected = DVec3::new(3.0_f64.sqrt() / 2.0, 0.5, 0.0);
    assert!((sun - expected).length() < 1e-12, "{sun}");
    let [light] = scene.lights() else {
        panic!("{:?}", scene.lights());
    };
    assert_eq!(light.emission.polarization, None);
    let LightShape::DistantDisk { toward, .. } = light.shape else {
        panic!("{light:?}");
    };
    assert_eq!(sun, toward);
}

#[test]
fn parts_of_a_gradient_are_the_same_only_if_their_polarization_is() {
    let gradient = |horizon: &str| {
        let environment = environment(&format!(
            "type = 'gradient', zenith = {{ constant = 1, {POLARIZATION} }}, horizon = {{ constant = 1{horizon} }}"
        ));
        environment.parts().len()
    };
    assert_eq!(gradient(&format!(", {POLARIZATION}")), 1);
    assert_eq!(gradient(""), 3);
}

/// The notes of a scene about polarization.
fn notes(rest: &str) -> Vec<String> {
    let notes = scene(rest).notes();
    let about = notes.into_iter().filter(|note| note.contains("polariz"));
    about.collect()
}

#[test]
fn polarized_light_that_is_traced_without_its_polarization_is_noted() {
    let light = |scale: f64| {
        format!(
            "[[lights]]\ntype = 'point'\nposition = [0, 1, 0]\nemission = {{ constant = 1, scale = {scale}, {POLARIZATION} }}\n"
        )
    };
    let sky = "environment = { type = 'sky', sun_elevation_deg = 30, polarization_degree = 0.8 }\n";
    let object = format!(
        "[materials.x]\ntype = 'emitter'\nemission = {{ constant = 1, {POLARIZATION} }}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'x'\ncenter = [0, 0, 0]\nradius = 1\n"
    );
    for text in [&light(1.0), sky, &object] {
        let found = notes(text);
        assert_eq!(found.len(), 1, "{text}");
        assert!(found[0].contains("no effect"), "{found:?}");
        assert!(found[0].contains("render.polarization = true"), "{found:?}");
        let traced = notes(&format!("{TRACED}{text}"));
        assert!(traced.is_empty(), "{traced:?}");
    }
    assert!(notes(&light(0.0)).is_empty(), "it gives no light");
    assert!(notes("").is_empty());
}
