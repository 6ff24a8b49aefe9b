//! The program of the robot's microcontroller, without heap, and scenes by which two machines can
//! be told apart: the same code makes the same bytes on a host and on a chip.
//!
//! | module | what |
//! | --- | --- |
//! | [`control`] | the decisional level, a period at a time, and what of it survives a power cut |
//! | [`patrol`] | the patrol mission: planned, watched, planned again |
//! | [`guard`] | the watchdog net that feeds the hardware watchdog |
//! | [`link`] | frames with a checksum and a number, over a UART |
//! | [`message`] | what the frames say |
//! | [`server`] | the robot behind its UART |
//! | [`store`] | the last whole record, in two pages of flash |
//! | [`robots`] | the robots, printed from their files |
//! | [`trace`] | what a run leaves behind |
//! | [`scenes`] | runs that are compared byte by byte |
#![no_std]
#![forbid(unsafe_code)]

pub mod control;
pub mod dice;
pub mod guard;
pub mod link;
pub mod message;
pub mod patrol;
pub mod robots;
pub mod scenes;
pub mod server;
pub mod store;
pub mod surroundings;
pub mod trace;
