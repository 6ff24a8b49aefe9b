//! The results of a campaign as Apache Parquet, made of the lines of results when they are whole.

use super::store::{Block, Lines};
use crate::exit::Failure;
use crate::output;
use cotama_sim::campaign::run::Line;
use cotama_sim::campaign::strategy::BLOCK;
use parquet::data_type::{ByteArray, ByteArrayType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::parser::parse_message_type;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

/// The columns, in the order in which they are written. A run has any number of faults, and breaks
/// any number of requirements.
const SCHEMA: &str = "message runs {
    required int64 run;
    required int64 time_ms;
    required int64 energy_mj;
    required int64 x_mm;
    required int64 requests;
    required int64 replans;
    required int64 exposed_ms;
    required binary outcome (STRING);
    required group faults (LIST) { repeated group list { required binary element (STRING); } }
    required group violated (LIST) { repeated group list { required binary element (STRING); } }
}";

/// How many rows stand together.
const GROUP: usize = 1 << 16;

/// Writes `runs.parquet` beside `runs.jsonl`, which has so many lines.
pub(super) fn write(folder: &Path, runs: u64) -> Result<(), Failure> {
    let path = folder.join("runs.parquet");
    output::replaced(&path, |file| {
        let wrong = |error: ParquetError| {
            Failure::of(path.display().to_string(), format!("it cannot be written: {error}"))
        };
        let schema = Arc::new(parse_message_type(SCHEMA).map_err(wrong)?);
        let by = format!("cotama {}", env!("CARGO_PKG_VERSION"));
        let properties = Arc::new(WriterProperties::builder().set_created_by(by).build());
        let mut writer = SerializedFileWriter::new(file, schema, properties).map_err(wrong)?;
        let (mut lines, mut rows) = (Lines::of(folder)?, Vec::new());
        for block in 0..runs.div_ceil(BLOCK) {
            let Block::Whole(more, _) = lines.block(block, runs)? else {
                return Err(lines.wrong("the file ends before its last run"));
            };
            rows.extend(more.into_iter().map(|it| it.0));
            if rows.len() >= GROUP {
                group(&mut writer, &rows).map_err(wrong)?;
                rows.clear();
            }
        }
        if !rows.is_empty() {
            group(&mut writer, &rows).map_err(wrong)?;
        }
        writer.close().map_err(wrong)?;
        Ok(())
    })
}

fn group(writer: &mut SerializedFileWriter<&mut File>, rows: &[Line]) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    let numbers: [fn(&Line) -> u64; 7] = [
        |it| it.run,
        |it| it.observed.time_ms,
        |it| it.observed.energy_mj,
        |it| it.observed.x_mm,
        |it| it.observed.requests,
        |it| it.observed.replans,
        |it| it.observed.exposed_ms,
    ];
    for number in numbers {
        let values: Vec<_> = rows.iter().map(|it| number(it).cast_signed()).collect();
        let mut column = group.next_column()?.ok_or(ParquetError::EOF("no column".into()))?;
        column.typed::<Int64Type>().write_batch(&values, None, None)?;
        column.close()?;
    }
    let outcomes: Vec<_> = rows.iter().map(|it| it.observed.outcome.name().into()).collect();
    texts(&mut group, &outcomes, None)?;
    let lists: [fn(&Line) -> &[String]; 2] = [|it| &it.faults, |it| &it.violated];
    for list in lists {
        let mut levels = Levels::default();
        let mut values: Vec<ByteArray> = Vec::new();
        for row in rows {
            let list = list(row);
            levels.list(list.len());
            values.extend(list.iter().map(|it| it.as_str().into()));
        }
        texts(&mut group, &values, Some(&levels))?;
    }
    group.close()?;
    Ok(())
}

fn texts(
    group: &mut SerializedRowGroupWriter<'_, &mut File>,
    values: &[ByteArray],
    levels: Option<&Levels>,
) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or(ParquetError::EOF("no column".into()))?;
    let (there, again) = (levels.map(|it| &it.there[..]), levels.map(|it| &it.again[..]));
    column.typed::<ByteArrayType>().write_batch(values, there, again)?;
    column.close()
}

/// How lists are told from each other: whether there is an element, and whether it goes on with the
/// list of the element before.
#[derive(Default)]
struct Levels {
    there: Vec<i16>,
    again: Vec<i16>,
}

impl Levels {
    fn list(&mut self, elements: usize) {
        self.there.extend(std::iter::repeat_n(i16::from(elements > 0), elements.max(1)));
        self.again.push(0);
        self.again.extend(std::iter::repeat_n(1, elements.saturating_sub(1)));
    }
}
