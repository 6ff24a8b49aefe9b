//! The results of a campaign as Apache Parquet, made of the lines of results when they are whole.

use super::lines::{Block, Lines};
use crate::exit::Failure;
use crate::output;
use cotama_campaign::run::Line;
use cotama_campaign::strategy::BLOCK;
use parquet::data_type::{ByteArray, ByteArrayType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::parser::parse_message_type;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

/// The columns, in the order in which they are written: all that a line of results holds. A run has
/// any number of faults, and breaks any number of requirements; its plan of faults is there if it
/// breaks one, and a witness if that ended it.
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
    optional binary plan (STRING);
    optional group witness {
        required binary requirement (STRING);
        required int64 at_ms;
        required group seen (LIST) { repeated group list { required binary element (STRING); } }
    }
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
    let lists: [fn(&Line) -> Vec<String>; 2] =
        [|it| it.faults.clone(), |it| it.violated.iter().map(ToString::to_string).collect()];
    for list in lists {
        let lists: Vec<_> = rows.iter().map(|it| Some(list(it))).collect();
        let (values, levels) = listed(&lists, 0);
        texts(&mut group, &values, Some(&levels))?;
    }
    let plans = rows.iter().map(|it| it.plan.as_deref());
    let (values, levels) = there(plans, ByteArray::from);
    texts(&mut group, &values, Some(&levels))?;
    let witnesses: Vec<_> = rows.iter().map(|it| it.observed.witness.as_ref()).collect();
    let requirements = witnesses.iter().map(|it| it.map(|it| it.requirement.as_str()));
    let (values, levels) = there(requirements, ByteArray::from);
    texts(&mut group, &values, Some(&levels))?;
    let (values, levels) = there(witnesses.iter().copied(), |it| it.at_ms.cast_signed());
    let mut column = group.next_column()?.ok_or(ParquetError::EOF("no column".into()))?;
    column.typed::<Int64Type>().write_batch(&values, Some(&levels.there), None)?;
    column.close()?;
    let seen: Vec<_> = witnesses.iter().map(|it| it.map(|it| it.seen.clone())).collect();
    let (values, levels) = listed(&seen, 1);
    texts(&mut group, &values, Some(&levels))?;
    group.close()?;
    Ok(())
}

/// The values that are there, with levels that say where.
fn there<T, V>(all: impl Iterator<Item = Option<T>>, value: fn(T) -> V) -> (Vec<V>, Levels) {
    let (mut values, mut levels) = (Vec::new(), Levels::default());
    for it in all {
        levels.there.push(i16::from(it.is_some()));
        values.extend(it.map(value));
    }
    (values, levels)
}

/// The elements of lists, which stand so deep in what may not be there, with their levels.
fn listed(lists: &[Option<Vec<String>>], depth: i16) -> (Vec<ByteArray>, Levels) {
    let (mut values, mut levels) = (Vec::new(), Levels::default());
    for list in lists {
        let elements = list.as_ref().map_or(0, Vec::len);
        levels.list(if list.is_some() { depth } else { 0 }, elements);
        values.extend(list.iter().flatten().map(|it| it.as_str().into()));
    }
    (values, levels)
}

fn texts(
    group: &mut SerializedRowGroupWriter<'_, &mut File>,
    values: &[ByteArray],
    levels: Option<&Levels>,
) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or(ParquetError::EOF("no column".into()))?;
    let there = levels.map(|it| &it.there[..]);
    let again = levels.map(|it| &it.again[..]).filter(|it| !it.is_empty());
    column.typed::<ByteArrayType>().write_batch(values, there, again)?;
    column.close()
}

/// How deep values are there, and whether an element of a list goes on with the list of the one
/// before.
#[derive(Default)]
struct Levels {
    there: Vec<i16>,
    again: Vec<i16>,
}

impl Levels {
    /// A list with so many elements; it is so deep if it has none.
    fn list(&mut self, depth: i16, elements: usize) {
        let level = depth + i16::from(elements > 0);
        self.there.extend(std::iter::repeat_n(level, elements.max(1)));
        self.again.push(0);
        self.again.extend(std::iter::repeat_n(1, elements.saturating_sub(1)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::{Field, Row};

    fn text(row: &Row, name: &str) -> Option<String> {
        match &row.get_column_iter().find(|it| it.0 == name)?.1 {
            Field::Null => None,
            Field::Str(text) => Some(text.clone()),
            other => Some(other.to_string()),
        }
    }

    #[test]
    fn a_table_holds_all_that_lines_hold() {
        let folder = std::env::temp_dir().join(format!("cotama-parquet-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let same = r#""time_ms":5,"energy_mj":7,"x_mm":9,"requests":1,"replans":0,"exposed_ms":0"#;
        let seen = r#""requirement":"AG !a","at_ms":70,"seen":["ls.l1","ls.l2"]"#;
        let none = r#""requirement":"AG !a","at_ms":0,"seen":[]"#;
        let (brakes, both) = (r#""violated":["brakes"]"#, r#""violated":["AG !a","brakes"]"#);
        let lines = [
            format!(r#"{{"run":0,"outcome":"completed",{same},"faults":[],"violated":[]}}"#),
            format!(
                r#"{{"run":1,"outcome":"safe",{same},"faults":["a","b"],{brakes},"plan":"p = 1\n"}}"#
            ),
            format!(
                r#"{{"run":2,"outcome":"safe",{same},"witness":{{{seen}}},"faults":["c"],{both},"plan":"q"}}"#
            ),
            format!(
                r#"{{"run":3,"outcome":"failed",{same},"witness":{{{none}}},"faults":[],{brakes},"plan":""}}"#
            ),
            format!(r#"{{"run":4,"outcome":"failed",{same},"faults":["d"],"violated":[]}}"#),
        ];
        std::fs::write(folder.join("runs.jsonl"), lines.join("\n") + "\n").unwrap();
        write(&folder, 5).unwrap();
        let file = File::open(folder.join("runs.parquet")).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let rows: Vec<Row> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
        assert_eq!(rows.len(), 5);
        let plans: Vec<_> = rows.iter().map(|it| text(it, "plan")).collect();
        let expected = [None, Some("p = 1\n"), Some("q"), Some(""), None];
        assert_eq!(plans, expected.map(|it| it.map(str::to_owned)));
        for (row, (violated, witness)) in rows.iter().zip([
            ("[]", None),
            ("[\"brakes\"]", None),
            ("[\"AG !a\", \"brakes\"]", Some("\"ls.l2\"")),
            ("[\"brakes\"]", Some("seen: []")),
            ("[]", None),
        ]) {
            assert_eq!(text(row, "violated").as_deref(), Some(violated));
            let found = text(row, "witness");
            assert_eq!(found.is_some(), witness.is_some(), "{found:?}");
            assert!(witness.is_none_or(|it| found.unwrap().contains(it)));
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
