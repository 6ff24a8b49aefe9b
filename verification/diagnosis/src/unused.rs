//! The parts of a net that no run uses.

use super::html::{code, page, sentence};
use super::picture::Picture;
use super::words::{name, printable, short_list};
use cotama_core::net::{Net, PlaceId, TransitionId};
use cotama_core::text::markup;
use cotama_property::pt::Pt;
use serde::Serialize;
use std::fmt::{self, Write as _};

/// Transitions that never fire and places that are never marked.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Unused<'n> {
    pt: &'n Pt,
    /// Transitions that never fire.
    pub transitions: Vec<TransitionId>,
    /// Places that are never marked.
    pub places: Vec<PlaceId>,
    /// Whether these are all. They are, unless a limit kept a search from its end.
    pub is_complete: bool,
    /// Whether transitions have to wait: what they need may be there, but not for long enough.
    pub is_timed: bool,
}

/// A transition that never fires, or a place that is never marked.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Never {
    /// Name of the place or transition.
    pub name: String,
    /// Why, as far as single places and transitions tell; names stand in backticks.
    pub why: String,
}

impl<'n> Unused<'n> {
    /// From what was used: for each transition whether it fires in some marking, for each place
    /// whether it is marked in one. What the lists do not reach counts as unused.
    ///
    /// ```
    /// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
    /// use cotama_verification::{diagnosis::Unused, pt::Pt};
    ///
    /// let mut net = OwnedNet::new("alarm", "");
    /// let smoke = net.place(OwnedPlace::new("smoke", 0)).unwrap();
    /// net.transition(OwnedTransition::new("ring").take(smoke, 1)).unwrap();
    /// let pt = Pt::from(&net.view().net());
    /// let unused = Unused::new(&pt, &[false], &[false]);
    /// let text = "1 of 1 transition never fires:\n  \
    ///             `ring`  needs `smoke`, which is never marked\n\
    ///             1 of 1 place is never marked:\n  `smoke`  no transition marks it\n";
    /// assert_eq!(unused.to_string(), text);
    /// ```
    pub fn new(pt: &'n Pt, fired: &[bool], marked: &[bool]) -> Self {
        let unused = |count: usize, used: &[bool]| -> Vec<u32> {
            (0..count as u32)
                .filter(|it| !used.get(*it as usize).copied().unwrap_or(false))
                .collect()
        };
        let transitions =
            unused(pt.transitions.len(), fired).into_iter().map(TransitionId).collect();
        let places = unused(pt.places.len(), marked).into_iter().map(PlaceId).collect();
        Self { pt, transitions, places, is_complete: true, is_timed: false }
    }

    /// Returns the parts known to be unused, given transitions that are known never to fire: these,
    /// and the places that are empty at the start and that only they mark.
    pub fn with_dead(pt: &'n Pt, dead: &[TransitionId]) -> Self {
        let mut fired = vec![true; pt.transitions.len()];
        for it in dead {
            fired[it.0 as usize] = false;
        }
        let is_given =
            |place: u32| pt.changers.of(place).iter().any(|it| it.1 > 0 && fired[it.0 as usize]);
        let places = 0..pt.places.len() as u32;
        let marked: Vec<_> = places.map(|it| pt.initial[it as usize] > 0 || is_given(it)).collect();
        Self { is_complete: false, ..Self::new(pt, &fired, &marked) }
    }

    /// The same of a net whose transitions have to wait.
    #[must_use]
    pub fn timed(self) -> Self {
        Self { is_timed: true, ..self }
    }

    /// The transitions that never fire, and why.
    pub fn never_fired(&self) -> Vec<Never> {
        let row = |&it: &TransitionId| Never {
            name: self.pt.transitions[it.0 as usize].clone(),
            why: self.why_not_fired(it),
        };
        self.transitions.iter().map(row).collect()
    }

    /// The places that are never marked, and why.
    pub fn never_marked(&self) -> Vec<Never> {
        let row = |&it: &PlaceId| Never {
            name: self.pt.places[it.0 as usize].clone(),
            why: self.why_not_marked(it),
        };
        self.places.iter().map(row).collect()
    }

    /// As JSON: `net`, `transitions` and `places` with `name` and `why` each, and `is_complete`.
    pub fn json(&self) -> String {
        let value = serde_json::json!({
            "net": self.pt.name,
            "transitions": self.never_fired(),
            "places": self.never_marked(),
            "is_complete": self.is_complete,
        });
        format!("{value:#}\n")
    }

    /// A page of its own, with a drawing of a small net in which what is unused is pointed out; of
    /// the net with its events and documentation, if that is given.
    pub fn html(&self, net: Option<&Net<'_>>) -> String {
        let lines = self.to_string();
        let heads: Vec<_> = lines.lines().filter(|it| !it.starts_with(' ')).collect();
        let heads = heads.join(" ").replace(':', ".");
        let mut out = format!(
            "<section class=\"diagnosis\">\n<div class=\"fails\">\n<p class=\"net\">{}</p>\n<h1>{}\
             </h1>\n</div>\n",
            markup(&printable(&self.pt.name)),
            sentence(&heads)
        );
        for (head, rows) in [
            ("Transitions that never fire", self.never_fired()),
            ("Places that are never marked", self.never_marked()),
        ] {
            if rows.is_empty() {
                continue;
            }
            let _ = writeln!(out, "<h2>{head}</h2>\n<div class=\"scroll\">\n<table>");
            for it in rows {
                let _ = writeln!(
                    out,
                    "<tr><td>{}</td><td>{}</td></tr>",
                    code(&it.name),
                    sentence(&it.why)
                );
            }
            out += "</table>\n</div>\n";
        }
        if let Some(picture) = self.picture(net) {
            out += &picture.figure("The net at the start", &[]);
        }
        page(&format!("{}: what no run uses", printable(&self.pt.name)), &(out + "</section>\n"))
    }

    pub(super) fn net_name(&self) -> &str {
        &self.pt.name
    }

    pub(super) fn picture(&self, net: Option<&Net<'_>>) -> Option<Picture> {
        let places = self.places.iter().map(|it| it.0).collect();
        Picture::new(self.pt, net, &self.pt.initial, &self.transitions, &places)
    }

    /// Whether everything is used.
    pub fn is_empty(&self) -> bool {
        self.transitions.is_empty() && self.places.is_empty()
    }

    /// Why a transition cannot fire, as far as single places tell.
    pub fn why_not_fired(&self, transition: TransitionId) -> String {
        let needs = self.pt.needs.of(transition.0);
        let inhibits = self.pt.inhibits(transition.0);
        let below = |&(place, below): &(u32, u32)| {
            format!("{} below {below}", name(&self.pt.places, place))
        };
        let below: Vec<_> = inhibits.iter().map(below).collect();
        let never: Vec<_> = needs
            .iter()
            .filter(|it| self.places.contains(&PlaceId(it.0)))
            .map(|it| name(&self.pt.places, it.0))
            .collect();
        let all: Vec<_> = needs
            .iter()
            .map(|&(place, weight)| match weight {
                1 => name(&self.pt.places, place),
                more => format!("{more} tokens in {}", name(&self.pt.places, place)),
            })
            .collect();
        let all = [all, below].concat();
        match (never.as_slice(), all.as_slice()) {
            ([], []) if !self.pt.is_plain() => "needs nothing, others go before it".to_owned(),
            ([], []) => "needs nothing".to_owned(),
            ([], [one]) if !inhibits.is_empty() => format!("needs {one}, which never is so"),
            ([], all) if self.is_timed => {
                format!("needs {}, never there for long enough", short_list(all, 4))
            }
            ([], [one]) => format!("needs {one}, which never holds so many"),
            ([], _) => format!("needs {}, never there together", short_list(&all, 4)),
            ([one], _) => format!("needs {one}, which is never marked"),
            _ => format!("needs {}, which are never marked", short_list(&never, 4)),
        }
    }

    /// Why a place cannot be marked, as far as single transitions tell.
    pub fn why_not_marked(&self, place: PlaceId) -> String {
        let changers = self.pt.changers.of(place.0).iter();
        let producers: Vec<_> =
            changers.filter(|it| it.1 > 0).map(|it| name(&self.pt.transitions, it.0)).collect();
        match producers.as_slice() {
            [] => "no transition marks it".to_owned(),
            [one] => format!("only {one} would mark it, which never fires"),
            _ => format!("{} would mark it, which never fire", short_list(&producers, 4)),
        }
    }
}

impl fmt::Display for Unused<'_> {
    /// A line for each, or a sentence when there is none.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() && self.is_complete {
            return f.write_str(
                "Every transition fires in some run, and every place is marked in one.\n",
            );
        }
        let head = |unused: usize, count: usize, noun: &str, verbs: [&str; 2]| {
            let plural = if count == 1 { "" } else { "s" };
            format!("{unused} of {count} {noun}{plural} {}:", verbs[usize::from(unused != 1)])
        };
        if !self.transitions.is_empty() {
            let verbs = ["never fires", "never fire"];
            writeln!(
                f,
                "{}",
                head(self.transitions.len(), self.pt.transitions.len(), "transition", verbs)
            )?;
            let line =
                |it: &TransitionId| (name(&self.pt.transitions, it.0), self.why_not_fired(*it));
            write_lines(f, &self.transitions.iter().map(line).collect::<Vec<_>>())?;
        }
        if !self.places.is_empty() {
            let verbs = ["is never marked", "are never marked"];
            writeln!(f, "{}", head(self.places.len(), self.pt.places.len(), "place", verbs))?;
            let line = |it: &PlaceId| (name(&self.pt.places, it.0), self.why_not_marked(*it));
            write_lines(f, &self.places.iter().map(line).collect::<Vec<_>>())?;
        }
        if self.is_complete {
            Ok(())
        } else {
            f.write_str("A limit was reached: there may be more.\n")
        }
    }
}

fn write_lines(f: &mut fmt::Formatter<'_>, lines: &[(String, String)]) -> fmt::Result {
    let width = lines.iter().map(|it| it.0.chars().count()).max().unwrap_or(0);
    lines.iter().try_for_each(|(name, why)| writeln!(f, "  {name:width$}  {why}"))
}
