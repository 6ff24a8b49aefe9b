//! The module in a page of `cotama play`: `cotama-playground` behind functions that a script calls.
//!
//! A page makes one [`Page`] for each model, writes the model into [`input`], [`load`]s it, and
//! then [`tell`]s, goes ([`go`]) and asks ([`state`], [`why`]). Answers stand in [`words`] and
//! [`text`] until the next call. A script has the handle alone: no function takes an address that
//! a script makes up, but for that. There is one thread.
//!
//! All unsafe code of the page is in this crate.
#![cfg_attr(target_arch = "wasm32", no_std)]
#![cfg(target_arch = "wasm32")]

extern crate alloc;

mod heap;

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use cotama_playground::{Board, Refused, answer};

/// A model in play, with the last answer.
pub struct Page {
    input: Vec<u8>,
    board: Option<Board>,
    words: Vec<u32>,
    text: String,
}

/// A page whose input has this many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn open(length: usize) -> *mut Page {
    let page = Page { input: vec![0; length], board: None, words: vec![], text: String::new() };
    Box::into_raw(Box::new(page))
}

/// The input, to be written.
#[unsafe(no_mangle)]
pub extern "C" fn input(page: &mut Page) -> *mut u8 {
    page.input.as_mut_ptr()
}

/// Reads the input as a system, in rounds or not. Returns 0, and the records of the start; or 1,
/// and why not, as a text.
#[unsafe(no_mangle)]
pub extern "C" fn load(page: &mut Page, rounds: u32) -> u32 {
    match Board::of(&page.input, rounds != 0) {
        Ok(board) => {
            page.words = answer::records(board.started());
            page.board = Some(board);
            0
        }
        Err(why) => {
            page.text = why;
            1
        }
    }
}

/// Lets time pass, then offers the event before this number, or none for 0. Returns 0, and records;
/// 1 when it would not come to rest, 2 when the run is full, 3 when there is no such event, or no
/// such time.
#[unsafe(no_mangle)]
pub extern "C" fn tell(page: &mut Page, event: u32, low: u32, high: u32) -> u32 {
    let Some(board) = &mut page.board else { return 3 };
    match board.tell_number(event, low, high) {
        Ok(records) => {
            page.words = answer::records(&records);
            0
        }
        Err(Refused::Endless) => 1,
        Err(Refused::Full) => 2,
        Err(Refused::Unknown) => 3,
    }
}

/// Goes to after so many steps.
#[unsafe(no_mangle)]
pub extern "C" fn go(page: &mut Page, to: usize) {
    page.board.iter_mut().for_each(|it| it.go(to));
}

/// Answers with the state, and what would use events that are told at this time.
#[unsafe(no_mangle)]
pub extern "C" fn state(page: &mut Page, low: u32, high: u32) {
    let state = page.board.as_ref().map(|it| answer::state(it, low, high));
    page.words = state.unwrap_or_default();
}

/// Answers, as a text, why no transition would use an event that is told at this time; with nothing
/// if one would.
#[unsafe(no_mangle)]
pub extern "C" fn why(page: &mut Page, event: u32, low: u32, high: u32) {
    let why = page.board.as_ref().and_then(|it| it.why(event, low, high));
    page.text = why.unwrap_or_default();
}

/// The numbers of the last answer.
#[unsafe(no_mangle)]
pub extern "C" fn words(page: &Page) -> *const u32 {
    page.words.as_ptr()
}

/// How many they are.
#[unsafe(no_mangle)]
pub extern "C" fn words_length(page: &Page) -> usize {
    page.words.len()
}

/// The text of the last answer, in UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn text(page: &Page) -> *const u8 {
    page.text.as_ptr()
}

/// How many bytes it has.
#[unsafe(no_mangle)]
pub extern "C" fn text_length(page: &Page) -> usize {
    page.text.len()
}

/// A trap: the script sees an error, and says so.
#[panic_handler]
fn panicked(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
