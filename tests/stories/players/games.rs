//! Games that bytes steer: what a fuzz target plays, on stable.

use super::by_the_book::plays;
use cotama_fuzz::Reader;

const READER: Reader = Reader { name: "games", words: &[], read: plays };

#[test]
fn a_thousand_mutants_are_played_by_the_book() {
    READER.run(1_000);
}

#[test]
#[ignore = "minutes in a release build, by hand"]
fn a_million_mutants_are_played_by_the_book() {
    READER.run_a_million();
}
