//! Readable one-line labels of stacks.

/// Formats a number for people: unchanged if it is short, else with two decimals, or with four digits if it is small.
pub(crate) fn rounded(value: f64) -> String {
    let whole = value.to_string();
    let decimals = whole
        .split_once('.')
        .map_or(0, |(_, decimals)| decimals.len());
    if decimals <= 3 || !value.is_finite() {
        return whole;
    }
    // Four digits after the leading zeros.
    let zeros = (-value.abs().log10()).floor().clamp(0.0, 12.0) as usize;
    let decimals = if zeros == 0 { 2 } else { zeros + 4 };
    let text = format!("{value:.decimals$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.to_owned()
}

/// Maximum number of parts of a label.
const MAX: usize = 24;

/// Returns the layers in one line. Repeated layers become a group with a power, `(TiO2 60 nm | SiO2 90 nm)^8`, and a line that is
/// still long keeps only its ends.
pub(crate) fn of_layers(layers: &[String]) -> Vec<String> {
    let mut parts = Vec::new();
    let mut rest = layers;
    while let Some(first) = rest.first() {
        let (period, times) = repetition(rest);
        let covered = period * times;
        match rest.get(..period) {
            Some(group) if times > 1 && covered > 3 => {
                parts.push((
                    format!("({})^{times}", shortened(group).join(" | ")),
                    covered,
                ));
                rest = rest.get(covered..).unwrap_or_default();
            }
            _ => {
                parts.push((first.clone(), 1));
                rest = rest.get(1..).unwrap_or_default();
            }
        }
    }
    let left_out = parts.len().saturating_sub(MAX);
    if left_out > 1 {
        let middle = (parts.len() - left_out) / 2;
        let layers: usize = parts
            .drain(middle..middle + left_out)
            .map(|part| part.1)
            .sum();
        parts.insert(middle, (format!("… {layers} layers …"), layers));
    }
    parts.into_iter().map(|(part, _)| part).collect()
}

fn shortened(group: &[String]) -> Vec<String> {
    let (ends, middle) = (MAX / 2, group.len().saturating_sub(MAX));
    if middle < 2 {
        return group.to_vec();
    }
    let mut short = group.get(..ends).unwrap_or_default().to_vec();
    short.push(format!("… {middle} layers …"));
    short.extend_from_slice(group.get(ends + middle..).unwrap_or_default());
    short
}

/// Returns the number of layers that repeat at the start of a list, and how often: the period that covers most, or the shortest of
/// those that cover the same.
fn repetition(layers: &[String]) -> (usize, usize) {
    let mut best = (1, 1);
    for period in 1..=layers.len() / 2 {
        let same = layers.iter().zip(layers.iter().skip(period));
        let times = 1 + same.take_while(|(a, b)| a == b).count() / period;
        if times > 1 && period * times > best.0 * best.1 {
            best = (period, times);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stack;

    #[test]
    fn numbers_are_as_written_or_short() {
        for (value, text) in [
            (0.0, "0"),
            (100.0, "100"),
            (56.452_345, "56.45"),
            (94.178_082_191, "94.18"),
            (2.125, "2.125"),
            (300.000_000_1, "300"),
            (0.001_234_567, "0.001235"),
            (0.000_1, "0.0001"),
            (99_999.123_45, "99999.12"),
        ] {
            assert_eq!(rounded(value), text);
        }
    }

    fn label(line: &str) -> String {
        Stack::parse(line).unwrap().label()
    }

    #[test]
    fn what_repeats_is_a_group() {
        // 0.25 · 550 / 1.25 = 110, 0.25 · 550 / 1.5 = 91.666….
        assert_eq!(
            label("H=1.25 0.25@550; L=1.5 0.25@550; air | (HL)^8 2H | 1.6"),
            "air | (1.25 110 nm | 1.5 91.67 nm)^8 | 1.25 220 nm | 1.6"
        );
        assert_eq!(
            label("1 | 1.4 1nm | 1.5 2nm | 1.4 1nm | 1"),
            "1 | 1.4 1 nm | 1.5 2 nm | 1.4 1 nm | 1"
        );
        assert_eq!(label("1 | (1.5 2nm)^1000 | 1"), "1 | (1.5 2 nm)^1000 | 1");
        let varied = Stack::parse("1 | (1.4 1nm | 1.5 2nm)^4 | 1").unwrap();
        assert_eq!(
            varied.label_with_varied(1),
            "1 | 1.4 1 nm | 1.5 d | (1.4 1 nm | 1.5 2 nm)^3 | 1"
        );
    }

    #[test]
    fn what_does_not_repeat_has_its_ends() {
        let layers: Vec<String> = (0..1000).map(|nm| format!("1.5 {nm}nm")).collect();
        let label = label(&format!("1 | {} | 1", layers.join(" | ")));
        assert!(
            label.contains("| 1.5 11 nm | … 976 layers … | 1.5 988 nm |"),
            "{label}"
        );
    }
}
