//! The requirements of the shipped decisional level, as questions to its net of rounds.

use cotama_core::system::System;
use cotama_models::cotama::{REQUIREMENTS, Watch, delivery};
use cotama_verification::certificate::{Evidence, verify};
use cotama_verification::check::{Checker, Model, Options, Verdict};
use cotama_verification::explicit::{Graph, Limits};
use cotama_verification::flat::{Looks, Rounds, Size, rounds};
use cotama_verification::property;
use cotama_verification::pt::Pt;

/// The rounds of a system, with what it takes to remember.
pub(crate) fn watched<'w>(system: &System<'_>, watches: impl Iterator<Item = &'w Watch>) -> Rounds {
    let mut rounds = rounds(system).unwrap();
    for it in watches {
        let looks = if it.at_end { Looks::AtEnd } else { Looks::BeforeOutside };
        rounds.watch(it.name, looks, (it.begins, it.ends), it.most).unwrap();
    }
    rounds
}

#[test]
fn scratch() {
    let t = std::time::Instant::now();
    let all = REQUIREMENTS.iter().filter_map(|it| it.asked.as_ref()).flat_map(|it| it.watches);
    let rounds = watched(&delivery::SYSTEM, all);
    let pt = Pt::from(&rounds.net().unwrap().view().net());
    let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
    println!("{} {} {} {:?} {:?}", pt.places.len(), pt.transitions.len(), graph.states(), rounds.size(&graph), t.elapsed());
    for it in REQUIREMENTS {
        for s in it.said { println!("{} unsaid {:?}", it.id, s.unsaid(&delivery::SYSTEM).collect::<Vec<_>>()); }
        let Some(asked) = it.asked else { continue };
        let t = std::time::Instant::now();
        let rounds = watched(&delivery::SYSTEM, asked.watches.iter());
        let model = Model::from(&rounds.net().unwrap().view().net());
        let property = match property::parse(asked.text, model.pt()) { Ok(p) => p, Err(e) => { println!("{} {e}", it.id); continue } };
        let answer = Checker::new(&model).answer(&property, &Options { evidence: true, ..Options::default() });
        let e = t.elapsed();
        println!("{} {:?} {} {} {} {e:?}", it.id, answer.verdict, answer.engine(), answer.states, model.pt().transitions.len());
        if answer.verdict == Verdict::Holds(false) && let Some(run) = &answer.run {
            for r in rounds.told(&run.stem) { println!("    {:?} {:?}", r.turns, r.outside); }
        }
    }
}
