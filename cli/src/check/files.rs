//! Certificates and traces as files.

use crate::args::CheckArgs;
use crate::exit::Failure;
use crate::output::{self, Screen};
use crate::render::style::NAME;
use crate::render::visible;
use crate::subject::Subject;
use cotama_verification::certificate::{self, Certificate};
use cotama_verification::check::{Answer, Model};
use cotama_verification::diagnosis::Diagnosis;
use cotama_verification::property::Property;
use std::path::{Path, PathBuf};

/// Where certificates and traces are written.
#[derive(Debug)]
pub(super) struct Files {
    certificate: Option<PathBuf>,
    trace: Option<PathBuf>,
    /// How many properties there are: of several, each has a file of its own.
    pub(super) of: usize,
}

impl Files {
    /// The files that are wanted.
    pub(super) fn new(args: &CheckArgs) -> Result<Self, Failure> {
        if let Some(path) = &args.trace
            && !matches!(extension(path).as_str(), "json" | "html")
        {
            let message = format!("{}: the end of this name says no form of a trace", path.display());
            return Err(Failure::new(message).help("a trace is written as .json or as .html"));
        }
        Ok(Self { certificate: args.certificate.clone(), trace: args.trace.clone(), of: 1 })
    }

    fn path(&self, wanted: &Path, position: usize) -> PathBuf {
        if self.of == 1 {
            return wanted.to_owned();
        }
        let mut name = wanted.file_stem().unwrap_or_default().to_owned();
        name.push(format!("-{}", position + 1));
        if let Some(end) = wanted.extension() {
            name.push(".");
            name.push(end);
        }
        wanted.with_file_name(name)
    }

    /// Writes the certificate of an answer and says where; or says why there is none.
    pub(super) fn certificate(
        &self,
        position: usize,
        subject: &Subject,
        property: &Property,
        answer: &Answer,
        screen: &Screen,
    ) -> Result<Option<String>, Failure> {
        let Some(wanted) = &self.certificate else { return Ok(None) };
        let written = match certified(subject, property, answer) {
            Ok(certificate) => certificate.text(),
            Err(why) => {
                screen.note(&format!("no certificate for {}: {why}", visible(&property.name)));
                return Ok(None);
            }
        };
        let path = self.path(wanted, position);
        output::file(&path, written.as_bytes())?;
        screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
        Ok(Some(path.display().to_string()))
    }

    /// Writes the run that shows a verdict.
    pub(super) fn trace(
        &self,
        position: usize,
        diagnosis: &Diagnosis,
        screen: &Screen,
    ) -> Result<(), Failure> {
        let Some(wanted) = &self.trace else { return Ok(()) };
        let is_page = extension(wanted) == "html";
        let text = if is_page { diagnosis.html() } else { diagnosis.json() };
        let path = self.path(wanted, position);
        output::file(&path, text.as_bytes())?;
        screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
        Ok(())
    }

    /// Says that no run is written, where one is wanted.
    pub(super) fn no_trace(&self, property: &Property, screen: &Screen) {
        if self.trace.is_some() {
            screen.note(&format!("no trace for {}: no single run shows the answer", visible(&property.name)));
        }
    }
}

fn extension(path: &Path) -> String {
    path.extension().map_or_else(String::new, |end| end.to_string_lossy().to_lowercase())
}

fn certified(subject: &Subject, property: &Property, answer: &Answer) -> Result<Certificate, String> {
    let Model::Plain(pt) = &subject.model else {
        return Err(certificate::Uncertifiable::Time.to_string());
    };
    answer.certificate(pt, property).map_err(|error| error.to_string())
}
