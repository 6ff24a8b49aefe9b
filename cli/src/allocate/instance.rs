//! The instance of an allocation problem, read from JSON with the place of every error.

use crate::exit::Failure;
use crate::file_errors::FileErrors;
use crate::input;
use cotama_core::problem::{Candidate, Problem};
use cotama_verification::formats::json::{Whole, Wrong, read_object};
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// An allocation problem: at least one candidate an activity.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Instance {
    /// In ms and mJ, inclusive.
    pub(crate) limits: [u64; 2],
    pub(crate) activities: Vec<Vec<Candidate<2>>>,
}

#[derive(serde::Deserialize)]
struct File {
    limits: Limits,
    activities: Bounded<Bounded<Triple, ActivityList>, InstanceList>,
}

#[derive(serde::Deserialize)]
struct Limits {
    duration_ms: Whole<u64>,
    energy_mj: Whole<u64>,
}

/// Quality, duration, energy.
struct Triple(u32, u32, u32);

impl<'de> Deserialize<'de> for Triple {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Three;

        impl<'de> Visitor<'de> for Three {
            type Value = Triple;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a candidate [quality,duration_ms,energy_mj]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Triple, A::Error> {
                let mut next = |before: usize| {
                    let number = list.next_element::<Whole<u32>>()?.map(|it| it.0);
                    number.ok_or_else(|| A::Error::invalid_length(before, &Three))
                };
                let triple = Triple(next(0)?, next(1)?, next(2)?);
                match list.next_element::<IgnoredAny>()? {
                    None => Ok(triple),
                    Some(_) => Err(A::Error::invalid_length(4, &self)),
                }
            }
        }

        deserializer.deserialize_seq(Three)
    }
}

/// A list of the instance, with its name and its largest length.
trait List {
    const WHAT: &'static str;
    const LEAST: usize;
    const MOST: usize;
}

struct InstanceList;

impl List for InstanceList {
    const WHAT: &'static str = "activities";
    const LEAST: usize = 0;
    const MOST: usize = Problem::<2>::MAX_ACTIVITIES;
}

struct ActivityList;

impl List for ActivityList {
    const WHAT: &'static str = "candidates";
    const LEAST: usize = 1;
    const MOST: usize = Problem::<2>::MAX_CANDIDATES;
}

/// A list within its bounds, so that the place of a list that is not is known.
struct Bounded<T, L> {
    items: Vec<T>,
    list: PhantomData<L>,
}

impl<'de, T: Deserialize<'de>, L: List> Deserialize<'de> for Bounded<T, L> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Items<T, L>(PhantomData<(T, L)>);

        impl<'de, T: Deserialize<'de>, L: List> Visitor<'de> for Items<T, L> {
            type Value = Vec<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a list of {}", L::WHAT)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<T>, A::Error> {
                let mut items = Vec::new();
                while let Some(item) = list.next_element()? {
                    if items.len() == L::MOST {
                        return Err(A::Error::custom(format!("more than {} {}", L::MOST, L::WHAT)));
                    }
                    items.push(item);
                }
                if items.len() < L::LEAST {
                    return Err(A::Error::custom(format!("an activity without {}", L::WHAT)));
                }
                Ok(items)
            }
        }

        let items = deserializer.deserialize_seq(Items::<T, L>(PhantomData))?;
        Ok(Self { items, list: PhantomData })
    }
}

impl Instance {
    /// Reads an instance; `name` is that of its file.
    pub(crate) fn parse(name: &str, text: &str) -> Result<Self, Failure> {
        let file: File = read_object(text).map_err(|error| {
            let Wrong { line, column, message, help, .. } = error;
            let more = help.map_or_else(String::new, |it| it + "; ");
            let is_fraction = message.starts_with("a whole number is needed here, not");
            let factor = if is_fraction { "multiply all by the same factor; " } else { "" };
            let errors = FileErrors::at(input::name(name), text.to_owned(), line, column, message);
            errors.help(format!(
                "{more}{factor}an instance is \
                 {{\"limits\":{{\"duration_ms\":D,\"energy_mj\":E}},\
                 \"activities\":[[[quality,duration_ms,energy_mj],...],...]}}, \
                 in whole numbers from 0; those of a candidate are below 2^32",
            ))
        })?;
        let candidate = |(id, &Triple(quality, duration, energy)): (u16, &Triple)| Candidate {
            cost: [duration, energy],
            quality,
            id,
        };
        let candidates = |activity: Bounded<Triple, ActivityList>| {
            (0..).zip(&activity.items).map(candidate).collect()
        };
        Ok(Self {
            limits: [file.limits.duration_ms.0, file.limits.energy_mj.0],
            activities: file.activities.items.into_iter().map(candidates).collect(),
        })
    }
}

/// Mutants of instances, for tests and fuzz targets.
#[cfg(any(test, feature = "fuzz"))]
pub(crate) mod mutants {
    use super::{Failure, Instance};
    use cotama_fuzz::Reader;

    pub(crate) const READER: Reader = Reader {
        name: "instances",
        words: &[
            "[",
            "]",
            ",",
            "null",
            "{}",
            "[0,0,0]",
            "\"limits\":",
            "\"activities\":",
            "4294967295",
        ],
        read,
    };

    fn read(bytes: &[u8]) -> bool {
        let text = String::from_utf8_lossy(bytes);
        match Instance::parse("file", &text) {
            Ok(instance) => {
                assert!(instance.activities.iter().all(|it| !it.is_empty()));
                true
            }
            Err(Failure::Text(errors)) => {
                assert_eq!(errors.errors.len(), 1);
                false
            }
            Err(other @ Failure::Message { .. }) => panic!("without its place: {other:?}"),
        }
    }

    #[test]
    fn reads_or_refuses_a_thousand_mutants() {
        READER.run(1_000);
    }

    #[test]
    #[ignore = "a minute in a release build, by hand"]
    fn reads_or_refuses_a_million_mutants() {
        READER.run_a_million();
    }
}
