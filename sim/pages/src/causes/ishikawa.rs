//! Cause-effect (Ishikawa) diagrams: what takes a function away. The head is the effect, each rib a
//! component, each branch of a rib a failure mode with its cause (method: Durand et al., IROS
//! 2010).

use super::scene::{Face, Group, Place, Scene};
use cotama_models::fmeca::{Analysis, Mode, Rib};
use cotama_models::severity::Severity;

/// The space around a diagram, and between things that must not touch.
const MARGIN: i64 = 14;
const GAP: i64 = 16;
/// How far text keeps from a rib.
const CLEAR: i64 = 7;
/// Failures and causes are broken into lines that are hardly wider.
const WRAP: i64 = 176;
const HEAD_WRAP: i64 = 130;
/// The height of a badge, and the width of one with a letter.
const BADGE: i64 = 16;
const LETTER: i64 = 15;
/// The height of the name of a component.
const NAME: i64 = 22;

/// A branch: a failure mode, as it is drawn.
struct Branch<'a> {
    mode: &'a Mode,
    failure: Vec<String>,
    cause: Vec<String>,
    /// The text stands this far from its left end, behind the badges.
    indent: i64,
    width: i64,
    height: i64,
}

impl<'a> Branch<'a> {
    fn new(mode: &'a Mode) -> Self {
        let failure = Face::Failure.lines(&mode.failure, WRAP);
        let cause = Face::Quiet.lines(&mode.cause, WRAP);
        let indent = badges_width(mode) + 6;
        let widths = failure.iter().map(|it| Face::Failure.width(it));
        let widest = widths.chain(cause.iter().map(|it| Face::Quiet.width(it))).max().unwrap_or(0);
        let height = Face::Failure.height(&failure) + Face::Quiet.height(&cause) + 5;
        Self { mode, failure, cause, indent, width: indent + widest, height }
    }
}

/// A rib with its branches, as it is drawn.
struct Bone<'a> {
    component: &'a str,
    branches: Vec<Branch<'a>>,
}

impl<'a> Bone<'a> {
    fn new(rib: Rib<'a>) -> Self {
        let branches = rib.modes.into_iter().map(Branch::new).collect();
        Self { component: rib.component, branches }
    }

    fn name_width(&self) -> i64 {
        Face::Component.width(self.component) + 18
    }

    /// How far it must reach from the spine.
    fn height(&self) -> i64 {
        NAME + GAP + self.branches.iter().map(|it| it.height + GAP).sum::<i64>()
    }

    /// How far to the left of its foot its texts would reach if it were upright, with what its
    /// slope adds beside them.
    fn width(&self) -> i64 {
        self.branches.iter().map(|it| it.width + CLEAR + slope(it.height)).max().unwrap_or(0)
    }
}

/// How far a rib leans to the left at a distance from the spine.
const fn slope(distance: i64) -> i64 {
    (distance * 2 + 4) / 5
}

/// The diagram of a function; an empty one of what is no function.
pub(super) fn diagram(analysis: &Analysis, function: &str) -> Scene {
    let bones: Vec<Bone<'_>> = analysis.ribs(function).into_iter().map(Bone::new).collect();
    // Ribs stand above and below in turn, two at each foot.
    let reach =
        |side: usize| bones.iter().skip(side).step_by(2).map(Bone::height).max().unwrap_or(0);
    let (above, below) = (reach(0), reach(1));
    let head = Head::new(function);
    let spine = MARGIN + above.max(head.height / 2);
    let mut feet: Vec<i64> = Vec::new();
    let mut before: Option<&[Bone<'_>]> = None;
    for pair in bones.chunks(2) {
        let room = |(side, bone): (usize, &Bone<'_>)| {
            let Some((before, foot)) = before.zip(feet.last()) else {
                return MARGIN
                    + slope([above, below][side])
                    + bone.width().max(bone.name_width() / 2);
            };
            let names =
                before.get(side).map_or(0, |it| i64::midpoint(it.name_width(), bone.name_width()));
            foot + names.max(bone.width()) + GAP
        };
        feet.push(pair.iter().enumerate().map(room).max().unwrap_or(0));
        before = Some(pair);
    }
    let (first, last) =
        (feet.first().copied().unwrap_or(MARGIN), feet.last().copied().unwrap_or(MARGIN));
    let mut scene = Scene::default();
    let left = last + 40;
    let mut body = Group::default();
    body.arrow("spine", (first - 36, spine), (left - 1, spine));
    head.draw(&mut body, left, spine);
    scene.groups.push(body);
    for (at, bone) in bones.iter().enumerate() {
        let (side, reach) = if at % 2 == 0 { (-1, above) } else { (1, below) };
        draw(&mut scene, bone, (feet[at / 2], spine), side, reach);
    }
    scene.width = left + head.width + MARGIN;
    scene.height = spine + below.max(head.height / 2) + MARGIN;
    scene
}

/// A rib that reaches so far to one side of the spine: -1 is above, 1 is below.
fn draw(scene: &mut Scene, bone: &Bone<'_>, (foot, spine): Place, side: i64, reach: i64) {
    let rib = |y: i64| foot - slope((y - spine).abs());
    let end = spine + side * (reach - NAME);
    let mut group = Group::default();
    group.line("rib", (rib(end), end), (foot, spine));
    let wide = bone.name_width();
    let top = if side < 0 { spine - reach } else { end };
    let corner = (rib(end) - wide / 2, top);
    group.rect("component", corner, (wide, NAME), 4);
    group.text(Face::Component, (corner.0 + 9, top + 15), bone.component);
    scene.groups.push(group);
    // Branches share the space that others on this side leave.
    let gaps = bone.branches.iter().fold(1, |gaps, _| gaps + 1);
    let spare = (reach - bone.height()) / gaps;
    let mut y = if side < 0 { spine - reach + NAME + GAP } else { spine + GAP };
    for branch in &bone.branches {
        y += spare;
        let right = rib(y).min(rib(y + branch.height)) - CLEAR;
        scene.groups.push(drawn(branch, (right - branch.width, y), rib(y + branch.height)));
        y += branch.height + GAP;
    }
}

/// A branch with its left upper corner, and the rib where it ends.
fn drawn(branch: &Branch<'_>, (left, top): Place, rib: i64) -> Group {
    let mode = branch.mode;
    let title =
        format!("{}: {}. Cause: {}. Effect: {}", mode.id, mode.failure, mode.cause, mode.effect);
    let mut group = Group { title, items: Vec::new() };
    badges(&mut group, mode, (left, top));
    let mut y = top;
    for (face, lines) in [(Face::Failure, &branch.failure), (Face::Quiet, &branch.cause)] {
        for line in lines {
            y += face.line();
            group.text(face, (left + branch.indent, y - 3), line);
        }
    }
    let class = if mode.is_detected() { "branch" } else { "unseen" };
    group.line(class, (left, top + branch.height), (rib, top + branch.height));
    group
}

/// The effect: the function that is lost.
struct Head {
    lines: Vec<String>,
    width: i64,
    height: i64,
}

impl Head {
    fn new(function: &str) -> Self {
        let lines = Face::Head.lines(function, HEAD_WRAP);
        let widest = lines.iter().map(|it| Face::Head.width(it)).max().unwrap_or(0);
        let height = Face::Quiet.line() + Face::Head.height(&lines) + 20;
        Self { width: widest.max(Face::Quiet.width("cannot")) + 28, height, lines }
    }

    fn draw(&self, group: &mut Group, left: i64, spine: i64) {
        let top = spine - self.height / 2;
        group.rect("head", (left, top), (self.width, self.height), 6);
        let mut y = top + 9 + Face::Quiet.line();
        group.text(Face::Quiet, (left + 14, y - 3), "cannot");
        for line in &self.lines {
            y += Face::Head.line();
            group.text(Face::Head, (left + 14, y - 2), line);
        }
    }
}

fn id_width(id: &str) -> i64 {
    Face::Badge.width(id) + 10
}

fn badges_width(mode: &Mode) -> i64 {
    id_width(&mode.id) + LETTER + mode.severity_operator.map_or(0, |_| LETTER)
}

/// An id on the colour of the first severity, and the first letter of each severity on its own.
fn badges(group: &mut Group, mode: &Mode, (left, top): Place) {
    let mut x = left;
    let letter = |it: Severity| (it.name()[..1].to_uppercase(), it, LETTER);
    let id = (mode.id.clone(), mode.severity, id_width(&mode.id));
    let letters = [Some(mode.severity), mode.severity_operator].into_iter().flatten().map(letter);
    for (text, severity, wide) in std::iter::once(id).chain(letters) {
        group.rect(severity.name(), (x, top), (wide, BADGE), 0);
        let face = if severity == Severity::Fatal { Face::DarkBadge } else { Face::Badge };
        group.text(face, (x + wide / 2, top + 12), text);
        x += wide;
    }
}

/// Draws the legend of colours, letters and lines, in lines no wider than `most`.
pub(super) fn legend(analysis: &Analysis, most: i64) -> Scene {
    let mut scene = Scene { width: 0, height: MARGIN, groups: Vec::new() };
    let mut group = Group::default();
    let mut x = MARGIN;
    let mut y = MARGIN;
    let mut place = |wide: i64| {
        if x > MARGIN && x + wide + MARGIN > most {
            (x, y) = (MARGIN, y + BADGE + 8);
        }
        let at = (x, y);
        x += wide + GAP;
        scene.width = scene.width.max(x - GAP + MARGIN);
        scene.height = y + BADGE + MARGIN;
        at
    };
    for severity in [Severity::Weak, Severity::Medium, Severity::Hard, Severity::Fatal] {
        let (left, top) = place(LETTER + 5 + Face::Quiet.width(severity.name()));
        group.rect(severity.name(), (left, top), (LETTER, BADGE), 0);
        let face = if severity == Severity::Fatal { Face::DarkBadge } else { Face::Badge };
        group.text(face, (left + LETTER / 2, top + 12), severity.name()[..1].to_uppercase());
        group.text(Face::Quiet, (left + LETTER + 5, top + 12), severity.name());
    }
    if analysis.modes().iter().any(|it| it.severity_operator.is_some()) {
        let words = "first letter: the robot drives itself; second: the operator drives";
        let (left, top) = place(Face::Quiet.width(words));
        group.text(Face::Quiet, (left, top + 12), words);
    }
    let declared = analysis.modes().iter().all(|it| it.is_detected() || it.silent.is_some());
    let unseen =
        if declared { "declared unseen, with a reason" } else { "nothing is sure to see it" };
    let lines = [("branch", "some observer sees it"), ("unseen", unseen)];
    for (class, words) in lines {
        let (left, top) = place(33 + Face::Quiet.width(words));
        group.line(class, (left, top + 8), (left + 28, top + 8));
        group.text(Face::Quiet, (left + 33, top + 12), words);
    }
    scene.groups.push(group);
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(one: [i64; 4], other: [i64; 4]) -> bool {
        one[2] <= other[0] || other[2] <= one[0] || one[3] <= other[1] || other[3] <= one[1]
    }

    /// Whether a line meets a box, by points a tenth of a pixel or less apart.
    fn meets(((x1, y1), (x2, y2)): (Place, Place), [left, top, right, bottom]: [i64; 4]) -> bool {
        let steps = 10 * (x2 - x1).abs().max((y2 - y1).abs());
        (0..=steps).any(|at| {
            let (x, y) = (x1 * steps + (x2 - x1) * at, y1 * steps + (y2 - y1) * at);
            x > left * steps && x < right * steps && y > top * steps && y < bottom * steps
        })
    }

    fn scenes() -> Vec<Scene> {
        let robot = Analysis::shipped("p3dx-delivery").unwrap();
        let diagrams = robot.functions().into_iter().map(|it| diagram(&robot, it));
        diagrams.chain([legend(&robot, 200), legend(&robot, 900)]).collect()
    }

    #[test]
    fn no_two_texts_overlap_and_all_are_inside() {
        for scene in scenes() {
            let texts = scene.texts();
            for (at, (text, one)) in texts.iter().enumerate() {
                for (other_text, other) in &texts[..at] {
                    assert!(apart(*one, *other), "{text:?} and {other_text:?}: {one:?} {other:?}");
                }
                let inside =
                    one[0] >= 0 && one[1] >= 0 && one[2] <= scene.width && one[3] <= scene.height;
                assert!(inside, "{text:?} {one:?}");
            }
        }
    }

    #[test]
    fn no_line_crosses_a_text() {
        for scene in scenes() {
            for (text, place) in scene.texts() {
                for line in scene.lines() {
                    assert!(!meets(line, place), "{text:?} {place:?} {line:?}");
                }
            }
        }
    }

    #[test]
    fn every_failure_mode_is_drawn_once() {
        let scenes = scenes();
        for mode in Analysis::shipped("p3dx-delivery").unwrap().modes() {
            let drawn =
                scenes.iter().flat_map(Scene::texts).filter(|(text, _)| *text == mode.id).count();
            assert_eq!(drawn, 1, "{}", mode.id);
        }
    }

    #[test]
    fn the_measurements_can_fail() {
        assert!(!apart([0, 0, 10, 10], [9, 9, 20, 20]) && apart([0, 0, 10, 10], [10, 0, 20, 10]));
        assert!(
            meets(((0, 0), (10, 10)), [4, 4, 6, 6]) && !meets(((0, 0), (10, 10)), [6, 0, 10, 4])
        );
    }
}
