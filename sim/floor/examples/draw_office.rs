//! Draws the office that ships, with a way from the docking station: `cargo run -p cotama-floor
//! --example draw_office -- "office C" > office.svg`.

use cotama_floor::{Needs, Planner, Version, embedded, metres, picture};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let office = embedded::OFFICE.floor()?;
    let surface = office.surface(Version::Charted, &[])?;
    let planner = Planner::new(&surface, Needs::default())?;
    let to = std::env::args().nth(1).unwrap_or_else(|| "office C".into());
    let place = |name: &str| office.place(name).map(|it| metres(it.at)).ok_or("no such place");
    let path = planner.route(place("dock")?, place(&to)?)?;
    eprintln!("{} mm from dock to {to}", path.length_mm());
    print!("{}", picture::floor(&office, Some(&path)));
    Ok(())
}
