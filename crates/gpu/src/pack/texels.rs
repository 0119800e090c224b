//! Pictures of four numbers in each place, in one list of texels. Before the texels of each stands its head.

use scene::{EnvironmentPicture, Texels};
use std::sync::Arc;

/// The pictures of a scene.
#[derive(Debug, Default)]
pub(super) struct Pictures {
    pub(super) texels: Vec<[f32; 4]>,
    /// Pictures that are among the texels already, with their size on planes, and where.
    known: Vec<(Arc<Texels>, [f32; 2], u32)>,
}

impl Pictures {
    /// The head of a picture of the surroundings: width and height in pixels, texels of a pixel, and the first of its table's numbers.
    ///
    /// The table: columns, rows, density of even light, heights of the rows' edges, running probability of the rows, and of the cells of each row.
    pub(super) fn add_environment(
        &mut self,
        picture: &EnvironmentPicture,
        numbers: &mut Vec<f32>,
    ) -> u32 {
        let (head, texels) = (self.texels.len() as u32, &picture.texels);
        let of_picture = [texels.width, texels.height, texels.per_pixel];
        let [width, height, per_pixel] = of_picture.map(|count| count as f32);
        self.texels
            .push([width, height, per_pixel, numbers.len() as f32]);
        self.texels.extend_from_slice(&texels.values);
        let table = &picture.table;
        let [columns, rows] = [table.columns, table.rows].map(|count| count as f32);
        numbers.extend([columns, rows, table.even_density]);
        for list in [&table.heights, &table.marginal, &table.conditional] {
            numbers.extend_from_slice(list);
        }
        head
    }

    /// The head of a picture: width and height in pixels, then the size on planes and rectangles, 0 for its natural one.
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
