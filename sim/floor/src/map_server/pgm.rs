//! Images in PGM: `P2` in letters, `P5` in bytes.

use super::image::{Broken, Image, cells};

/// Reads an image that begins with `P2` or `P5`.
pub(super) fn read(bytes: &[u8]) -> Result<Image, Broken> {
    let mut header = Numbers { bytes, at: 2 };
    let start = header.skip();
    if start == 2 {
        return Err(header.broken("a space is missing behind the first two letters"));
    }
    let width = header.number("the width")?;
    let height = header.number("the height")?;
    let cells = cells(width, height, Some(start))?;
    let at = header.skip();
    let most = header.number("the largest grey")?;
    if !(1..=u64::from(u16::MAX)).contains(&most) {
        let message = format!("the largest grey is {most}; it is 1 to 65535");
        return Err(Broken { at: Some(at), message, help: HELP });
    }
    let samples = if bytes.get(1) == Some(&b'2') {
        in_letters(header, cells, most)
    } else {
        in_bytes(header, cells, most)
    };
    let greys = samples?;
    Ok(Image { width: width as usize, height: height as usize, greys, opacities: None })
}

const HELP: &str = "save the map again";

/// The grey of 8 bits.
fn scaled(sample: u64, most: u64) -> u8 {
    (sample * 255 / most) as u8
}

fn in_letters(mut from: Numbers<'_>, cells: usize, most: u64) -> Result<Vec<u8>, Broken> {
    // A grey takes two letters at least.
    if cells > from.bytes.len() {
        return Err(from.few(cells, from.bytes.len() / 2));
    }
    let mut greys = Vec::with_capacity(cells);
    for index in 0..cells {
        let at = from.skip();
        if at >= from.bytes.len() {
            return Err(from.few(cells, index));
        }
        let sample = from.number("a grey")?;
        if sample > most {
            return Err(above(at, sample, most));
        }
        greys.push(scaled(sample, most));
    }
    Ok(greys)
}

fn in_bytes(mut from: Numbers<'_>, cells: usize, most: u64) -> Result<Vec<u8>, Broken> {
    if !from.bytes.get(from.at).is_some_and(u8::is_ascii_whitespace) {
        return Err(from.broken("one space is missing in front of the greys"));
    }
    from.at += 1;
    let size = if most > u64::from(u8::MAX) { 2 } else { 1 };
    let data = from.bytes.get(from.at..).unwrap_or_default();
    let Some(data) = data.get(..cells * size) else {
        return Err(Broken { at: None, ..from.few(cells, data.len() / size) });
    };
    let mut greys = Vec::with_capacity(cells);
    for (index, sample) in data.chunks_exact(size).enumerate() {
        let sample = sample.iter().fold(0, |all, it| all << 8 | u64::from(*it));
        if sample > most {
            let Broken { message, help, .. } = above(0, sample, most);
            let message = format!("{message}, pixel {} of {cells}", index + 1);
            return Err(Broken { at: None, message, help });
        }
        greys.push(scaled(sample, most));
    }
    Ok(greys)
}

fn above(at: usize, sample: u64, most: u64) -> Broken {
    let message = format!("a grey is {sample}, the largest one was said to be {most}");
    Broken { at: Some(at), message, help: HELP }
}

/// Numbers with spaces and comments between them.
struct Numbers<'b> {
    bytes: &'b [u8],
    at: usize,
}

impl Numbers<'_> {
    fn broken(&self, message: &str) -> Broken {
        Broken { at: Some(self.at), message: message.into(), help: HELP }
    }

    fn few(&self, cells: usize, found: usize) -> Broken {
        let message = format!("the image ends after {found} of {cells} pixels");
        Broken { at: Some(self.bytes.len()), message, help: HELP }
    }

    /// Passes over spaces and comments, and returns where the next thing stands.
    fn skip(&mut self) -> usize {
        while let Some(byte) = self.bytes.get(self.at) {
            match byte {
                b'#' => {
                    let rest = self.bytes.get(self.at..).unwrap_or_default();
                    let line = rest.iter().take_while(|it| !matches!(it, b'\n' | b'\r')).count();
                    self.at += line;
                }
                it if it.is_ascii_whitespace() => self.at += 1,
                _ => break,
            }
        }
        self.at
    }

    fn number(&mut self, what: &str) -> Result<u64, Broken> {
        let start = self.skip();
        let rest = self.bytes.get(start..).unwrap_or_default();
        let digits = rest.iter().take_while(|it| it.is_ascii_digit());
        let mut number: Option<u64> = None;
        for digit in digits {
            let next = number.unwrap_or(0).saturating_mul(10);
            number = Some(next.saturating_add(u64::from(digit - b'0')));
            self.at += 1;
        }
        number.ok_or_else(|| match rest.first() {
            None => self.broken(&format!("the image ends where {what} should stand")),
            Some(_) => self.broken(&format!("{what} is no whole number")),
        })
    }
}
