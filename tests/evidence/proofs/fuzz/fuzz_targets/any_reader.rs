//! Texts for the reader that `READER` names, as the folders of `tests/corpora` do: one of the
//! libraries, of the program, or of the firmware.
#![no_main]

#[path = "../../../../../firmware/robot/tests/readers.rs"]
mod firmware;
#[path = "../../../../stories/readers/mod.rs"]
mod readers;

use cotama_cli::readers::ALL as PROGRAM;
use cotama_fuzz::Reader;
use std::sync::LazyLock;

static CHOSEN: LazyLock<Reader> = LazyLock::new(|| {
    let name = std::env::var("READER").unwrap_or_default();
    let all = || readers::all().chain(PROGRAM).chain(firmware::ALL.iter().copied());
    let names = || all().map(|it| it.name).collect::<Vec<_>>().join(", ");
    all().find(|it| it.name == name).unwrap_or_else(|| panic!("READER={name}: one of {}", names()))
});

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    (CHOSEN.read)(bytes);
});
