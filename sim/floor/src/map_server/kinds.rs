//! Images by their first bytes.

use super::image::{Broken, Image, ImageError};
use super::{pgm, png};
use cotama_models::reading::Position;

/// First bytes of kinds of files, for a message.
const OTHERS: [(&[u8], &str); 12] = [
    (b"P1", "a PBM"),
    (b"P3", "a PPM"),
    (b"P4", "a PBM"),
    (b"P6", "a PPM"),
    (b"P7", "a PAM"),
    (b"BM", "a BMP"),
    (b"\xff\xd8", "a JPEG"),
    (b"GIF8", "a GIF"),
    (b"II*\0", "a TIFF"),
    (b"MM\0*", "a TIFF"),
    (b"image:", "the text of a map"),
    (b"<svg", "an SVG"),
];

/// Reads an image by its first bytes.
pub(super) fn read(source_name: &str, bytes: &[u8]) -> Result<Image, ImageError> {
    let read = match bytes {
        [0x89, b'P', b'N', b'G', ..] => png::read(bytes),
        [b'P', b'2' | b'5', ..] => pgm::read(bytes),
        _ => Err(of_another_kind(bytes)),
    };
    read.map_err(|Broken { at, message, help }| ImageError {
        source_name: source_name.into(),
        position: at.map(|at| position(bytes, at)),
        message,
        help,
    })
}

fn of_another_kind(bytes: &[u8]) -> Broken {
    let known = OTHERS.iter().find(|it| bytes.starts_with(it.0)).map(|it| it.1);
    let message = match known {
        Some(it) => format!("this is {it}, no PNG and no PGM"),
        None if bytes.is_empty() => "the image is empty".to_owned(),
        None => "this is no PNG and no PGM: it begins as neither".to_owned(),
    };
    Broken { at: None, message, help: "convert the image to PNG" }
}

/// Returns the line and the column of a byte, a character each.
fn position(bytes: &[u8], at: usize) -> Position {
    let before = bytes.get(..at.min(bytes.len())).unwrap_or_default();
    let line = before.split(|it| *it == b'\n').count();
    let column = before.iter().rev().take_while(|it| **it != b'\n').count() + 1;
    Position { line, column }
}
