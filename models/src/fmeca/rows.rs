//! An analysis as rows of a robot's file.

use super::analysis::{Analysis, Mode};
use super::csv::thousandths;
use crate::toml_text::quoted;
use std::fmt::Write;

impl Analysis {
    /// Returns the rows as `[[failure]]` of a [`cotama-robot/1`](crate::robots::FORMAT) file, to be
    /// put into one that has these flags and parts. Names of what is lost stand between blanks, `,`
    /// or `;`; the reaction in words is a comment, since in a robot's file severity, what is lost,
    /// `restart` and `set` say it.
    ///
    /// ```
    /// use cotama_models::fmeca::Analysis;
    /// let rows = Analysis::shipped("p3dx-delivery").unwrap().to_rows();
    /// assert_eq!(rows.matches("[[failure]]").count(), 46);
    /// assert!(rows.starts_with("[[failure]]\nid = \"SON1\"\n"));
    /// ```
    #[must_use]
    pub fn to_rows(&self) -> String {
        let rows: Vec<_> = self.modes.iter().map(|it| self.row(it)).collect();
        rows.join("\n")
    }

    fn row(&self, it: &Mode) -> String {
        let mut row = format!("[[failure]]\nid = {}\n", quoted(&it.id));
        let mut put = |key: &str, value: String| {
            let _ = writeln!(row, "{key} = {value}"); // writing into a string cannot fail
        };
        let texts = [
            ("function", &it.function),
            ("item", &it.component),
            ("mode", &it.failure),
            ("cause", &it.cause),
            ("effect", &it.effect),
        ];
        for (key, text) in texts.into_iter().filter(|it| !it.1.is_empty()) {
            put(key, quoted(text));
        }
        let operator = it.severity_operator.unwrap_or(it.severity).name();
        let own = it.severity.name();
        put("severity", format!("{{ autonomous = \"{own}\", operator = \"{operator}\" }}"));
        if let Some(it) = it.persistence {
            put("persistence", quoted(it.name()));
        }
        let list = |names: &mut dyn Iterator<Item = &str>| {
            format!("[{}]", names.map(quoted).collect::<Vec<_>>().join(", "))
        };
        let (flags, sometimes) = (self.names(&it.flags), self.names(&it.sometimes));
        match &it.silent {
            Some(why) if flags.is_empty() => put("unseen", quoted(why)),
            _ => put("flags", list(&mut flags.iter().copied())),
        }
        if !sometimes.is_empty() {
            put("sometimes", list(&mut sometimes.iter().copied()));
        }
        if it.latency_ms > 0 {
            put("latency_ms", it.latency_ms.to_string());
        }
        let parts = it.lost.split([' ', ',', ';']).filter(|it| !it.is_empty() && *it != "-");
        let parts: Vec<_> = parts.collect();
        if !parts.is_empty() {
            put("loses", list(&mut parts.into_iter()));
        }
        let share = u64::from(it.alpha_permille.unwrap_or(1_000)).max(1);
        put("mean_hours", thousandths(it.mtbf_mh.saturating_mul(1_000) / share));
        if !it.rate_source.is_empty() {
            put("source", quoted(&it.rate_source));
        }
        if !it.reaction.is_empty() {
            let _ = writeln!(row, "# {}", it.reaction.replace(char::is_control, " "));
        }
        row
    }
}
