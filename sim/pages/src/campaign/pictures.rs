//! Two drawings of a campaign: how the estimate settles, and where on the path runs end.

use super::{between, share};
use crate::axis::{Layout, draw_tick_labels, ticks};
use crate::chart::figure;
use crate::format::{count, grouped};
use crate::svg::{Svg, fixed};
use cotama_campaign::results::Tally;
use cotama_campaign::sampling::Sampling;
use cotama_campaign::statistics::Interval;
use std::fmt::Write;

const TOP: f64 = 12.0;
const BOTTOM: f64 = 172.0;

/// The estimate and its interval after each number of runs, which is drawn by its logarithm.
pub(super) fn settles(tally: &Tally, sampling: Sampling, confidence: f64) -> String {
    let last = (tally.runs, tally.failing);
    let more = tally.course.last() != Some(&last);
    let points: Vec<(u64, Interval)> = tally
        .course
        .iter()
        .copied()
        .chain(more.then_some(last))
        .filter_map(|(runs, hits)| Some((runs, sampling.interval(hits, runs, confidence)?)))
        .collect();
    let Some(&(_, end)) = points.last() else { return String::new() };
    // Few runs say nothing: what they leave open would hide what many say.
    let settled = points.iter().filter(|it| it.0.saturating_mul(32) >= tally.runs);
    let high = settled.map(|it| it.1.high).fold(0.0, f64::max).min(1.0);
    let percent = 100.0 * confidence;
    format!(
        "<section><h2>How the estimate settles</h2>\n<p>After {}, {} of them failing: {}, with \
         {percent} % confidence {}. The band is the interval after each number of runs{}.</p>\n{}\
         </section>\n",
        count(tally.runs, "run"),
        grouped(tally.failing.into()),
        share(end.estimate),
        between(end),
        if high < 1.0 { "; where it is cut off it reaches further up" } else { "" },
        figure("Probability of failure", "%, by the number of runs", |layout| {
            curve(&points, high, layout)
        })
    )
}

fn curve(points: &[(u64, Interval)], high: f64, layout: Layout) -> String {
    // Room for the numbers at both axes.
    let (left, right) = (layout.left.max(52.0), layout.end());
    let last = points.last().map_or(1, |it| it.0);
    let most = last.max(2) as f64;
    let x = |runs: f64| left + (right - left) * libm::log(runs) / libm::log(most);
    let y = |it: f64| BOTTOM - (BOTTOM - TOP) * (it / high.max(1e-12)).min(1.0);
    let mut svg = Svg::new();
    // Shares as whole parts of 10^12.
    let (numbers, _) = ticks(0, (high * 1e12) as i128, 6);
    for it in numbers.into_iter().map(|it| it as f64 / 1e12) {
        svg.line(if it == 0.0 { "zero" } else { "grid" }, [left, y(it)], [right, y(it)]);
        svg.text("e small muted", [left - 6.0, y(it) + 4.0], &tick(it));
    }
    let (mut band, mut line) = (String::new(), String::new());
    // The estimate is drawn where it fits in.
    let (mut begun, mut drawn) = (false, false);
    for (runs, it) in points {
        let at = fixed(x(*runs as f64));
        let _ = write!(band, "{}{at} {}", if begun { 'L' } else { 'M' }, fixed(y(it.high)));
        let fits = it.estimate <= high;
        if fits {
            let _ = write!(line, "{}{at} {}", if drawn { 'L' } else { 'M' }, fixed(y(it.estimate)));
        }
        (begun, drawn) = (true, fits);
    }
    for (runs, it) in points.iter().rev() {
        let _ = write!(band, "L{} {}", fixed(x(*runs as f64)), fixed(y(it.low)));
    }
    svg.ground_path("band", &(band + "Z"));
    svg.path("line real", &line);
    let mut labels = Vec::new();
    for runs in std::iter::successors(Some(1_u64), |it| it.checked_mul(10)) {
        if runs > last {
            break;
        }
        svg.line("axis", [x(runs as f64), BOTTOM], [x(runs as f64), BOTTOM + 4.0]);
        labels.push((x(runs as f64), grouped(runs.into())));
    }
    draw_tick_labels(&mut svg, layout, labels, "", BOTTOM + 17.0);
    svg.text("e small muted", [right, BOTTOM + 32.0], "runs");
    svg.finish(layout.class, [layout.width, BOTTOM + 38.0], "the estimate by the number of runs")
}

/// A share as a tick, in percent, with the digits that it has.
fn tick(share: f64) -> String {
    let text = format!("{:.9}", 100.0 * share);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    format!("{} %", if text.is_empty() { "0" } else { text })
}

/// In how many runs the robot came so far, of those that were not completed or broke a requirement.
pub(super) fn ends(tally: &Tally, path_mm: u64) -> String {
    let (failing, others) =
        tally.ended.values().fold((0, 0), |(failing, others), it| (failing + it.0, others + it.1));
    if failing + others == 0 {
        return String::new();
    }
    let key = |runs: u64, class: &str, words: &str| {
        if runs == 0 {
            return String::new();
        }
        format!("<span class=\"key\"><i class=\"box {class}\"></i>{words}</span> ")
    };
    let and = |runs: u64, words: &str| {
        if runs == 0 { String::new() } else { format!("{} {words}", count(runs, "run")) }
    };
    let said = [
        and(failing, "that broke a requirement"),
        and(others, "that broke none but did not complete the mission"),
    ];
    let said: Vec<_> = said.into_iter().filter(|it| !it.is_empty()).collect();
    format!(
        "<section><h2>Where they end</h2>\n<p>How far the robot came: {}.</p>\n{}<p class=\"keys \
         boxes\">{}{}</p>\n</section>\n",
        said.join(", and "),
        figure("Runs", "by the place of their end on the path, in m", |layout| {
            bars(tally, path_mm, layout)
        }),
        key(failing, "bad", "breaks a requirement"),
        key(others, "warn", "breaks none, and stopped before its end"),
    )
}

fn bars(tally: &Tally, path_mm: u64, layout: Layout) -> String {
    let farthest = tally.ended.keys().next_back().copied().unwrap_or(0);
    let path = path_mm.div_ceil(1_000).max(farthest + 1);
    let (left, right) = (layout.left.max(52.0), layout.end());
    // As wide as a round number of metres, so that at most so many bars stand beside each other.
    let (_, width) = ticks(0, path.into(), if layout.names_beside { 48 } else { 24 });
    let width = u64::try_from(width).unwrap_or(1).max(1);
    let bins = usize::try_from(path.div_ceil(width)).unwrap_or(1);
    let mut heights = vec![(0, 0); bins];
    for (metre, it) in &tally.ended {
        let bin = usize::try_from(metre / width).unwrap_or(0).min(bins - 1);
        heights[bin] = (heights[bin].0 + it.0, heights[bin].1 + it.1);
    }
    let most = heights.iter().map(|it| it.0 + it.1).max().unwrap_or(1).max(1);
    let x = |metre: u64| left + (right - left) * metre as f64 / (bins as u64 * width) as f64;
    let y = |runs: u64| BOTTOM - (BOTTOM - TOP) * runs as f64 / most as f64;
    let mut svg = Svg::new();
    for runs in ticks(0, most.into(), 6).0.into_iter().filter_map(|it| u64::try_from(it).ok()) {
        svg.line(if runs == 0 { "zero" } else { "grid" }, [left, y(runs)], [right, y(runs)]);
        svg.text("e small muted", [left - 6.0, y(runs) + 4.0], &grouped(runs.into()));
    }
    for (bin, &(failing, others)) in heights.iter().enumerate().filter(|it| *it.1 != (0, 0)) {
        let (from, to) = (bin as u64 * width, (bin as u64 + 1) * width);
        let title = format!("{from} to {to} m: {failing} broke a requirement, {others} others");
        svg.titled(&title, |svg| {
            let (at, wide) = (x(from) + 0.5, x(to) - x(from) - 1.0);
            // A bar is visible, however rare its runs.
            let tall = |runs: u64| if runs == 0 { 0.0 } else { (BOTTOM - y(runs)).max(2.0) };
            svg.rect("bar bad", [at, BOTTOM - tall(failing)], [wide, tall(failing)]);
            let top = BOTTOM - tall(failing) - tall(others);
            svg.rect("bar warn", [at, top], [wide, tall(others)]);
        });
    }
    let metres = ticks(0, path.into(), layout.x_ticks).0;
    let mut labels = Vec::new();
    for metre in metres.into_iter().filter_map(|it| u64::try_from(it).ok()) {
        svg.line("axis", [x(metre), BOTTOM], [x(metre), BOTTOM + 4.0]);
        labels.push((x(metre), grouped(metre.into())));
    }
    draw_tick_labels(&mut svg, layout, labels, " m", BOTTOM + 17.0);
    let label = "how many runs end where on the path";
    svg.finish(layout.class, [layout.width, BOTTOM + 26.0], label)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::WIDE;

    /// A tally of runs that end at these places: whether each breaks a requirement.
    fn tally(ends: &[(u64, bool)]) -> Tally {
        let mut tally = Tally::default();
        for (run, (x_mm, breaks)) in (0_u64..).zip(ends) {
            let broken = if *breaks { "\"completed\"" } else { "" };
            let line = format!(
                "{{\"run\":{run},\"outcome\":\"safe\",\"time_ms\":1,\"energy_mj\":1,\
                 \"x_mm\":{x_mm},\"requests\":0,\"replans\":0,\"exposed_ms\":0,\"faults\":[],\
                 \"violated\":[{broken}]}}"
            );
            tally.add(&serde_json::from_str(&line).unwrap(), &line);
        }
        tally
    }

    #[test]
    fn bars_hold_each_run_once_in_the_metres_in_which_it_ended() {
        for (path_mm, ends, said) in [
            (
                80_000,
                &[(80_000, true), (79_999, false)][..],
                "78 to 80 m: 0 broke a requirement, 1",
            ),
            (80_000, &[(80_000, true)], "80 to 82 m: 1 broke a requirement, 0 others"),
            (10_000, &[(0, false), (999, true)], "0 to 1 m: 1 broke a requirement, 1 others"),
            (1_000_000, &[(500_000, true); 3], "500 to 550 m: 3 broke a requirement, 0 others"),
            // Further than the path is long.
            (1_000, &[(7_500, true)], "7 to 8 m: 1 broke a requirement, 0 others"),
            (0, &[(0, true)], "0 to 1 m: 1 broke a requirement, 0 others"),
        ] {
            let drawn = bars(&tally(ends), path_mm, WIDE);
            assert!(drawn.contains(said), "{path_mm} {ends:?}: {drawn}");
        }
    }

    #[test]
    fn ticks_of_shares_have_the_digits_they_need() {
        let said = [0.0, 0.5, 0.002, 0.000_05, 1.0, 2e-9].map(tick);
        assert_eq!(said, ["0 %", "50 %", "0.2 %", "0.005 %", "100 %", "0.0000002 %"]);
    }

    #[test]
    fn a_curve_is_there_for_what_estimates_and_for_nothing_else() {
        let runs: Vec<_> = (0..300).map(|it| (1_000, it % 7 == 0)).collect();
        let tally = tally(&runs);
        for (sampling, is_there) in [
            (Sampling::Fixed, true),
            (Sampling::Stopped, true),
            (Sampling::Every, false),
            (Sampling::Chosen, false),
        ] {
            let page = settles(&tally, sampling, 0.95);
            assert_eq!(page.contains("<svg"), is_there, "{sampling:?}");
            assert_eq!(page.contains("class=\"band\""), is_there);
        }
        let page = settles(&tally, Sampling::Fixed, 0.95);
        assert!(page.contains("After 300 runs, 43 of them failing: 14.3 %"), "{page}");
    }
}
