//! The drawing of causes and effects of a mission with axes: inducers, indicators, axes.

use cotama_axes::causes::Causes;
use cotama_verification::drawing::elements::Elements;
use cotama_verification::drawing::svg::{STYLE, short, width};

/// Sizes in pixels: of text, of its lines, within a box, between boxes, between columns, outside.
const SIZE: i64 = 11;
const LINE: i64 = 14;
const PAD: i64 = 6;
const GAP: i64 = 10;
const ACROSS: i64 = 120;
const MARGIN: i64 = 16;

/// A box with lines of text.
struct Card {
    lines: Vec<String>,
    y: i64,
}

impl Card {
    fn height(&self) -> i64 {
        let lines = i64::try_from(self.lines.len()).unwrap_or(0);
        lines * LINE + 2 * PAD
    }

    fn middle(&self) -> i64 {
        self.y + self.height() / 2
    }
}

/// Boxes below one another.
struct Column {
    x: i64,
    width: i64,
    cards: Vec<Card>,
}

impl Column {
    fn new(x: i64, texts: impl Iterator<Item = Vec<String>>) -> Self {
        let (mut y, mut cards) = (MARGIN, Vec::new());
        for lines in texts {
            let card = Card { lines, y };
            y += card.height() + GAP;
            cards.push(card);
        }
        let lines = cards.iter().flat_map(|it| &it.lines);
        let widest = lines.map(|it| width(it, SIZE)).max().unwrap_or(0);
        Self { x, width: widest + 2 * PAD, cards }
    }

    fn right(&self) -> i64 {
        self.x + self.width
    }

    fn bottom(&self) -> i64 {
        self.cards.last().map_or(MARGIN, |it| it.y + it.height())
    }

    /// Spreads the boxes over a height.
    fn spread(mut self, bottom: i64) -> Self {
        let gaps = i64::try_from(self.cards.len() + 1).unwrap_or(1);
        let free = bottom - self.bottom();
        for (it, place) in self.cards.iter_mut().zip(1..) {
            it.y += free * place / gaps;
        }
        self
    }

    fn draw(&self, out: &mut Elements) {
        for it in &self.cards {
            out.push_str("<g class=\"state\">");
            out.rounded("", [self.x, it.y], [self.width, it.height()], 4);
            for (line, y) in it.lines.iter().zip((0..).map(|at| it.y + PAD + LINE * at + SIZE)) {
                out.text("", [self.x + PAD, y], line);
            }
            out.push_str("</g>\n");
        }
    }
}

/// Draws the diagram as SVG: each inducer stands beside the indicators that it acts on.
pub(crate) fn svg(causes: &Causes) -> String {
    // An inducer stands at the height of the middle of its indicators.
    let height = |inducer: usize| {
        let effects = causes.effects.iter().enumerate();
        let of: Vec<_> = effects.filter(|it| it.1.inducers.contains(&inducer)).collect();
        of.iter().map(|it| it.0).sum::<usize>() * 1_000 / of.len().max(1)
    };
    let mut order: Vec<usize> = (0..causes.inducers.len()).collect();
    order.sort_by_key(|&it| (height(it), it));
    let lines = |it: &String| vec![short(it)];
    let names = order.iter().filter_map(|&it| causes.inducers.get(it)).map(lines);
    let inducers = Column::new(MARGIN, names);
    let texts = causes.effects.iter().map(|it| it.lines.iter().map(|it| short(it)).collect());
    let effects = Column::new(inducers.right() + ACROSS, texts);
    let axes = Column::new(effects.right() + ACROSS, causes.axes.iter().map(lines));
    let bottom = [&inducers, &effects, &axes].map(Column::bottom).into_iter().max().unwrap_or(0);
    let [inducers, effects, axes] = [inducers, effects, axes].map(|it| it.spread(bottom));
    let (wide, high) = (axes.right() + MARGIN, bottom + MARGIN);
    let mut out = Elements::default();
    out.add(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"cotama\" width=\"{wide}\" \
         height=\"{high}\" viewBox=\"0 0 {wide} {high}\" font-family=\"Helvetica, Arial, \
         sans-serif\" role=\"img\">\n"
    ));
    out.title(&format!("Causes and effects of {}", causes.mission));
    out.add(format_args!("<style>{STYLE}</style>\n"));
    out.rect("paper", [0, 0], [wide, high]);
    for (effect, to) in causes.effects.iter().zip(&effects.cards) {
        let places = effect.inducers.iter().filter_map(|it| order.iter().position(|at| at == it));
        for from in places.filter_map(|it| inducers.cards.get(it)) {
            arrow(&mut out, [inducers.right(), from.middle()], [effects.x, to.middle()]);
        }
        if let Some(axis) = axes.cards.get(effect.axis) {
            arrow(&mut out, [effects.right(), to.middle()], [axes.x, axis.middle()]);
        }
    }
    [&inducers, &effects, &axes].iter().for_each(|it| it.draw(&mut out));
    out.push_str("</svg>\n");
    out.into_string()
}

/// A curve from left to right, with a head.
fn arrow(out: &mut Elements, [x1, y1]: [i64; 2], [x2, y2]: [i64; 2]) {
    let (half, end) = (i64::midpoint(x1, x2), x2 - 6);
    out.path("line", format_args!("M{x1} {y1}C{half} {y1} {half} {y2} {end} {y2}"));
    out.path("head", format_args!("M{x2} {y2}L{end} {}V{}Z", y2 - 3, y2 + 3));
    out.push_str("\n");
}
