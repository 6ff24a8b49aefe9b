//! The roots of the sets of named things, each with its members: modules, resources, flags, failure
//! modes and what else a supervisor counts.
//!
//! A set comes as its caller can make it at worst: with any bits.

/// The roots of a set and of its members.
macro_rules! sets {
    ($($name:ident: $item:ident $set:ident;)*) => {$(
        mod $name {
            use cotama_models::cotama::{$item, $set};

            #[unsafe(export_name = concat!("root_set_", stringify!($name), "_made"))]
            fn made(list: &[$item], one: $item, set: $set, other: $set) -> [$set; 5] {
                let of = $set::of(list);
                [of, set.with(one), set.without(other), set.union(other), set.common(other)]
            }

            #[unsafe(export_name = concat!("root_set_", stringify!($name), "_from_bits"))]
            fn from_bits(any: $set) -> Option<$set> {
                $set::from_bits(any.bits())
            }

            #[unsafe(export_name = concat!("root_set_", stringify!($name), "_read"))]
            fn read(set: $set, one: $item, other: $set) -> ([bool; 4], usize, Option<$item>) {
                let asked = [set.has(one), set.covers(other), set.is(other), set.is_empty()];
                (asked, set.len(), set.first())
            }

            #[unsafe(export_name = concat!("root_set_", stringify!($name), "_iter"))]
            fn iter(set: $set) -> Option<$item> {
                set.iter().last()
            }

            #[unsafe(export_name = concat!("root_set_", stringify!($name), "_member"))]
            fn member(one: $item, name: &str) -> (&'static str, &'static str, Option<$item>) {
                (one.name(), one.doc(), $item::named(name))
            }
        }
    )*};
}

sets! {
    adjustments: Adjustment Adjustments;
    configurations: Configuration Configurations;
    failure_modes: FailureMode FailureModes;
    flags: Flag Flags;
    losses: Loss Losses;
    modules: Module Modules;
    probes: Probe Probes;
    reports: Report Reports;
    resources: Resource Resources;
}
