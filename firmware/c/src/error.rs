//! The errors of a call.

use core::ffi::c_char;

/// The result of a call. If it is not `COTAMA_ERROR_OK`, nothing has happened: nothing has fired,
/// and no memory is written but the working memory of planning.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_error {
    /// The call has succeeded.
    Ok = 0,
    /// A pointer is null that must not be.
    NullPointer = 1,
    /// Memory is not aligned as its type needs it.
    Misaligned = 2,
    /// Memory is shorter than what it is for.
    TooSmall = 3,
    /// Memory that is written overlaps memory that is used at the same time.
    Overlap = 4,
    /// The memory holds no such handle: none was started there, or one of another type.
    NotStarted = 5,
    /// The handle is in use by a call that this one has interrupted.
    Busy = 6,
    /// A number stands for nothing here, or is out of its range.
    BadNumber = 7,
    /// An activity has no candidate.
    NoCandidates = 8,
    /// Stored bytes are not as they were written.
    Damaged = 9,
    /// Stored bytes are of another net, or of another version of it.
    OtherNet = 10,
    /// Stored bytes say what cannot be, such as a broken law.
    Impossible = 11,
    /// The numbers of the header are of another robot, or of another mission.
    OtherRobot = 12,
}

/// The result of a function, for callers who are not C.
///
/// cbindgen:ignore
pub type Done = Result<(), cotama_error>;

impl From<Done> for cotama_error {
    fn from(done: Done) -> Self {
        done.err().unwrap_or(Self::Ok)
    }
}

/// Returns the text of an error, in English, ended by a zero. Never null.
// SAFETY: no other function of the program has this name.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_error_text(error: i32) -> *const c_char {
    let text = match error {
        0 => c"it is done",
        1 => c"a pointer is null that must not be",
        2 => c"memory is not aligned as its type needs it",
        3 => c"memory is shorter than what it is for",
        4 => c"memory that is written overlaps memory that is used at the same time",
        5 => c"the memory holds no such handle: none was started there, or one of another type",
        6 => c"the handle is in use by a call that this one has interrupted",
        7 => c"a number stands for nothing here, or is out of its range",
        8 => c"an activity has no candidate",
        9 => c"the stored bytes are not as they were written",
        10 => c"the stored bytes are of another net, or of another version of it",
        11 => c"the stored bytes say what cannot be, such as a broken law",
        12 => c"the numbers of the header are of another robot, or of another mission",
        _ => c"there is no such error",
    };
    text.as_ptr()
}
