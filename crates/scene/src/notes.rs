//! Notes on a valid scene.

use crate::{Emission, LightShape, Material, Scene, trees};

impl Scene {
    /// Assumptions about files, and anything that can be rendered but may be unintended, one line each.
    pub fn notes(&self) -> Vec<String> {
        let dark = (self.lamps() == 0 && !self.is_lit_by_environment())
            .then(|| "nothing emits light: the picture will be black".to_owned());
        let assumed = self.assumptions().iter().cloned();
        assumed
            .chain(dark)
            .chain(self.note_on_mirrors())
            .chain(self.notes_on_stacks())
            .chain(self.note_on_gain())
            .chain(self.note_on_polarization())
            .collect()
    }

    /// The number of objects and lights that emit light, including the sun of a sky.
    pub fn lamps(&self) -> usize {
        let all = self.emissions();
        all.filter(|&emission| self.shines(emission)).count()
    }

    /// What objects and lights emit.
    fn emissions(&self) -> impl Iterator<Item = Emission> {
        let of_objects =
            self.objects()
                .iter()
                .filter_map(|object| match self.material(object.material) {
                    Material::Cook(cook) => cook.ambient,
                    material => material.emission(),
                });
        let of_lights = self.lights().iter().map(|light| light.emission);
        of_objects.chain(of_lights)
    }

    /// Whether the environment emits light. The disks of distant lights do not count.
    pub fn is_lit_by_environment(&self) -> bool {
        let parts = self.environment().parts();
        parts.iter().any(|part| self.shines(part.emission))
    }

    fn shines(&self, emission: Emission) -> bool {
        emission.scale > 0.0 && self.spectrum(emission.spectrum).extent().1 > 0.0
    }

    /// Notes on coincident surfaces, one per stack.
    fn notes_on_stacks(&self) -> Vec<String> {
        let mut notes: Vec<(u32, String)> = Vec::new();
        for (object, sheet) in self.sheets().iter().enumerate() {
            let Some(sheet) = sheet else { continue };
            let others = self.sheets().iter().enumerate().skip(object + 1);
            let over = others
                .filter(|(_, other)| other.is_some_and(|other| other.stack == sheet.stack))
                .find(|(other, _)| {
                    let shape = |object: usize| &self.objects()[object].shape;
                    trees::overlap(shape(object), shape(*other))
                });
            let Some((other, _)) = over else { continue };
            if notes.iter().all(|(stack, _)| *stack != sheet.stack) {
                let note = format!(
                    "objects[{object}] and objects[{other}] coincide; the first of them in the file is the outermost of spheres, and \
                     on the side of its own normal on planes"
                );
                notes.push((sheet.stack, note));
            }
        }
        notes.into_iter().map(|(_, note)| note).collect()
    }

    /// A note if all lights have no size and nothing scatters their light.
    fn note_on_mirrors(&self) -> Option<String> {
        let has_no_size = |shape: &LightShape| !matches!(shape, LightShape::DistantDisk { .. });
        let mut lights = self
            .lights()
            .iter()
            .filter(|light| self.shines(light.emission));
        let only_points = self.lamps() > 0
            && !self.is_lit_by_environment()
            && self.emitting_objects() == 0
            && lights.all(|light| has_no_size(&light.shape));
        let mut objects = self.objects().iter();
        let only_mirrors = objects.all(|object| self.material(object.material).is_mirror());
        (only_points && only_mirrors && !self.objects().is_empty()).then(|| {
            "the picture will be black: all surfaces are smooth mirrors or films, in which a light without a size is never visible; give a \
             surface roughness, or use a sphere that emits, or a distant light with an angular diameter"
                .to_owned()
        })
    }

    /// The number of objects that emit light.
    fn emitting_objects(&self) -> usize {
        let emission = |object: &crate::Object| self.material(object.material).emission();
        let emissions = self.objects().iter().filter_map(emission);
        emissions.filter(|&emission| self.shines(emission)).count()
    }

    /// A note if light grows from one reflection to the next.
    fn note_on_gain(&self) -> Option<String> {
        let segments = self.settings().max_path_segments;
        let gains =
            self.objects()
                .iter()
                .filter_map(|object| match self.material(object.material) {
                    Material::Cook(cook) => Some(cook.gain),
                    _ => None,
                });
        let gain = gains.fold(0.0, f64::max);
        // The margin keeps rounding from counting as gain.
        (gain > 1.0 + 1e-6 && segments > 2).then(|| {
            format!(
                "a surface by cook1981 with printed constants reflects up to {gain:.1} times the incident light, and more after every \
                 reflection; render.max_path_segments = 2 gives the single reflection of the paper (found {segments})"
            )
        })
    }

    /// A note if emitted light is polarized, and traced without that.
    fn note_on_polarization(&self) -> Option<String> {
        let parts = self.environment().parts();
        let of_environment = parts.iter().map(|part| part.emission);
        let is_polarized =
            |emission: Emission| emission.polarization.is_some() && self.shines(emission);
        let has_polarized = self.emissions().chain(of_environment).any(is_polarized);
        (has_polarized && !self.settings().polarization).then(|| {
            "the polarization of emitted light has no effect; render.polarization = true traces light with it"
                .to_owned()
        })
    }
}
