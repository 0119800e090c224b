//! Renders that are ended by SIGKILL at random moments: what they leave is whole, and the next goes on from it.
//!
//! `PELLICLE_KILLS=100 cargo test --release -p pellicle-cli --test commands kills::` tries more moments.

use crate::checkpoints::assert_is_whole;
use crate::place::Place;
use crate::render::{bytes, exr};
use crate::running::{Random, Running, exists, is_temporary, temporary, tries};
use crate::scene;
use std::time::Duration;

/// The moment of a kill.
#[derive(Clone, Copy, Debug)]
enum Moment {
    /// Some milliseconds after the start.
    After(u64),
    /// When the temporary file of a checkpoint appears for the n-th time.
    AtCheckpoint(u64),
    /// When the temporary file of the picture appears.
    AtPicture,
}

impl Moment {
    /// Later moments than `longest_ms` find a render that has ended.
    fn any(random: &mut Random, longest_ms: u64) -> Self {
        match random.below(3) {
            0 => Self::After(random.below(longest_ms)),
            1 => Self::AtCheckpoint(random.below(3)),
            _ => Self::AtPicture,
        }
    }

    /// Waits for it; returns whether the render still runs.
    fn wait(self, running: &mut Running, place: &Place) -> bool {
        let appears = |running: &mut Running, target| {
            running.wait_for(|| !temporary(place, target).is_empty())
        };
        match self {
            Self::After(ms) => {
                std::thread::sleep(Duration::from_millis(ms));
                running.is_running()
            }
            Self::AtCheckpoint(times) => {
                for _ in 0..times {
                    let is_there = appears(running, "kept");
                    let before = temporary(place, "kept");
                    if !is_there || !running.wait_for(|| temporary(place, "kept") != before) {
                        return false;
                    }
                }
                appears(running, "kept")
            }
            Self::AtPicture => appears(running, "a.exr"),
        }
    }
}

/// Every file under its own name is whole.
fn assert_is_sound(place: &Place) {
    if exists(place, "kept") {
        assert_is_whole(place, "kept");
    }
    if exists(place, "a.exr") {
        let _ = exr(place, "a.exr");
    }
    for name in place.names() {
        let is_known = ["kept", "a.exr", "whole.exr"].contains(&&name[..]);
        assert!(is_temporary(&name) || is_known, "{name}");
    }
}

/// Kills renders, each of which goes on from the one before, and compares what the last writes with a render in one go. A killed
/// render leaves its temporary file; no later render removes or reads it.
fn a_killed_render_goes_on(of: &str, settings: &str, longest_ms: u64) {
    let place = Place::default();
    let render = format!("render {} {settings}", scene(of));
    let _ = place.run(&format!("{render} -o whole.exr")).succeeded();
    let whole = bytes(&place, "whole.exr");
    let options = "-o a.exr --checkpoint kept --checkpoint-every 20ms --resume";
    let again = format!("{render} {options}");
    let mut random = Random(1);
    let (mut kills, mut finished) = (0, 0);
    while kills < tries(10) {
        let moment = Moment::any(&mut random, longest_ms);
        let left = temporary(&place, "");
        for name in left {
            std::fs::remove_file(place.path(&name)).unwrap();
        }
        let mut running = Running::start(&place, &again);
        let is_running = moment.wait(&mut running, &place);
        let is_killed = is_running && running.kill();
        println!("seed 1, kill {kills}: {moment:?}, running: {is_killed}");
        assert_is_sound(&place);
        kills += u32::from(is_killed);
        // A picture that was killed while it was written is finished, and another begun.
        if !is_killed || matches!(moment, Moment::AtPicture) || kills == tries(10) {
            let left = temporary(&place, "");
            let _ = place.run(&again).succeeded();
            assert!(bytes(&place, "a.exr") == whole, "other bytes");
            assert_eq!(temporary(&place, ""), left);
            for name in ["kept", "a.exr"] {
                std::fs::remove_file(place.path(name)).unwrap();
            }
            finished += 1;
        }
    }
    assert!(finished > 1, "one picture only");
}

const BUBBLE: &str = "--backend cpu --size 48x36 --bands 8 --samples 256";
const WEDGE: &str = "--backend gpu --size 32x24 --bands 8 --samples 128";

cases! { a_killed_render_goes_on:
    a_killed_render_goes_on_on_the_cpu("soap_bubble.toml", BUBBLE, 800);
    a_killed_render_goes_on_on_the_gpu("film_wedge.toml", WEDGE, 1000);
}
