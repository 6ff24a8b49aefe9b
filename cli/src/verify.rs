//! `cotama verify`: whether a certificate shows its verdict.

use crate::answers::check::VerifyAnswer;
use crate::args::VerifyArgs;
use crate::check::questions;
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind};
use crate::output::Screen;
use crate::render;
use crate::subject::Subject;
use crate::tree;
use cotama_verification::certificate::{Certificate, VerifyError, verify as verify_text};
use cotama_verification::formats::json::{Wrong, in_words};

/// Checks a certificate again.
pub(crate) fn verify(args: &VerifyArgs, screen: &Screen) -> Result<Exit, Failure> {
    const WHAT: &str = "a certificate";
    let (limit, wanted) = (input::CERTIFICATE_BYTES, [Kind::Certificate]);
    let text = kind::text(&args.certificate, WHAT, limit, &wanted)?;
    let nothing = VerifyAnswer {
        schema: "cotama/verify/1",
        verified: false,
        net: None,
        tree: None,
        question: None,
        verdict: None,
        evidence: None,
        at: None,
        message: None,
    };
    if tree::is_certificate(&text) {
        if args.model.is_some() {
            return Err(Failure::new("--model is not for certificates of behaviour trees")
                .help("leave --model out: the certificate holds its files"));
        }
        return ended(&tree::verify(&text, nothing), args, screen);
    }
    let shown = match (&args.model, &args.property) {
        (Some(model), Some(property)) => {
            let subject = Subject::load(model, true, args.semantics)?;
            let property = questions::one(property, true, &subject)?;
            let pt = subject.model.pt();
            let about = || Certificate::read(&text).and_then(|it| it.is_about(pt, &property));
            verify_text(&text).and_then(|shown| about().map(|()| shown))
        }
        _ => verify_text(&text),
    };
    let answer = match shown {
        Ok(shown) => VerifyAnswer {
            verified: true,
            net: Some(shown.net),
            question: Some(shown.question),
            verdict: Some(shown.verdict),
            evidence: Some(shown.evidence),
            ..nothing
        },
        // A text that is no certificate at all is not refused, it is bad input.
        Err(VerifyError { at, message }) if at == "certificate" || at == "schema" => {
            const HELP: &str =
                "`cotama check MODEL --property TEXT --certificate FILE` writes certificates";
            let name = input::name(&args.certificate);
            return Err(match in_words(&message, &text) {
                Some(Wrong { line, column, message, .. }) => {
                    FileErrors::at(name, text, line, column, message).help(HELP).into()
                }
                None => Failure::of(name, format!("{at}: {message}")).help(HELP),
            });
        }
        Err(VerifyError { at, message }) => {
            VerifyAnswer { at: Some(at), message: Some(message), ..nothing }
        }
    };
    ended(&answer, args, screen)
}

fn ended(answer: &VerifyAnswer, args: &VerifyArgs, screen: &Screen) -> Result<Exit, Failure> {
    if args.json.json {
        Screen::json(answer)?;
    } else {
        screen.print(&render::verify::screen(answer, screen.width()))?;
    }
    Ok(if answer.verified { Exit::Success } else { Exit::Violated })
}
