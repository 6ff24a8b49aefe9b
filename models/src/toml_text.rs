//! Texts as strings of TOML.

use std::fmt::Write;

/// Returns a text as a basic string of TOML, with its quotes.
///
/// ```
/// assert_eq!(cotama_models::toml_text::quoted("say \"no\""), r#""say \"no\"""#);
/// ```
pub fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for it in text.chars() {
        match it {
            '"' | '\\' => quoted.extend(['\\', it]),
            it if it.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", it as u32);
            }
            it => quoted.push(it),
        }
    }
    quoted.push('"');
    quoted
}

#[cfg(test)]
mod tests {
    use super::quoted;
    use crate::missions::faults::FaultsFile;
    use crate::missions::{Mission, embedded};

    #[test]
    fn a_quoted_text_is_read_again() {
        let patrol = embedded::mission("patrol").unwrap();
        let mission = Mission::parse(patrol.name, patrol.text).unwrap();
        for text in ["", "a b", "say \"no\"", "c:\\x\n", "\u{7f}\u{1}", "ä, 雪", "'"] {
            let file = format!(
                "format = 'panorama-faults/1'\nexpected = {{ mission = {0}, requirement = {0}, \
                 outcome = 'safe', time_ms = 1, energy_mj = 1, x_mm = 1 }}",
                quoted(text)
            );
            let read = FaultsFile::parse("it", &file, &mission).unwrap().expected.unwrap();
            assert_eq!((read.mission.as_deref(), read.requirement.as_str()), (Some(text), text));
        }
    }
}
