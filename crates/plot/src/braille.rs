//! Curves drawn as text with braille: each character is two dots wide and four high.

/// Width of a curve in dots; it has one value for each.
pub const DOTS_WIDE: usize = 2 * CELLS_WIDE;
const CELLS_WIDE: usize = 64;
const CELLS_HIGH: usize = 10;
const DOTS_HIGH: usize = 4 * CELLS_HIGH;

/// The bits of a braille character's dots by column and row.
const BITS: [[u32; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];

/// The lines of text that draw a curve, from the top, each with the vertical axis before it; none if the curve has no
/// values.
pub fn curve(values: &[Option<f64>; DOTS_WIDE]) -> Vec<String> {
    let known = || values.iter().flatten().copied();
    let (Some(low), Some(high)) = (known().reduce(f64::min), known().reduce(f64::max)) else {
        return Vec::new();
    };
    // A flat line lies in the middle of a range of its own size.
    let margin = if high > low {
        0.0
    } else {
        (0.5 * low.abs()).max(f64::MIN_POSITIVE)
    };
    let (low, high) = (low - margin, high + margin);
    let dot = |value: f64| {
        let share = ((value - low) / (high - low)).clamp(0.0, 1.0);
        ((1.0 - share) * (DOTS_HIGH - 1) as f64).round() as usize
    };
    let rows: Vec<Option<usize>> = values.iter().map(|value| value.map(dot)).collect();
    let label = |line| match line {
        0 => number(high),
        line if line + 1 == CELLS_HIGH => number(low),
        _ => String::new(),
    };
    let lines = cells(&rows).into_iter().enumerate();
    lines
        .map(|(line, text)| format!("{:>10} ┤{text}", label(line)))
        .collect()
}

/// The characters, row by row. Neighboring dots are joined, so that a steep curve has no gaps.
fn cells(rows: &[Option<usize>]) -> Vec<String> {
    let mut bits = [[0; CELLS_WIDE]; CELLS_HIGH];
    for (column, &row) in rows.iter().enumerate() {
        let Some(row) = row else { continue };
        let before = column.checked_sub(1).and_then(|before| rows[before]);
        let from = before.unwrap_or(row).min(row);
        let to = before.unwrap_or(row).max(row);
        for dot in from..=to {
            bits[dot / 4][column / 2] |= BITS[column % 2][dot % 4];
        }
    }
    let character = |bits: &u32| char::from_u32(0x2800 + bits).unwrap_or(' ');
    bits.iter()
        .map(|row| row.iter().map(character).collect())
        .collect()
}

/// The axis below a curve, with five wavelengths on it.
pub fn axis(from_nm: f64, to_nm: f64) -> String {
    let step = CELLS_WIDE / 4;
    let mut line = " ".repeat(10);
    for mark in 0..=4 {
        let nm = from_nm + (to_nm - from_nm) * f64::from(mark) / 4.0;
        // Each number ends below its mark.
        let end = 12 + mark as usize * step;
        let width = end.saturating_sub(line.chars().count());
        line.push_str(&format!("{nm:>width$.0}"));
    }
    line + " nm"
}

/// A number with a few digits.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        "0".to_owned()
    } else if value.abs() < 1e-3 {
        format!("{value:.2e}")
    } else {
        format!("{value:.4}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rising_line_goes_from_the_lower_left_to_the_upper_right() {
        let line = std::array::from_fn(|column| Some(column as f64));
        let drawn = curve(&line);
        assert_eq!(drawn.len(), CELLS_HIGH);
        assert!(drawn[0].starts_with("  127.0000 ┤\u{2800}") && !drawn[0].ends_with('\u{2800}'));
        assert!(
            drawn[CELLS_HIGH - 1].starts_with("         0 ┤")
                && drawn[CELLS_HIGH - 1].ends_with('\u{2800}')
        );
        let first = drawn[CELLS_HIGH - 1].chars().nth(12).unwrap();
        assert_eq!(u32::from(first) - 0x2800, 0x40 | 0x80);
        assert!(
            drawn
                .iter()
                .all(|line| line.chars().count() == 12 + CELLS_WIDE)
        );
    }

    #[test]
    fn gaps_flat_lines_and_jumps_are_drawn() {
        assert!(curve(&[None; DOTS_WIDE]).is_empty());
        let flat = curve(&[Some(0.0); DOTS_WIDE]);
        assert_eq!(
            flat.iter()
                .filter(|line| line.contains(['⠤', '⠒', '⣀', '⠉']))
                .count(),
            1
        );
        let step = |column| (column >= 10).then_some(if column < 64 { 0.0 } else { 1.0 });
        let drawn = curve(&std::array::from_fn(step));
        for line in &drawn {
            let cells: Vec<char> = line.chars().skip(12).collect();
            assert!(cells[..5].iter().all(|&cell| cell == '\u{2800}'), "{line}");
            assert_ne!(cells[32], '\u{2800}', "the jump has a gap: {line}");
        }
    }

    #[test]
    fn the_axis_names_five_wavelengths() {
        let words: Vec<_> = axis(380.0, 780.0)
            .split_whitespace()
            .map(str::to_owned)
            .collect();
        assert_eq!(words, ["380", "480", "580", "680", "780", "nm"]);
    }
}
