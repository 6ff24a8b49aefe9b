//! The lists of a packed system, declared once: borrowed, of lengths known when compiling, or on
//! the heap.

/// Hands the table of all lists to a macro: documentation, name, item, the parameter of the length,
/// and an item that says nothing.
macro_rules! each_list {
    ($make:ident) => { $make! {
    /// Transitions by row: those of an event, by the state that they need where rows have states,
    /// then by priority and number.
    entries: Listed [T] = Listed { need: 0, delta: 0, transition: 0, clock: NONE },
    /// Tokens that must be there for a transition to fire: those of each entry at its own position
    /// where a marking is a single word, otherwise most of them once.
    needs: [u64; W] [Y] = [0; W],
    /// Words added to a marking, modulo 2^64 each, in the same way.
    deltas: [u64; W] [Z] = [0; W],
    /// The tokens that each transition removes, by its number; empty if there are no clocks.
    takes: [u64; W] [K] = [0; W],
    /// The bounds of each row in `entries`: two numbers, at `2 * (kind * states + state)`; a row
    /// without any begins at [`NONE`]. The kinds: events, then for each component what fires at
    /// once by itself, then all that fires by itself in an interval.
    rows: u16 [R] = 0,
    /// The destinations of the outputs of all transitions.
    routes: Route [O] = Route { event: 0, mailbox: NONE },
    /// The position in `routes` at which those of each transition begin, by its number, and at the
    /// end how many there are; empty if there are no routes.
    says: u16 [D] = 0,
    /// Mailboxes, by component and then by event.
    mailboxes: Mailbox [B] = Mailbox {
        event: 0, waiting: Field::NOWHERE, room: None, slot: 0, capacity: 0,
    },
    /// For each component where its mailboxes begin, and at the end how many there are.
    turns: u16 [N] = 0,
    /// For each component the number of its first event, and at the end how many there are.
    events: u16 [N] = 0,
    /// For each component the number of its first transition, and at the end how many there are.
    transitions: u16 [N] = 0,
    /// For each component the number of its first place, and at the end how many there are.
    places: u16 [N] = 0,
    /// The field of each place.
    fields: Field [P] = Field::NOWHERE,
    /// Complements that no net has, and the system needs: the number of the place, and where its
    /// complement lies.
    complements: (u16, Field) [X] = (0, Field::NOWHERE),
    /// Transitions with an interval.
    clocks: Clock<W> [C] = Clock { need: [0; W], entry: 0, event: false, earliest: 0, latest: 0 },
    /// Pairs of an event and the position of a mailbox that it empties.
    clears: (u16, u16) [E] = (0, 0),
    /// Pairs of an event and a place that ignores it on purpose, those without a guard.
    ignored: (u16, u16) [G] = (0, 0),
    /// The same for pairs with a guard: an event and the tokens that must be there.
    ignored_where: (u16, [u64; W]) [I] = (0, [0; W]),
    /// The invariants of every reachable marking: complements, then laws by component.
    kept: Kept [L] = Kept::NOTHING,
    /// The numbers of the places of `kept`, with their weights.
    summands: (u16, u32) [M] = (0, 0),
    } };
}

/// Makes `Code`, `Lists` and, with the feature `alloc`, `Lengths` of the lists.
macro_rules! borrowed {
    ($(
        $(#[doc = $doc:literal])*
        $list:ident : $item:ty [$length:ident] = $nothing:expr,
    )*) => {
        /// A system packed for execution. Lists are borrowed: from flash, or from the heap.
        #[derive(Clone, Copy, Debug)]
        pub struct Code<'c, const W: usize> {
            $( $(#[doc = $doc])* pub $list: &'c [$item], )*
            /// See [`Words::guards`].
            pub guards: [u64; W],
            /// See [`Words::bounds`].
            pub bounds: [u64; W],
            /// See [`Words::initial`].
            pub initial: [u64; W],
            /// See [`Words::restless`].
            pub restless: [u64; W],
            /// See [`Words::control`].
            pub control: u64,
            /// See [`Words::states`].
            pub states: u16,
            /// See [`Words::fingerprint`].
            pub fingerprint: u64,
            /// The most transitions that fire at once by themselves one after another.
            pub settle: u32,
            /// Whether it is known that no bound is ever exceeded.
            pub bounded: bool,
        }

        /// The lists of a [`Code`] to be filled, as long as [`Size`] says.
        #[derive(Debug)]
        #[expect(missing_docs, reason = "they are those of `Code`")]
        pub struct Lists<'l, const W: usize> {
            $( pub $list: &'l mut [$item], )*
        }

        /// The length of each list.
        #[cfg(feature = "alloc")]
        #[derive(Debug)]
        pub(super) struct Lengths {
            $( pub(super) $list: usize, )*
        }

        #[cfg(feature = "alloc")]
        impl Size {
            /// The length of each list.
            pub(super) const fn lengths(&self) -> Lengths {
                Lengths {
                    entries: self.entries,
                    needs: self.needs,
                    deltas: self.deltas,
                    takes: self.takes,
                    rows: self.rows,
                    routes: self.routes,
                    says: self.says,
                    mailboxes: self.mailboxes,
                    turns: self.components + 1,
                    events: self.components + 1,
                    transitions: self.components + 1,
                    places: self.components + 1,
                    fields: self.fields,
                    complements: self.complements,
                    clocks: self.clocks,
                    clears: self.clears,
                    ignored: self.ignored,
                    ignored_where: self.ignored_where,
                    kept: self.kept,
                    summands: self.summands,
                }
            }
        }
    };
}

/// Makes `Arrays` and, with the feature `alloc`, `Packed` of the lists.
macro_rules! owned {
    ($(
        $(#[doc = $doc:literal])*
        $list:ident : $item:ty [$length:ident] = $nothing:expr,
    )*) => {
        /// The lists of a [`Code`] whose lengths are known when compiling.
        #[derive(Clone, Copy, Debug)]
        pub struct Arrays<
            const W: usize,
            const T: usize,
            const Y: usize,
            const Z: usize,
            const K: usize,
            const R: usize,
            const O: usize,
            const D: usize,
            const B: usize,
            const N: usize,
            const P: usize,
            const X: usize,
            const C: usize,
            const E: usize,
            const G: usize,
            const I: usize,
            const L: usize,
            const M: usize,
        > {
            $( $list: [$item; $length], )*
            words: Words<W>,
        }

        impl<
            const W: usize,
            const T: usize,
            const Y: usize,
            const Z: usize,
            const K: usize,
            const R: usize,
            const O: usize,
            const D: usize,
            const B: usize,
            const N: usize,
            const P: usize,
            const X: usize,
            const C: usize,
            const E: usize,
            const G: usize,
            const I: usize,
            const L: usize,
            const M: usize,
        > Arrays<W, T, Y, Z, K, R, O, D, B, N, P, X, C, E, G, I, L, M>
        {
            /// Packs a system; the lengths are those of [`size_of`].
            pub const fn of(system: &crate::system::data::System<'_>) -> Self {
                let mut it = Self { $( $list: [$nothing; $length], )* words: Words::NOTHING };
                it.words = pack(system, &mut Lists { $( $list: &mut it.$list, )* });
                it
            }

            /// The same lists as these, which are longer or as long.
            ///
            /// # Panics
            /// When one of them is shorter than the one here: at compile time.
            pub const fn cut(longer: &Code<'_, W>) -> Self {
                let Code { guards, bounds, initial, restless, control, states, fingerprint, .. } =
                    *longer;
                let (needs, deltas) = (Y as u16, Z as u16);
                Self {
                    $( $list: first(longer.$list), )*
                    words: Words {
                        guards, bounds, initial, restless, control, states, fingerprint, needs,
                        deltas,
                    },
                }
            }

            /// The size of what is packed, given the one that [`size_of`] says.
            pub const fn exact(&self, most: Size) -> Size {
                let (needs, deltas) = (self.words.needs as usize, self.words.deltas as usize);
                Size { needs, deltas, ..most }
            }

            /// The packed system.
            pub const fn code(&self, settle: u32, bounded: bool) -> Code<'_, W> {
                let Words { guards, bounds, initial, restless, control, states, fingerprint, .. } =
                    self.words;
                Code {
                    $( $list: &self.$list, )*
                    guards, bounds, initial, restless, control, states, fingerprint,
                    settle, bounded,
                }
            }
        }

        /// A system made at run time, packed on the heap.
        ///
        /// ```
        /// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
        /// use cotama_core::player::{Packed, Player, words};
        /// use cotama_core::system::{Component, System};
        /// use cotama_core::units::Millis;
        ///
        /// let mut net = OwnedNet::new("lamp", "");
        /// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
        /// let on = net.place(OwnedPlace::new("on", 0)).unwrap();
        /// let press = net.event("press", "").unwrap();
        /// let light = OwnedTransition::new("light").on(press).take(off, 1).give(on, 1);
        /// net.transition(light).unwrap();
        /// let view = net.view();
        /// let net = view.net();
        ///
        /// let alone = [Component::alone(&net)];
        /// let system = System::alone(&alone);
        /// assert_eq!(words(&system), Some(1)); // how many machine words a marking needs
        /// let packed = Packed::<1>::of(&system).unwrap();
        /// let mut player = Player::<_, 1>::start(packed.load(&system), Millis(0), &mut ());
        /// assert!(player.offer(Millis(0), &press.into()).fired());
        /// assert_eq!(player.tokens(on), 1);
        /// ```
        #[cfg(feature = "alloc")]
        #[derive(Clone, Debug)]
        pub struct Packed<const W: usize, const C: usize = 0, const S: usize = 0> {
            $( $list: alloc::vec::Vec<$item>, )*
            words: Words<W>,
            /// Positions of entries by priority, then by number; empty unless it is a net alone.
            pub(super) order: alloc::vec::Vec<u16>,
        }

        #[cfg(feature = "alloc")]
        impl<const W: usize, const C: usize, const S: usize> Packed<W, C, S> {
            /// The lists of a sound system.
            pub(super) fn sound(system: &crate::system::data::System<'_>, size: &Size) -> Self {
                let lengths = size.lengths();
                let mut it = Self {
                    $( $list: alloc::vec![$nothing; lengths.$list], )*
                    words: Words::NOTHING,
                    order: alloc::vec::Vec::new(),
                };
                it.words = pack(system, &mut Lists { $( $list: &mut it.$list, )* });
                it.needs.truncate(usize::from(it.words.needs));
                it.deltas.truncate(usize::from(it.words.deltas));
                it
            }

            /// The packed system; no bound is taken to be proven.
            pub fn code(&self) -> Code<'_, W> {
                let Words { guards, bounds, initial, restless, control, states, fingerprint, .. } =
                    self.words;
                let (settle, bounded) = (super::SETTLE, false);
                Code {
                    $( $list: &self.$list, )*
                    guards, bounds, initial, restless, control, states, fingerprint,
                    settle, bounded,
                }
            }
        }
    };
}
pub(super) use {borrowed, each_list, owned};
