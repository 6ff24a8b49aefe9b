//! A text made wrong, in the ways in which files are wrong and in those in which nobody writes
//! them.

use crate::random::Random;
use std::ops::Range;

/// No mutant is longer, in bytes: how long a text a reader takes is its own limit, and has its own
/// tests.
pub const MAX_BYTES: usize = 16 << 10;

/// Numbers at which types end, and what is no number.
const NUMBERS: [&str; 24] = [
    "0",
    "-0",
    "1",
    "-1",
    "00",
    "255",
    "65535",
    "65536",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "9007199254740991",
    "9223372036854775807",
    "9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "99999999999999999999999999999999999999999",
    "1.5",
    "1e3",
    "1e999",
    "0x10",
    "nan",
    "1_000",
];

/// Bytes and characters that readers trip over.
const PIECES: [&[u8]; 12] = [
    b"\0",
    b"\xff",
    b"\xc3",
    b"\xef\xbb\xbf",
    b"\r\n",
    b"\t",
    b"\\",
    b"\"",
    "\u{1F916}".as_bytes(),
    "\u{202e}".as_bytes(),
    b"\\ud800",
    b"\x1b[2J",
];

/// A mutant of one of the texts: one to four changes, and mostly one. `words` are those of the
/// format.
pub fn mutant(random: &mut Random, texts: &[Vec<u8>], words: &[&str]) -> Vec<u8> {
    let mut text = random.choose(texts).cloned().unwrap_or_default();
    let changes = [1, 1, 1, 2, 2, 3, 4][random.below(7)];
    for _ in 0..changes {
        change(random, &mut text, texts, words);
        text.truncate(MAX_BYTES);
    }
    text
}

fn change(random: &mut Random, text: &mut Vec<u8>, texts: &[Vec<u8>], words: &[&str]) {
    let at = random.below(text.len() + 1);
    let part = at..(at + random.below(64)).min(text.len());
    match random.below(16) {
        0 => flip(random, text),
        1 => drop(text.drain(part)),
        2 => text.truncate(at),
        3 => {
            let copy = text[part].to_vec();
            let to = random.below(text.len() + 1);
            text.splice(to..to, copy);
        }
        4 => {
            // The begin of this text and the end of another one, or of itself.
            let other = random.choose(texts).map_or(&[][..], Vec::as_slice);
            let from = random.below(other.len() + 1);
            text.truncate(at);
            text.extend_from_slice(&other[from..]);
        }
        5 => insert(random, text, at, &PIECES.map(<[u8]>::to_vec)),
        6 => insert(
            random,
            text,
            at,
            &words.iter().map(|it| it.as_bytes().to_vec()).collect::<Vec<_>>(),
        ),
        7..=9 => number(random, text),
        10 | 11 => token(random, text, texts),
        12..=14 => line(random, text),
        _ => nest(random, text, words),
    }
}

fn flip(random: &mut Random, text: &mut [u8]) {
    let at = random.below(text.len());
    if let Some(byte) = text.get_mut(at) {
        *byte ^= 1 << random.below(8);
    }
}

fn insert(random: &mut Random, text: &mut Vec<u8>, at: usize, pieces: &[Vec<u8>]) {
    if let Some(piece) = random.choose(pieces) {
        text.splice(at..at, piece.iter().copied());
    }
}

/// Another number for a number, so that the checks behind the syntax are reached.
fn number(random: &mut Random, text: &mut Vec<u8>) {
    let numbers = runs(text, u8::is_ascii_digit);
    let Some(at) = random.choose(&numbers).cloned() else { return };
    let digits = String::from_utf8_lossy(&text[at.clone()]).into_owned();
    let near =
        |by: i128| digits.parse::<i128>().map_or_else(|_| "7".into(), |it| (it + by).to_string());
    let other = match random.below(5) {
        0 => near(1),
        1 => near(-1),
        2 => random.below(10).to_string(),
        3 => digits + "0",
        _ => (*random.choose(&NUMBERS).unwrap_or(&"0")).to_owned(),
    };
    text.splice(at, other.into_bytes());
}

/// A word of any of the texts for a word: names that exist where they do not belong.
fn token(random: &mut Random, text: &mut Vec<u8>, texts: &[Vec<u8>]) {
    let is_word = |it: &u8| it.is_ascii_alphanumeric() || *it == b'_' || *it >= 0x80;
    let Some(from) = random.choose(texts) else { return };
    let (here, there) = (runs(text, is_word), runs(from, is_word));
    let (Some(at), Some(of)) = (random.choose(&here), random.choose(&there)) else { return };
    let other = from[of.clone()].to_vec();
    text.splice(at.clone(), other);
}

/// A line is left out, said twice, or goes elsewhere.
fn line(random: &mut Random, text: &mut Vec<u8>) {
    let lines: Vec<_> = text.split_inclusive(|it| *it == b'\n').map(<[u8]>::to_vec).collect();
    let mut lines = lines;
    let (one, other) = (random.below(lines.len()), random.below(lines.len()));
    match random.below(3) {
        _ if lines.is_empty() => {}
        0 => drop(lines.remove(one)),
        1 => lines.insert(other, lines[one].clone()),
        _ => lines.swap(one, other),
    }
    *text = lines.concat();
}

/// The same again and again: a bracket, a word of the format, or a part of the text.
fn nest(random: &mut Random, text: &mut Vec<u8>, words: &[&str]) {
    let at = random.below(text.len() + 1);
    let brackets: [&[u8]; 8] = [b"[", b"{", b"(", b"<a>", b"\"", b"!", b"{\"a\":", b"a."];
    let part = at..(at + random.below(12)).min(text.len());
    let piece = match random.below(3) {
        0 => random.choose(&brackets).map_or(vec![], |it| it.to_vec()),
        1 => random.choose(words).map_or(vec![], |it| it.as_bytes().to_vec()),
        _ => text[part].to_vec(),
    };
    let times = 1 << random.below(12);
    let again = piece.repeat(times.min(MAX_BYTES / piece.len().max(1)));
    text.splice(at..at, again);
}

/// Returns the runs of such bytes.
fn runs(text: &[u8], is_one: impl Fn(&u8) -> bool) -> Vec<Range<usize>> {
    let mut all: Vec<Range<usize>> = vec![];
    for (at, _) in text.iter().enumerate().filter(|(_, it)| is_one(it)) {
        match all.last_mut() {
            Some(last) if last.end == at => last.end += 1,
            _ => all.push(at..at + 1),
        }
    }
    all
}
