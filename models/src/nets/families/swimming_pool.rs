use super::{Draft, Family, OutOfRange};
use cotama_core::net::owned::{OwnedLaw, OwnedNet};

/// The swimming pool: 9 places, 7 transitions.
pub const SWIMMING_POOL: Family = Family {
    name: "swimming_pool",
    description: "A swimming pool of 20n guests who share 10n cabins and 15n baskets.",
    least: 1,
    most: 3_276,
    grow,
};

/// The swimming pool of the Model Checking Contest: `20n` guests need one of `10n` cabins to change
/// their clothes in, and leave them in one of `15n` baskets while they bathe. The cabin is given
/// back in between, so nobody waits for ever.
///
/// # Errors
/// When `n` is not from 1 to 3,276.
///
/// ```
/// use cotama_models::nets::families::swimming_pool;
/// let net = swimming_pool(1).unwrap();
/// assert_eq!((net.places.len(), net.transitions.len()), (9, 7));
/// ```
pub fn swimming_pool(n: u32) -> Result<OwnedNet, OutOfRange> {
    SWIMMING_POOL.net(n)
}

fn grow(net: &mut Draft, n: u32) {
    let (guests, all_cabins, all_baskets) = (20 * n, 10 * n, 15 * n);
    let (cabins, baskets) = (
        net.place("cabins", all_cabins, all_cabins),
        net.place("baskets", all_baskets, all_baskets),
    );
    let entrance = net.place("entrance", guests, guests);
    let leaving = net.place("leaving", 0, guests);
    let bathing = net.place("bathing", 0, all_baskets);
    let [waiting, undressing, dressing, finished] =
        ["waiting", "undressing", "dressing", "finished"]
            .map(|name| net.place(name, 0, all_cabins));

    net.transition("take_cabin", &[entrance, cabins], &[waiting]);
    net.transition("take_basket", &[waiting, baskets], &[undressing]);
    net.transition("leave_cabin", &[undressing], &[bathing, cabins]);
    net.transition("take_cabin_again", &[bathing, cabins], &[dressing]);
    net.transition("return_basket", &[dressing], &[finished, baskets]);
    net.transition("return_cabin", &[finished], &[leaving, cabins]);
    net.transition("come_back", &[leaving], &[entrance]);

    net.invariant(&[entrance, waiting, undressing, bathing, dressing, finished, leaving], guests);
    net.invariant(&[cabins, waiting, undressing, dressing, finished], all_cabins);
    net.invariant(&[baskets, undressing, bathing, dressing], all_baskets);
    net.law(OwnedLaw::AlwaysCan(leaving));
    net.law(OwnedLaw::DeadlockFree { end: None });
}
