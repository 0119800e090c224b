//! The memory that a picture takes, printed before it is rendered.

use pellicle::scene::Scene;

/// The light groups and bytes of a scene's picture: `light groups: key, sky; the picture takes 113 MB`.
pub(crate) fn of_picture(scene: &Scene) -> String {
    let groups = scene.light_groups().iter();
    let names: Vec<&str> = groups.map(|group| group.name.as_str()).collect();
    format!(
        "light {}: {}; the picture takes {}",
        if names.len() == 1 { "group" } else { "groups" },
        names.join(", "),
        shown_bytes(scene.image_bytes())
    )
}

/// Bytes with three digits.
fn shown_bytes(bytes: u128) -> String {
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
        for (bytes, shown) in [
            (1, "1 B"),
            (999, "999 B"),
            (1000, "1.00 kB"),
            (12_345, "12.3 kB"),
            (999_499, "999 kB"),
            (999_501, "1.00 MB"),
            (331_776_000, "332 MB"),
            (34_359_738_368, "34.4 GB"),
        ] {
            assert_eq!(shown_bytes(bytes), shown, "{bytes}");
        }
    }
}
