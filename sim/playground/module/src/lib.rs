//! The module in a page of `cotama play`: `cotama-playground` behind functions that a script calls.
//!
//! A page makes one `Page` for each model, writes the model into its `input`, `load`s it, and then
//! `tell`s, goes (`go`) and asks (`state`, `why`). Answers stand in `words` and `text` until the
//! next call. A script has the handle alone: no function takes an address that
//! a script makes up, but for that. There is one thread.
//!
//! All unsafe code of the page is in this crate.
#![cfg_attr(target_arch = "wasm32", no_std)]
#![cfg(target_arch = "wasm32")]

extern crate alloc;

mod heap;

use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;
use cotama_playground::course::{Course, Plan, World};
use cotama_playground::{Board, Pilot, Refused, answer};

/// A model in play, with the last answer.
pub struct Page {
    input: Vec<u8>,
    board: Option<Board>,
    tables: Vec<u8>,
    pilot: Option<Pilot>,
    world: Option<World>,
    plan: Vec<u32>,
    course: Option<Course>,
    words: Vec<u32>,
    text: String,
}

/// A page whose input has this many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn open(length: usize) -> *mut Page {
    let page = Page {
        input: vec![0; length],
        board: None,
        tables: vec![],
        pilot: None,
        world: None,
        plan: vec![],
        course: None,
        words: vec![],
        text: String::new(),
    };
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
        Err(refused) => number(refused),
    }
}

fn number(refused: Refused) -> u32 {
    match refused {
        Refused::Endless => 1,
        Refused::Full => 2,
        Refused::Unknown => 3,
    }
}

/// So many bytes for the tables of a decider, to be written.
#[unsafe(no_mangle)]
pub extern "C" fn tables(page: &mut Page, length: usize) -> *mut u8 {
    page.tables = vec![0; length];
    page.tables.as_mut_ptr()
}

/// Sets the decider of these tables beside the supervisors that were loaded. Returns 0; or 1, and
/// why not, as a text.
#[unsafe(no_mangle)]
pub extern "C" fn employ(page: &mut Page) -> u32 {
    match Pilot::of(&page.tables, &page.input) {
        Ok(pilot) => {
            page.pilot = Some(pilot);
            0
        }
        Err(why) => {
            page.text = why;
            1
        }
    }
}

/// A period of the decider, in place of `tell`: flags that are up, modules that work, what is
/// said (kind times 256, and number, and 1; 0 for nothing), what the planner tells (a failure after
/// 1, or 0), whether the robot stands. Returns as `tell` does, and the account of the period.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments, reason = "a script passes numbers of 32 bits")]
pub extern "C" fn period(
    page: &mut Page,
    up_low: u32,
    up_high: u32,
    works_low: u32,
    works_high: u32,
    said: u32,
    planned: u32,
    stands: u32,
    low: u32,
    high: u32,
) -> u32 {
    let (Some(board), Some(pilot)) = (&mut page.board, &mut page.pilot) else { return 3 };
    let halves = |low: u32, high: u32| u64::from(high) << 32 | u64::from(low);
    let (up, works) = (halves(up_low, up_high), halves(works_low, works_high));
    match pilot.period_number(board, [up, works, halves(low, high)], [said, planned], stands != 0) {
        Ok(words) => {
            page.words = words;
            0
        }
        Err(refused) => number(refused),
    }
}

/// Answers where the robot is, and what is requested of it.
#[unsafe(no_mangle)]
pub extern "C" fn pilot(page: &mut Page) {
    let state = page.pilot.as_ref().zip(page.board.as_ref()).map(|(it, board)| it.state(board));
    page.words = state.unwrap_or_default();
}

/// Takes the bytes in `tables` for the world of courses. Returns 0; or 1, and why not, as a text.
#[unsafe(no_mangle)]
pub extern "C" fn world(page: &mut Page) -> u32 {
    match World::decode(&page.tables) {
        Ok(world) => {
            page.world = Some(world);
            0
        }
        Err(why) => {
            page.text = why.to_string();
            1
        }
    }
}

/// So many numbers for a plan of faults, to be written.
#[unsafe(no_mangle)]
pub extern "C" fn plan(page: &mut Page, length: usize) -> *mut u32 {
    page.plan = vec![0; length];
    page.plan.as_mut_ptr()
}

/// Runs the plan from its start to its end, beside the run that is played. Returns 0, and the
/// course; 1 when the plan is none, or there is no world.
#[unsafe(no_mangle)]
pub extern "C" fn course(page: &mut Page) -> u32 {
    let (Some(board), Some(pilot), Some(world)) = (&page.board, &page.pilot, &page.world) else {
        return 1;
    };
    let Some(plan) = Plan::of_numbers(&page.plan) else { return 1 };
    let course = Course::of(pilot, board, world, &plan);
    page.words = course.to_numbers();
    page.course = Some(course);
    0
}

/// Answers with the periods of the last course.
#[unsafe(no_mangle)]
pub extern "C" fn periods(page: &mut Page) {
    page.words = page.course.as_ref().map(Course::inputs_to_numbers).unwrap_or_default();
}

/// Goes to after so many steps.
#[unsafe(no_mangle)]
pub extern "C" fn go(page: &mut Page, to: usize) {
    page.board.iter_mut().for_each(|it| it.go(to));
    page.pilot.iter_mut().for_each(|it| it.go(to));
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

/// The count of them.
#[unsafe(no_mangle)]
pub extern "C" fn words_length(page: &Page) -> usize {
    page.words.len()
}

/// The text of the last answer, in UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn text(page: &Page) -> *const u8 {
    page.text.as_ptr()
}

/// The count of its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn text_length(page: &Page) -> usize {
    page.text.len()
}

/// A trap: the script sees an error, and says so.
#[panic_handler]
fn panicked(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
