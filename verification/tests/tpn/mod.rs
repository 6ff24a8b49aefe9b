//! Time Petri nets: their files, their classes, their response times, their runs.
//!
//! Known answers are taken from the folder that `COTAMA_TPN_DIR` names: `*.net`, `facts.tsv`,
//! `bounds.tsv`.

mod broken;
mod conversion;
pub(crate) mod discrete;
mod facts;
mod growth;
mod random;
mod reading;
pub(crate) mod regions;
pub(crate) mod replay;
mod response;
mod schedules;
mod textbook;
mod watchdog;

use cotama_verification::tina;
use cotama_verification::tpn::{self, Limits, Response, Time, TimeNet};
use std::path::PathBuf;

/// The folder of known nets; `None`, said loudly, without it.
fn folder(what: &str) -> Option<PathBuf> {
    cotama_golden::public_folder("COTAMA_TPN_DIR", what)
}

/// A net of text that is right.
fn net(text: &str) -> TimeNet {
    tina::read("test.net", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

/// `min..max`, `never fires` or why not.
fn bound(net: &TimeNet, from: &str, to: &str) -> String {
    let (from, to) = (net.transition(from).unwrap(), net.place(to).unwrap());
    shown(tpn::bound(net, from, to, &Limits::default()))
}

fn shown(response: Response) -> String {
    match response {
        Response::NeverFires => "never fires".to_owned(),
        Response::Between { min, max } => format!("{min}..{max}"),
        Response::Unknown { limit, explored } => format!("unknown after {explored}: {limit:?}"),
    }
}

fn finite(time: u64) -> Time {
    Time::Finite(time)
}
