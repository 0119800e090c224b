//! What is worth saying of a scene that is sound.

use crate::{Emission, Material, Scene};

impl Scene {
    /// What was assumed of files, and what may not be meant though it can be rendered: one line each.
    pub fn notes(&self) -> Vec<String> {
        let dark = (self.lamps() == 0 && !self.is_lit_by_surroundings())
            .then(|| "nothing shines: the picture will be black".to_owned());
        let assumed = self.assumptions.iter().cloned();
        assumed.chain(dark).chain(self.note_on_gain()).collect()
    }

    /// How many objects and lights shine, the sun of a sky among them.
    pub fn lamps(&self) -> usize {
        let of_objects =
            self.objects()
                .iter()
                .filter_map(|object| match self.material(object.material) {
                    Material::Cook(cook) => cook.ambient,
                    material => material.emission(),
                });
        let of_lights = self.lights().iter().map(|light| light.emission);
        let all = of_objects.chain(of_lights);
        all.filter(|&emission| self.shines(emission)).count()
    }

    /// Whether light comes from around the objects, the discs of distant lights not counted.
    pub fn is_lit_by_surroundings(&self) -> bool {
        let parts = self.environment().parts();
        parts.iter().any(|part| self.shines(part.emission))
    }

    fn shines(&self, emission: Emission) -> bool {
        emission.scale > 0.0 && self.spectrum(emission.spectrum).extent().1 > 0.0
    }

    /// Light that grows from one surface to the next.
    fn note_on_gain(&self) -> Option<String> {
        let segments = self.settings().max_path_segments;
        let gains =
            self.objects()
                .iter()
                .filter_map(|object| match self.material(object.material) {
                    Material::Cook(cook) => Some(cook.gain()),
                    _ => None,
                });
        let gain = gains.fold(0.0, f64::max);
        // Rounding is no gain.
        (gain > 1.0 + 1e-6 && segments > 2).then(|| {
            format!(
                "a surface by cook1981 with printed constants sends back up to {gain:.1} times the light that falls on it, and more \
                 after every reflection; render.max_path_segments = 2 is the single reflection of the paper (here {segments})"
            )
        })
    }
}
