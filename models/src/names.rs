//! Names that someone typed, and how messages say them.

/// The longest id, in characters.
pub(crate) const MAX_ID: usize = 64;

/// A text from a file, as it is quoted in a message: one line, without control characters, not too
/// long.
pub fn quoted(text: &str) -> String {
    let short: String = text.chars().take(MAX_ID).collect();
    let more = if short.len() < text.len() { "..." } else { "" };
    format!("`{}{more}`", short.escape_debug())
}

/// The known name nearest to a misspelt one, if one is near enough to be meant.
pub(crate) fn nearest<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    if name.len() > MAX_ID {
        return None;
    }
    let distance =
        |known: &str| strsim::damerau_levenshtein(&name.to_lowercase(), &known.to_lowercase());
    let near = |known: &&str| !known.is_empty() && distance(known) <= (known.len() / 3).max(1);
    known.filter(near).min_by_key(|known| distance(known))
}

/// "unknown ... `name`; did you mean ...?", with the known names when none is near.
pub fn unknown<'n>(
    what: &str,
    name: &str,
    known: impl Iterator<Item = &'n str>,
) -> (String, String) {
    unknown_among(what, name, &known.collect::<Vec<_>>())
}

/// Works on a list, as there are forty kinds of iterators, and it is built for each.
fn unknown_among(what: &str, name: &str, names: &[&str]) -> (String, String) {
    let message = format!("unknown {what} {}", quoted(name));
    if let Some(near) = nearest(name, names.iter().copied()) {
        return (format!("{message}; did you mean `{near}`?"), format!("write `{near}`"));
    }
    let names = &names[..names.len().min(20)];
    let help = if names.is_empty() {
        "none is defined".into()
    } else {
        format!("known: {}", names.join(", "))
    };
    (message, help)
}
