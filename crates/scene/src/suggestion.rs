//! "Did you mean …?"

/// The candidate nearest to `word` that a slip of the keys could have turned into it.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    // A long word in a file is not a slip of a short known one; the bound keeps the comparison cheap.
    if word.chars().count() > 64 {
        return None;
    }
    let word = word.to_lowercase();
    candidates
        .into_iter()
        .map(|candidate| (distance(&word, &candidate.to_lowercase()), candidate))
        .filter(|&(distance, candidate)| {
            let length = candidate.chars().count().min(word.chars().count());
            distance <= (length / 3).max(1) && distance < length.max(1)
        })
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// The fewest insertions, deletions, replacements and swaps of neighbours between two words.
fn distance(a: &str, b: &str) -> usize {
    strsim::osa_distance(a, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_slips_and_ignores_strangers() {
        let known = ["radius", "center", "material"];
        assert_eq!(nearest("radus", known), Some("radius"));
        assert_eq!(nearest("Centre", known), Some("center"));
        assert_eq!(nearest("colour", known), None);
        assert_eq!(nearest("", known), None);
        assert_eq!(nearest(&"r".repeat(100_000), known), None);
    }
}
