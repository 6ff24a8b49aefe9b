//! Names as they are typed: told from paths, quoted for a shell, and what was probably meant.

/// Whether this looks like a name and not like a path.
pub(crate) fn is_name(text: &str) -> bool {
    text != "-" && !text.contains(['/', '\\', '.'])
}

/// The name that was probably meant: one with at most one wrong letter of three, or else one that
/// begins with the word.
pub(crate) fn near<'a>(word: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    // The distance takes time that grows with both lengths.
    let names = names.filter(|name| name.len() <= 64 && word.len() <= 64);
    let like = |(distance, name): &(usize, &str)| {
        let begins = word.len() >= 3 && name.starts_with(word);
        *distance <= (name.chars().count() / 3).max(1) || begins
    };
    let names = names.map(|name| (strsim::damerau_levenshtein(word, name), name));
    names.filter(like).min().map(|it| it.1)
}

/// A word as a shell takes it.
pub(crate) fn quoted(word: &str) -> String {
    let safe = |c: char| c.is_alphanumeric() || "-_./:=+@,".contains(c);
    if !word.is_empty() && word.chars().all(safe) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_names_as_near_the_first_in_the_alphabet_is_meant() {
        assert_eq!(near("cat", ["car", "cab", "dog"].into_iter()), Some("cab"));
        assert_eq!(near("dug", ["car", "cab", "dog"].into_iter()), Some("dog"));
    }

    #[test]
    fn a_quote_ends_the_quoted_word_and_begins_another() {
        assert_eq!(["a-b", "a b", "it's", ""].map(quoted), ["a-b", "'a b'", "'it'\\''s'", "''"]);
    }
}
