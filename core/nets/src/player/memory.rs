//! The memory of a packed system: arrays, or vectors.

use super::code::{Clock, Code, Kept, Listed, Lists, Mailbox, NONE, Route, Size, Words};
use super::field::Field;
use super::lists::{each_list, owned};
use super::pack::pack;

each_list!(owned);

/// The first items of a list, as many as an array has.
const fn first<T: Copy, const N: usize>(list: &[T]) -> [T; N] {
    match list.first_chunk() {
        Some(first) => *first,
        None => panic!("the list is longer than the array"),
    }
}

/// The type of the arrays of this size.
#[doc(hidden)]
#[macro_export]
macro_rules! __arrays {
    ($size:ident) => {
        $crate::player::Arrays<
            { $size.words },
            { $size.entries },
            { $size.needs },
            { $size.deltas },
            { $size.takes },
            { $size.rows },
            { $size.routes },
            { $size.says },
            { $size.mailboxes },
            { $size.components + 1 },
            { $size.fields },
            { $size.complements },
            { $size.clocks },
            { $size.clears },
            { $size.ignored },
            { $size.ignored_where },
            { $size.kept },
            { $size.summands },
        >
    };
}
