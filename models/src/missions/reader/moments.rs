//! Places of events on the path.

use super::entry::Names;
use super::fields::Fields;
use crate::missions::diagnostic::Diagnostic;
use cotama_core::units::Millimetres;

/// Reports a place of the key that is behind the end of the path.
pub(super) fn on_the_path(
    fields: &Fields<'_>,
    key: &'static str,
    x: Option<Millimetres>,
    names: &Names<'_>,
) {
    if let (Some(x), Some(end)) = (x, names.path_length)
        && x > end
    {
        let message = format!("the event at {x} lies behind the end of the path, {end}");
        let help = format!("place it between 0 and {}", end.0);
        fields.report(Diagnostic::new(fields.span_of(key), message, "not on the path").help(help));
    }
}
