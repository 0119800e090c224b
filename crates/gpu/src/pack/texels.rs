//! Pictures with four numbers per texel, in one list of texels. Before the texels of each is its header: width and height in pixels.

use crate::layout::Panorama;
use scene::{EnvironmentPicture, Texels};
use std::sync::Arc;

/// The pictures of a scene.
#[derive(Debug, Default)]
pub(super) struct Pictures {
    pub(super) texels: Vec<[f32; 4]>,
    /// Pictures that are already among the texels, with their size on planes, and where.
    known: Vec<(Arc<Texels>, [f32; 2], u32)>,
}

impl Pictures {
    /// Adds a picture of the environment, whose table is added to the numbers.
    pub(super) fn add_environment(
        &mut self,
        picture: &EnvironmentPicture,
        numbers: &mut Vec<f32>,
    ) -> Panorama {
        let (texels, table) = (&picture.texels, &picture.table);
        let panorama = panorama(picture, self.texels.len(), numbers.len());
        let [width, height] = [texels.width, texels.height].map(|count| count as f32);
        self.texels.push([width, height, 0.0, 0.0]);
        self.texels.extend_from_slice(&texels.values);
        for list in [&table.heights, &table.marginal, &table.conditional] {
            numbers.extend_from_slice(list);
        }
        panorama
    }

    /// Adds a picture and returns the index of its header: width and height in pixels, then the size on planes and rectangles, 0
    /// for its natural size.
    pub(super) fn add(&mut self, texels: &Arc<Texels>, size: [f32; 2]) -> u32 {
        let known = self.known.iter();
        let mut same = known.filter(|(known, on_planes, _)| known == texels && *on_planes == size);
        if let Some(&(_, _, head)) = same.next() {
            return head;
        }
        let head = self.texels.len() as u32;
        let [width, height] = size;
        let pixels = [texels.width as f32, texels.height as f32];
        self.texels.push([pixels[0], pixels[1], width, height]);
        self.texels.extend_from_slice(&texels.values);
        self.known.push((Arc::clone(texels), size, head));
        head
    }
}

/// Returns the record of a picture of the environment whose header and table begin at these indices.
fn panorama(picture: &EnvironmentPicture, head: usize, first_number: usize) -> Panorama {
    Panorama {
        head: head as u32,
        per_pixel: picture.texels.per_pixel,
        columns: picture.table.columns,
        rows: picture.table.rows,
        first_number: first_number as u32,
        even_density: picture.table.even_density,
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PackedScene;
    use scene::Environment;
    use scene_file::SceneFile;
    use std::path::Path;

    const SKY: &str = r#"
        environment = { type = "sky", sun_elevation_deg = 40 }
        [camera]
        type = "perspective"
        position = [0, 0, 5]
        look_at = [0, 0, 0]
        fov_deg = 40
        [materials.gray]
        type = "diffuse"
        reflectance = 0.5
        [[objects]]
        type = "sphere"
        material = "gray"
        center = [0, 0, 0]
        radius = 1
    "#;

    /// Beyond 2²⁴ an `f32` cannot represent every integer.
    #[test]
    fn places_are_exact_in_long_lists() {
        let scene = SceneFile::parse("sky.toml", SKY, Path::new(".")).unwrap();
        let scene = scene.validate().unwrap();
        let Environment::Picture { picture, .. } = scene.environment() else {
            panic!("a picture");
        };
        let mut tables = crate::pack::tables::Tables::with_materials(1);
        for place in [0, (1 << 24) + 1, (1 << 26) - 1, u32::MAX - 1] {
            let of_picture = panorama(picture, place as usize, place as usize);
            let row = tables.push(&of_picture);
            let words = tables.records[row as usize..].as_flattened();
            // As the shader reads them: the first word of the first row, and of the second.
            assert_eq!([words[0], words[4]], [place, place]);
        }
    }

    /// The table is where the record of the scene's picture says.
    #[test]
    fn the_table_of_a_sky_lies_where_its_record_says() {
        let scene = SceneFile::parse("sky.toml", SKY, Path::new(".")).unwrap();
        let scene = scene.validate().unwrap();
        let packed = PackedScene::new(&scene);
        let Environment::Picture { picture, .. } = scene.environment() else {
            panic!("a picture");
        };
        let mut emitters = packed.emitters.iter();
        let emitter = emitters.find(|emitter| emitter.kind == crate::layout::EMITTER_PICTURE);
        let panorama: Panorama = packed.record(emitter.unwrap().record);
        let table = &picture.table;
        assert_eq!(
            [panorama.columns, panorama.rows],
            [table.columns, table.rows]
        );
        let first = panorama.first_number as usize;
        let (heights, rows) = (&packed.numbers[first..], table.rows as usize);
        assert_eq!((heights[0], heights[rows]), (1.0, -1.0));
        assert_eq!((heights[rows + 1], heights[2 * rows + 1]), (0.0, 1.0));
        let head = panorama.head as usize;
        let texels = &picture.texels;
        let size = [texels.width as f32, texels.height as f32];
        assert_eq!(packed.texels[head][..2], size);
        assert_eq!(packed.texels[head + 1], texels.values[0]);
        assert_eq!(panorama.per_pixel, texels.per_pixel);
    }
}
