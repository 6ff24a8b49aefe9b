//! A stand-in for the crate that Kani links into proofs, for machines without Kani.
//!
//! The harnesses are the same files. Kani proves them for all inputs within the bounds of their
//! loops. Here they are type-checked, and run: on every combination of inputs where those are few
//! enough (*exhaustive*), else on a sample (no proof, and it says so). With `--cfg kani_symbolic`
//! inputs come from symbols that a symbolic executor replaces.
//!
//! It has no more than the harnesses use, under the names and with the meaning of Kani's crate.
#![cfg_attr(kani_symbolic, no_std)]

pub use kani_macros::{proof, should_panic, solver, unwind};

#[cfg_attr(kani_symbolic, path = "symbolic.rs")]
#[cfg_attr(not(kani_symbolic), path = "explore.rs")]
mod engine;
#[cfg(not(kani_symbolic))]
pub use engine::{Report, drive, explore};
pub use engine::{assume, covered};

/// A harness, as `#[kani::proof]` knows it.
#[derive(Clone, Copy)]
pub struct Harness {
    /// The path of the function.
    pub name: &'static str,
    /// Documentation of the harness.
    pub says: &'static str,
    /// The harness.
    pub run: fn(),
    /// Whether it is a canary: an engine that does not see it fail is blind.
    pub must_fail: bool,
}

/// A type with a value that stands for all of them.
pub trait Arbitrary: Sized {
    /// Any value.
    fn any() -> Self;
}

/// A value that stands for all values of its type.
pub fn any<T: Arbitrary>() -> T {
    T::any()
}

/// A value that stands for all those of its type for which `holds`.
pub fn any_where<T: Arbitrary, F: Fn(&T) -> bool>(holds: F) -> T {
    let mark = engine::mark();
    loop {
        let value = T::any();
        if holds(&value) {
            return value;
        }
        engine::again(mark);
    }
}

/// Claims that `condition` holds for some input: a harness that assumes too much fails this.
#[macro_export]
macro_rules! cover {
    ($condition:expr, $text:literal) => {
        $crate::covered($text, $condition)
    };
    ($condition:expr) => {
        $crate::covered(stringify!($condition), $condition)
    };
}

macro_rules! integers {
    ($($kind:ty)+) => { $(
        impl Arbitrary for $kind {
            fn any() -> Self {
                engine::choose(<$kind>::BITS) as Self
            }
        }
    )+ };
}
integers!(u8 u16 u32 u64 usize i8 i16 i32 i64 isize);

impl Arbitrary for bool {
    fn any() -> Self {
        engine::choose(1) == 1
    }
}

impl<T: Arbitrary, const N: usize> Arbitrary for [T; N] {
    fn any() -> Self {
        core::array::from_fn(|_| T::any())
    }
}

impl<T: Arbitrary> Arbitrary for Option<T> {
    fn any() -> Self {
        bool::any().then(T::any)
    }
}

impl<A: Arbitrary, B: Arbitrary> Arbitrary for (A, B) {
    fn any() -> Self {
        (A::any(), B::any())
    }
}
