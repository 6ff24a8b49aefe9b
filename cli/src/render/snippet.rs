//! Errors of files as people know them from compilers: the line, the place under it, and what to do.

use crate::exit::Failure;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use cotama_models::diagnostic::MissionErrors;

/// A failure in words, with styles.
pub(crate) fn failure(failure: &Failure, width: usize) -> String {
    let renderer = Renderer::styled().term_width(width);
    match failure {
        Failure::Message { message, help } => {
            let title = Level::ERROR.primary_title(message.as_str());
            let group = match help {
                Some(help) => title.element(Level::HELP.message(help.as_str())),
                None => Group::with_title(title),
            };
            renderer.render(&[group])
        }
        Failure::Text(errors) => text(errors, &renderer),
    }
}

fn text(errors: &MissionErrors, renderer: &Renderer) -> String {
    let mut said = String::new();
    for diagnostic in errors.diagnostics() {
        let place = AnnotationKind::Primary.span(diagnostic.span.clone()).label(diagnostic.label.as_str());
        let snippet = Snippet::source(errors.text()).path(errors.source_name()).annotation(place);
        let mut group = Level::ERROR.primary_title(diagnostic.message.as_str()).element(snippet);
        if let Some(help) = &diagnostic.help {
            group = group.element(Level::HELP.message(help.as_str()));
        }
        said += &renderer.render(&[group]);
        said += "\n\n";
    }
    let count = errors.diagnostics().len() + errors.omitted();
    let s = if count == 1 { "" } else { "s" };
    let shown = if errors.omitted() > 0 {
        format!(", the first {} are shown", errors.diagnostics().len())
    } else {
        String::new()
    };
    let title = format!("{}: {count} error{s}{shown}", errors.source_name());
    said += &renderer.render(&[Group::with_title(Level::ERROR.primary_title(title))]);
    said
}
