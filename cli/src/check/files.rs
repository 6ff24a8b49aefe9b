//! Certificates and traces as files.

use crate::args::CheckArgs;
use crate::exit::Failure;
use crate::output::{self, Screen};
use crate::render::style::NAME;
use crate::render::visible;
use crate::subject::Subject;
use cotama_core::net::owned::OwnedNet;
use cotama_core::text;
use cotama_verification::certificate::{self, Certificate};
use cotama_verification::check::{Answer, Model};
use cotama_verification::diagnosis::{Diagnosis, Unused};
use cotama_verification::property::Property;
use std::path::{Path, PathBuf};

/// The paths of certificates and traces to write.
#[derive(Debug)]
pub(super) struct Files {
    certificate: Option<PathBuf>,
    trace: Option<(PathBuf, Form)>,
    /// How many properties there are: of several, each has a file of its own.
    pub(super) of: usize,
}

impl Files {
    /// The files that are wanted.
    pub(super) fn new(args: &CheckArgs) -> Result<Self, Failure> {
        for path in args.certificate.iter().chain(&args.trace).chain(&args.junit).chain(&args.sarif)
        {
            output::place(path)?;
        }
        let trace = match &args.trace {
            Some(path) => Some((path.clone(), Form::of(path)?)),
            None => None,
        };
        Ok(Self { certificate: args.certificate.clone(), trace, of: 1 })
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
        output::file(&path, text::json(&written).to_string().as_bytes())?;
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
        self.write(position, screen, |form| match form {
            Form::Html => diagnosis.html(),
            Form::Svg => diagnosis.svg(),
            Form::Json => text::json(&diagnosis.json()).to_string(),
        })
    }

    /// Writes what no run uses, where that is why a property is false.
    pub(super) fn unused(
        &self,
        position: usize,
        subject: &Subject,
        unused: &Unused<'_>,
        screen: &Screen,
    ) -> Result<(), Failure> {
        let view = subject.net.as_ref().map(OwnedNet::view);
        let net = view
            .as_ref()
            .map(|it| it.net())
            .filter(|it| it.transitions.len() == subject.model.pt().transitions.len());
        self.write(position, screen, |form| match form {
            Form::Html => unused.html(net.as_ref()),
            Form::Svg => unused.svg(net.as_ref()),
            Form::Json => text::json(&unused.json()).to_string(),
        })
    }

    fn write(
        &self,
        position: usize,
        screen: &Screen,
        text: impl Fn(Form) -> String,
    ) -> Result<(), Failure> {
        let Some((wanted, form)) = &self.trace else { return Ok(()) };
        let path = self.path(wanted, position);
        output::file(&path, text(*form).as_bytes())?;
        screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
        Ok(())
    }

    /// Says that no run is written, where one is wanted.
    pub(super) fn no_trace(&self, property: &Property, screen: &Screen) {
        if self.trace.is_some() {
            screen.note(&format!(
                "no trace for {}: no single run shows the answer",
                visible(&property.name)
            ));
        }
    }
}

/// A form of a trace.
#[derive(Clone, Copy, Debug)]
enum Form {
    Html,
    Svg,
    Json,
}

impl Form {
    /// The form that the end of a name says.
    fn of(path: &Path) -> Result<Self, Failure> {
        match path.extension().map(|end| end.to_string_lossy().to_lowercase()).as_deref() {
            Some("html") => Ok(Self::Html),
            Some("svg") => Ok(Self::Svg),
            Some("json") => Ok(Self::Json),
            _ => {
                let message =
                    format!("{}: the end of this name says no form of a trace", path.display());
                Err(Failure::new(message).help("a trace is written as .html, .svg or .json"))
            }
        }
    }
}

fn certified(
    subject: &Subject,
    property: &Property,
    answer: &Answer,
) -> Result<Certificate, String> {
    let Model::Plain(pt) = &subject.model else {
        return Err(certificate::Uncertifiable::Time.to_string());
    };
    answer.certificate(pt, property).map_err(|error| error.to_string())
}
