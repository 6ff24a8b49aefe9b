//! Reading an analysis from TOML or from comma-separated values.
//!
//! Both are a list of [rows](row::Row) that are read by one function; what rows refer to is looked
//! up when all of them are there.

mod amount;
mod cells;
mod row;
mod table;

pub(crate) use amount::thousandths;

use super::analysis::{Analysis, Flag, MAX_FLAGS, MAX_MODES, MAX_PROBES, Probe};
use super::set::Set;
use crate::missions::reader::fields::{self, Fields, Sink};
use crate::missions::{Diagnostic, MissionErrors, Spanned};
use cells::Table;
use row::{Draft, words};

/// Value of `format` in the TOML files.
pub const FORMAT: &str = "cotama-fmeca/1";

/// The time of operation where the file says none, in hours: a working day (assumed).
const PERIOD_H: u32 = 8;

impl Analysis {
    /// Reads a `cotama-fmeca/1` file in TOML. `source_name` is its name in messages.
    ///
    /// # Errors
    /// All errors of the file, with their places.
    ///
    /// ```
    /// # use cotama_models::fmeca::Analysis;
    /// let text = "format = 'cotama-fmeca/1'\nmode = []";
    /// let errors = Analysis::parse("gripper.toml", text).unwrap_err().to_string();
    /// assert!(errors.starts_with("gripper.toml:2:8: `mode` is empty"), "{errors}");
    /// ```
    pub fn parse(source_name: &str, text: &str) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let analysis = fields::document(text, &sink, FORMAT, |root| read(root, source_name));
        finished(source_name, text, sink, analysis)
    }

    /// Reads comma-separated values with a heading (RFC 4180): the names of the columns are the
    /// keys of a TOML file, or those of [`COLUMNS`](super::COLUMNS). Names in a list stand between
    /// `;` or on lines of their own; `sonar far;` is one name with a space, and `sonar far`, which
    /// could be two, is refused. Columns, cells and rows in which nothing stands are left out, as
    /// spreadsheets write them behind a table. The title is the name of the file.
    ///
    /// # Errors
    /// All errors of the file, with their places.
    ///
    /// ```
    /// # use cotama_models::fmeca::Analysis;
    /// let text = "id,function,component,failure,cause,effect,severity,mtbf_h
    /// GRP1,hold,gripper,slips,worn pads,it falls,hrad,500";
    /// let errors = Analysis::parse_csv("gripper.csv", text).unwrap_err().to_string();
    /// let first = "gripper.csv:2:44: unknown severity `hrad`; did you mean `hard`?";
    /// assert_eq!(errors.lines().next(), Some(first));
    /// ```
    pub fn parse_csv(source_name: &str, text: &str) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let analysis = Table::read(text, &sink).and_then(|table| {
            let drafts = table.rows(&sink).map(|mut it| row::read(&mut it));
            let drafts = drafts.collect::<Vec<_>>().into_iter().collect::<Option<Vec<_>>>();
            let title = title_of(source_name);
            complete(&sink, (title, PERIOD_H), None, Some(Vec::new()), drafts)
        });
        finished(source_name, text, sink, analysis)
    }
}

fn finished(
    source_name: &str,
    text: &str,
    sink: Sink,
    analysis: Option<Analysis>,
) -> Result<Analysis, MissionErrors> {
    match analysis {
        Some(analysis) if sink.is_empty() => Ok(analysis),
        _ => Err(MissionErrors::new(source_name, text, sink.into_diagnostics())),
    }
}

/// The name of a file without folder and end.
fn title_of(source_name: &str) -> String {
    let name = source_name.rsplit(['/', '\\']).next().unwrap_or(source_name);
    let name = name.rsplit_once('.').map_or(name, |it| it.0);
    words(name)
}

fn read(mut root: Fields<'_>, source_name: &str) -> Option<Analysis> {
    let title = root.optional_text("title").map(|it| it.map(|it| words(&it.value)));
    let period = root.optional_integer("period_h", 1..=1_000_000);
    let declares = root.has("flag");
    let flags = root.tables_up_to("flag", false, MAX_FLAGS).and_then(|tables| {
        let flags = tables.into_iter().map(table::flag).collect::<Vec<_>>();
        flags.into_iter().collect::<Option<Vec<_>>>()
    });
    let probes = root.tables_up_to("probe", false, MAX_PROBES).and_then(|tables| {
        let probes = tables.into_iter().map(table::probe).collect::<Vec<_>>();
        probes.into_iter().collect::<Option<Vec<_>>>()
    });
    let drafts = root.tables_up_to("mode", true, MAX_MODES).and_then(|tables| {
        let drafts = tables.into_iter().map(|mut fields| {
            let draft = row::read(&mut fields);
            fields.finish();
            draft
        });
        drafts.collect::<Vec<_>>().into_iter().collect::<Option<Vec<_>>>()
    });
    let sink = root.sink();
    root.finish();
    let title = title.ok()?.unwrap_or_else(|| title_of(source_name));
    let heading = (title, period.ok()?.unwrap_or(PERIOD_H));
    complete(sink, heading, if declares { Some(flags?) } else { None }, probes, drafts)
}

/// Looks up what rows and probes refer to, and that names are unique.
fn complete(
    sink: &Sink,
    (title, period_h): (String, u32),
    declared: Option<Vec<(Spanned<String>, Flag)>>,
    probes: Option<Vec<table::ProbeDraft>>,
    drafts: Option<Vec<Draft>>,
) -> Option<Analysis> {
    let (drafts, probes) = (drafts?, probes?);
    unique(sink, "failure mode", drafts.iter().map(|it| &it.id));
    unique(sink, "probe", probes.iter().map(|it| &it.name));
    unique(sink, "flag", declared.iter().flatten().map(|it| &it.0));
    let flags = declared.map(|flags| flags.into_iter().map(|it| it.1).collect::<Vec<_>>());
    let flags = flags.unwrap_or_else(|| named_by(&drafts));
    if flags.len() > MAX_FLAGS {
        let message = format!("the rows name {} flags; at most {MAX_FLAGS} are read", flags.len());
        sink.report(Diagnostic::new(0..0, message, "").help("give fewer rows"));
        return None;
    }
    let names: Vec<&str> = flags.iter().map(|it| it.name.as_str()).collect();
    let ids: Vec<String> = drafts.iter().map(|it| it.id.value.clone()).collect();
    let ids: Vec<&str> = ids.iter().map(String::as_str).collect();
    let modes = drafts.into_iter().map(|it| it.complete(sink, &names)).collect();
    let probe = |it: table::ProbeDraft| {
        let shows = row::places(sink, &it.shows, "failure mode", &ids);
        Probe { name: it.name.value, doc: it.doc, shows: Set::of(ids.len(), shows) }
    };
    let probes = probes.into_iter().map(probe).collect();
    Some(Analysis { title, period_h, flags, probes, modes })
}

/// The flags that rows name, in the order in which they come first.
fn named_by(drafts: &[Draft]) -> Vec<Flag> {
    let mut seen = std::collections::HashSet::new();
    let names = drafts.iter().flat_map(|it| it.always.iter().chain(&it.sometimes));
    let first = names.filter(|it| seen.insert(it.value.as_str()));
    let flag = |name: &Spanned<String>| Flag {
        name: name.value.clone(),
        doc: String::new(),
        observer: String::new(),
    };
    first.map(flag).collect()
}

fn unique<'a>(sink: &Sink, what: &str, names: impl Iterator<Item = &'a Spanned<String>>) {
    let mut seen = std::collections::HashSet::new();
    for name in names.filter(|it| !seen.insert(it.value.as_str())) {
        let message = format!("the {what} `{}` is defined twice", name.value);
        let again = Diagnostic::new(name.span.clone(), message, "again");
        sink.report(again.help("rename one of them"));
    }
}
