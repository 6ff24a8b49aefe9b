//! A figure with a legend under it.

use super::scene::{SPACE, Scene};
use super::text::{LABEL, bold_width, width};
use super::{Highlight, Svg, Tip};
use crate::elements::Elements;
use crate::figure::{Figure, Flow};
use crate::layout::Point;
use cotama_core::net::Net;
use cotama_core::text::markup;

/// The length of a line in a legend, and the height of a line of it.
const KEY: i64 = 40;
const KEY_LINE: i64 = 20;

/// A line of a legend: how the lines look that it explains, a word at them, and what it means.
pub(crate) type Key = (Flow, &'static str, &'static str);

/// Draws a figure, whose places are those of a net, with a legend; what it is, in a word or two.
pub(crate) fn write_figure(
    net: &Net<'_>,
    figure: Figure<'_>,
    kind: &str,
    legend: &[Key],
) -> String {
    let highlight = Highlight::default();
    let mut scene = Scene::of(net, figure, &highlight);
    let top = scene.layout.height;
    let wide = |(_, word, meaning): &Key| KEY + bold_width(word, LABEL) + width(meaning, LABEL);
    let widest = legend.iter().map(wide).max().unwrap_or(0) + 3 * SPACE + KEY / 2;
    scene.layout.width = scene.layout.width.max(widest);
    scene.layout.height += i64::try_from(legend.len()).unwrap_or(0) * KEY_LINE + SPACE;
    let mut out = Svg { out: Elements::default(), prefix: "" };
    out.head(&scene, kind);
    out.body(net, &scene, &highlight);
    out.legend(legend, top);
    out.out.push_str("</svg>\n");
    out.out.into_string()
}

impl Svg<'_> {
    /// Lines as they are drawn, each with its word and what it means.
    fn legend(&mut self, legend: &[Key], top: i64) {
        self.out.push_str("<g class=\"legend\">\n");
        for (&(flow, word, meaning), y) in legend.iter().zip((0..).map(|at| top + at * KEY_LINE)) {
            let (class, tip) = match flow {
                Flow::Read => ("edge read", Tip::Dot),
                Flow::Move | Flow::Borrow => ("edge", Tip::Arrow),
            };
            let (left, right) = (KEY / 2, KEY / 2 + KEY);
            self.out.add(format_args!("<g class=\"{class}\">"));
            self.out.path("line", format_args!("M{left} {y}H{}", right - tip.length()));
            self.tip(Point { x: right, y }, (1, 0), tip);
            let said = format!(
                "<tspan class=\"strong\">{word}</tspan> <tspan class=\"quiet\">{}</tspan>",
                markup(meaning)
            );
            self.out.rich_text("", [right + SPACE, y + 4], &said);
            self.out.push_str("</g>\n");
        }
        self.out.push_str("</g>\n");
    }
}
