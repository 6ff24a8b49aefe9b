//! The truth about a certificate, by plain search: nothing of it is shared with the checker.

use serde_json::{Value, json};
use std::collections::HashMap;

type Marking = Vec<i64>;

/// A net with its reachable markings.
pub(crate) struct Space {
    places: Vec<String>,
    names: Vec<String>,
    enabled: Vec<Vec<bool>>,
    markings: Vec<Marking>,
    next: Vec<Vec<usize>>,
}

impl Space {
    /// Returns the space; `None` when there are more than so many markings.
    pub(crate) fn new(net: &Value, most: usize) -> Option<Self> {
        let pair = |it: &Value| (it[0].as_str().unwrap().to_owned(), it[1].as_i64().unwrap());
        let list = |it: &Value| it.as_array().unwrap().iter().map(pair).collect::<Vec<_>>();
        let (places, start): (Vec<_>, Vec<_>) = list(&net["places"]).into_iter().unzip();
        let at = |name: &String| places.iter().position(|it| it == name).unwrap();
        let transitions: Vec<_> = net["transitions"].as_array().unwrap().iter().collect();
        let arcs: Vec<(Vec<_>, Vec<_>)> =
            transitions.iter().map(|it| (list(&it["take"]), list(&it["give"]))).collect();
        let names = transitions.iter().map(|it| it["name"].as_str().unwrap().to_owned()).collect();
        let (mut markings, mut next, mut enabled) = (vec![start.clone()], Vec::new(), Vec::new());
        let mut numbers = HashMap::from([(start, 0)]);
        while next.len() < markings.len() {
            let marking = markings[next.len()].clone();
            let can: Vec<bool> = arcs
                .iter()
                .map(|it| it.0.iter().all(|(place, weight)| marking[at(place)] >= *weight))
                .collect();
            let mut after = Vec::new();
            for ((take, give), _) in arcs.iter().zip(&can).filter(|it| *it.1) {
                let mut new = marking.clone();
                for (place, weight) in take {
                    new[at(place)] -= weight;
                }
                for (place, weight) in give {
                    new[at(place)] = new[at(place)].checked_add(*weight)?;
                }
                let fresh = markings.len();
                let number = *numbers.entry(new.clone()).or_insert(fresh);
                if number == fresh {
                    markings.push(new);
                }
                after.push(number);
            }
            if markings.len() > most {
                return None;
            }
            enabled.push(can);
            next.push(after);
        }
        Some(Self { places, names, enabled, markings, next })
    }

    /// Whether the answer to a question is yes; `None` when this search cannot tell.
    pub(crate) fn answer(&self, question: &Value) -> Option<bool> {
        let reached_from = |from: usize| {
            let mut seen = vec![false; self.markings.len()];
            let mut stack = vec![from];
            while let Some(at) = stack.pop() {
                if !std::mem::replace(&mut seen[at], true) {
                    stack.extend(&self.next[at]);
                }
            }
            (0..seen.len()).filter(move |it| seen[*it])
        };
        let transitions = 0..self.names.len();
        match question.as_str() {
            Some("one_safe") => return Some(self.markings.iter().flatten().all(|it| *it <= 1)),
            Some("stable") => {
                let same = |place: usize| {
                    self.markings.iter().all(|it| it[place] == self.markings[0][place])
                };
                return Some((0..self.places.len()).any(same));
            }
            Some("quasi_live") => {
                return Some(
                    transitions.into_iter().all(|it| self.enabled.iter().any(|can| can[it])),
                );
            }
            Some("live") => {
                let again =
                    |from: usize, it: usize| reached_from(from).any(|at| self.enabled[at][it]);
                return Some(
                    transitions
                        .into_iter()
                        .all(|it| (0..self.markings.len()).all(|from| again(from, it))),
                );
            }
            _ => {}
        }
        if let Some(bound) = question.get("bound") {
            let places: Vec<_> =
                bound["places"].as_array()?.iter().map(|it| self.place(it)).collect();
            let sum =
                |it: &Marking| places.iter().map(|place| i128::from(it[*place])).sum::<i128>();
            return Some(
                self.markings.iter().map(sum).max() == Some(bound["most"].as_i64()?.into()),
            );
        }
        let formula = &question["formula"];
        self.holds(formula).map(|it| it[0]).or_else(|| self.on_some_run(formula))
    }

    fn place(&self, name: &Value) -> usize {
        self.places.iter().position(|it| it == name.as_str().unwrap()).unwrap()
    }

    fn not(list: Vec<bool>) -> Vec<bool> {
        list.into_iter().map(|it| !it).collect()
    }

    /// Returns the markings in which a formula of CTL holds, by fixed points.
    fn holds(&self, formula: &Value) -> Option<Vec<bool>> {
        let all = 0..self.markings.len();
        if formula == "deadlock" {
            return Some(all.map(|it| self.next[it].is_empty()).collect());
        }
        let (kind, inner) = formula.as_object()?.iter().next()?;
        let list = || {
            inner.as_array().unwrap().iter().map(|it| self.holds(it)).collect::<Option<Vec<_>>>()
        };
        Some(match kind.as_str() {
            "at_most" => {
                let weights: Vec<_> = inner["weights"]
                    .as_array()?
                    .iter()
                    .map(|it| (self.place(&it[0]), i128::from(it[1].as_i64().unwrap())))
                    .collect();
                let constant = i128::from(inner["constant"].as_i64()?);
                let value = |it: &Marking| {
                    constant
                        + weights
                            .iter()
                            .map(|(place, weight)| weight * i128::from(it[*place]))
                            .sum::<i128>()
                };
                self.markings.iter().map(|it| value(it) <= 0).collect()
            }
            "fireable" => {
                let ids: Vec<_> = inner
                    .as_array()?
                    .iter()
                    .map(|it| self.names.iter().position(|name| it == name).unwrap())
                    .collect();
                all.map(|it| ids.iter().any(|id| self.enabled[it][*id])).collect()
            }
            "not" => Self::not(self.holds(inner)?),
            "and" => list()?.iter().fold(vec![true; all.len()], |a, b| {
                a.iter().zip(b).map(|(a, b)| *a && *b).collect()
            }),
            "or" => list()?.iter().fold(vec![false; all.len()], |a, b| {
                a.iter().zip(b).map(|(a, b)| *a || *b).collect()
            }),
            "EX" | "AX" => {
                let a = self.holds(inner)?;
                let after = |it: usize| self.next[it].iter().map(|to| a[*to]).collect::<Vec<_>>();
                all.map(|it| {
                    if kind == "EX" {
                        after(it).contains(&true)
                    } else {
                        !after(it).contains(&false)
                    }
                })
                .collect()
            }
            "E" | "A" => {
                let every = kind == "A";
                let step = |good: &[bool], at: usize| {
                    if every {
                        self.next[at].iter().all(|it| good[*it])
                    } else {
                        self.next[at].iter().any(|it| good[*it])
                    }
                };
                let until = |a: Vec<bool>, b: Vec<bool>| {
                    let mut until = b;
                    loop {
                        let more: Vec<bool> = (0..a.len())
                            .map(|it| {
                                until[it] || a[it] && !self.next[it].is_empty() && step(&until, it)
                            })
                            .collect();
                        if more == until {
                            return until;
                        }
                        until = more;
                    }
                };
                let (operator, inner) = inner.as_object()?.iter().next()?;
                match operator.as_str() {
                    "F" => until(vec![true; all.len()], self.holds(inner)?),
                    "G" => {
                        let mut good = self.holds(inner)?;
                        loop {
                            let less: Vec<bool> = all
                                .clone()
                                .map(|it| good[it] && (self.next[it].is_empty() || step(&good, it)))
                                .collect();
                            if less == good {
                                return Some(good);
                            }
                            good = less;
                        }
                    }
                    "not" => {
                        let opposite = json!({ if every { "E" } else { "A" }: inner });
                        Self::not(self.holds(&opposite)?)
                    }
                    "U" => until(self.holds(&inner[0])?, self.holds(&inner[1])?),
                    _ => return None,
                }
            }
            _ => return None,
        })
    }

    /// Whether some short run decides `E path` (true) or `A path` (false).
    fn on_some_run(&self, formula: &Value) -> Option<bool> {
        let (kind, path) = formula.as_object()?.iter().next()?;
        if kind == "not" {
            return self.on_some_run(path).map(|it| !it);
        }
        let wanted = match kind.as_str() {
            "E" => true,
            "A" => false,
            _ => return None,
        };
        let mut runs = vec![vec![0_usize]];
        while let Some(run) = runs.pop() {
            let last = *run.last()?;
            if self.next[last].is_empty() && self.at(path, &run, run.len() - 1, 0)? == wanted {
                return Some(wanted);
            }
            for &after in &self.next[last] {
                for back in (0..run.len()).filter(|it| run[*it] == after) {
                    if self.at(path, &run, back, 0)? == wanted {
                        return Some(wanted);
                    }
                }
                if run.len() < 7 {
                    runs.push(run.iter().copied().chain([after]).collect());
                }
            }
        }
        None
    }

    /// Whether a path formula holds at a position of the run, whose last marking is followed by the
    /// one at `back`.
    fn at(&self, path: &Value, run: &[usize], back: usize, position: usize) -> Option<bool> {
        let next = |it: usize| if it + 1 < run.len() { it + 1 } else { back };
        // All positions from here on, in order, each once.
        let later = |from: usize| {
            let mut seen = vec![from];
            while !seen.contains(&next(seen[seen.len() - 1])) {
                seen.push(next(seen[seen.len() - 1]));
            }
            seen
        };
        if let Some((kind, inner)) = path.as_object().and_then(|it| it.iter().next()) {
            let at = |formula: &Value, it: usize| self.at(formula, run, back, it);
            match kind.as_str() {
                "not" => return at(inner, position).map(|it| !it),
                "and" | "or" => {
                    let parts: Option<Vec<bool>> =
                        inner.as_array()?.iter().map(|it| at(it, position)).collect();
                    return parts.map(|it| {
                        if kind == "and" { it.iter().all(|it| *it) } else { it.contains(&true) }
                    });
                }
                "X" => return at(inner, next(position)),
                "F" | "G" => {
                    let all: Option<Vec<bool>> =
                        later(position).into_iter().map(|it| at(inner, it)).collect();
                    return all.map(|it| {
                        if kind == "G" { it.iter().all(|it| *it) } else { it.contains(&true) }
                    });
                }
                "U" => {
                    for it in later(position) {
                        if at(&inner[1], it)? {
                            return Some(true);
                        }
                        if !at(&inner[0], it)? {
                            return Some(false);
                        }
                    }
                    return Some(false);
                }
                _ => {}
            }
        }
        self.holds(path).map(|it| it[run[position]])
    }
}
