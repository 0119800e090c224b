//! The memory that a render takes, and what the machine has.

use miette::miette;
use pellicle::scene::Scene;
use pellicle::spectra::{Accumulation, SpectralImage, Window};
use sysinfo::{MemoryRefreshKind, RefreshKind, System};

/// What a render takes beside its pixels: the program, the driver, the lines of files that are compressed.
const BASE: u64 = 256 << 20;
/// The least and the most bytes of a strip that is rendered at a time. A GPU is busy with half a million pixels.
const STRIP: u64 = 128 << 20;
const LARGE_STRIP: u64 = 1 << 30;
/// Bytes of a pixel while a picture is developed: XYZ, linear red, green and blue twice, and codes.
const DEVELOPED: u64 = 12 + 2 * 12 + 6;

/// How a render uses memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layout {
    /// All pixels at once.
    Whole,
    /// This many rows at a time.
    Strips(u32),
}

/// What pictures are developed from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pictures {
    /// There are none.
    None,
    /// The colors of the pixels.
    OfColors,
    /// The spectra of all pixels.
    OfSpectra,
}

/// What decides over the memory of a render.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Needs {
    /// Whether pictures are developed, and from what.
    pub(crate) pictures: Pictures,
    /// How many copies of the state there are: one more if checkpoints are written.
    pub(crate) copies: u64,
    /// Whether anything needs all pixels at once: an end other than a number of samples, previews, checkpoints.
    pub(crate) rounds: bool,
}

/// How a render of a window fits into some memory, and the bytes that it takes.
///
/// # Errors
/// When it does not fit.
pub(crate) fn layout(
    scene: &Scene,
    window: Window,
    needs: Needs,
    available: u64,
) -> miette::Result<(Layout, u64)> {
    let pixels = window.pixels() as u64;
    let state = Accumulation::bytes_per_pixel(scene.content());
    let image = SpectralImage::bytes(1, 1, scene.content()) as u64;
    let developing = match needs.pictures {
        Pictures::None => 0,
        Pictures::OfColors => DEVELOPED,
        Pictures::OfSpectra => DEVELOPED + image,
    };
    let whole = BASE + pixels * (needs.copies * state + developing);
    if whole <= available {
        return Ok((Layout::Whole, whole));
    }
    // A strip, its image, and its lines before and after compression.
    let of_row = u64::from(window.size[0]) * (state + 4 * image);
    let fixed = BASE + pixels * developing;
    let strip = (available.saturating_sub(fixed) / 2).clamp(STRIP, LARGE_STRIP);
    let rows = (strip / of_row).clamp(1, u64::from(window.size[1]));
    let strips = fixed + rows * of_row;
    let needs_all = needs.rounds || needs.pictures == Pictures::OfSpectra;
    if strips <= available && !needs_all {
        return Ok((Layout::Strips(rows as u32), strips));
    }
    let (takes, help) = if needs_all {
        let help = "render parts of it with --part K/N and join them with `pellicle merge`, or leave out --time, --noise, --adaptive, \
                    --preview-every, --checkpoint, other lamps and a second .exr: rows are then rendered one after the other";
        (whole, help)
    } else {
        (
            strips,
            "render parts of it with --part K/N, or write the .exr alone and develop it later",
        )
    };
    Err(miette!(
        help = help,
        "this picture of {}×{} pixels with {} bands takes {}, but {} can be used",
        window.size[0],
        window.size[1],
        scene.content().bands,
        shown(takes),
        shown(available)
    ))
}

/// Four fifths of the memory that is free now, as far as this process may use it.
pub(crate) fn available() -> u64 {
    let refresh = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    // A system that does not tell has enough.
    let Ok(system) = System::new_with_specifics(refresh) else {
        return u64::MAX;
    };
    let mut free = system.available_memory();
    if let Some(limits) = system.cgroup_limits() {
        free = free.min(limits.free_memory);
    }
    free / 5 * 4
}

/// The light groups and bytes of a scene's picture: `light groups: key, sky; the picture takes 113 MB`.
pub(crate) fn of_picture(scene: &Scene) -> String {
    format!(
        "{}; the picture takes {}",
        light_groups(scene),
        shown(scene.image_bytes() as u64)
    )
}

/// The light groups of a scene, and the bytes of a render.
pub(crate) fn of_render(scene: &Scene, bytes: u64) -> String {
    format!(
        "{}; the render takes up to {}",
        light_groups(scene),
        shown(bytes)
    )
}

fn light_groups(scene: &Scene) -> String {
    let groups = scene.light_groups().iter();
    let names: Vec<&str> = groups.map(|group| group.name.as_str()).collect();
    let noun = if names.len() == 1 { "group" } else { "groups" };
    format!("light {noun}: {}", names.join(", "))
}

/// Reads a number of bytes, such as 4GB or 512MiB.
pub(crate) fn bytes(text: &str) -> Result<u64, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = match &text[digits.len()..].to_lowercase()[..] {
        "mb" => 1e6,
        "gb" => 1e9,
        "tb" => 1e12,
        "mib" => f64::from(1 << 20),
        "gib" => f64::from(1 << 30),
        _ => 0.0,
    };
    let bytes = digits
        .trim()
        .parse()
        .map_or(0.0, |number: f64| number * unit);
    if (1.0..1e18).contains(&bytes) {
        Ok(bytes as u64)
    } else {
        Err("write a size with its unit, as in 512MB or 4GB".to_owned())
    }
}

/// Bytes with three digits.
pub(crate) fn shown(bytes: u64) -> String {
    let mut value = bytes as f64;
    for unit in ["B", "kB", "MB"] {
        if value < 999.5 {
            let decimals = if unit == "B" {
                0
            } else {
                2 - value.log10().floor() as usize
            };
            return format!("{value:.decimals$} {unit}");
        }
        value /= 1000.0;
    }
    format!("{value:.1} GB")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_shown_in_three_digits() {
        for (bytes, text) in [
            (1, "1 B"),
            (999, "999 B"),
            (1000, "1.00 kB"),
            (12_345, "12.3 kB"),
            (999_499, "999 kB"),
            (999_501, "1.00 MB"),
            (331_776_000, "332 MB"),
            (34_359_738_368, "34.4 GB"),
        ] {
            assert_eq!(shown(bytes), text, "{bytes}");
        }
    }

    #[test]
    fn sizes_are_read() {
        assert_eq!(bytes("4GB"), Ok(4_000_000_000));
        assert_eq!(bytes("1.5 MiB"), Ok(1_572_864));
        for bad in ["4", "GB", "-1GB", "4PB", "NaNGB", ""] {
            assert!(bytes(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn what_fits_is_rendered_whole_and_the_rest_in_strips() {
        let text = "camera = { type = 'orthographic', position = [0, 0, 9], look_at = [0, 0, 0], height = 9 }\n\
             environment = { type = 'constant', emission = { constant = 1 } }\n\
             render = { bands = 40, size = [7680, 4320], samples = 1 }\n";
        let file = pellicle::scene_file::SceneFile::parse("x.toml", text, std::path::Path::new(""));
        let scene = file.unwrap().validate().unwrap();
        let window = Window::whole([7680, 4320]);
        let needs = Needs {
            pictures: Pictures::OfColors,
            copies: 1,
            rounds: false,
        };
        let at = |needs, available| layout(&scene, window, needs, available);
        let (whole, bytes) = at(needs, u64::MAX).unwrap();
        assert_eq!((whole, bytes / 1_000_000_000), (Layout::Whole, 23));
        let (strips, bytes) = at(needs, 8_000_000_000).unwrap();
        assert!(matches!(strips, Layout::Strips(50..100)), "{strips:?}");
        assert!(bytes < 2_800_000_000, "{bytes}");
        let error = at(needs, 1_000_000_000).unwrap_err().to_string();
        assert!(error.ends_with("but 1.0 GB can be used"), "{error}");
        let rounds = Needs {
            rounds: true,
            ..needs
        };
        assert!(at(rounds, 8_000_000_000).is_err());
        let copies = Needs {
            copies: 2,
            ..rounds
        };
        assert!(at(copies, u64::MAX).unwrap().1 > 40_000_000_000);
    }
}
