//! The lamps of a scene, as the fit of a film needs them.

use super::PickedFilm;
use coating::FilmFitting;
use reference::{
    environment_pdf, environment_pixel, environment_strength, sample_environment, smooth_value,
};
use scene::{
    Emission, Environment, EnvironmentPart, EnvironmentPicture, EnvironmentShape, PictureSpectra,
    Scene,
};
use scene_file::description::{self, Description};
use spectra::{BandGrid, LightGroup};
use std::f64::consts::PI;

/// The emission spectrum of emitters of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneLamp {
    /// The emitter with this spectrum: the name of a material, the entry of a light such as `lights[0]`, or the environment.
    pub name: String,
    /// Relative power at each of [`FilmFitting::wavelengths_nm`] of the scene's bands.
    pub power: Vec<f64>,
}

/// The distinct emission spectra of the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneLamps {
    /// Spectra of the environment: of each part of a gradient, and the mean over all directions of a picture or a sky.
    pub environment: Vec<SceneLamp>,
    /// Spectra of lights, including the sun of a sky, and of objects.
    pub lights: Vec<SceneLamp>,
}

const ENVIRONMENT: &str = "the environment";
/// Number of directions for the mean of a picture, half of them sampled by its brightness.
const DIRECTIONS: u32 = 8192;
/// The golden ratio minus 1: its multiples spread evenly.
const GOLDEN: f64 = 0.618_033_988_749_895;
/// Number of random numbers that average the four pixels around a position.
const PLACES: u32 = 64;

impl SceneLamps {
    /// The lamps of a scene that was made from `description`.
    pub fn new(description: &Description, scene: &Scene) -> Self {
        let mut found = Self::default();
        match scene.environment() {
            Environment::Constant(emission) => {
                found.add_environment(ENVIRONMENT, power(scene, *emission));
            }
            Environment::Gradient {
                zenith,
                horizon,
                ground,
            } => {
                for emission in [zenith, horizon, ground] {
                    found.add_environment(ENVIRONMENT, power(scene, *emission));
                }
            }
            Environment::Picture { emission, picture } => {
                let name = format!("{ENVIRONMENT}, its mean");
                found.add_environment(&name, mean(scene, *emission, picture));
            }
        }
        for (light, name) in scene.lights().iter().zip(names(description, scene)) {
            found.add_light(&name, power(scene, light.emission));
        }
        for (object, described) in scene.objects().iter().zip(&description.objects) {
            let emission = match scene.material(object.material) {
                scene::Material::Cook(cook) => cook.ambient,
                material => material.emission(),
            };
            if let Some(emission) = emission {
                found.add_light(described.material(), power(scene, emission));
            }
        }
        found
    }

    /// Whether the scene has no emitters.
    pub fn is_empty(&self) -> bool {
        self.environment.is_empty() && self.lights.is_empty()
    }

    /// The lamps under which a film may be seen. If the film mirrors the environment, only the light in the mirror direction
    /// represents the environment.
    pub fn of(&self, film: &PickedFilm) -> Vec<SceneLamp> {
        let environment = film.mirrored.as_ref().map(std::slice::from_ref);
        let environment = environment.unwrap_or(&self.environment);
        environment.iter().chain(&self.lights).cloned().collect()
    }

    fn add_environment(&mut self, name: &str, power: Vec<f64>) {
        add(&mut self.environment, name, power);
    }

    fn add_light(&mut self, name: &str, power: Vec<f64>) {
        if self.environment.iter().all(|lamp| lamp.power != power) {
            add(&mut self.lights, name, power);
        }
    }
}

/// The distinct lamps of light groups at these wavelengths, named after the groups that use them. Groups without a known lamp are left out.
pub fn lamps_of_groups(groups: &[LightGroup], nm: &[f64]) -> Vec<SceneLamp> {
    let mut known: Vec<SceneLamp> = Vec::new();
    for group in groups {
        let Some(lamp) = &group.lamp else { continue };
        let power: Vec<f64> = nm.iter().map(|&nm| lamp.clamped_at(nm)).collect();
        match known.iter_mut().find(|lamp| lamp.power == power) {
            Some(same) => same.name += &format!(" and {:?}", group.name),
            None => known.push(SceneLamp {
                name: format!("the lights {:?}", group.name),
                power,
            }),
        }
    }
    known
}

/// Adds a spectrum unless it is already there or dark.
fn add(lamps: &mut Vec<SceneLamp>, name: &str, power: Vec<f64>) {
    let shines = power.iter().any(|&v| v > 0.0);
    if shines && lamps.iter().all(|lamp| lamp.power != power) {
        let name = name.to_owned();
        lamps.push(SceneLamp { name, power });
    }
}

/// The entry of each of [`Scene::lights`] in the scene file: disks come first, and the sun of a sky is the last of them.
fn names(description: &Description, scene: &Scene) -> Vec<String> {
    let lights = || description.lights.iter().enumerate();
    let is_distant_disk = |light: &description::Light| matches!(light, description::Light::Distant { diameter_deg, .. } if *diameter_deg > 0.0);
    let disks = lights().filter(|(_, light)| is_distant_disk(light));
    let others = lights().filter(|(_, light)| !is_distant_disk(light));
    let name = |(index, _)| format!("lights[{index}]");
    let has_sun = scene.lights().len() > description.lights.len();
    let sun = has_sun.then(|| "the sun".to_owned());
    disks.map(name).chain(sun).chain(others.map(name)).collect()
}

/// The light of the environment in a direction, given by a unit vector, including the disks of distant lights; `None` if it is dark.
pub(super) fn of_environment(scene: &Scene, direction: glam::DVec3) -> Option<SceneLamp> {
    let parts = scene.environment_parts();
    let seen = |part: &EnvironmentPart<'_>| environment_strength(part.shape, direction) > 0.0;
    let is_even = |part: &EnvironmentPart<'_>| part.shape == EnvironmentShape::Everywhere;
    let name = if parts.iter().filter(|part| seen(part)).all(is_even) {
        ENVIRONMENT.to_owned()
    } else {
        format!("{ENVIRONMENT} in the mirror direction")
    };
    let mut sum = Sum::new(scene);
    for part in &parts {
        let share = part.emission.scale * environment_strength(part.shape, direction);
        match part.shape {
            EnvironmentShape::Picture(picture) => {
                let mut of_picture = Sum::new(scene);
                for place in 0..PLACES {
                    let random = (f64::from(place) + 0.5) / f64::from(PLACES);
                    let pixel = environment_pixel(picture, direction, random);
                    of_picture.add_pixel(picture, pixel, share / f64::from(PLACES));
                }
                sum.add(&of_picture.times(&power(scene, part.emission)), 1.0);
            }
            _ => sum.add(&power(scene, part.emission), share),
        }
    }
    let power = sum.values;
    let shines = power.iter().any(|&v| v > 0.0);
    shines.then_some(SceneLamp { name, power })
}

/// The mean of a picture over all directions. Half of the directions are sampled uniformly, half by the picture's brightness, and
/// each is weighted by the combined density, so that no small sun is missed.
fn mean(scene: &Scene, emission: Emission, picture: &EnvironmentPicture) -> Vec<f64> {
    let shapes = [
        EnvironmentShape::Everywhere,
        EnvironmentShape::Picture(picture),
    ];
    let mut sum = Sum::new(scene);
    for turn in 0..DIRECTIONS {
        let u = (f64::from(turn / 2) + 0.5) / f64::from(DIRECTIONS / 2);
        let v = (f64::from(turn) * GOLDEN).fract();
        let direction = sample_environment(shapes[turn as usize % 2], u, v);
        let density = shapes.map(|shape| environment_pdf(shape, direction));
        let density = 0.5 * (density[0] + density[1]) * f64::from(DIRECTIONS);
        let random = (f64::from(turn) * GOLDEN * GOLDEN).fract();
        let pixel = environment_pixel(picture, direction, random);
        sum.add_pixel(picture, pixel, 1.0 / (4.0 * PI * density));
    }
    sum.times(&power(scene, emission))
}

/// A sum of spectra at each of [`FilmFitting::wavelengths_nm`].
struct Sum<'a> {
    bands: &'a BandGrid,
    nm: Vec<f64>,
    values: Vec<f64>,
}

impl<'a> Sum<'a> {
    fn new(scene: &'a Scene) -> Self {
        let bands = &scene.settings().bands;
        let nm = FilmFitting::wavelengths_nm(bands);
        Self {
            bands,
            values: vec![0.0; nm.len()],
            nm,
        }
    }

    fn add(&mut self, spectrum: &[f64], factor: f64) {
        for (sum, value) in self.values.iter_mut().zip(spectrum) {
            *sum += factor * value;
        }
    }

    fn add_pixel(&mut self, picture: &EnvironmentPicture, pixel: [u32; 2], factor: f64) {
        let texels = picture.texels.at(pixel);
        let values = self.values.iter_mut().zip(&self.nm);
        match picture.spectra {
            PictureSpectra::Smooth => {
                let Some(&texel) = texels.first() else { return };
                let [c0, c1, c2, scale] = texel.map(f64::from);
                for (sum, &nm) in values {
                    *sum += factor * scale * smooth_value([c0, c1, c2], nm);
                }
            }
            PictureSpectra::Bands => {
                let of_bands = texels.as_flattened();
                for (sum, &nm) in values {
                    let (band, _) = place(self.bands, nm);
                    let value = of_bands.get(band as usize).copied().unwrap_or_default();
                    *sum += factor * f64::from(value);
                }
            }
        }
    }

    fn times(&self, spectrum: &[f64]) -> Vec<f64> {
        let values = self.values.iter().zip(spectrum);
        values.map(|(a, b)| a * b).collect()
    }
}

/// The band of a wavelength, and the position in it.
fn place(bands: &BandGrid, nm: f64) -> (u32, f64) {
    let at = (nm - bands.min_nm()) / bands.width_nm();
    let band = (at as u32).min(bands.count() - 1);
    (band, at - f64::from(band))
}

/// The spectrum of an emission at scale 1; zeros if its scale is 0.
fn power(scene: &Scene, emission: Emission) -> Vec<f64> {
    let bands = &scene.settings().bands;
    let table = scene.spectrum(emission.spectrum);
    let value = |nm: f64| {
        let (band, offset) = place(bands, nm);
        table.at(band, offset)
    };
    let wavelengths = FilmFitting::wavelengths_nm(bands);
    if emission.scale == 0.0 {
        return vec![0.0; wavelengths.len()];
    }
    wavelengths.into_iter().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Picked, pick};
    use super::*;
    use coating::{Measured, View};
    use scene_file::SceneFile;
    use std::ops::ControlFlow;
    use std::path::Path;

    /// A free film of water, 620 nm thick, seen at normal incidence from +Z, and the rest of the scene.
    fn film(rest: &str) -> String {
        format!(
            r#"
            {rest}
            [camera]
            type = "orthographic"
            position = [0, 0, 5]
            look_at = [0, 0, 0]
            height = 0.2
            [render]
            size = [1, 1]
            samples = 256
            bands = 40
            [materials.soap]
            type = "film"
            index = "water"
            thickness_nm = 620
            [[objects]]
            type = "rectangle"
            material = "soap"
            center = [0, 0, 0]
            normal = [0, 0, 1]
            size = [4, 4]
            "#
        )
    }

    struct Found {
        scene: Scene,
        lamps: SceneLamps,
        film: PickedFilm,
    }

    fn found(text: &str) -> Found {
        let file = SceneFile::parse("film.toml", text, Path::new(".")).unwrap();
        let scene = file.validate().unwrap();
        let lamps = SceneLamps::new(&file.description, &scene);
        let picked = pick(&file.description, &scene, Path::new("."), [0.5, 0.5]).unwrap();
        let Picked::Film(film) = picked else {
            panic!("{picked:?}");
        };
        Found {
            scene,
            lamps,
            film: *film,
        }
    }

    /// The fitted thickness and residual of what the reference renders, under the lamp that fits best, and that lamp's name.
    fn thickness(found: &Found) -> (f64, f64, String) {
        let bands = &found.scene.settings().bands;
        let image = reference::render(&found.scene, &mut |_| ControlFlow::Continue(())).unwrap();
        let radiance: Vec<f64> = image.pixel(0, 0).iter().map(|&v| f64::from(v)).collect();
        let measured = Measured {
            bands,
            radiance: &radiance,
            deviation: None,
            xyz: [1.0; 3],
        };
        let fits = found.lamps.of(&found.film).into_iter().map(|lamp| {
            let fitting = FilmFitting {
                stack: &found.film.stack,
                layer: 0,
                from_nm: 0.0,
                to_nm: 2000.0,
                angle: found.film.angle,
                view: View::default(),
                lamp: &lamp.power,
            };
            let fits = fitting.fit(&measured).unwrap().unwrap();
            let best = &fits.by_shape[0];
            (best.thickness_nm, best.residual, lamp.name)
        });
        fits.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
    }

    /// A wall behind the camera, part of which the film mirrors.
    const WALL: &str = r#"
        [materials.wall]
        type = "diffuse"
        reflectance = 0.8
        [[objects]]
        type = "rectangle"
        material = "wall"
        center = [0, 0, 8]
        normal = [0, 0, -1]
        size = [4, 4]
    "#;

    #[test]
    fn groups_with_one_lamp_share_it() {
        let bands = BandGrid::visible(40).unwrap();
        let group = |name: &str, lamp: Option<&str>| LightGroup {
            name: name.to_owned(),
            lamp: lamp.map(|lamp| {
                bands
                    .lamp(&spectra::illuminant(lamp).unwrap().data)
                    .unwrap()
            }),
        };
        let groups = [
            group("key", Some("D65")),
            group("fire", Some("A")),
            group("mixed", None),
            group("fill", Some("D65")),
        ];
        let nm = FilmFitting::wavelengths_nm(&bands);
        let lamps = lamps_of_groups(&groups, &nm);
        let names: Vec<&str> = lamps.iter().map(|lamp| lamp.name.as_str()).collect();
        let expected = ["the lights \"key\" and \"fill\"", "the lights \"fire\""];
        assert_eq!(names, expected);
        assert!(lamps.iter().all(|lamp| lamp.power.len() == nm.len()));
    }

    #[test]
    fn a_film_is_known_again_in_each_kind_of_light() {
        for light in [
            "type = 'point'
position = [1, 0, 6]",
            "type = 'spot'
position = [1, 0, 6]
direction = [-1, 0, 2]
angle_deg = 60",
            "type = 'distant'
direction = [0.3, 0, -1]
diameter_deg = 0",
            "type = 'distant'
direction = [0.3, 0, -1]",
        ] {
            let light = format!(
                "[[lights]]
{light}
emission = {{ illuminant = 'FL11' }}"
            );
            // Distant lights do not reach the wall past the edge of the film, but the film transmits most of their light.
            let found = found(&film(&format!(
                "{WALL}
{light}"
            )));
            assert_eq!(found.film.mirrored, None, "{light}");
            assert!(found.lamps.environment.is_empty());
            let (nm, residual, name) = thickness(&found);
            assert!(
                (nm - 620.0).abs() < 1.0 && residual < 0.01,
                "{light}: {nm} {residual}"
            );
            assert_eq!(name, "lights[0]");
        }
    }

    /// A disk that the film mirrors together with the constant environment around it.
    #[test]
    fn a_disk_is_seen_in_the_mirror_with_what_is_around_it() {
        let found = found(&film(
            r#"
            environment = { type = "constant", emission = { illuminant = "D65", scale = 0.1 } }
            lights = [{ type = "distant", direction = [0, 0, 1], diameter_deg = 40, emission = { illuminant = "FL11" } }]
            "#,
        ));
        let names = found.lamps.of(&found.film);
        let names: Vec<&str> = names.iter().map(|lamp| lamp.name.as_str()).collect();
        assert_eq!(
            names,
            ["the environment in the mirror direction", "lights[0]"]
        );
        let (d65, fl11) = (
            &found.lamps.environment[0].power,
            &found.lamps.lights[0].power,
        );
        // The disk lights a surface from 2π (1 − cos 20°) sr, and the environment shines there as well.
        let radiance = found.scene.lights()[0].emission.scale;
        let solid_angle = 2.0 * PI * (1.0 - 20_f64.to_radians().cos());
        assert!((radiance * solid_angle - 1.0).abs() < 0.05, "{radiance}");
        let mirrored = &found.film.mirrored.as_ref().unwrap().power;
        for ((sum, d65), fl11) in mirrored.iter().zip(d65).zip(fl11) {
            assert!(
                (sum / (0.1 * d65 + radiance * fl11) - 1.0).abs() < 1e-9,
                "{sum}"
            );
        }
    }

    #[test]
    fn a_sky_is_seen_with_the_spectrum_of_its_direction() {
        // Nothing is seen through the film.
        let sky = film(
            r#"
            environment = { type = "sky", sun_elevation_deg = 35, sun_azimuth_deg = 90, turbidity = 3 }
            [materials.velvet]
            type = "diffuse"
            reflectance = 0
            [[objects]]
            type = "plane"
            material = "velvet"
            point = [0, 0, -3]
            normal = [0, 0, 1]
            "#,
        );
        let sky = sky.replace("normal = [0, 0, 1]", "normal = [0, 1, 1]");
        let found = found(&sky);
        let names = found.lamps.of(&found.film);
        let names: Vec<&str> = names.iter().map(|lamp| lamp.name.as_str()).collect();
        assert_eq!(
            names,
            ["the environment in the mirror direction", "the sun"]
        );
        let (nm, residual, _) = thickness(&found);
        assert!(
            (nm - 620.0).abs() < 1.0 && residual < 0.01,
            "{nm} {residual}"
        );
    }

    /// Compares with the sum over the pixels, weighted by the solid angles of their rows.
    #[test]
    fn the_mean_of_a_sky_is_that_of_its_pixels() {
        let found = found(&film(
            "environment = { type = 'sky', sun_elevation_deg = 20, turbidity = 4, sun = false }",
        ));
        let Environment::Picture { picture, emission } = found.scene.environment() else {
            panic!("a picture");
        };
        let texels = &picture.texels;
        let (mut sum, mut whole) = (vec![0.0; 40], 0.0);
        for row in 0..texels.height {
            let angle = PI * (f64::from(row) + 0.5) / f64::from(texels.height);
            for column in 0..texels.width {
                whole += angle.sin();
                for (band, sum) in sum.iter_mut().enumerate() {
                    let value = texels.at([column, row])[band / 4][band % 4];
                    *sum += angle.sin() * f64::from(value);
                }
            }
        }
        let mean = &found.lamps.environment[0];
        assert_eq!(mean.name, "the environment, its mean");
        let factor = power(&found.scene, *emission);
        let bands = &found.scene.settings().bands;
        let nm = FilmFitting::wavelengths_nm(bands);
        for ((power, factor), nm) in mean.power.iter().zip(factor).zip(nm) {
            let expected = factor * sum[place(bands, nm).0 as usize] / whole;
            assert!(
                (power / expected - 1.0).abs() < 5e-3,
                "{nm}: {power} {expected}"
            );
        }
    }

    #[test]
    fn each_spectrum_is_one_lamp() {
        let found = found(&film(
            r#"
            environment = { type = "constant", emission = { illuminant = "D65", scale = 3 } }
            lights = [
                { type = "point", position = [1, 0, 1], emission = { illuminant = "A" } },
                { type = "point", position = [1, 0, 2], emission = { illuminant = "A", scale = 2 } },
                { type = "point", position = [1, 0, 1], emission = { illuminant = "D65" } },
                { type = "point", position = [1, 0, 1], emission = { illuminant = "FL2", scale = 0 } },
                { type = "distant", direction = [1, 0, 1], emission = { illuminant = "D50" } },
            ]
            [materials.lamp]
            type = "emitter"
            emission = { illuminant = "C" }
            [[objects]]
            type = "sphere"
            material = "lamp"
            center = [3, 0, 0]
            radius = 0.5
            "#,
        ));
        let names = found.lamps.of(&found.film);
        let names: Vec<&str> = names.iter().map(|lamp| lamp.name.as_str()).collect();
        assert_eq!(names, ["the environment", "lights[4]", "lights[0]", "lamp"]);
        let nm = FilmFitting::wavelengths_nm(&found.scene.settings().bands);
        let d65 = spectra::illuminant("D65").unwrap().data;
        for (found, nm) in found.lamps.environment[0].power.iter().zip(nm) {
            assert!((found / d65.at(nm).unwrap() - 1.0).abs() < 1e-3, "{nm}");
        }
    }
}
