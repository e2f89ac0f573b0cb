//! The word that was probably meant.

/// The candidate that is nearest to `word` in spelling, when it is near enough to be a slip:
/// at most one slip in three letters, and letter case counts for nothing.
pub fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let word: Vec<char> = word.to_lowercase().chars().collect();
    let allowed = (word.len() / 3).max(1);
    candidates
        .map(|candidate| (distance(&word, &candidate.to_lowercase().chars().collect::<Vec<_>>()), candidate))
        .filter(|&(slips, candidate)| slips <= allowed && slips < candidate.chars().count())
        .min_by_key(|&(slips, _)| slips)
        .map(|(_, candidate)| candidate)
}

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`
/// (Damerau and Levenshtein's distance, restricted to one edit of each letter).
fn distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replaced.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(before[j - 2] + 1);
            }
            row.push(best);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(word: &str) -> Option<&'static str> {
        nearest(word, ["sin", "cos", "sqrt", "distance", "m1"].into_iter())
    }

    #[test]
    fn slips_are_recognised() {
        assert_eq!(near("sqtr"), Some("sqrt"));
        assert_eq!(near("Cos"), Some("cos"));
        assert_eq!(near("distanec"), Some("distance"));
        assert_eq!(near("snn"), Some("sin"));
        assert_eq!(near("m2"), Some("m1"));
    }

    #[test]
    fn strangers_are_not() {
        assert_eq!(near("torque"), None);
        assert_eq!(near("x"), None);
        assert_eq!(near(""), None);
    }

    #[test]
    fn distance_is_symmetric_and_counts_slips() {
        let letters = |text: &str| text.chars().collect::<Vec<_>>();
        for (a, b, slips) in [("", "abc", 3), ("ab", "ba", 1), ("kitten", "sitting", 3), ("same", "same", 0)] {
            assert_eq!(distance(&letters(a), &letters(b)), slips);
            assert_eq!(distance(&letters(b), &letters(a)), slips);
        }
    }
}
