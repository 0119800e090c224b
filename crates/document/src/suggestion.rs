//! "Did you mean …?"

/// Returns the candidate nearest to `word` within the distance of a typing error, or else the first that is a prefix of
/// `word` or has `word` as a prefix: `fov` suggests `fov_deg`. A typing error changes at most a third of the letters of
/// the shorter word, rounded up, and not all of them; case is ignored.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // A long word in a file is not a misspelling of a short known one; the bound keeps the comparison cheap.
    if word.chars().count() > 64 {
        return None;
    }
    let word = word.to_lowercase();
    let candidates = candidates
        .into_iter()
        .map(|known| (known.to_lowercase(), known));
    candidates
        .filter_map(|(lower, known)| Some((badness(&word, &lower)?, known)))
        .min_by_key(|&(badness, _)| badness)
        .map(|(_, known)| known)
}

/// Returns the distance of `word` from `known` in insertions, deletions, replacements and swaps of neighbors, or the maximum
/// if one is a prefix of the other; `None` when they are unrelated.
fn badness(word: &str, known: &str) -> Option<usize> {
    let length = known.chars().count().min(word.chars().count());
    let distance = strsim::osa_distance(word, known);
    if distance <= length.div_ceil(3) && distance < length {
        return Some(distance);
    }
    let is_start = known.starts_with(word) || word.starts_with(known);
    (is_start && length >= 3).then_some(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_slips_and_ignores_strangers() {
        let known = ["radius", "center", "material"];
        assert_eq!(nearest("radus", known), Some("radius"));
        assert_eq!(nearest("Center", known), Some("center"));
        assert_eq!(nearest("color", known), None);
        assert_eq!(nearest("radius_mm", known), Some("radius"));
        // A difference in case alone has distance 0.
        assert_eq!(nearest("sio2", ["SiO", "TiO2", "SiO2"]), Some("SiO2"));
        assert_eq!(nearest("mat", known), Some("material"));
        assert_eq!(nearest("m", known), None);
        assert_eq!(nearest("", known), None);
        assert_eq!(nearest(&"r".repeat(100_000), known), None);
    }
}
