//! A drawing that a slider moves through the time of a run.

use cotama_core::text::markup;

/// A section with a drawing of a floor and a slider below it, which a script moves.
pub(crate) struct Player<'p> {
    /// One more class of the section.
    pub(crate) class: &'p str,
    /// Words on what is seen.
    pub(crate) note: &'p str,
    /// The drawing.
    pub(crate) drawn: &'p str,
    /// Markup below the slider.
    pub(crate) below: &'p str,
    /// The end of the run, in ms.
    pub(crate) end_ms: u64,
    /// How many times faster than the run it plays.
    pub(crate) speed: u64,
    /// The run, as the entries of an object of JSON.
    pub(crate) data: &'p str,
    /// The script that shows the run at a time.
    pub(crate) script: &'p str,
}

impl Player<'_> {
    pub(crate) fn section(&self) -> String {
        let Self { class, note, drawn, below, end_ms, speed, data, script } = self;
        format!(
            "<section class=\"{class}\"><h2>On the floor</h2>\n<p class=\"note\">{}</p>\n\
             <figure class=\"map\" tabindex=\"0\" aria-label=\"The floor\">{drawn}</figure>\n\
             <p class=\"player\"><button type=\"button\">Play</button> <input type=\"range\" \
             min=\"0\" max=\"{end_ms}\" step=\"100\" value=\"0\" data-speed=\"{speed}\" \
             aria-label=\"Time of the run\"> <output></output></p>\n{below}<script>\n\
             var RUN={{{data}}};\n{}{script}</script></section>\n",
            markup(note),
            include_str!("player.js")
        )
    }
}
