//! The nets that are compared.

use cotama_models::nets::families::{FMS, KANBAN, PHILOSOPHERS, SWIMMING_POOL, TOKEN_RING};
use cotama_verification::pt::Pt;
use cotama_verification::tpn::TimeNet;
use cotama_verification::{pnml, tina};
use std::fmt::Write as _;

fn bytes(file: &str) -> Result<Vec<u8>, String> {
    std::fs::read(file).map_err(|error| format!("{file}: {error}"))
}

/// A name and a number, as in `kanban:5`.
fn member(name: &str) -> Option<(&str, u32)> {
    let (name, n) = name.split_once(':')?;
    Some((name, n.parse().ok()?))
}

/// A net of a family, as in `kanban:5`, or of a PNML file.
pub fn untimed(name: &str) -> Result<Pt, String> {
    let families = [&KANBAN, &FMS, &PHILOSOPHERS, &SWIMMING_POOL, &TOKEN_RING];
    let family = member(name)
        .and_then(|(name, n)| Some((families.into_iter().find(|it| it.name == name)?, n)));
    let net = match family {
        Some((family, n)) => family.net(n).map_err(|error| error.to_string())?,
        None => pnml::read(name, &bytes(name)?).map_err(|errors| errors.to_string())?,
    };
    Ok(Pt::from(&net.view().net()))
}

/// `crossing:3`, `line:6`, or the net of a `.net` file.
pub fn timed(name: &str) -> Result<TimeNet, String> {
    let text = match member(name) {
        Some(("crossing", trains)) => crossing(trains),
        Some(("line", machines)) => line(machines),
        _ => return tina::read(name, &bytes(name)?).map_err(|error| error.to_string()),
    };
    tina::read(name, text.as_bytes()).map_err(|error| error.to_string())
}

/// The level crossing of the state class papers (Leveson and Stolzy 1987), with two changes without
/// which libpetri could not express it or would not end: trains are counted by one place per
/// number, and each comes back within 5 to 9 instead of at any time.
fn crossing(trains: u32) -> String {
    let mut text = format!("net crossing_{trains}\n");
    for train in 1..=trains {
        let i = train;
        let _ = writeln!(text, "tr arrive_{i} [5,9] far_{i} -> here_{i}");
        let _ = writeln!(text, "tr first_in_{i} [0,0] here_{i} near_0 -> close_{i} near_1 coming");
        for near in 1..trains {
            let _ = writeln!(
                text,
                "tr in_{i}_{near} [0,0] here_{i} near_{near} -> close_{i} near_{}",
                near + 1
            );
        }
        let _ = writeln!(text, "tr enter_{i} [3,5] close_{i} -> on_{i}");
        let _ = writeln!(text, "tr pass_{i} [2,4] on_{i} -> left_{i}");
        let _ = writeln!(text, "tr last_out_{i} [0,0] left_{i} near_1 -> far_{i} near_0 leaving");
        for near in 2..=trains {
            let _ = writeln!(
                text,
                "tr out_{i}_{near} [0,0] left_{i} near_{near} -> far_{i} near_{}",
                near - 1
            );
        }
        let _ = writeln!(text, "pl far_{i} (1)");
    }
    text + "tr down_from_up [0,0] coming up -> lowering\n\
            tr down_from_raising [0,0] coming raising -> lowering\n\
            tr lower [1,2] lowering -> down\n\
            tr up_from_down [0,0] leaving down -> raising\n\
            tr raise [1,2] raising -> up\n\
            pl near_0 (1) pl up (1)\n"
}

/// Machines in a line, each working for 2 to 4, with room for one part between two of them.
fn line(machines: u32) -> String {
    let mut text = format!("net line_{machines}\n");
    for at in 1..=machines {
        let (take, give) = (
            if at == 1 { String::new() } else { format!("full_{}", at - 1) },
            if at == 1 { String::new() } else { format!("free_{}", at - 1) },
        );
        let (from, to) = if at == machines {
            (String::new(), String::new())
        } else {
            (format!("free_{at}"), format!("full_{at}"))
        };
        let _ = writeln!(text, "tr start_{at} [0,0] idle_{at} {take} -> working_{at} {give}");
        let _ = writeln!(text, "tr work_{at} [2,4] working_{at} -> done_{at}");
        let _ = writeln!(text, "tr pass_{at} [0,0] done_{at} {from} -> idle_{at} {to}");
        let _ = writeln!(text, "pl idle_{at} (1)");
        if at < machines {
            let _ = writeln!(text, "pl free_{at} (1)");
        }
    }
    text
}
