//! Tables made of a system while compiling: what its transitions say, and names. A system as plain
//! data holds its documentation too, which no chip needs.

use crate::error::cotama_error;
use cotama_core::system::System;

/// The outputs of each transition of a system: bit `n` is output `n` of its net.
#[derive(Clone, Copy, Debug)]
pub struct Says<'t> {
    /// Start of the transitions of each net.
    pub firsts: &'t [u16],
    /// The outputs of each transition, net by net.
    pub outputs: &'t [u64],
}

impl Says<'_> {
    /// Returns the outputs of a transition; 0 for one that does not exist.
    pub(crate) fn of(self, net: u16, transition: u32) -> u64 {
        let first = self.firsts.get(usize::from(net)).map(|it| usize::from(*it));
        let at = first.and_then(|it| it.checked_add(transition as usize));
        at.and_then(|it| self.outputs.get(it)).copied().unwrap_or(0)
    }
}

/// The names of something in each net of a system.
#[derive(Clone, Copy, Debug)]
pub struct NamesOf<'t> {
    /// The names of the nets.
    pub nets: &'t [&'t str],
    /// Start of the names of each net, and the end of the last.
    pub firsts: &'t [u16],
    /// The names, net by net.
    pub names: &'t [&'t str],
}

impl<'t> NamesOf<'t> {
    /// The name of a net, and of what has this number in it.
    pub(crate) fn of(self, net: u32, number: u32) -> Result<(&'t str, &'t str), cotama_error> {
        let net = net as usize;
        let find = || {
            let first = usize::from(*self.firsts.get(net)?);
            let end = usize::from(*self.firsts.get(net.checked_add(1)?)?);
            let own = self.names.get(first..end)?;
            Some((*self.nets.get(net)?, *own.get(number as usize)?))
        };
        find().ok_or(cotama_error::BadNumber)
    }
}

/// How many transitions there are in the first so many nets.
pub const fn transitions(system: &System<'_>, nets: usize) -> usize {
    let (mut sum, mut at) = (0, 0);
    while at < nets {
        sum += system.components[at].net.transitions.len();
        at += 1;
    }
    sum
}

/// Returns the start of the transitions of each net, and the end of the last; `N` is one more than
/// nets.
pub const fn first_transitions<const N: usize>(system: &System<'_>) -> [u16; N] {
    let (mut firsts, mut at) = ([0; N], 0);
    while at < N {
        firsts[at] = transitions(system, at) as u16;
        at += 1;
    }
    firsts
}

/// Returns the outputs of each of all `T` transitions.
///
/// # Panics
/// When a net has more than 64 outputs: an error while compiling.
pub const fn outputs<const T: usize>(system: &System<'_>) -> [u64; T] {
    let (mut says, mut at, mut net) = ([0; T], 0, 0);
    while net < system.components.len() {
        let (own, mut number) = (system.components[net].net, 0);
        assert!(own.outputs.len() <= 64, "a net has more outputs than a firing has bits");
        while number < own.transitions.len() {
            let (emits, mut output) = (own.transitions[number].emits, 0);
            while output < emits.len() {
                says[at] |= 1 << emits[output].0;
                output += 1;
            }
            (at, number) = (at + 1, number + 1);
        }
        net += 1;
    }
    says
}

/// The names of the `N` nets.
pub const fn net_names<'n, const N: usize>(system: &System<'n>) -> [&'n str; N] {
    let (mut names, mut at) = ([""; N], 0);
    while at < N {
        names[at] = system.components[at].name;
        at += 1;
    }
    names
}

/// The names of all `T` transitions.
pub const fn transition_names<'n, const T: usize>(system: &System<'n>) -> [&'n str; T] {
    let (mut names, mut at, mut net) = ([""; T], 0, 0);
    while net < system.components.len() {
        let (own, mut number) = (system.components[net].net, 0);
        while number < own.transitions.len() {
            names[at] = own.transitions[number].name;
            (at, number) = (at + 1, number + 1);
        }
        net += 1;
    }
    names
}

/// Tables of a system, as `static` items: `SAYS` and `TRANSITIONS`.
#[macro_export]
macro_rules! tables {
    ($system:expr) => {
        /// The system that the tables are made of.
        const TABLES_OF: ::cotama_core::system::System<'static> = $system;
        /// How many nets it has.
        const NETS: usize = TABLES_OF.components.len();
        /// The outputs of its transitions.
        static SAYS: $crate::tables::Says<'static> = $crate::tables::Says {
            firsts: &$crate::tables::first_transitions::<{ NETS + 1 }>(&TABLES_OF),
            outputs: &$crate::tables::outputs::<{ $crate::tables::transitions(&TABLES_OF, NETS) }>(
                &TABLES_OF,
            ),
        };
        /// The names of its transitions.
        static TRANSITIONS: $crate::tables::NamesOf<'static> = $crate::tables::NamesOf {
            nets: &$crate::tables::net_names::<NETS>(&TABLES_OF),
            firsts: &$crate::tables::first_transitions::<{ NETS + 1 }>(&TABLES_OF),
            names: &$crate::tables::transition_names::<
                { $crate::tables::transitions(&TABLES_OF, NETS) },
            >(&TABLES_OF),
        };
    };
}
