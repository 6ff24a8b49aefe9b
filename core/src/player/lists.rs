//! The lists of a packed system, declared once: borrowed, of lengths known when compiling, or on
//! the heap.

/// Makes `Code`, `Lists`, `Arrays` and, with the feature `alloc`, `Packed` of the same lists.
macro_rules! lists {
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

        /// The lists of a [`Code`] to be filled, as long as [`size`] says.
        #[derive(Debug)]
        #[expect(missing_docs, reason = "they are those of `Code`")]
        pub struct Lists<'l, const W: usize> {
            $( pub $list: &'l mut [$item], )*
        }

        /// The lists of a [`Code`] whose lengths are known when compiling.
        #[derive(Clone, Copy, Debug)]
        pub struct Arrays<
            const W: usize,
            const T: usize,
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
        > Arrays<W, T, K, R, O, D, B, N, P, X, C, E, G, I, L, M>
        {
            /// Packs a system; the lengths are those of [`size_of`].
            pub const fn of(system: &crate::system::data::System<'_>) -> Self {
                let mut it = Self { $( $list: [$nothing; $length], )* words: Words::NOTHING };
                it.words = pack(system, &mut Lists { $( $list: &mut it.$list, )* });
                it
            }

            /// The packed system.
            pub const fn code(&self, settle: u32, bounded: bool) -> Code<'_, W> {
                let Words { guards, bounds, initial, restless, control, states, fingerprint } =
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
                it
            }

            /// The packed system; no bound is taken to be proven.
            pub fn code(&self) -> Code<'_, W> {
                let Words { guards, bounds, initial, restless, control, states, fingerprint } =
                    self.words;
                let (settle, bounded) = (super::SETTLE, false);
                Code {
                    $( $list: &self.$list, )*
                    guards, bounds, initial, restless, control, states, fingerprint,
                    settle, bounded,
                }
            }
        }

        /// The length of each list.
        #[cfg(feature = "alloc")]
        #[derive(Debug)]
        struct Lengths {
            $( $list: usize, )*
        }

        #[cfg(feature = "alloc")]
        impl Size {
            /// The length of each list.
            const fn lengths(&self) -> Lengths {
                Lengths {
                    entries: self.entries,
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
pub(super) use lists;
