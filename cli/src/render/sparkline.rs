//! Margins over a run in one line.

use super::style::{BAD, PLAIN, Style};
use std::fmt::Write;

const LEVELS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// Draws the least value of each of `width` equal parts of the time from 0 to `end`; values below
/// zero are `!`. `samples` are times with values, in the order of time.
pub(crate) fn sparkline(samples: &[(u64, i64)], end: u64, width: usize, style: Style) -> String {
    // The least value of each part, and its last one, with which a gap after it goes on.
    let mut parts: Vec<Option<(i64, i64)>> = vec![None; width];
    for &(time, value) in samples {
        if let Some(part) = parts.get_mut(column(time, end, width)) {
            *part = Some((part.map_or(value, |(least, _)| least.min(value)), value));
        }
    }
    let most = samples.iter().map(|&(_, value)| value).max().unwrap_or(0).max(1);
    let mut text = String::new();
    let mut before = samples.first().map_or(0, |&(_, value)| value);
    let mut drawn = PLAIN;
    for part in parts {
        let (value, last) = part.unwrap_or((before, before));
        before = last;
        let (letter, style) = if value < 0 { ('!', BAD) } else { (level(value, most), style) };
        if style != drawn {
            let _ = write!(text, "{drawn:#}{style}");
            drawn = style;
        }
        text.push(letter);
    }
    let _ = write!(text, "{drawn:#}");
    text
}

fn level(value: i64, most: i64) -> char {
    // Half up to the nearest level.
    let (steps, most) = (LEVELS.len() as i128 - 1, i128::from(most));
    let place = (2 * steps * i128::from(value) + most) / (2 * most);
    LEVELS[usize::try_from(place).unwrap_or(0).min(LEVELS.len() - 1)]
}

/// The column of a time.
pub(crate) fn column(time: u64, end: u64, width: usize) -> usize {
    let place = u128::from(time) * width as u128 / (u128::from(end) + 1);
    usize::try_from(place).unwrap_or(0).min(width.saturating_sub(1))
}

/// A line with a mark at each time; where marks meet, the first one stands.
pub(crate) fn marks(times: &[u64], end: u64, width: usize) -> String {
    let mut line = vec![' '; width];
    for (number, &time) in times.iter().enumerate() {
        let place = column(time, end, width);
        for (offset, digit) in number.to_string().chars().enumerate() {
            if line.get(place + offset) == Some(&' ') {
                line[place + offset] = digit;
            }
        }
    }
    let line: String = line.into_iter().collect();
    format!("{PLAIN}{}{PLAIN:#}", line.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::style::unstyled;

    #[test]
    fn the_least_of_each_part_is_drawn_and_gaps_go_on() {
        let samples = [(0, 8), (9, 70), (30, -1), (39, 80)];
        let drawn = |samples, end, width| unstyled(&sparkline(samples, end, width, PLAIN));
        assert_eq!(drawn(&samples, 39, 4), "▂▇▇!");
        assert_eq!(drawn(&[(0, 5)], 0, 3), "███");
        assert_eq!(drawn(&[(0, 0), (1, 8)], 1, 2), "▁█");
    }

    #[test]
    fn marks_stand_at_their_times() {
        assert_eq!(marks(&[0, 20, 39], 39, 4), "0 12");
    }
}
