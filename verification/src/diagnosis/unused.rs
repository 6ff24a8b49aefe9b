//! What no run uses.

use super::words::{name, short_list};
use crate::pt::Pt;
use cotama_core::net::{PlaceId, TransitionId};
use std::fmt;

/// Transitions that never fire and places that are never marked, as a complete search has found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unused<'n> {
    pt: &'n Pt,
    /// Transitions that never fire.
    pub transitions: Vec<TransitionId>,
    /// Places that are never marked.
    pub places: Vec<PlaceId>,
}

impl<'n> Unused<'n> {
    /// From what was used: for each transition whether it fires in some marking, for each place whether it is marked in one.
    /// What the lists do not reach counts as unused.
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
    /// let text = "1 of 1 transition never fires:\n  `ring`  needs `smoke`, which is never marked\n\
    ///             1 of 1 place is never marked:\n  `smoke`  no transition marks it\n";
    /// assert_eq!(unused.to_string(), text);
    /// ```
    pub fn new(pt: &'n Pt, fired: &[bool], marked: &[bool]) -> Self {
        let unused = |count: usize, used: &[bool]| -> Vec<u32> {
            (0..count as u32).filter(|it| !used.get(*it as usize).copied().unwrap_or(false)).collect()
        };
        Self {
            pt,
            transitions: unused(pt.transitions.len(), fired).into_iter().map(TransitionId).collect(),
            places: unused(pt.places.len(), marked).into_iter().map(PlaceId).collect(),
        }
    }

    /// Whether everything is used.
    pub fn is_empty(&self) -> bool {
        self.transitions.is_empty() && self.places.is_empty()
    }

    /// Why a transition cannot fire, as far as single places tell.
    pub fn why_not_fired(&self, transition: TransitionId) -> String {
        let needs = self.pt.needs.of(transition.0);
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
        match (never.as_slice(), all.as_slice()) {
            ([], []) => "needs nothing".to_owned(),
            ([], [one]) => format!("needs {one}, which never holds so many"),
            ([], _) => format!("needs {}, never there together", short_list(&all, 4)),
            ([one], _) => format!("needs {one}, which is never marked"),
            _ => format!("needs {}, which are never marked", short_list(&never, 4)),
        }
    }

    /// Why a place cannot be marked, as far as single transitions tell.
    pub fn why_not_marked(&self, place: PlaceId) -> String {
        let changers = self.pt.changers.of(place.0).iter();
        let givers: Vec<_> =
            changers.filter(|it| it.1 > 0).map(|it| name(&self.pt.transitions, it.0)).collect();
        match givers.as_slice() {
            [] => "no transition marks it".to_owned(),
            [one] => format!("only {one} would mark it, which never fires"),
            _ => format!("{} would mark it, which never fire", short_list(&givers, 4)),
        }
    }
}

impl fmt::Display for Unused<'_> {
    /// A line for each, or a sentence when there is none.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("Every transition fires in some run, and every place is marked in one.\n");
        }
        let head = |unused: usize, count: usize, noun: &str, verbs: [&str; 2]| {
            let plural = if count == 1 { "" } else { "s" };
            format!("{unused} of {count} {noun}{plural} {}:", verbs[usize::from(unused != 1)])
        };
        if !self.transitions.is_empty() {
            let verbs = ["never fires", "never fire"];
            writeln!(f, "{}", head(self.transitions.len(), self.pt.transitions.len(), "transition", verbs))?;
            let line = |it: &TransitionId| (name(&self.pt.transitions, it.0), self.why_not_fired(*it));
            write_lines(f, &self.transitions.iter().map(line).collect::<Vec<_>>())?;
        }
        if !self.places.is_empty() {
            let verbs = ["is never marked", "are never marked"];
            writeln!(f, "{}", head(self.places.len(), self.pt.places.len(), "place", verbs))?;
            let line = |it: &PlaceId| (name(&self.pt.places, it.0), self.why_not_marked(*it));
            write_lines(f, &self.places.iter().map(line).collect::<Vec<_>>())?;
        }
        Ok(())
    }
}

fn write_lines(f: &mut fmt::Formatter<'_>, lines: &[(String, String)]) -> fmt::Result {
    let width = lines.iter().map(|it| it.0.chars().count()).max().unwrap_or(0);
    lines.iter().try_for_each(|(name, why)| writeln!(f, "  {name:width$}  {why}"))
}
