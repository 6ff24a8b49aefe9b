//! An analysis as comma-separated values.

use super::analysis::{Analysis, Mode};
use super::set::Set;
use std::fmt::Write;

/// The columns of [`Analysis::to_csv`]. The last nine are computed and not read back: the ranks of
/// severity, occurrence and detection, their product, the class of criticality, and the Action
/// Priority; then detection rank, product and priority by runs, where they were made.
pub const COLUMNS: &str = "id,function,component,failure_mode,cause,effect,\
    severity_auto,severity_teleop,modules_lost,observer,detection_rule,detection_latency_s,\
    cs_event_auto,reaction,persistence,mtbf_h,rate_source,injection,\
    flags,sometimes,silent,rate_label,alpha_permille,beta_permille,detection_rank,\
    s,o,d,rpn,criticality,\
    action_priority,d_measured,rpn_measured,action_priority_measured";

impl Analysis {
    /// Comma-separated values: a heading and one line a row, fields quoted where they must be (RFC
    /// 4180, with plain line ends). Names in a list stand between `;`. A text that a spreadsheet
    /// would take for a formula, because it begins with `=`, `+`, `-` or `@` and is no number,
    /// stands behind an apostrophe, which [`parse_csv`](Self::parse_csv) takes away.
    ///
    /// ```
    /// use cotama_models::fmeca::{Analysis, COLUMNS};
    /// let csv = Analysis::shipped("p3dx-delivery").unwrap().to_csv();
    /// assert_eq!(csv.lines().next(), Some(COLUMNS));
    /// let again = Analysis::parse_csv("robot.csv", &csv).unwrap();
    /// assert_eq!(again.modes().len(), 46);
    /// ```
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut text = format!("{COLUMNS}\n");
        for mode in &self.modes {
            text += &self.fields(mode).map(quoted).join(",");
            text.push('\n');
        }
        text
    }

    fn fields(&self, it: &Mode) -> [String; 34] {
        let number = |it: Option<u16>| it.map_or_else(String::new, |it| it.to_string());
        let criticality = self.criticality(it);
        let measured = criticality.measured;
        [
            it.id.clone(),
            it.function.clone(),
            it.component.clone(),
            it.failure.clone(),
            it.cause.clone(),
            it.effect.clone(),
            it.severity.name().to_owned(),
            it.severity_operator.map_or("", |it| it.name()).to_owned(),
            it.lost.clone(),
            it.observer.clone(),
            it.detection.clone(),
            thousandths(it.latency_ms.into()),
            it.event.clone(),
            it.reaction.clone(),
            it.persistence.map_or("", |it| it.name()).to_owned(),
            thousandths(it.mtbf_mh),
            it.rate_source.clone(),
            it.injection.clone(),
            self.list(&it.flags),
            self.list(&it.sometimes),
            it.silent.clone().unwrap_or_default(),
            it.rate_label.name().to_owned(),
            number(it.alpha_permille),
            number(it.beta_permille),
            number(it.detection_rank.map(u16::from)),
            criticality.severity.to_string(),
            criticality.occurrence.to_string(),
            criticality.detection.to_string(),
            criticality.rpn().to_string(),
            criticality.class().name().to_owned(),
            criticality.priority().name().to_owned(),
            number(measured.map(u16::from)),
            number(measured.map(|it| criticality.rpn_by(it))),
            measured.map_or("", |it| criticality.priority_by(it).name()).to_owned(),
        ]
    }

    /// Names in a list, by the alphabet; one that could be several is one where a `;` follows it.
    fn list(&self, flags: &Set) -> String {
        let mut names = self.names(flags);
        names.sort_unstable();
        match names.as_slice() {
            [one] if one.contains(is_between) => format!("{one};"),
            names => names.join("; "),
        }
    }
}

/// Whether a letter stands between names in the lists of some tables, and within names of others.
pub(super) fn is_between(letter: char) -> bool {
    matches!(letter, ' ' | ',' | '|' | '+' | '&' | '，' | '、' | '；')
}

/// Whether a spreadsheet would take a text for a formula; numbers and a lone `-` are none.
pub(super) fn is_formula(text: &str) -> bool {
    let begins = text.starts_with(['=', '+', '-', '@', '\t', '\r']);
    let signed =
        text.get(1..).is_some_and(|it| it.starts_with(|c: char| c.is_ascii_digit() || c == '.'));
    begins && text != "-" && !(signed && text.parse::<f64>().is_ok())
}

/// A field as it is written. Behind an apostrophe a spreadsheet shows a text as it is; the reader
/// of analyses takes it away again.
fn quoted(field: String) -> String {
    let inert = is_formula(field.trim_start_matches('\''));
    let field = if inert { format!("'{field}") } else { field };
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field
    }
}

/// A number of thousandths as a decimal number without trailing zeros.
pub(super) fn thousandths(number: u64) -> String {
    let mut text = (number / 1000).to_string();
    if !number.is_multiple_of(1000) {
        // Writing into a string cannot fail.
        let _ = write!(text, ".{:03}", number % 1000);
        text.truncate(text.trim_end_matches('0').len());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::quoted;
    use crate::fmeca::Analysis;

    #[test]
    fn a_formula_stands_behind_an_apostrophe_and_a_number_does_not() {
        for (field, written) in [
            ("=1+2", "'=1+2"),
            ("+SUM(A1)", "'+SUM(A1)"),
            ("-cmd|x", "'-cmd|x"),
            ("@it", "'@it"),
            ("-", "-"),
            ("\tx", "'\tx"),
            ("'=x", "''=x"),
            ("=a,b", "\"'=a,b\""),
            ("-inf", "'-inf"),
            ("-5", "-5"),
            ("+3.2", "+3.2"),
            ("-.5e1", "-.5e1"),
            ("it's", "it's"),
            ("a=b", "a=b"),
            ("", ""),
        ] {
            assert_eq!(quoted(field.to_owned()), written);
        }
    }

    #[test]
    fn a_text_like_a_formula_is_read_back_as_it_was() {
        let csv = Analysis::shipped("p3dx-delivery").unwrap().to_csv();
        let effect = csv.lines().nth(1).unwrap().split(',').nth(5).unwrap().to_owned();
        for text in ["=1+2", "@x", "-stop", "+go", "'=x", "''-", "it's"] {
            let analysis = csv.replacen(&effect, &quoted(text.to_owned()), 1);
            let read = Analysis::parse_csv("it.csv", &analysis).unwrap();
            assert_eq!(read.modes()[0].effect, text);
            let again = Analysis::parse_csv("it.csv", &read.to_csv()).unwrap();
            assert_eq!(again.modes()[0].effect, text);
        }
    }
}
