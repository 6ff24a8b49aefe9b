//! Kinds of leaves: when they are asked, and what they may answer.

/// How a leaf behaves towards its parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LeafKind {
    /// Asked at every tick, answers SUCCESS or FAILURE.
    Condition,
    /// The same for an action that ends at once.
    Sync,
    /// Starts when IDLE, is asked while RUNNING, and repeats its status until it is reset.
    Stateful,
    /// Polled while RUNNING, else starts anew at every tick.
    Service,
    /// Takes its reference and answers FAILURE whenever it begins; asked while active.
    Latch,
    /// SUCCESS at the first tick of the object; asked afterwards.
    FirstSuccess,
    /// FAILURE at the first tick of the object; asked afterwards.
    FirstFailure,
}

impl LeafKind {
    /// All kinds, with their words in files of leaves.
    pub const ALL: [(&'static str, LeafKind); 7] = [
        ("condition", LeafKind::Condition),
        ("sync", LeafKind::Sync),
        ("stateful", LeafKind::Stateful),
        ("service", LeafKind::Service),
        ("latch", LeafKind::Latch),
        ("first_success", LeafKind::FirstSuccess),
        ("first_failure", LeafKind::FirstFailure),
    ];

    /// Returns the kind of this word.
    pub fn of_word(word: &str) -> Option<LeafKind> {
        LeafKind::ALL.iter().find(|it| it.0 == word).map(|it| it.1)
    }

    /// Returns the word of this kind.
    pub fn word(self) -> &'static str {
        LeafKind::ALL.iter().find(|it| it.1 == self).map_or("", |it| it.0)
    }

    /// Returns whether the leaf may answer RUNNING.
    pub fn runs(self) -> bool {
        matches!(self, LeafKind::Stateful | LeafKind::Service)
    }
}

/// A leaf as a file of leaves describes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Leaf {
    /// Tag.
    pub tag: String,
    /// Kind.
    pub kind: LeafKind,
    /// Ports that it writes, where this is known.
    pub writes: Vec<String>,
}

/// Reads a file of leaves: `tag kind [ports that it writes]` in columns; `#` begins a comment.
///
/// # Errors
///
/// Returns the line, from 1, and the cause.
pub fn read_leaves(text: &str) -> Result<Vec<Leaf>, (usize, String)> {
    let mut all = Vec::new();
    for (at, line) in text.lines().enumerate() {
        let line = line.trim_end();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let mut words = line.split_whitespace();
        let (Some(tag), Some(word)) = (words.next(), words.next()) else {
            return Err((at + 1, "a line has a tag and a kind".to_owned()));
        };
        let Some(kind) = LeafKind::of_word(word) else {
            let names: Vec<_> = LeafKind::ALL.iter().map(|it| it.0).collect();
            return Err((at + 1, format!("no kind `{word}`; there are {}", names.join(", "))));
        };
        let writes = line.split('\t').nth(2).unwrap_or("").split_whitespace();
        let writes = writes.filter(|it| *it != "-").map(str::to_owned).collect();
        all.push(Leaf { tag: tag.to_owned(), kind, writes });
    }
    Ok(all)
}

/// Returns the leaves of Nav2.
pub fn nav2() -> Vec<Leaf> {
    read_leaves(include_str!("nav2.tsv")).unwrap_or_default()
}

/// Returns the kind of a generic leaf: one of `A`, `B`, `C`, `S`, `L` and a number.
pub(crate) fn generic(tag: &str) -> Option<LeafKind> {
    let number = tag.get(1..)?;
    if number.is_empty() || !number.bytes().all(|it| it.is_ascii_digit()) {
        return None;
    }
    Some(match tag.as_bytes()[0] {
        b'A' => LeafKind::Stateful,
        b'B' => LeafKind::Service,
        b'C' => LeafKind::Condition,
        b'S' => LeafKind::Sync,
        b'L' => LeafKind::Latch,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_leaves_of_nav2_have_kinds() {
        let all = nav2();
        let kind = |tag: &str| all.iter().find(|it| it.tag == tag).map(|it| it.kind);
        assert_eq!(all.len(), 69);
        assert_eq!(kind("GoalUpdated"), Some(LeafKind::Latch));
        assert_eq!(kind("BackUp"), Some(LeafKind::Stateful));
        assert_eq!(generic("A12"), Some(LeafKind::Stateful));
        assert_eq!(generic("Ax"), None);
        assert_eq!(read_leaves("Fly slowly").unwrap_err().0, 1);
    }
}
