//! Names of a net as identifiers of a language that allows fewer characters.

use std::collections::{BTreeMap, BTreeSet};

/// One identifier a name, no two alike: a letter, then letters, digits, `_` and what `also` lists.
///
/// A name that is an identifier already stays as it is, unless it is in `reserved` or stands for
/// the second time. In the others each character that is not allowed becomes `_`, a first one that
/// is no letter is led by `n_`, and what is taken is followed by `_2`, `_3`, and so on.
pub(super) fn identifiers<'a>(
    names: impl Iterator<Item = &'a str> + Clone,
    also: &str,
    reserved: &[&str],
) -> Vec<String> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || also.contains(c);
    let begins = |name: &str| name.starts_with(|c: char| c.is_ascii_alphabetic());
    let fits = |name: &str| begins(name) && name.chars().all(allowed) && !reserved.contains(&name);

    // Names that fit go first: none of them gives way to a name that has to change anyway.
    let fitting: BTreeSet<&str> = names.clone().filter(|name| fits(name)).collect();
    let mut taken: BTreeSet<String> =
        fitting.iter().chain(reserved).map(|&name| name.to_owned()).collect();
    let mut given: BTreeSet<&str> = BTreeSet::new();
    let mut next: BTreeMap<String, u64> = BTreeMap::new();
    let mut identifier = |name: &'a str| {
        if fitting.contains(name) && given.insert(name) {
            return name.to_owned();
        }
        let lead = if begins(name) { "" } else { "n_" };
        let base: String =
            lead.chars().chain(name.chars().map(|c| if allowed(c) { c } else { '_' })).collect();
        let mut tried = base.clone();
        let number = next.entry(base.clone()).or_insert(2);
        while !taken.insert(tried.clone()) {
            tried = format!("{base}_{number}");
            *number += 1;
        }
        tried
    };
    names.map(&mut identifier).collect()
}

#[cfg(test)]
mod tests {
    use super::identifiers;

    #[test]
    fn names_that_fit_stay_and_the_others_make_way_for_them() {
        let names = ["door open", "door_open", "door_open", "", "3rd", "Tür", "if", "_x", "a-b"];
        let expected = [
            "door_open_2",
            "door_open",
            "door_open_3",
            "n_",
            "n_3rd",
            "T_r",
            "if_2",
            "n__x",
            "a_b",
        ];
        assert_eq!(identifiers(names.into_iter(), "", &["if"]), expected);
        assert_eq!(identifiers(["a-b", "a.b"].into_iter(), "-", &[]), ["a-b", "a_b"]);
    }

    #[test]
    fn many_names_alike_are_told_apart() {
        let all = identifiers(std::iter::repeat_n("?", 50_000), "", &[]);
        assert_eq!(
            (all[0].as_str(), all[1].as_str(), all[49_999].as_str()),
            ("n__", "n___2", "n___50000")
        );
    }
}
