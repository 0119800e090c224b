//! The title of a picture.

use crate::picture::{Drawn, Scale};
use plotters::coord::Shift;
use plotters::prelude::*;

/// Draws the title above a picture.
pub(crate) fn draw_title<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    scale: Scale,
    title: &str,
) -> Drawn<B> {
    let style = scale.text_from(16.0);
    let place = (scale.px(16.0), scale.px(22.0));
    area.draw(&Text::new(shortened(title), place, style))
}

/// Shortens a stack to fit into a line: a long one keeps its first layers, their number, and the substrate.
fn shortened(title: &str) -> String {
    const MAX: usize = 90;
    let parts: Vec<&str> = title.split(" | ").collect();
    if title.chars().count() <= MAX || parts.len() < 3 {
        return title.chars().take(2 * MAX).collect();
    }
    let (start, layers, end) = (parts[0], parts.len() - 2, parts[parts.len() - 1]);
    let end = format!("… ({layers} layers) | {end}");
    let mut shown = start.to_owned();
    for part in &parts[1..=layers] {
        let length = shown.chars().count() + part.chars().count() + end.chars().count() + 6;
        if length > MAX {
            break;
        }
        shown += &format!(" | {part}");
    }
    format!("{shown} | {end}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_stack_is_shortened() {
        let many = "1 | ".to_owned() + &"titania 57 nm | silica 94 nm | ".repeat(7) + "bk7";
        let found = shortened(&many);
        assert!(
            found.starts_with("1 | titania 57 nm | silica 94 nm | "),
            "{found}"
        );
        assert!(found.ends_with("… (14 layers) | bk7"), "{found}");
        assert!(found.chars().count() <= 90, "{found}");
        assert_eq!(shortened("1 | 1.5 3 nm | 1"), "1 | 1.5 3 nm | 1");
    }
}
