//! Reading JSON, and what is wrong with it in the words of who wrote it.

use serde::de::{Deserialize, DeserializeOwned, Deserializer, Error, Visitor};
use serde::{Serialize, Serializer};
use std::fmt;
use std::marker::PhantomData;

/// An error of a text of JSON: the place, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// The line, from 1.
    pub line: usize,
    /// The column in bytes, from 1.
    pub column: usize,
    /// The error.
    pub message: String,
    /// The help, where that is more than the message says.
    pub help: Option<String>,
    /// Whether the text ends too early.
    pub cut_off: bool,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, message, .. } = self;
        write!(f, "line {line}, column {column}: {message}")
    }
}

impl std::error::Error for Wrong {}

/// The value that a text has as one object of JSON.
///
/// # Errors
/// The first thing that is wrong with the text.
///
/// ```
/// use cotama_verification::formats::json::{Whole, read_object};
/// #[derive(serde::Deserialize)]
/// struct At {
///     t_ms: Whole<u32>,
/// }
/// assert_eq!(read_object::<At>(r#"{"t_ms": 2000.0}"#).unwrap().t_ms.0, 2000);
/// let said = |text| read_object::<At>(text).err().unwrap().to_string();
/// let half = said(r#"{"t_ms": 2.5}"#);
/// assert_eq!(half, "line 1, column 12: a whole number is needed here, not 2.5");
/// let list = said("[]");
/// assert_eq!(list, "line 1, column 1: a list stands where an object is needed");
/// let cut = said("{\"t_ms\": 2");
/// assert_eq!(cut, "line 1, column 10: the text is cut off inside of an object");
/// ```
pub fn read_object<T: DeserializeOwned>(text: &str) -> Result<T, Wrong> {
    let bare = text.strip_prefix('\u{feff}').unwrap_or(text);
    let trimmed = bare.trim_start();
    if trimmed.starts_with('[') {
        let before = &bare[..bare.len() - trimmed.len()];
        let line = 1 + before.matches('\n').count();
        let column = 1 + before.len() - before.rfind('\n').map_or(0, |it| it + 1);
        let message = "a list stands where an object is needed".to_owned();
        let help = Some("an object is `{\"key\": value, ...}`".to_owned());
        return Err(Wrong { line, column, message, help, cut_off: false });
    }
    serde_json::from_str(bare).map_err(|error| wrong(&error, bare))
}

/// Translates a message of `serde_json` about this text, which ends with its place; nothing of
/// other messages.
///
/// ```
/// use cotama_verification::formats::json::in_words;
/// let wrong = in_words("EOF while parsing a list at line 1 column 1", "[").unwrap();
/// assert_eq!(wrong.message, "the text is cut off inside of a list");
/// ```
pub fn in_words(said: &str, text: &str) -> Option<Wrong> {
    let (said, place) = said.rsplit_once(" at line ")?;
    let (line, column) = place.split_once(" column ")?;
    let (line, column) = (line.parse::<usize>().ok()?, column.parse::<usize>().ok()?);
    let (line, column) = (line.max(1), column.max(1));
    let cut_off = said.starts_with("EOF while parsing");
    let (message, help) = if text.trim().is_empty() {
        ("the file is empty".to_owned(), None)
    } else if cut_off {
        (ends(said).to_owned(), Some("it was not written to its end"))
    } else {
        syntax(said, word_at(text, line, column)).unwrap_or_else(|| data(said))
    };
    Some(Wrong { line, column, message, help: help.map(str::to_owned), cut_off })
}

/// Translates an error of the library.
fn wrong(error: &serde_json::Error, text: &str) -> Wrong {
    let said = error.to_string();
    in_words(&said, text).unwrap_or_else(|| Wrong {
        line: error.line().max(1),
        column: error.column().max(1),
        message: data(&said).0,
        help: None,
        cut_off: false,
    })
}

fn ends(said: &str) -> &'static str {
    if said.ends_with("string") {
        "the text is cut off inside of a text in quotation marks"
    } else if said.ends_with("list") {
        "the text is cut off inside of a list"
    } else if said.ends_with("object") {
        "the text is cut off inside of an object"
    } else {
        "the text is cut off before a value"
    }
}

/// The word or sign around a place.
fn word_at(text: &str, line: usize, column: usize) -> &str {
    let line = text.split('\n').nth(line - 1).unwrap_or("");
    let part = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_' || *byte == b'-';
    let at = (column - 1).min(line.len());
    let bytes = line.as_bytes();
    let start = at - bytes[..at].iter().rev().take_while(|it| part(it)).count();
    let length = bytes[start..].iter().take_while(|it| part(it)).count();
    line.get(start..start + length.max(1)).unwrap_or("")
}

type Words = (String, Option<&'static str>);

/// Says what is wrong with the signs of a text; nothing where it is about what they say.
fn syntax(said: &str, word: &str) -> Option<Words> {
    let message = match said {
        "expected value" | "expected ident" | "invalid number" => return Some(no_value(word)),
        "expected `:`" => "`:` is needed behind a key",
        "expected `,` or `}`" => "`,` or `}` is needed here",
        "expected `,` or `]`" => "`,` or `]` is needed here",
        "trailing comma" => "a comma stands before the bracket that closes",
        "trailing characters" => "nothing may follow behind the object",
        "key must be a string" if ["/", "#"].contains(&word) => return Some(no_value(word)),
        "key must be a string" => "a key in double quotation marks is needed here",
        "number out of range" => "this number is too large",
        "recursion limit exceeded" => "this is nested too deeply",
        "invalid escape" => "after `\\` comes one of \" \\ / b f n r t, or u and four digits",
        _ if said.starts_with("control character") => {
            "a text ends on the line where it begins, and has no control characters"
        }
        _ if said.ends_with("hex escape") || said == "invalid unicode code point" => {
            "this `\\u` is the code of no character"
        }
        _ => return None,
    };
    Some((message.to_owned(), None))
}

/// Names a value of another language in place of one of JSON.
fn no_value(word: &str) -> Words {
    let foreign = match word.trim_start_matches('-') {
        it if it.eq_ignore_ascii_case("nan") => "NaN is no number of JSON",
        "Infinity" | "inf" | "Inf" | "infinity" => "infinity is no number of JSON",
        "None" | "True" | "False" => {
            let message = format!("`{word}` is a word of Python, not of JSON");
            return (message, Some("write `null`, `true` and `false`, as `json.dumps` does"));
        }
        "undefined" => "`undefined` is no value of JSON",
        "'" => return ("a text stands in double quotation marks".to_owned(), None),
        "/" | "#" => return ("JSON has no comments".to_owned(), Some("remove it")),
        _ => "",
    };
    if !foreign.is_empty() {
        return (foreign.to_owned(), Some("write `null` where there is no number"));
    }
    ("a value of JSON is needed here".to_owned(), None)
}

fn data(said: &str) -> Words {
    if let Some(name) = said.strip_prefix("missing field ") {
        return (format!("{name} is missing"), None);
    }
    if let Some(name) = said.strip_prefix("duplicate field ") {
        return (format!("{name} is there twice"), Some("leave one of them out"));
    }
    for (word, ours) in [("unknown field ", "key"), ("unknown variant ", "word")] {
        let Some(rest) = said.strip_prefix(word) else { continue };
        let (name, known) = rest.split_once(", expected ").unwrap_or((rest, ""));
        let known = known.trim_start_matches("one of ");
        let known = if known.is_empty() { String::new() } else { format!("; known: {known}") };
        return (format!("unknown {ours} {name}{known}"), None);
    }
    let kinds = ["invalid type: ", "invalid value: ", "invalid length "];
    let found = kinds.iter().find_map(|it| said.strip_prefix(it));
    match found.and_then(|it| it.rsplit_once(", expected ")) {
        Some((found, wanted)) => {
            let message = format!("{} is needed here, not {}", needed(wanted), there(found));
            (message, None)
        }
        None => (said.to_owned(), None),
    }
}

/// The value that is needed, without names of types.
fn needed(wanted: &str) -> String {
    let whole = |least: i128, most: i128| format!("a whole number from {least} to {most}");
    match wanted {
        "u8" => whole(0, u8::MAX.into()),
        "u16" => whole(0, u16::MAX.into()),
        "u32" => whole(0, u32::MAX.into()),
        "u64" | "usize" => whole(0, u64::MAX.into()),
        "i8" => whole(i8::MIN.into(), i8::MAX.into()),
        "i16" => whole(i16::MIN.into(), i16::MAX.into()),
        "i32" => whole(i32::MIN.into(), i32::MAX.into()),
        "i64" | "isize" => whole(i64::MIN.into(), i64::MAX.into()),
        "f32" | "f64" => "a number".to_owned(),
        "a string" | "a borrowed string" | "string" | "str" => "a text".to_owned(),
        "a boolean" => "`true` or `false`".to_owned(),
        "a sequence" => "a list".to_owned(),
        "a map" => "an object".to_owned(),
        "unit" | "null" => "`null`".to_owned(),
        _ if wanted.starts_with("tuple") => match wanted.split(" with ").nth(1) {
            Some(count) => format!("a list of {count}"),
            None => "a list".to_owned(),
        },
        _ if wanted.starts_with("struct ") || wanted.starts_with("internally tagged") => {
            "an object".to_owned()
        }
        _ if wanted.starts_with("enum ") || wanted.contains("variant") => {
            "one of the words of this format".to_owned()
        }
        _ if wanted.starts_with("Option<") || wanted == "option" => "a value or `null`".to_owned(),
        other => other.to_owned(),
    }
}

/// The value that is there instead.
fn there(found: &str) -> String {
    let value = |it: &str| it.trim_matches('`').to_owned();
    match found {
        "map" | "struct" | "struct variant" => "an object".to_owned(),
        "sequence" | "tuple" | "tuple variant" => "a list".to_owned(),
        "null" | "unit" | "Option value" | "unit value" => "`null`".to_owned(),
        _ => {
            if let Some(number) = found.strip_prefix("integer ") {
                value(number)
            } else if let Some(number) = found.strip_prefix("floating point ") {
                value(number)
            } else if let Some(word) = found.strip_prefix("boolean ") {
                word.to_owned()
            } else if let Some(text) = found.strip_prefix("string ") {
                format!("the text {text}")
            } else if let Ok(length) = found.parse::<usize>() {
                format!("a list of {length}")
            } else {
                found.to_owned()
            }
        }
    }
}

/// A whole number, however it is written: `2000.0` and `2e3` are 2000.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Whole<T>(pub T);

/// The whole numbers of a width.
pub trait Count: TryFrom<i128> + Into<i128> + Copy {
    /// The least of them.
    const LEAST: i128;
    /// The largest of them.
    const MOST: i128;
}

macro_rules! counts {
    ($($width:ty),*) => {$(
        impl Count for $width {
            const LEAST: i128 = <$width>::MIN as i128;
            const MOST: i128 = <$width>::MAX as i128;
        }
    )*};
}
counts!(u8, u16, u32, u64, i16, i32, i64);

impl<T: Serialize> Serialize for Whole<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de, T: Count> Deserialize<'de> for Whole<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Read<T>(PhantomData<T>);

        impl<T: Count> Read<T> {
            fn of<E: Error>(number: i128) -> Result<Whole<T>, E> {
                T::try_from(number).map(Whole).map_err(|_| {
                    let (least, most) = (T::LEAST, T::MOST);
                    E::custom(format!(
                        "a whole number from {least} to {most} is needed here, not {number}"
                    ))
                })
            }
        }

        impl<T: Count> Visitor<'_> for Read<T> {
            type Value = Whole<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a whole number from {} to {}", T::LEAST, T::MOST)
            }

            fn visit_u64<E: Error>(self, number: u64) -> Result<Whole<T>, E> {
                Self::of(number.into())
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<Whole<T>, E> {
                Self::of(number.into())
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Whole<T>, E> {
                /// Up to here each whole number is a float of its own.
                const EXACT: f64 = 9_007_199_254_740_992.0;
                if number.fract() != 0.0 {
                    let message = format!("a whole number is needed here, not {number:?}");
                    return Err(E::custom(message));
                }
                if number.abs() <= EXACT {
                    return Self::of(number as i128);
                }
                let (least, most) = (T::LEAST, T::MOST);
                Err(E::custom(if T::try_from(number as i128).is_ok() {
                    format!("a whole number with all its digits is needed here, not {number:?}")
                } else {
                    format!("a whole number from {least} to {most} is needed here, not {number:?}")
                }))
            }
        }

        deserializer.deserialize_any(Read(PhantomData))
    }
}

#[cfg(test)]
mod tests {
    use super::{Whole, read_object};
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "only whether it can be read counts")]
    struct Place {
        name: String,
        tokens: Whole<u16>,
        #[serde(default)]
        more: Vec<u32>,
        open: Option<bool>,
    }

    fn said(text: &str) -> String {
        read_object::<Place>(text).unwrap_err().message
    }

    #[test]
    fn a_number_is_whole_however_it_is_written() {
        for (written, number) in [("2000.0", 2000), ("2e3", 2000), ("7", 7), ("-0.0", 0)] {
            let text = format!("{{\"name\": \"p\", \"tokens\": {written}}}");
            assert_eq!(read_object::<Place>(&text).unwrap().tokens, Whole(number), "{written}");
        }
        for (written, message) in [
            ("2.5", "a whole number is needed here, not 2.5"),
            ("-1", "a whole number from 0 to 65535 is needed here, not -1"),
            ("65536", "a whole number from 0 to 65535 is needed here, not 65536"),
            ("1e300", "a whole number from 0 to 65535 is needed here, not 1e300"),
            ("-1e23", "a whole number from 0 to 65535 is needed here, not -1e23"),
            ("99999999999999999999", "a whole number from 0 to 65535 is needed here, not 1e20"),
            ("\"7\"", "a whole number from 0 to 65535 is needed here, not the text \"7\""),
            ("null", "a whole number from 0 to 65535 is needed here, not `null`"),
            ("[7]", "a whole number from 0 to 65535 is needed here, not a list"),
            ("{}", "a whole number from 0 to 65535 is needed here, not an object"),
        ] {
            let text = format!("{{\"name\": \"p\", \"tokens\": {written}}}");
            assert!(said(&text).starts_with(message), "{written}: {}", said(&text));
        }
    }

    #[test]
    fn errors_are_told_without_words_of_a_library() {
        for (text, message) in [
            ("", "the file is empty"),
            (" \n", "the file is empty"),
            ("[{\"name\": \"p\"}]", "a list stands where an object is needed"),
            ("{\"name\": \"p", "the text is cut off inside of a text in quotation marks"),
            ("{\"name\": \"p\", \"more\": [1", "the text is cut off inside of a list"),
            ("{\"name\": ", "the text is cut off before a value"),
            ("{\"name\": \"p\"", "the text is cut off inside of an object"),
            ("{\"tokens\": NaN}", "NaN is no number of JSON"),
            ("{\"tokens\": -Infinity}", "infinity is no number of JSON"),
            ("{\"open\": True}", "`True` is a word of Python, not of JSON"),
            ("{\"name\": 'p'}", "a text stands in double quotation marks"),
            ("{\"name\": \"p\", // so", "JSON has no comments"),
            ("{\"name\": \"p\",}", "a comma stands before the bracket that closes"),
            ("{name: \"p\"}", "a key in double quotation marks is needed here"),
            ("{\"name\": \"p\"} x", "`tokens` is missing"),
            ("id,function", "a value of JSON is needed here"),
            ("{\"nam\": 1}", "unknown key `nam`; known: `name`, `tokens`, `more`, `open`"),
            ("{\"name\": 1}", "a text is needed here, not 1"),
            ("{\"name\": \"p\", \"name\": \"q\"}", "`name` is there twice"),
            ("{\"name\": \"p\", \"more\": 3}", "a list is needed here, not 3"),
            ("{\"name\": \"p\", \"open\": 3}", "`true` or `false` is needed here, not 3"),
        ] {
            assert_eq!(said(text), message, "{text}");
        }
    }

    #[test]
    fn a_byte_order_mark_is_no_part_of_the_text() {
        let text = "\u{feff}{\"name\": \"p\", \"tokens\": 1}";
        assert_eq!(read_object::<Place>(text).unwrap().name, "p");
    }
}
