//! The first byte chooses a harness of those whose names hold `HARNESS`, the others are its inputs.
#![no_main]

#[path = "../../run/src/canaries.rs"]
mod canaries;
#[path = "../../run/src/harnesses.rs"]
#[allow(dead_code, reason = "whether a harness is exhaustive is no matter here")]
mod harnesses;

use std::sync::LazyLock;

static CHOSEN: LazyLock<Vec<kani::Harness>> = LazyLock::new(|| {
    let wanted = std::env::var("HARNESS").unwrap_or_default();
    let all = harnesses::all().into_iter().map(|it| it.harness);
    all.filter(|it| !it.must_fail && it.name.contains(&wanted)).collect()
});

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Some((&first, inputs)) = bytes.split_first() else { return };
    if let Some(harness) = CHOSEN.get(usize::from(first) % CHOSEN.len().max(1)) {
        kani::drive(inputs, harness.run);
    }
});
