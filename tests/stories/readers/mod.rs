//! No input makes a reader panic, hang or take much memory; what is refused is refused with its
//! place, and what is read is what is written again.
//!
//! A thousand mutants each here; a million each in a release build, which says what it found:
//! `cargo test --release -p cotama-tests --test stories readers -- --ignored`. What only the
//! program or the firmware reads has its readers there.

mod checks;
mod models;
mod stored;
mod verification;

/// Two tests of each reader.
macro_rules! readers {
    ($($name:ident: $read:ident, [$($word:literal),* $(,)?];)*) => {
        pub(super) mod of {
            /// All of them.
            pub(crate) const ALL: &[cotama_fuzz::Reader] = &[$($name::READER),*];

            $( pub(super) mod $name {
                pub(in super::super) const READER: cotama_fuzz::Reader = cotama_fuzz::Reader {
                    name: stringify!($name),
                    words: &[$($word),*],
                    read: super::super::$read,
                };

                #[test]
                fn reads_or_refuses_a_thousand_mutants() {
                    READER.run(1_000);
                }

                #[test]
                #[ignore = "a minute in a release build, by hand"]
                fn reads_or_refuses_a_million_mutants() {
                    READER.run_a_million();
                }
            } )*
        }
    };
}
use readers;

/// The folders of what is read elsewhere: by players, by the program, by the firmware.
#[cfg(test)]
const ELSEWHERE: [&str; 9] =
    ["games", "campaigns", "instances", "runs", "steps", "flash", "frames", "served", "states"];

/// All readers but those of the program and of the firmware.
pub(crate) fn all() -> impl Iterator<Item = cotama_fuzz::Reader> {
    let readers = [models::of::ALL, stored::of::ALL, verification::of::ALL];
    readers.into_iter().flatten().copied()
}

#[test]
fn every_folder_of_the_corpus_has_its_reader() {
    let folders = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/corpora")).unwrap();
    let mut folders: Vec<_> =
        folders.map(|it| it.unwrap().file_name().into_string().unwrap()).collect();
    folders.sort();
    let mut names: Vec<_> = all().map(|it| it.name).chain(ELSEWHERE).collect();
    names.sort_unstable();
    assert_eq!(folders, names);
}
