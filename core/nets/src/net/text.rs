//! Sentences made while compiling: what a compile error of `net!` says.

/// The longest text; what goes beyond is cut off with "...".
const LIMIT: usize = 4_000;

/// The most names that are listed when one is not found.
const LISTED: usize = 12;

/// A text that grows, also in a `const`.
#[derive(Clone, Copy)]
pub(crate) struct Text {
    bytes: [u8; LIMIT],
    length: usize,
}

impl Text {
    pub(crate) const fn new() -> Self {
        Self { bytes: [0; LIMIT], length: 0 }
    }

    /// The same with this at its end.
    pub(crate) const fn with(mut self, more: &str) -> Self {
        let more = more.as_bytes();
        let mut at = 0;
        while at < more.len() && self.length < LIMIT {
            self.bytes[self.length] = more[at];
            self.length += 1;
            at += 1;
        }
        self
    }

    /// The same with a name in backticks at its end.
    pub(crate) const fn name(self, name: &str) -> Self {
        self.with("`").with(name).with("`")
    }

    /// The same with a number at its end, as 65,535.
    pub(crate) const fn number(self, number: u64) -> Self {
        if number < 1_000 {
            return self.digits(number);
        }
        let rest = number % 1_000;
        let zeros = if rest < 10 {
            ",00"
        } else if rest < 100 {
            ",0"
        } else {
            ","
        };
        self.number(number / 1_000).with(zeros).digits(rest)
    }

    /// The same with a number at its end as it is written in code, as 65535.
    pub(crate) const fn digits(self, number: u64) -> Self {
        let mut digits = [0_u8; 20];
        let mut rest = number;
        let mut at = digits.len();
        loop {
            at -= 1;
            digits[at] = b'0' + (rest % 10) as u8;
            rest /= 10;
            if rest == 0 {
                break;
            }
        }
        self.with(as_str(digits.split_at(at).1))
    }

    /// Ends the compilation with this text.
    ///
    /// The compiler names each function between the definition and here in a note of several lines,
    /// but not those with `#[track_caller]`: so what can stop has it.
    #[track_caller]
    pub(crate) const fn stop(self) -> ! {
        let cut = if self.length == LIMIT { self.cut() } else { self };
        panic!("{}", cut.as_str())
    }

    /// Returns the text.
    pub(crate) const fn as_str(&self) -> &str {
        as_str(self.bytes.split_at(self.length).0)
    }

    /// Ends the compilation: this name is not among those that are known.
    #[track_caller]
    pub(crate) const fn unknown(self, what: &str, name: &str, known: &[&str]) -> ! {
        let text = self.with("there is no ").with(what).with(" ").name(name);
        let (mut best, mut least) = ("", 3);
        let mut at = 0;
        while at < known.len() {
            let far = distance(known[at], name);
            if far < least && 2 * far <= name.len() {
                (best, least) = (known[at], far);
            }
            at += 1;
        }
        if !best.is_empty() {
            text.with("; did you mean ").name(best).with("?").stop()
        }
        let mut text =
            text.with(if known.is_empty() { "; none is declared" } else { "; there are: " });
        let mut at = 0;
        while at < known.len() && at < LISTED {
            text = text.with(if at > 0 { ", " } else { "" }).name(known[at]);
            at += 1;
        }
        if known.len() > LISTED { text.with(", ...").stop() } else { text.stop() }
    }

    /// Ends with "...", at a border of characters.
    const fn cut(mut self) -> Self {
        self.length -= 3;
        while self.length > 0 && self.bytes[self.length] & 0xC0 == 0x80 {
            self.length -= 1;
        }
        self.with("...")
    }
}

/// Bytes that were taken from a `str` as a whole.
pub(crate) const fn as_str(bytes: &[u8]) -> &str {
    match core::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(_) => "?",
    }
}

/// Whether two names are the same.
pub(crate) const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let length = a.len();
    if length != b.len() {
        return false;
    }
    let mut at = 0;
    while at < length && a[at] == b[at] {
        at += 1;
    }
    at == length
}

/// How many letters must be inserted, removed or exchanged to get from one name to the other
/// (Levenshtein), for names of up to 63 bytes; many for longer ones.
pub(crate) const fn distance(a: &str, b: &str) -> usize {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    if a.len() > 63 || b.len() > 63 {
        return usize::MAX;
    }
    let mut row = [0; 64];
    let mut column = 0;
    while column <= b.len() {
        row[column] = column;
        column += 1;
    }
    let mut line = 0;
    while line < a.len() {
        let mut diagonal = row[0];
        row[0] = line + 1;
        let mut column = 0;
        while column < b.len() {
            let exchanged = diagonal + !a[line].eq_ignore_ascii_case(&b[column]) as usize;
            diagonal = row[column + 1];
            let skipped = 1 + if diagonal < row[column] { diagonal } else { row[column] };
            row[column + 1] = if exchanged < skipped { exchanged } else { skipped };
            column += 1;
        }
        line += 1;
    }
    row[b.len()]
}
