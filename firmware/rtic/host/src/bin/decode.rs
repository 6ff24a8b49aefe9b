//! Reads defmt's frames from a file with the names that an image's file holds: `decode IMAGE LOG`.

use anyhow::{Context, bail};
use defmt_decoder::{DecodeError, Table};

fn main() -> anyhow::Result<()> {
    let mut arguments = std::env::args_os().skip(1);
    let (Some(image), Some(log), None) = (arguments.next(), arguments.next(), arguments.next())
    else {
        bail!("usage: decode IMAGE LOG");
    };
    let table = Table::parse(&std::fs::read(image)?)?.context("the image has no defmt data")?;
    let mut decoder = table.new_stream_decoder();
    decoder.received(&std::fs::read(log)?);
    loop {
        match decoder.decode() {
            Ok(frame) => {
                let level = frame.level().map_or("", |it| it.as_str());
                println!("{level} {}", frame.display_message());
            }
            Err(DecodeError::UnexpectedEof) => return Ok(()),
            Err(DecodeError::Malformed) => bail!("a frame that is none"),
        }
    }
}
