//! Cause-effect diagrams of an FMECA: as SVG files, one with its legend or all on one sheet, and as
//! elements of a page.

mod ishikawa;
mod scene;

use cotama_core::text::markup;
use cotama_drawing::palette;
use cotama_models::fmeca::Analysis;
use ishikawa::diagram;
use scene::Scene;

/// The style of diagrams, in files and in pages, where severities have their colours by name too:
/// `--weak`, `--medium`, `--hard`, `--fatal`.
pub const STYLE: &str = concat!(palette!(".causes"), include_str!("causes.css"));

/// A sheet is hardly wider, unless a diagram is.
const WIDE: i64 = 1440;

/// Draws the diagrams of all functions on one sheet.
///
/// ```
/// use cotama_models::fmeca::Analysis;
/// use cotama_pages::causes;
/// let sheet = causes::all(&Analysis::shipped("p3dx-delivery").unwrap());
/// assert!(sheet.starts_with("<svg xmlns=") && sheet.contains("cannot"));
/// ```
pub fn all(analysis: &Analysis) -> String {
    let diagrams: Vec<Scene> =
        analysis.functions().into_iter().map(|it| diagram(analysis, it)).collect();
    let title = format!("Cause-effect diagrams, {}: what takes a function away", analysis.title());
    file(&title, analysis, &diagrams)
}

/// Draws the diagram of one function; of what is no function, an empty one.
pub fn one(analysis: &Analysis, function: &str) -> String {
    let title = format!("Cause-effect diagram: cannot {function}");
    file(&title, analysis, &[diagram(analysis, function)])
}

/// Draws the diagram of one function as an element of a page that has the style.
pub fn element(analysis: &Analysis, function: &str) -> String {
    let scene = diagram(analysis, function);
    let label = format!("Cause-effect diagram: cannot {function}");
    inline(&label, &scene)
}

/// Draws the legend as an element of a page that has the style.
pub fn legend(analysis: &Analysis) -> String {
    inline("What colours, letters and lines mean", &ishikawa::legend(analysis, 900))
}

fn inline(label: &str, scene: &Scene) -> String {
    let (width, height) = (scene.width, scene.height);
    format!(
        "<svg class=\"causes\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\
         \" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
        markup(label),
        scene.elements((0, 0))
    )
}

/// Diagrams in rows under their legend.
fn file(title: &str, analysis: &Analysis, diagrams: &[Scene]) -> String {
    let widest = diagrams.iter().map(|it| it.width).max().unwrap_or(0);
    let most = if diagrams.len() > 1 { widest.max(WIDE) } else { widest };
    let legend = ishikawa::legend(analysis, most);
    let mut body = legend.elements((0, 0));
    let (mut x, mut y, mut row) = (0, legend.height, 0);
    let mut width = legend.width;
    for scene in diagrams {
        if x > 0 && x + scene.width > most {
            (x, y, row) = (0, y + row, 0);
        }
        body += &scene.elements((x, y));
        x += scene.width;
        row = row.max(scene.height);
        width = width.max(x);
    }
    let height = y + row;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"causes\" width=\"{width}\" \
         height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         aria-labelledby=\"title\">\n\
         <title id=\"title\">{}</title>\n<style>\n{STYLE}</style>\n\
         <rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n{body}</svg>\n",
        markup(title)
    )
}
