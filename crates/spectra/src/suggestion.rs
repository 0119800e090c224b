//! "Did you mean …?"

/// The candidate nearest to `word` that a slip of the keys could have turned into it, or else the first that goes
/// on where it ends or ends where it goes on: `fov` means `fov_deg`. A slip changes at most a third of the letters of
/// the shorter word, rounded up, and not all of them; upper and lower case are no difference.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // A long word in a file is not a slip of a short known one; the bound keeps the comparison cheap.
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

/// How far `word` is from `known`, in insertions, deletions, replacements and swaps of neighbors; `None` when they have
/// nothing to do with each other.
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
        // Upper and lower case alone are no slip at all.
        assert_eq!(nearest("sio2", ["SiO", "TiO2", "SiO2"]), Some("SiO2"));
        assert_eq!(nearest("mat", known), Some("material"));
        assert_eq!(nearest("m", known), None);
        assert_eq!(nearest("", known), None);
        assert_eq!(nearest(&"r".repeat(100_000), known), None);
    }
}
