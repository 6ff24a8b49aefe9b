//! The roots of quantities: sums and differences that fit or are none, and what follows from one
//! another.

use cotama_core::ticks::Ticks32;
use cotama_core::units::{
    Micros, Millijoules, Millimetres, MillimetresPerSecond, Millis, Milliwatts, mul_div_half_up,
};

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_units(a: u64, b: u64, c: u64) -> [Option<u64>; 4] {
    [
        mul_div_half_up(a, b, c),
        Millis::to_travel(Millimetres(a), MillimetresPerSecond(b)).map(|it| it.0),
        Micros::from_millis(Millis(a)).map(|it| it.0),
        Millijoules::spent(Milliwatts(a), Millis(b)).map(|it| it.0),
    ]
}

#[unsafe(no_mangle)]
fn root_ticks(mut ticks: Ticks32, first: u32, count: u32) -> [Millis; 3] {
    let mut other = Ticks32::starting_at(first);
    let mut third = Ticks32::going_on_at(ticks.latest());
    [ticks.widen(count), other.widen(count), third.widen(first)]
}

/// The roots of a quantity.
macro_rules! quantities {
    ($($name:ident: $quantity:ident;)*) => {$(
        #[unsafe(export_name = concat!("root_units_", stringify!($name)))]
        fn $name(one: $quantity, other: $quantity) -> [Option<$quantity>; 2] {
            [one.checked_add(other), one.checked_sub(other)]
        }
    )*};
}

quantities! {
    duration: Millis;
    short_duration: Micros;
    energy: Millijoules;
    length: Millimetres;
    power: Milliwatts;
    speed: MillimetresPerSecond;
}
