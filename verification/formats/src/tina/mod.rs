//! The `.net` format of TINA, in which time Petri nets are exchanged, read and written.
//!
//! ```
//! use cotama_verification::tina;
//!
//! let net = tina::read(
//!     "lamp.net",
//!     b"net lamp  tr press [0,w[ off -> on  tr fade ]2,5] on -> off  pl off (1)",
//! )
//! .unwrap();
//! assert_eq!(net.transitions()[1].interval.to_string(), "]2,5]");
//! assert_eq!(tina::read("lamp.net", tina::write(&net).as_bytes()), Ok(net));
//! ```
//!
//! # What is read
//!
//! ```text
//! file        = { declaration }
//! declaration = "net" name
//!             | "pl" name [":" name] ["(" number ")"]
//!             | "tr" name [":" name] [interval] [{ input } "->" { output }]
//!             | "nt" name ("0" | "1") name                     a note, not kept
//! interval    = ("[" | "]") integer "," (integer ("]" | "[") | "w" "[")
//! input       = name [("*" | "?") number]                      * weight, ? read arc
//! output      = name ["*" number]
//! number      = integer ["K" | "M" | "G" | "T" | "P" | "E"]
//! name        = one or more of A-Z, a-z, 0-9, ' and _   |   "{" any characters "}" with \{ \} \\
//! comment     = "#" to the end of the line
//! ```
//!
//! - A byte order mark is no part of the text.
//! - White space separates and means nothing else; a keyword begins the next declaration. A name
//!   that is a keyword needs braces.
//! - A bracket opens and closes: `]2,5]` is 2 < x ≤ 5, `[2,w[` has no end. Without interval a
//!   transition has `[0,w[`.
//! - Nodes are declared by their first appearance, which is also their order. Declarations of one
//!   node add up: arcs and tokens are summed, of several read arcs to a place the largest counts,
//!   intervals intersect, the last label stays.
//! - An arc of weight 0 is none.
//! - Priorities (`pr`), `lb`, inhibitor arcs (`?-`), stopwatch arcs (`!`) and arcs in `pl`
//!   declarations are refused.
//!
//! Weights and tokens are at most [`u32::MAX`], bounds at most
//! [`Interval::LARGEST`](cotama_property::time::Interval::LARGEST). [`Limits`] bound what a file
//! may ask for.
//! Time and memory grow with the length of the file, and there is no recursion.

mod error;
mod parser;
mod token;
mod write;

pub use error::TinaError;
pub use write::write;

use cotama_property::time::TimeNet;
use error::Finding;

/// How much a file may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The length of the file.
    pub bytes: usize,
    /// The bytes of one name.
    pub name: usize,
    /// Places, transitions and arcs together.
    pub objects: usize,
}

impl Default for Limits {
    /// A file of 1 GiB, names of 1 MiB, 2²⁸ objects.
    fn default() -> Self {
        Self { bytes: 1 << 30, name: 1 << 20, objects: 1 << 28 }
    }
}

/// Reads the net of a `.net` file. `name` is the name of the file in messages.
///
/// # Errors
/// The first error of the file.
///
/// ```
/// use cotama_verification::tina;
/// let net = tina::read("mine.net", b"tr t [2,5] p -> q*2  pl p (1)").unwrap();
/// assert_eq!((net.places().len(), net.transitions()[0].give[0].weight), (2, 2));
/// let error = tina::read("mine.net", b"tr t [2,5 p -> q").unwrap_err();
/// assert_eq!((error.line, error.column), (1, 11));
/// ```
pub fn read(name: &str, bytes: &[u8]) -> Result<TimeNet, TinaError> {
    read_within(name, bytes, Limits::default())
}

/// Reads the net of a `.net` file within other limits than the usual ones.
///
/// # Errors
/// As [`read`].
pub fn read_within(name: &str, bytes: &[u8], limits: Limits) -> Result<TimeNet, TinaError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let parsed = if bytes.len() > limits.bytes {
        let message = format!("the file has {} bytes, more than {}", bytes.len(), limits.bytes);
        Err(Finding::new(0, message).help("raise the limit, or make the net smaller"))
    } else {
        match std::str::from_utf8(bytes) {
            Ok(text) => parser::parse(text, limits),
            Err(error) => Err(Finding::new(error.valid_up_to(), "this byte is not UTF-8 text")),
        }
    };
    parsed.map_err(|finding| finding.locate(name, bytes))
}
