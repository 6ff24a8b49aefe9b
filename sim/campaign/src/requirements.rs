//! Requirements as a set: however often one is named, it is one.

use crate::requirement::Requirement;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::ops::Deref;

/// Requirements, each once, in the order in which they were named first.
///
/// Two are one if they say the same after reading: `time<=05` is `time<=5`, and blanks of a
/// property are none of its words. The spelling of the first is kept.
///
/// ```
/// use cotama_campaign::requirements::Requirements;
/// let texts = ["requests<=0", "AG !gs.Safe", "requests<=00", "AG  ! gs.Safe"];
/// let asked: Requirements = texts.iter().map(|it| it.parse().unwrap()).collect();
/// let kept: Vec<_> = asked.iter().map(ToString::to_string).collect();
/// assert_eq!(kept, ["requests<=0", "AG !gs.Safe"]);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Requirements(Vec<Requirement>);

impl Requirements {
    /// Adds one; whether it was not there.
    pub fn insert(&mut self, requirement: Requirement) -> bool {
        let is_new = !self.0.iter().any(|it| it.says_what(&requirement));
        if is_new {
            self.0.push(requirement);
        }
        is_new
    }
}

impl Deref for Requirements {
    type Target = [Requirement];

    fn deref(&self) -> &[Requirement] {
        &self.0
    }
}

impl FromIterator<Requirement> for Requirements {
    fn from_iter<I: IntoIterator<Item = Requirement>>(all: I) -> Self {
        let mut set = Self::default();
        all.into_iter().for_each(|it| {
            set.insert(it);
        });
        set
    }
}

impl<const N: usize> From<[Requirement; N]> for Requirements {
    fn from(all: [Requirement; N]) -> Self {
        all.into_iter().collect()
    }
}

impl<'r> IntoIterator for &'r Requirements {
    type Item = &'r Requirement;
    type IntoIter = std::slice::Iter<'r, Requirement>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl Serialize for Requirements {
    /// A list of texts.
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.0.iter().map(ToString::to_string))
    }
}

impl<'de> Deserialize<'de> for Requirements {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let texts = Vec::<String>::deserialize(from)?;
        texts.iter().map(|it| it.parse().map_err(D::Error::custom)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(texts: &[&str]) -> Vec<String> {
        let set: Requirements = texts.iter().map(|it| it.parse().unwrap()).collect();
        set.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_requirement_is_there_once_wherever_it_was_named() {
        for (named, kept) in [
            (&["energy<=0", "completed", "energy<=0"][..], &["energy<=0", "completed"][..]),
            (&["requests<=0", "in-time", "requests<=00"], &["requests<=0", "in-time"]),
            (&["time<=007", "time<=7", "time<=8"], &["time<=7", "time<=8"]),
            (&["exposed<=1", "exposed<=1", "exposed<=1"], &["exposed<=1"]),
            (
                &["never gs.abort_DriveA", "brakes", "never gs.abort_DriveA"],
                &["never gs.abort_DriveA", "brakes"],
            ),
            (&["AG !gs.Safe", "completed", " AG  !gs.Safe "], &["AG !gs.Safe", "completed"]),
            (&["AG (a & b)", "AG(a&b)", "AG ( a &\tb )"], &["AG (a & b)"]),
            (
                &["AG (\"a b\" & c)", "AG (\"a  b\" & c)"],
                &["AG (\"a b\" & c)", "AG (\"a  b\" & c)"],
            ),
            (&["AG {a b}", "AG {ab}"], &["AG {a b}", "AG {ab}"]),
            (&["AG (not a)", "AG (nota)"], &["AG (not a)", "AG (nota)"]),
        ] {
            assert_eq!(read(named), kept, "{named:?}");
        }
    }

    #[test]
    fn a_stored_list_is_read_as_a_set_and_written_as_one() {
        let text = r#"["brakes","requests<=00","brakes","requests<=0"]"#;
        let set: Requirements = serde_json::from_str(text).unwrap();
        assert_eq!(serde_json::to_string(&set).unwrap(), r#"["brakes","requests<=0"]"#);
        let unknown = serde_json::from_str::<Requirements>(r#"["flies"]"#).unwrap_err();
        assert!(unknown.to_string().starts_with("`flies` is no requirement"), "{unknown}");
    }
}
