//! Counts in how many of 40 trainings a quantile chooses another way than the exact mean, where the
//! discs are told.

use cotama_risk::{ChoiceRule, Measure, Wrong};
use cotama_ways::{ObjectSpeed, Ratio, World, train};

fn main() -> Result<(), Wrong> {
    println!("speed  ratio  0.5: thesis, total  0.75: thesis, total");
    for speed in ObjectSpeed::ALL {
        let mut counts = [[0; 4]; 5];
        for seed in 100..140 {
            let (learned, _) = train(&mut World::new(seed, speed))?;
            let model = learned.model()?;
            for (ratio, counts) in Ratio::ALL.iter().zip(&mut counts) {
                let belief = Ratio::ALL.map(|it| f64::from(u8::from(it == *ratio)));
                let way = |measure, rule| model.estimate(&belief, 3, measure, rule).way;
                let best = way(Measure::Mean, ChoiceRule::Exact);
                let (half, high) = (Measure::Quantile(0.5), Measure::Quantile(0.75));
                let (thesis, total) = (ChoiceRule::Thesis, ChoiceRule::Total);
                let ways = [(half, thesis), (half, total), (high, thesis), (high, total)];
                for (count, (measure, rule)) in counts.iter_mut().zip(ways) {
                    *count += u32::from(way(measure, rule) != best);
                }
            }
        }
        for (ratio, [half, of_half, high, of_high]) in Ratio::ALL.iter().zip(counts) {
            println!("{} {} {half}, {of_half} {high}, {of_high}", speed.name(), ratio.name());
        }
    }
    Ok(())
}
