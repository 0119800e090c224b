//! What a position in a picture shows of its scene.

use coating::{Angle, LayerDescription, Stack, StackDescription};
use reference::{Ray, camera_ray, layer_thickness, nearest_hit, surface_point};
use scene::Scene;
use scene_file::Problem;
use scene_file::description::{Description, Index, Layer, Material};
use std::path::Path;

mod lamps;

pub use lamps::{SceneLamp, SceneLamps, lamps_of_groups};

/// What is seen at a position in a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Picked {
    /// The environment.
    Environment,
    /// An object without layers, of this material.
    Bare(String),
    /// A film or a coated surface.
    Film(Box<PickedFilm>),
}

/// A film or a coated surface at a position in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PickedFilm {
    /// The name of its material in the scene.
    pub material: String,
    /// Its layers, with their thicknesses there, in the order in which light meets them.
    pub stack: Stack,
    /// The angle at which it is seen.
    pub angle: Angle,
    /// The light of the environment in the mirror direction; `None` if an object is in front of it, or it is dark.
    pub mirrored: Option<SceneLamp>,
}

/// Returns what is nearest to the camera at a position, in pixels from the left and the top of the picture. `description` is what
/// `scene` was made from, in a file of `directory`.
///
/// # Errors
/// When the layers are not valid as a stack.
pub fn pick(
    description: &Description,
    scene: &Scene,
    directory: &Path,
    [x, y]: [f64; 2],
) -> Result<Picked, Vec<Problem>> {
    let ray = camera_ray(scene, [x as u32, y as u32], [x.fract(), y.fract()]);
    let Some(hit) = nearest_hit(scene, &ray, None) else {
        return Ok(Picked::Environment);
    };
    let object = &scene.objects()[hit.object];
    let name = description.objects[hit.object].material();
    let material = description.materials.get(name);
    let (substrate, media) = match material {
        Some(Material::Film { index, layers, .. }) => {
            (Index::Real(1.0), media(index.as_ref(), layers.as_deref()))
        }
        Some(Material::Coated {
            substrate,
            index,
            layers,
            ..
        }) => (substrate.clone(), media(index.as_ref(), layers.as_deref())),
        _ => return Ok(Picked::Bare(name.to_owned())),
    };
    let point = surface_point(&object.shape, &ray, hit.distance);
    let thicknesses = scene.material(object.material).thicknesses();
    let thicknesses = thicknesses.map(|t| layer_thickness(t, &object.shape, point.position));
    let layer = |(index, thickness_nm)| LayerDescription {
        index,
        thickness_nm: Some(thickness_nm),
        optical_thickness: None,
    };
    let mut layer: Vec<LayerDescription> = media.into_iter().zip(thicknesses).map(layer).collect();
    // A coated surface is coated on both sides, with its first layer outermost.
    if !point.is_front && matches!(material, Some(Material::Film { .. })) {
        layer.reverse();
    }
    let stack = StackDescription {
        incident: Index::Real(1.0),
        substrate,
        layer,
    };
    let mirrored = Ray {
        origin: point.position,
        direction: ray.direction + 2.0 * point.cosine * point.normal,
    };
    let is_open = nearest_hit(scene, &mirrored, Some(hit.object)).is_none();
    let deg = point.cosine.min(1.0).acos().to_degrees();
    Ok(Picked::Film(Box::new(PickedFilm {
        material: name.to_owned(),
        stack: stack.check(directory)?,
        // A ray at exactly grazing incidence hits nothing.
        angle: Angle::from_degrees(deg).unwrap_or(Angle::NORMAL),
        mirrored: is_open
            .then(|| lamps::of_environment(scene, mirrored.direction))
            .flatten(),
    })))
}

/// The medium of each layer.
fn media(index: Option<&Index>, layers: Option<&[Layer]>) -> Vec<Index> {
    let layers = layers
        .into_iter()
        .flatten()
        .map(|layer| layer.index.clone());
    index.into_iter().cloned().chain(layers).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene_file::SceneFile;
    use std::ops::ControlFlow;

    const BUBBLE: &str = r#"
        [camera]
        type = "perspective"
        position = [0, 0, 5]
        look_at = [0, 0, 0]
        fov_deg = 40
        [render]
        size = [101, 101]
        bands = 20
        [materials.soap]
        type = "film"
        index = "water"
        thickness_nm = { pole = 300, equator = 1200 }
        [materials.lamp]
        type = "emitter"
        emission = { illuminant = "A", scale = 2 }
        [[objects]]
        type = "sphere"
        material = "soap"
        center = [0, 0, 0]
        radius = 1
        [[objects]]
        type = "rectangle"
        material = "lamp"
        center = [1.5, 1.5, 0]
        normal = [0, 0, 1]
        size = [0.5, 0.5]
        [environment]
        type = "constant"
        emission = { illuminant = "D65" }
    "#;

    fn at(place: [f64; 2]) -> Picked {
        let file = SceneFile::parse("bubble.toml", BUBBLE, Path::new(".")).unwrap();
        let scene = file.validate().unwrap();
        pick(&file.description, &scene, Path::new("."), place).unwrap()
    }

    #[test]
    fn the_film_is_as_thick_and_as_oblique_as_geometry_says() {
        // The middle of the bubble: the equator, at normal incidence.
        let Picked::Film(film) = at([50.5, 50.5]) else {
            panic!("a film");
        };
        assert_eq!(film.material, "soap");
        assert!((film.stack.thicknesses_nm()[0] - 1200.0).abs() < 1e-9);
        assert!(film.angle.degrees() < 1e-5);
        // Ten pixels further up, the film is thinner and seen obliquely.
        let Picked::Film(up) = at([50.5, 40.5]) else {
            panic!("a film");
        };
        assert!(up.stack.thicknesses_nm()[0] < 1150.0 && up.angle.degrees() > 5.0);
        assert_eq!(at([0.5, 100.5]), Picked::Environment);
        assert_eq!(at([91.5, 9.5]), Picked::Bare("lamp".to_owned()));
    }

    /// Silver under 60 nm of n = 2.4 and 180 nm of n = 1.4, or the same layers free, seen at normal incidence from one side.
    fn plate(material: &str, side: f64) -> (Scene, Picked) {
        let text = format!(
            r#"
            environment = {{ type = "constant", emission = {{ constant = 1 }} }}
            [camera]
            type = "orthographic"
            position = [0, 0, {side}]
            look_at = [0, 0, 0]
            height = 1
            [render]
            size = [1, 1]
            samples = 1
            bands = 8
            sampling = "center"
            [materials.plate]
            {material}
            layers = [{{ index = 2.4, thickness_nm = 60 }}, {{ index = [1.4, 0.2], thickness_nm = 180 }}]
            [[objects]]
            type = "rectangle"
            material = "plate"
            center = [0, 0, 0]
            normal = [0, 0, 1]
            size = [4, 4]
            "#
        );
        let file = SceneFile::parse("plate.toml", &text, Path::new(".")).unwrap();
        let scene = file.validate().unwrap();
        let picked = pick(&file.description, &scene, Path::new("."), [0.5, 0.5]).unwrap();
        (scene, picked)
    }

    fn order(picked: &Picked) -> &[f64] {
        match picked {
            Picked::Film(film) => film.stack.thicknesses_nm(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_free_film_is_met_from_either_end() {
        let film = |side| plate("type = 'film'", side).1;
        assert_eq!(order(&film(5.0)), [60.0, 180.0]);
        assert_eq!(order(&film(-5.0)), [180.0, 60.0]);
    }

    /// In an environment of radiance 1, a mirror's radiance is its reflectance, which the reference renders.
    #[test]
    fn a_coated_plate_is_the_same_from_both_sides() {
        for side in [5.0, -5.0] {
            let (scene, picked) = plate("type = 'coated'\nsubstrate = 'silver'", side);
            assert_eq!(order(&picked), [60.0, 180.0], "from {side}");
            let Picked::Film(film) = &picked else {
                panic!("a coating");
            };
            let bands = &scene.settings().bands;
            let nm: Vec<f64> = (0..bands.count()).map(|b| bands.center_nm(b)).collect();
            let powers = film.stack.sampled(&nm).unwrap();
            let powers = powers.powers(film.stack.thicknesses_nm(), film.angle);
            let image = reference::render(&scene, &mut |_| ControlFlow::Continue(())).unwrap();
            for (rendered, powers) in image.pixel(0, 0).iter().zip(powers) {
                // Silver's table is linear between knots of 1 nm in the render, and the image is of f32.
                let expected = powers.reflectance.unpolarized();
                let off = f64::from(*rendered) - expected;
                assert!(off.abs() < 1e-4, "from {side}: {rendered} {expected}");
            }
        }
    }
}
