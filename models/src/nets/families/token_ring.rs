use super::{Draft, Family, OutOfRange};
use cotama_core::net::owned::{OwnedLaw, OwnedNet};

/// Dijkstra's self-stabilising ring: `(n + 1)^2` places, `n + 1 + n^2 (n + 1)` transitions.
pub const TOKEN_RING: Family = Family {
    name: "token_ring",
    description: "Dijkstra's self-stabilising token ring of n + 1 processes with n + 1 values \
                  each.",
    least: 1,
    most: 50,
    grow,
};

/// The self-stabilising ring (E. W. Dijkstra, "Self-stabilizing systems in spite of distributed
/// control", CACM 17(11), 1974), as in the Model Checking Contest: `n + 1` processes hold a value
/// from 0 to `n` each, at the start as many different ones as there are. The first process counts
/// up when it has the value of the last one; every other takes the value of the one before it over
/// when it differs. From any start, a single process can move in the end.
///
/// # Errors
/// When `n` is not from 1 to 50.
///
/// ```
/// use cotama_models::nets::families::token_ring;
/// let net = token_ring(5).unwrap();
/// assert_eq!((net.places.len(), net.transitions.len()), (36, 156));
/// ```
pub fn token_ring(n: u32) -> Result<OwnedNet, OutOfRange> {
    TOKEN_RING.net(n)
}

fn grow(net: &mut Draft, n: u32) {
    let last = n as usize;
    let ring: Vec<Vec<_>> = (0..=n)
        .map(|process| {
            let holds =
                |value| (format!("process_{process}_has_{value}"), u32::from(value == process));
            (0..=n).map(holds).map(|(name, tokens)| net.place(&name, tokens, 1)).collect()
        })
        .collect();
    for value in 0..=last {
        let next = (value + 1) % (last + 1);
        let (from, to) = ([ring[0][value], ring[last][value]], [ring[0][next], ring[last][value]]);
        net.transition(&format!("process_0_counts_{value}"), &from, &to);
    }
    for process in 1..=last {
        for (old, new) in (0..=last).flat_map(|old| (0..=last).map(move |new| (old, new))) {
            if old != new {
                let before = ring[process - 1][new];
                let name = format!("process_{process}_from_{old}_to_{new}");
                net.transition(&name, &[ring[process][old], before], &[ring[process][new], before]);
            }
        }
    }
    for process in &ring {
        net.invariant(process, 1);
    }
    net.law(OwnedLaw::DeadlockFree { end: None });
    net.law(OwnedLaw::AlwaysCan(ring[0][0]));
}
