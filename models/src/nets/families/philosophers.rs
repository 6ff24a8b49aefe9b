use super::{Draft, Family, OutOfRange};
use cotama_core::net::owned::{OwnedLaw, OwnedNet};

/// The dining philosophers: `5n` places, `5n` transitions, `3^n` markings, two of which are dead.
pub const PHILOSOPHERS: Family = Family {
    name: "philosophers",
    description: "Dining philosophers, who take one fork after the other, in either order, and may \
                  starve together.",
    least: 2,
    most: 10_000,
    grow,
};

/// The dining philosophers (E. W. Dijkstra 1965), as in the Model Checking Contest: `n` think, each
/// takes the left or the right fork first, then the other one, eats, and puts both back. All with a
/// left fork, or all with a right one, starve.
///
/// # Errors
/// When `n` is not from 2 to 10,000.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// let net = philosophers(3).unwrap();
/// assert_eq!((net.places.len(), net.transitions.len()), (15, 15));
/// assert!(philosophers(1).is_err()); // nobody dines alone
/// ```
pub fn philosophers(n: u32) -> Result<OwnedNet, OutOfRange> {
    PHILOSOPHERS.net(n)
}

fn grow(net: &mut Draft, n: u32) {
    let mut row = |name: &str, tokens| -> Vec<_> {
        (1..=n).map(|it| net.place(&format!("{name}_{it}"), tokens, 1)).collect()
    };
    let (think, fork) = (row("think", 1), row("fork", 1));
    let (with_left, with_right, eat) = (row("with_left", 0), row("with_right", 0), row("eat", 0));
    let around = |it: usize, by: usize| (it + by) % n as usize;
    for it in 0..n as usize {
        let (left, right, number) = (fork[around(it, n as usize - 1)], fork[it], it + 1);
        net.transition(&format!("left_first_{number}"), &[think[it], left], &[with_left[it]]);
        net.transition(&format!("right_first_{number}"), &[think[it], right], &[with_right[it]]);
        net.transition(&format!("then_right_{number}"), &[with_left[it], right], &[eat[it]]);
        net.transition(&format!("then_left_{number}"), &[with_right[it], left], &[eat[it]]);
        net.transition(&format!("end_{number}"), &[eat[it]], &[think[it], left, right]);
    }
    for it in 0..n as usize {
        let next = around(it, 1);
        net.invariant(&[think[it], with_left[it], with_right[it], eat[it]], 1);
        net.invariant(&[fork[it], with_right[it], eat[it], with_left[next], eat[next]], 1);
        net.law(OwnedLaw::NeverBoth(eat[it], eat[next]));
        net.law(OwnedLaw::Reachable(eat[it]));
    }
}
