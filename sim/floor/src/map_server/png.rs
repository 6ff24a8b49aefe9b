//! Images in PNG: bits, palettes, channels and transparency of every kind.

use super::image::{Broken, Image, cells, grey};
use png::{BitDepth, ColorType, Decoder, Limits, Transformations};
use std::io::Cursor;

/// The most bytes that the decoder may take for itself.
const MAX_BYTES: usize = 64 << 20;

/// Reads an image that begins as a PNG.
pub(super) fn read(bytes: &[u8]) -> Result<Image, Broken> {
    let limits = Limits { bytes: MAX_BYTES };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    // Palettes become colours, few bits eight, and a transparent colour an opacity.
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    let mut reader = decoder.read_info().map_err(|it| broken(&it))?;
    let info = reader.info();
    let (width, height) = (info.width as usize, info.height as usize);
    let cells = cells(info.width.into(), info.height.into(), None)?;
    let is_interlaced = info.interlaced;
    // The decoder takes a palette for whole colours, and would go beyond its end.
    let palette = info.palette.as_ref().map(|it| it.len());
    if palette.is_some_and(|it| it == 0 || it % 3 != 0) {
        let message = "not a whole PNG: the palette has no whole colours".to_owned();
        return Err(Broken { at: None, message, help: HELP });
    }
    let (color, depth) = reader.output_color_type();
    let samples = color.samples();
    let has_opacity = matches!(color, ColorType::GrayscaleAlpha | ColorType::Rgba);
    let mut image = Image {
        width,
        height,
        greys: Vec::with_capacity(cells),
        opacities: has_opacity.then(|| Vec::with_capacity(cells)),
    };
    let wide = depth == BitDepth::Sixteen;
    let pixel = samples * if wide { 2 } else { 1 };
    let mut take = |row: &[u8]| {
        for pixel in row.chunks_exact(pixel) {
            let byte = |at: usize| pixel.get(at).copied().unwrap_or(0);
            let channel = |at: usize| {
                let two = if wide { [byte(2 * at), byte(2 * at + 1)] } else { [byte(at); 2] };
                u16::from_be_bytes(two)
            };
            let grey = match color {
                ColorType::Rgb | ColorType::Rgba => grey([channel(0), channel(1), channel(2)]),
                _ => (channel(0) / 257) as u8,
            };
            image.greys.push(grey);
            if let Some(opacities) = &mut image.opacities {
                opacities.push((channel(samples - 1) / 257) as u8);
            }
        }
    };
    if is_interlaced {
        let size = reader.output_buffer_size().filter(|it| *it <= 2 * MAX_BYTES);
        let Some(size) = size else {
            let message = "an interlaced image of so many bytes is not read".to_owned();
            return Err(Broken { at: None, message, help: "save it without interlacing" });
        };
        let mut all = vec![0; size];
        reader.next_frame(&mut all).map_err(|it| broken(&it))?;
        take(&all);
    } else {
        while let Some(row) = reader.next_row().map_err(|it| broken(&it))? {
            take(row.data());
        }
    }
    if image.greys.len() == cells {
        return Ok(image);
    }
    let message = format!("the image ends after {} of {cells} pixels", image.greys.len());
    Err(Broken { at: None, message, help: HELP })
}

const HELP: &str = "save the map again, or convert it to PNG anew";

fn broken(error: &png::DecodingError) -> Broken {
    let error = error.to_string();
    // The name of a part of the file says nothing to most.
    let cause = error.split(" while decoding").next().unwrap_or_default();
    let message = format!("not a whole PNG: {cause}");
    Broken { at: None, message, help: HELP }
}
