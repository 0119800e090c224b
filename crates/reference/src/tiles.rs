//! The tiles into which rounds are cut.

use spectra::{Round, Window};
use std::ops::Range;

/// Side of a tile in pixels, a power of two. Tiles keep neighboring pixels together, because they see neighboring parts of the scene.
const TILE: u32 = 16;
/// The least number of tiles per thread; tiles of small pictures are made smaller for it.
const TILES_OF_A_THREAD: u32 = 4;

/// The tiles of some rounds.
pub(crate) struct Tiles<'a> {
    rounds: &'a [Round],
    side: u32,
}

impl<'a> Tiles<'a> {
    pub(crate) fn new(rounds: &'a [Round], threads: u32) -> Self {
        let mut tiles = Self { rounds, side: TILE };
        while tiles.side > 1 && tiles.count() < u64::from(TILES_OF_A_THREAD * threads) {
            tiles.side /= 2;
        }
        tiles
    }

    fn count(&self) -> u64 {
        let of_round = |round: &Round| {
            let [columns, rows] = round.window.size.map(|pixels| pixels.div_ceil(self.side));
            u64::from(columns) * u64::from(rows)
        };
        self.rounds.iter().map(of_round).sum()
    }

    /// Returns each tile with the number of its samples before and after, round by round and row by row.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Window, Range<u32>)> + 'a {
        let side = self.side;
        self.rounds.iter().flat_map(move |round| {
            let [columns, rows] = round.window.size.map(|pixels| pixels.div_ceil(side));
            let samples = round.samples.clone();
            let corners = (0..rows).flat_map(move |y| (0..columns).map(move |x| [x, y]));
            corners.map(move |corner| (tile(round.window, corner, side), samples.clone()))
        })
    }
}

fn tile(of: Window, corner: [u32; 2], side: u32) -> Window {
    let from = corner.map(|place| place * side);
    Window {
        origin: [0, 1].map(|i| of.origin[i] + from[i]),
        size: [0, 1].map(|i| side.min(of.size[i] - from[i])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_hold_every_pixel_once() {
        for (width, height, threads) in [(1, 1, 8), (33, 17, 2), (640, 480, 2), (5, 300, 64)] {
            let round = |x: u32, samples| Round {
                window: Window {
                    origin: [x, 7],
                    size: [width, height],
                },
                samples,
            };
            let rounds = [round(0, 0..4), round(width, 2..3)];
            let tiles = Tiles::new(&rounds, threads);
            let mut uses = vec![0; 2 * rounds[0].window.pixels()];
            for (tile, samples) in tiles.iter() {
                for y in tile.origin[1]..tile.origin[1] + tile.size[1] {
                    for x in tile.origin[0]..tile.origin[0] + tile.size[0] {
                        uses[((y - 7) * 2 * width + x) as usize] += 1;
                        assert_eq!(samples, if x < width { 0..4 } else { 2..3 });
                    }
                }
            }
            assert!(uses.iter().all(|&count| count == 1));
            assert!(tiles.side == 1 || tiles.count() >= u64::from(4 * threads));
            assert_eq!(tiles.iter().count() as u64, tiles.count());
        }
        let round = Round {
            window: Window::whole([640, 480]),
            samples: 0..1,
        };
        assert_eq!(Tiles::new(&[round], 2).side, TILE);
    }
}
