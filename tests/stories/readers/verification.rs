//! Nets, questions, certificates, recordings.

use super::checks::{is_place, is_span, text};
use cotama_models::nets::door;
use cotama_verification::certificate::{self, Certificate};
use cotama_verification::conform::Recording;
use cotama_verification::formats::json::{self, Wrong};
use cotama_verification::property::{self, Ids, PropertyError, Question, mcc};
use cotama_verification::pt::Pt;
use cotama_verification::{pnml, tina};
use std::sync::LazyLock;

super::readers! {
    pnml: read_pnml, [
        "<page>", "</page>", "<place id='p'/>", "<transition id='t'/>",
        "<arc source='p' target='t'/>",
        "<!--", "-->", "]]>", "<![CDATA[", "&lt;", "&#0;", "<!DOCTYPE x [", "<text>", "</text>",
        "<referencePlace id='r' ref='r'/>", "<?xml version='1.0' encoding='latin1'?>",
    ];
    tina: read_tina, [
        "tr ", "pl ", "net ", "nt ", "pr ", " -> ", "?1", "?-1", "*2", "{", "}", "[0,w[", "]2,5]",
        ": a", "(1)", "K", "E", "# ",
    ];
    json: read_json, [
        "null", "[]", "{}", "\"places\":", "\"within\":", "\"on\":", "\"bound\":", "\"guard\":",
        "true", "\\u0000",
    ];
    systems: read_system, [
        "null", "[]", "{}", "\"nets\":", "\"mail\": 1", "\"mailbox\":", "\"links\":", "\"a.b\"",
    ];
    properties: read_property, [
        "AG ", "EF ", "A ", "E ", " U ", "X ", "deadlock", "fireable(", "bounds(", " assuming ",
        "weak(", "often(", "live", "one_safe", " -> ", " <-> ", "<=", "\"", "{", "}", "\\u{", "5ms",
        "response(", " + ", " * ", "!",
    ];
    property_files: read_property_file, [
        "<property>", "</property>", "<id>", "</id>", "<formula>", "</formula>", "<all-paths>",
        "<globally>", "<until>", "<before>", "<reach>", "<negation>", "<true/>", "<deadlock/>",
        "<integer-le>", "<place>", "&amp;", "&#x110000;", "<![CDATA[", "]]>", "<!--",
    ];
    certificates: read_certificate, [
        "null", "[]", "{}", "\"graph\":", "\"trace\":", "\"not\":", "\"and\":", "\"fire\":",
        "true", "false", "\"refutation\":", "\"lasso\":",
    ];
    recordings: read_recording, [
        "{\"t_ms\":0,\"end\":true}\n", "null", "\"event\":\"Call\"", "\"fired\":\"close\"",
        "\"round\":true", "\"silent\":[]", "\"ignored\":true", "{}", "\n",
    ];
}

fn read_pnml(bytes: &[u8]) -> bool {
    match pnml::read("file", bytes) {
        Ok(net) => {
            assert_eq!(net.view().net().defect(), None);
            let written = pnml::write(&net.view().net());
            assert_eq!(pnml::read("again", written.as_bytes()).as_ref(), Ok(&net));
            true
        }
        Err(errors) => {
            assert!(!errors.diagnostics().is_empty());
            for diagnostic in errors.diagnostics() {
                is_span(errors.text(), diagnostic.at.span.clone());
                is_place(errors.text(), diagnostic.at.line, diagnostic.at.column);
                assert!(diagnostic.help.is_some(), "{errors}");
            }
            false
        }
    }
}

fn read_tina(bytes: &[u8]) -> bool {
    match tina::read("file", bytes) {
        Ok(net) => {
            assert_eq!(tina::read("again", tina::write(&net).as_bytes()).as_ref(), Ok(&net));
            true
        }
        Err(error) => {
            is_place(&text(bytes), error.line, error.column);
            assert!(error.to_string().starts_with("file:"));
            false
        }
    }
}

fn read_json(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match json::read(&text) {
        Ok(net) => {
            assert_eq!(json::read(&json::write(&net.view().net())).as_ref(), Ok(&net));
            true
        }
        Err(error) => is_wrong(&text, &error),
    }
}

fn read_system(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match json::read_system(&text) {
        Ok(system) => {
            let again = json::read_system(&system.with(json::write_system));
            assert_eq!(again.as_ref(), Ok(&system));
            true
        }
        Err(error) => is_wrong(&text, &error),
    }
}

/// Checks that a text is refused with its place.
fn is_wrong(text: &str, error: &Wrong) -> bool {
    // The end of the text has no column; all else says where by names.
    is_place(text, error.line.max(1), error.column.max(1));
    assert!(!error.to_string().is_empty());
    false
}

/// The net that questions are about.
static DOOR: LazyLock<Pt> = LazyLock::new(|| Pt::from(&door::NET));

fn is_refusal(text: &str, error: &PropertyError) {
    is_span(text, error.at.span.clone());
    is_place(text, error.at.line, error.at.column);
    assert!(!error.message.is_empty());
}

/// Checks that a question that was read is read again as it is shown.
fn is_shown(question: &Question) {
    let shown = question.display(&DOOR).to_string();
    // A question shown with all its brackets may be longer than the reader allows.
    if shown.len() <= property::MAX_TEXT
        && let Ok(again) = property::parse(&shown, &DOOR)
    {
        assert_eq!(again.question.display(&DOOR).to_string(), shown);
    }
    let _ = question.simplified();
}

fn read_property(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match property::parse(&text, &DOOR) {
        Ok(property) => {
            is_shown(&property.question);
            true
        }
        Err(error) => {
            is_refusal(&text, &error);
            false
        }
    }
}

fn read_property_file(bytes: &[u8]) -> bool {
    match mcc::read("file", bytes, &DOOR, Ids::default()) {
        Ok(properties) => {
            properties.iter().for_each(|it| is_shown(&it.question));
            true
        }
        Err(error) => {
            is_place(&text(bytes), error.at.line, error.at.column);
            assert!(error.to_string().starts_with("file:"));
            false
        }
    }
}

fn read_certificate(bytes: &[u8]) -> bool {
    let text = text(bytes);
    let read = Certificate::read(&text);
    match certificate::verify(&text) {
        Ok(_) => {
            // Another test shows that no forged certificate is believed.
            assert!(read.is_ok());
            true
        }
        Err(error) => {
            assert!(!error.at.is_empty() && !error.message.is_empty());
            if let Err(unread) = read {
                assert_eq!(unread, error);
            }
            false
        }
    }
}

fn read_recording(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match Recording::read("file", &text) {
        Ok(recording) => {
            assert!(recording.lines.is_sorted_by_key(|it| it.at));
            true
        }
        Err(error) => {
            is_place(&text, error.line, error.column);
            assert!(!error.message.is_empty());
            false
        }
    }
}
