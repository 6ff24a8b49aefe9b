//! Groups against what each set of flags leaves open, one by one.

use cotama_models::fmeca::Analysis;
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::fmt::Write;

const FLAGS: u32 = 5;

fn names(bits: u32) -> String {
    let names = (0..FLAGS).filter(|bit| bits & (1 << bit) != 0).map(|bit| format!("f{bit}"));
    names.collect::<Vec<_>>().join(";")
}

proptest! {
    /// A group is a largest set of candidates of some raised flags, and each of these is a group.
    #[test]
    fn groups_are_the_largest_ambiguous_diagnoses(
        rows in prop::collection::vec((0_u32..1 << FLAGS, 0_u32..1 << FLAGS), 1..10),
    ) {
        let heading = "id,function,component,failure,cause,effect,severity,mtbf_h,latency_ms";
        let mut text = format!("{heading},flags,sometimes\n");
        for (at, (always, sometimes)) in rows.iter().enumerate() {
            let (always, sometimes) = (names(*always), names(sometimes & !always));
            writeln!(text, "M{at},f,c,x,y,z,weak,100,5,{always},{sometimes}").unwrap();
        }
        let read = Analysis::parse_csv("random.csv", &text).unwrap();
        let told = read.diagnose(&read.sound());
        prop_assert!(told.groups.complete);
        let candidates = (1..1 << FLAGS).map(|raised: u32| {
            let explains = |(always, sometimes): (u32, u32)| {
                always != 0 && always & !raised == 0 && raised & !(always | sometimes) == 0
            };
            (0..rows.len()).filter(|&at| explains(rows[at])).collect::<BTreeSet<_>>()
        });
        let open: BTreeSet<_> = candidates.filter(|it| it.len() > 1).collect();
        let is_largest =
            |it: &&BTreeSet<usize>| !open.iter().any(|o| o != *it && o.is_superset(it));
        let largest: Vec<Vec<usize>> =
            open.iter().filter(is_largest).map(|it| it.iter().copied().collect()).collect();
        prop_assert_eq!(told.groups.list, largest);
    }
}
