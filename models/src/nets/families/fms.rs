use super::{Draft, Family, OutOfRange};
use cotama_core::net::owned::{OwnedLaw, OwnedNet};

/// A flexible manufacturing system: 22 places, 20 transitions.
pub const FMS: Family = Family {
    name: "fms",
    description: "A flexible manufacturing system with three machines and n parts of each of three \
                  kinds.",
    least: 1,
    most: 65_535,
    grow,
};

/// The flexible manufacturing system (G. Ciardo and K. S. Trivedi, "A decomposition approach for
/// stochastic reward net models", Performance Evaluation 18, 1993), as in the Model Checking
/// Contest: `n` parts of each of three kinds. Machine M1 works on kind 1, M2 on kind 2 (and on kind
/// 3 when it is free), and M3 on pairs of kinds 1 and 2 that were joined.
///
/// # Errors
/// When `n` is not from 1 to 65,535.
///
/// ```
/// use cotama_models::nets::families::fms;
/// let net = fms(2).unwrap();
/// assert_eq!((net.places.len(), net.transitions.len()), (22, 20));
/// ```
pub fn fms(n: u32) -> Result<OwnedNet, OutOfRange> {
    FMS.net(n)
}

fn grow(net: &mut Draft, n: u32) {
    let [m1, m2, m3] = [("M1", 3), ("M2", 1), ("M3", 2)]
        .map(|(name, machines)| net.place(name, machines, machines));
    let mut parts = |name, tokens| net.place(name, tokens, n);
    let (p1, p2, p3) = (parts("P1", n), parts("P2", n), parts("P3", n));
    let [wait1, done1, ship1, join1] = ["P1wM1", "P1d", "P1s", "P1wP2"].map(|name| parts(name, 0));
    let [wait2, done2, ship2, join2] = ["P2wM2", "P2d", "P2s", "P2wP1"].map(|name| parts(name, 0));
    let [at3, ship3] = ["P3M2", "P3s"].map(|name| parts(name, 0));
    let [pair, wait12, ship12] = ["P12", "P12wM3", "P12s"].map(|name| parts(name, 0));
    let [at1, at2, at12] = [("P1M1", 3), ("P2M2", 1), ("P12M3", 2)]
        .map(|(name, machines)| net.place(name, 0, machines.min(n)));

    for (name, from, to) in [
        ("tP1", &[p1][..], &[wait1][..]),
        ("tM1", &[wait1, m1], &[at1]),
        ("tP1M1", &[at1], &[m1, done1]),
        ("tP1e", &[done1], &[ship1]),
        ("tP1j", &[done1], &[join1]),
        ("tP1s", &[ship1], &[p1]),
        ("tP2", &[p2], &[wait2]),
        ("tM2", &[wait2, m2], &[at2]),
        ("tP2M2", &[at2], &[m2, done2]),
        ("tP2e", &[done2], &[ship2]),
        ("tP2j", &[done2], &[join2]),
        ("tP2s", &[ship2], &[p2]),
        ("tP3", &[p3], &[at3]),
        ("tP3M2", &[at3, m2], &[ship3, m2]),
        ("tP3s", &[ship3], &[p3]),
        ("tx", &[join1, join2], &[pair]),
        ("tP12", &[pair], &[wait12]),
        ("tM3", &[wait12, m3], &[at12]),
        ("tP12M3", &[at12], &[m3, ship12]),
        ("tP12s", &[ship12], &[p1, p2]),
    ] {
        net.transition(name, from, to);
    }
    net.invariant(&[m1, at1], 3);
    net.invariant(&[m2, at2], 1);
    net.invariant(&[m3, at12], 2);
    net.invariant(&[p1, wait1, at1, done1, ship1, join1, pair, wait12, at12, ship12], n);
    net.invariant(&[p2, wait2, at2, done2, ship2, join2, pair, wait12, at12, ship12], n);
    net.invariant(&[p3, at3, ship3], n);
    for place in [ship1, ship2, ship3, ship12] {
        net.law(OwnedLaw::AlwaysCan(place));
    }
    net.law(OwnedLaw::DeadlockFree { end: None });
}
