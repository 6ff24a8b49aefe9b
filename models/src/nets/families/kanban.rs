use super::{Draft, Family, OutOfRange};
use cotama_core::net::owned::{OwnedLaw, OwnedNet};

/// A Kanban manufacturing system: 16 places, 16 transitions.
pub const KANBAN: Family = Family {
    name: "kanban",
    description: "A Kanban manufacturing system of four cells with n cards each.",
    least: 1,
    most: 65_535,
    grow,
};

/// The Kanban system (G. Ciardo and M. Tilgner, "On the use of Kronecker operators for the solution
/// of generalized stochastic Petri nets", ICASE report 96-35, 1996): four cells with `n` cards
/// each. A part enters cell 4, is split to cells 2 and 3, assembled in cell 1 and leaves. In each
/// cell it is machined, and redone when it is not good.
///
/// # Errors
/// When `n` is not from 1 to 65,535.
///
/// ```
/// use cotama_models::nets::families::kanban;
/// let net = kanban(5).unwrap();
/// assert_eq!((net.places.len(), net.transitions.len()), (16, 16));
/// ```
pub fn kanban(n: u32) -> Result<OwnedNet, OutOfRange> {
    KANBAN.net(n)
}

fn grow(net: &mut Draft, n: u32) {
    let [(p1, m1, out1), (p2, m2, out2), (p3, m3, out3), (p4, m4, out4)] =
        [1, 2, 3, 4].map(|cell| {
            let [cards, machined, back, out] = [("P", n), ("Pm", 0), ("Pback", 0), ("Pout", 0)]
                .map(|(name, tokens)| net.place(&format!("{name}{cell}"), tokens, n));
            net.transition(&format!("tredo{cell}"), &[machined], &[back]);
            net.transition(&format!("tback{cell}"), &[back], &[machined]);
            net.transition(&format!("tok{cell}"), &[machined], &[out]);
            net.invariant(&[cards, machined, back, out], n);
            net.law(OwnedLaw::AlwaysCan(back));
            (cards, machined, out)
        });
    net.transition("tin4", &[p4], &[m4]);
    net.transition("tsynch4_23", &[out4, p2, p3], &[p4, m2, m3]);
    net.transition("tsynch1_23", &[out2, out3, p1], &[p2, p3, m1]);
    net.transition("tout1", &[out1], &[p1]);
    net.law(OwnedLaw::DeadlockFree { end: None });
}
