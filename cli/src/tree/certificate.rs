//! Certificates of answers about behaviour trees, written and verified.

use super::Source;
use super::beside::explored;
use crate::answers::check::VerifyAnswer;
use crate::answers::check::tree::TreeAnswer;
use crate::args::CheckArgs;
use crate::exit::Failure;
use crate::output::{self, Screen};
use crate::render::style::NAME;
use cotama_core::text;
use cotama_trees::certificate::{self, Certificate, SHOWN};
use std::path::Path;

/// Whether a text is a certificate about a tree.
pub(crate) fn is_certificate(text: &str) -> bool {
    let schema = text.split_once("\"schema\"").map(|it| it.1.trim_start_matches([':', ' ']));
    schema.is_some_and(|it| it.starts_with("\"cotama-tree-certificate/"))
}

/// Writes a certificate of what holds, and says of what there is none.
pub(super) fn write(
    path: &Path,
    args: &CheckArgs,
    source: &Source,
    answer: &TreeAnswer,
    screen: &Screen,
) -> Result<(), Failure> {
    let files = source.files.iter().map(|(name, bytes)| {
        let text = String::from_utf8(bytes.clone());
        let message = "no certificate of a file that is not UTF-8";
        Ok((name.clone(), text.map_err(|_| Failure::of(name.clone(), message))?))
    });
    let files = files.collect::<Result<_, Failure>>()?;
    let mut it = Certificate::new(&args.model, files, &source.options);
    it.skips = args.wishes.skips;
    it.period = args.wishes.period;
    it.assume.clone_from(&args.wishes.assume);
    let tree = &source.loaded.tree;
    let exclusive = super::check::exclusive(args, tree)?;
    it.given.clone_from(&args.wishes.given);
    it.beside.clone_from(&source.beside);
    it.exclusive = exclusive.into_iter().map(|it| tree.shown(it)).collect();
    let mut others = Vec::new();
    for row in answer.results.iter().filter(|it| it.verdict == "true") {
        let own = row.name == "property";
        let name = if own { &row.property } else { &row.name };
        if SHOWN.contains(&name.as_str()) || own {
            it.shows.push(name.clone());
        } else {
            others.push(name.clone());
        }
    }
    let mut refused = it.verify(&mut explored);
    // What is shown of a node that nothing enters is less than what holds.
    while let Err(("shows", why)) = &refused {
        let Some(at) = it.shows.iter().position(|name| why.starts_with(name.as_str())) else {
            break;
        };
        others.push(it.shows.remove(at));
        refused = it.verify(&mut explored);
    }
    if let Err((at, why)) = refused {
        screen.note(&format!("no certificate: {at}: {why}"));
        return Ok(());
    }
    output::file(path, text::json(&it.text()).to_string().as_bytes())?;
    screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
    if !others.is_empty() {
        screen.note(&format!("without a certificate: {}", others.join(", ")));
    }
    Ok(())
}

/// Verifies a certificate about a tree.
pub(crate) fn verify(text: &str, nothing: VerifyAnswer) -> VerifyAnswer {
    match certificate::verify(text, &mut explored) {
        Ok(it) => VerifyAnswer {
            verified: true,
            tree: Some(format!("{} ({} nodes)", it.tree, it.nodes)),
            question: Some(it.shows.join(", ")),
            verdict: Some(true),
            evidence: Some(format!("a plain walk through {} states", it.states)),
            ..nothing
        },
        Err((at, message)) => {
            VerifyAnswer { at: Some(at.to_owned()), message: Some(message), ..nothing }
        }
    }
}
