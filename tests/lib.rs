//! What the tests and benchmarks across the crates share: seeded problem instances.

pub mod instances;
