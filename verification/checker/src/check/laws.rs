//! The laws of a net as questions.

use cotama_core::net::{Law, Net, PlaceId};
use cotama_property::pt::Pt;
use cotama_property::{Atom, Formula, Linear, Property, Question};

/// The laws of a net that are about reachable markings, as properties named by their text. Those
/// about events and priorities (`handles(all)`, `settles`, `deterministic`) are not among them:
/// they are checked while compiling, or by rounds.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::check::laws;
/// let laws = laws(&door::NET);
/// assert_eq!(laws[0].name, "AG Closed + Opening + Open + Closing + Blocked = 1");
/// ```
pub fn laws(net: &Net<'_>) -> Vec<Property> {
    let pt = Pt::from(net);
    let property = |law: &Law<'_>| {
        let question = question(law)?;
        let name = question.display(&pt).to_string();
        Some(Property { name, question })
    };
    net.laws.iter().filter_map(property).collect()
}

/// Returns the question of a law; `None` for those that are not about reachable markings.
pub fn question(law: &Law<'_>) -> Option<Question> {
    let formula = match *law {
        Law::Invariant { sum, equals } => {
            let mut weights: Vec<_> =
                sum.iter().map(|it| (it.place, i64::from(it.weight))).collect();
            weights.retain(|it| it.1 != 0);
            weights.sort_unstable();
            weights.dedup_by(|later, kept| {
                let same = later.0 == kept.0;
                kept.1 += if same { later.1 } else { 0 };
                same
            });
            let negative = weights.iter().map(|&(place, weight)| (place, -weight)).collect();
            let at_most = Linear { constant: -i64::from(equals), weights };
            let at_least = Linear { constant: i64::from(equals), weights: negative };
            always(Formula::And(
                [at_most, at_least].map(|it| Formula::Atom(Atom::AtMost(it))).into(),
            ))
        }
        Law::NeverBoth(a, b) => {
            always(Formula::Not(Formula::And(vec![marked(a), marked(b)]).into()))
        }
        Law::Reachable(place) => possible(marked(place)),
        Law::AlwaysCan(place) => always(possible(marked(place))),
        Law::DeadlockFree { end } => {
            let mut allowed = vec![Formula::Not(Formula::Atom(Atom::Deadlock).into())];
            allowed.extend(end.map(marked));
            always(if allowed.len() == 1 { allowed.swap_remove(0) } else { Formula::Or(allowed) })
        }
        Law::HandlesAll | Law::Settles | Law::Deterministic => return None,
    };
    Some(Question::Formula(formula))
}

fn marked(place: PlaceId) -> Formula {
    Formula::Atom(Atom::AtMost(Linear::marked(place)))
}

fn always(formula: Formula) -> Formula {
    Formula::All(Formula::Globally(formula.into()).into())
}

fn possible(formula: Formula) -> Formula {
    Formula::Exists(Formula::Finally(formula.into()).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_models::nets::door;

    #[test]
    fn laws_read_as_formulas() {
        let asked: Vec<String> = laws(&door::NET).into_iter().map(|it| it.name).collect();
        let written = [
            "AG Closed + Opening + Open + Closing + Blocked = 1",
            "AG !(Closing & obstacle)",
            "AG !deadlock",
            "AG EF Closed",
            "AG EF Open",
            "AG EF Blocked",
        ];
        assert_eq!(asked, written);
    }
}
