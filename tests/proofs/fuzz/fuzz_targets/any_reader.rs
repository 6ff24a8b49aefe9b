//! Texts for the reader that `READER` names, as the folders of `tests/corpora` do.
#![no_main]

#[path = "../../../stories/readers/mod.rs"]
mod readers;

use std::sync::LazyLock;

static CHOSEN: LazyLock<cotama_fuzz::Reader> = LazyLock::new(|| {
    let name = std::env::var("READER").unwrap_or_default();
    let names = || readers::all().map(|it| it.name).collect::<Vec<_>>().join(", ");
    readers::all()
        .find(|it| it.name == name)
        .unwrap_or_else(|| panic!("READER={name}: one of {}", names()))
});

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    (CHOSEN.read)(bytes);
});
