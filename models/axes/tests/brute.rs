//! Random missions of two to five axes with constraints of every kind: the exact search agrees with
//! a look at every plan.

use cotama_axes::{
    Case, Infeasible, Kind, Lifted, Mission, Problem, Relation, Sense, Steps, Table,
};
use proptest::prelude::*;
use std::fmt::Write;

/// Numbers that a random mission is made of.
struct Draw<'d>(std::slice::Iter<'d, u16>);

impl Draw<'_> {
    fn below(&mut self, most: i64) -> i64 {
        i64::from(self.0.next().copied().unwrap_or(0)) % most
    }

    fn place(&mut self, count: usize) -> usize {
        usize::from(self.0.next().copied().unwrap_or(0)) % count
    }
}

fn options(text: &mut String, draw: &mut Draw<'_>, task: &str, count: i64, axes: i64) {
    for number in 0..count {
        let stand = draw.below(900);
        let _ = write!(
            text,
            "[[tio]]\nid = \"{task}{number}\"\ntask = \"{task}\"\nstand_ms = {stand}\n"
        );
        for axis in 0..axes {
            let [sum, time, each] = [40, 4, 30].map(|it| draw.below(it));
            let _ = writeln!(text, "sum{axis} = {sum}\ntime{axis} = {time}\neach{axis} = {each}");
        }
    }
}

fn mission(numbers: &[u16]) -> String {
    let draw = &mut Draw(numbers.iter());
    let axes = 2 + draw.below(4);
    let mut text =
        "format = \"cotama-axes/1\"\nname = \"random\"\npath_length_mm = 6000\n".to_owned();
    let wishes = (0..axes).map(|axis| {
        format!("[\"{}\", \"a{axis}.sum\"]", if draw.below(3) == 0 { "max" } else { "min" })
    });
    let _ = writeln!(text, "ask = [{}]", wishes.collect::<Vec<_>>().join(", "));
    text += "[robot]\nspeed_max_mm_s = 50\nspeed_step_mm_s = 10\n[motion_power]\nc0 = 0\nc1 = 0\n\
             c2 = 0\n[detection]\ndetect_by = \"zone\"\n";
    for (task, count) in [("MOV", 2 + draw.below(2)), ("LOC", 2), ("DET", 1 + draw.below(3))] {
        options(&mut text, draw, task, count, axes);
    }
    for (id, start, end, tasks) in [
        ("O1", 0, 4_000, "\"MOV\", \"LOC\""),
        ("O2", 4_000, 4_000, "\"DET\""),
        ("O3", 4_000, 6_000, "\"MOV\""),
    ] {
        let _ = write!(
            text,
            "[[objective]]\nid = \"{id}\"\nx_start_mm = {start}\nx_end_mm = {end}\n\
             tasks = [{tasks}]\n"
        );
    }
    let border = 1_000 + 1_000 * draw.below(5);
    let _ = write!(text, "[[zone]]\nid = \"Z\"\nx_start_mm = 0\nx_end_mm = {border}\n");
    for axis in 0..axes {
        let sum = format!("option(sum{axis}) + div_near(option(time{axis}) * duration_ms, 40000)");
        let _ = write!(
            text,
            "[[axis]]\nid = \"a{axis}\"\n[[axis.indicator]]\nid = \"sum\"\nunit = \"u\"\n\
             combine = \"sum\"\ntravel = \"{sum}\"\nstand = \"{sum}\"\n[[axis.indicator]]\n\
             id = \"each\"\nunit = \"u\"\ncombine = \"each\"\n\
             travel = \"option(each{axis}) + speed_mm_s\"\n"
        );
    }
    for number in 0..=draw.below(5) {
        let axis = draw.below(axes);
        let (kind, indicator) =
            [("core", "each"), ("end", "sum"), ("end", "sum"), ("running", "sum")][draw.place(4)];
        let op = ["<", "<=", "=", ">=", ">"][draw.place(if kind == "core" { 2 } else { 5 })];
        let near = |draw: &mut Draw<'_>| match kind {
            "core" => 40 + draw.below(60),
            "end" => 60 + draw.below(150),
            _ if op.starts_with('>') => draw.below(30),
            _ => 90 + draw.below(150),
        };
        let goal = near(draw);
        let _ = write!(
            text,
            "[[constraint]]\nid = \"c{number}\"\nindicator = \"a{axis}.{indicator}\"\n\
             kind = \"{kind}\"\nop = \"{op}\"\ngoal = {goal}\n"
        );
        if kind != "end" && draw.below(2) == 0 {
            let _ = writeln!(text, "at = [{{ zone = \"Z\", goal = {} }}]", near(draw));
        }
    }
    text
}

/// All plans of a table: the sums of each, and the constraints it breaks.
fn plans(mission: &Mission, table: &Table) -> Vec<(Vec<i64>, Lifted)> {
    let mut plans = vec![(vec![0; mission.indicators.len()], Lifted::default())];
    for activity in &table.activities {
        let mut longer = Vec::new();
        for (sums, broken) in &plans {
            for candidate in &activity.candidates {
                let mut sums: Vec<i64> = sums.clone();
                sums.iter_mut().enumerate().for_each(|(it, sum)| *sum += candidate.value(it));
                let mut broken = *broken;
                for (number, it) in mission.constraints.iter().enumerate() {
                    let goal = it.goal_in(&activity.zones);
                    if it.kind == Kind::Running && !it.relation.holds(sums[it.indicator], goal) {
                        broken = broken.with(number);
                    }
                }
                longer.push((sums, broken));
            }
        }
        plans = longer;
    }
    for (sums, broken) in &mut plans {
        for (number, it) in mission.constraints.iter().enumerate() {
            if it.kind == Kind::End && !it.relation.holds(sums[it.indicator], it.goal) {
                *broken = broken.with(number);
            }
        }
    }
    plans
}

/// The least sets of constraints to lift, and of those of one constraint the goals that suffice.
fn corrections(mission: &Mission) -> (Vec<Lifted>, Vec<[Option<i64>; 2]>) {
    let count = mission.constraints.len();
    let mut sets: Vec<Lifted> = (0..1_u32 << count)
        .map(|bits| {
            (0..count).filter(|it| bits >> it & 1 == 1).fold(Lifted::default(), Lifted::with)
        })
        .collect();
    sets.sort_by_key(|it| (it.iter().count(), it.iter().collect::<Vec<_>>()));
    let mut found: Vec<Lifted> = Vec::new();
    let mut needed = Vec::new();
    for set in sets.into_iter().skip(1) {
        let table = Table::new(mission, set, &mut Steps::default()).unwrap();
        let plans = plans(mission, &table);
        let good: Vec<_> = plans.iter().filter(|it| set.covers(it.1)).collect();
        if good.is_empty() || found.iter().any(|it| set.covers(*it)) {
            continue;
        }
        found.push(set);
        let mut alone = set.iter();
        if let (Some(number), None) = (alone.next(), alone.next()) {
            let it = &mission.constraints[number];
            let sums = || good.iter().map(|plan| plan.0[it.indicator]);
            needed.push(match (it.kind, it.relation) {
                (Kind::Core | Kind::Running, _) => [None; 2],
                (Kind::End, Relation::AtMost) => [None, sums().min()],
                (Kind::End, Relation::Below) => [None, sums().min().map(|it| it + 1)],
                (Kind::End, Relation::AtLeast) => [sums().max(), None],
                (Kind::End, Relation::Above) => [sums().max().map(|it| it - 1), None],
                (Kind::End, Relation::Equal) => [
                    sums().filter(|&sum| sum < it.goal).max(),
                    sums().filter(|&sum| sum > it.goal).min(),
                ],
            });
        }
    }
    (found, needed)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn search_and_every_plan_agree(numbers in proptest::collection::vec(any::<u16>(), 160)) {
        let case = Case::parse(&mission(&numbers)).unwrap();
        let mission = &case.mission;
        let steps = &mut Steps::default();
        let table = Table::new(mission, Lifted::default(), steps).unwrap();
        let problem = Problem::new(mission, &table, Lifted::default());
        let good: Vec<_> =
            plans(mission, &table).into_iter().filter(|it| it.1 == Lifted::default()).collect();
        prop_assert_eq!(problem.count(steps).unwrap(), Some(good.len() as u128));
        let rank = |sums: &[i64]| -> Vec<i64> {
            let sign = |sense| if sense == Sense::Min { 1 } else { -1 };
            case.ask.iter().map(|it| sign(it.sense) * sums[it.indicator]).collect()
        };
        let best = good.iter().map(|it| rank(&it.0)).min();
        let plan = problem.best(&case.ask, steps).unwrap();
        prop_assert_eq!(plan.map(|it| rank(&it.totals)), best.clone());
        // The front, of the first two axes and of all.
        for ask in [&case.ask[..2], &case.ask] {
            let mut ranks: Vec<_> =
                good.iter().map(|it| rank(&it.0)[..ask.len()].to_vec()).collect();
            ranks.sort();
            ranks.dedup();
            let below = |a: &[i64], b: &[i64]| a != b && a.iter().zip(b).all(|(a, b)| a <= b);
            let is_best = |it: &&Vec<i64>| !ranks.iter().any(|than| below(than, it));
            let front: Vec<_> = ranks.iter().filter(is_best).cloned().collect();
            let found = problem.front(ask, steps).unwrap();
            let found: Vec<_> =
                found.iter().map(|it| rank(&it.plan.totals)[..ask.len()].to_vec()).collect();
            prop_assert_eq!(found, front);
        }
        if best.is_none() {
            let found = Infeasible::of(mission, &table, steps).unwrap();
            let (sets, needed) = corrections(mission);
            prop_assert_eq!(&found.corrections, &sets);
            let own: Vec<_> = found.single.iter().map(|it| it.needed).collect();
            prop_assert_eq!(own, needed);
        }
    }
}
