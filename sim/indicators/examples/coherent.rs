//! Prints means, variances and the most coherent pairs of indicators on both floors, over two
//! drives of ten minutes.

use cotama_indicators::{COLUMNS, Options, PLAZA, SIDEWALK, drive_on, to_csv};
use cotama_risk::{
    Cells, Constraints, Counts, Data, Families, Limits, Rule, Score, coherence, discretise, exact,
};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    for (world, people) in [(SIDEWALK, 6), (PLAZA, 24)] {
        let floor = world.floor().map_err(|it| it.to_string())?;
        let mut all = vec![];
        for seed in 0..2 {
            all.extend(drive_on(&floor, &Options { seed, people, seconds: 600 })?);
        }
        println!("{}, {} samples", world.name, all.len());
        for (at, name) in COLUMNS.iter().enumerate() {
            let count = f64::from(u32::try_from(all.len())?);
            let mean = all.iter().map(|it| it.0[at]).sum::<f64>() / count;
            let square = |it: f64| (it - mean) * (it - mean);
            let variance = all.iter().map(|it| square(it.0[at])).sum::<f64>() / count;
            println!("  {name}: mean {mean:.4}, variance {variance:.5}");
        }
        let of = |it: cotama_risk::Wrong| it.message;
        let cells = Cells::parse(&to_csv(&all)).map_err(of)?;
        let (steps, _) = discretise(&cells, &Rule::Frequency { bins: 3 }).map_err(of)?;
        let data = Data::from_csv(&steps.to_csv()).map_err(of)?;
        let mut families = Families::new(&data, Score::Bic);
        let none = Constraints::none(COLUMNS.len()).map_err(of)?;
        let Ok(best) = exact(&mut families, &none, Limits::default()) else { continue };
        let counts = Counts::new(&data, &best.dag, None).map_err(of)?;
        let network = counts.network("indicators", 1.0).map_err(of)?;
        let mut pairs = coherence(&network).map_err(|it| it.to_string())?;
        pairs.sort_by(|a, b| b.eta.total_cmp(&a.eta));
        for it in pairs.iter().take(20) {
            println!("  {:.4} {} - {}", it.eta, COLUMNS[it.x], COLUMNS[it.y]);
        }
    }
    Ok(())
}
