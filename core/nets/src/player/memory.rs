//! The memory of a packed system: arrays, or vectors.

#[cfg(feature = "alloc")]
use super::code::Size;
use super::code::{Clock, Code, Entry, Kept, Lists, Mailbox, NONE, Route, Words};
use super::field::Field;
use super::lists::{each_list, owned};
use super::pack::pack;

each_list!(owned);
