//! The language: `system!`.

/// Puts nets together, checks that they fit while compiling, and makes them ready to be run.
///
/// ```
/// use cotama_core::{net, system, units::Millis};
/// use cotama_core::system::{Offered, Turned};
///
/// net! {
///     /// Somebody at the door.
///     pub mod visitor {
///         places { Outside: 1, Waiting, Inside }
///         events { arrive, opened }
///         outputs { ring }
///         transitions {
///             come  on arrive: Outside => Waiting emit ring;
///             enter on opened: Waiting => Inside;
///         }
///     }
/// }
/// net! {
///     /// Opens when somebody rings.
///     pub mod door {
///         places { Closed: 1, Open }
///         events { bell }
///         outputs { click }
///         transitions { open on bell: Closed => Open emit click; }
///         ignore { bell in Open; }
///     }
/// }
/// system! {
///     /// A visitor and a door.
///     pub mod house {
///         nets { visitor: visitor, door: door }
///         links {
///             visitor.ring => door.bell mail 1;
///             door.click => visitor.opened now;
///         }
///     }
/// }
///
/// fn main() {
///     let mut house = house::Player::<()>::new();
///     let arrive = house::on::visitor(&visitor::Event::arrive);
///     assert!(matches!(house.offer(Millis(0), arrive, (), &mut ()), Offered::Fired(_)));
///     assert_eq!(house.waiting(house::on::door(&door::Event::bell)), 1);
///     assert_eq!(house.round(Millis(100), &mut ()), Turned { fired: 1, ..Turned::default() });
///     assert_eq!(house.tokens(house::at::visitor(visitor::Place::Inside)), 1);
/// }
/// ```
///
/// # The sections
///
/// | section | item | meaning |
/// | --- | --- | --- |
/// | `nets` | `gs: global` | a net by the name of its module, in the order of turns |
/// | `links` | `gs.start => ls.start mail 1;` | the output `start` of `gs` waits in a mailbox for the turn of `ls` |
/// | | `gs.abort => ls.abort & es.abort now;` | a rendezvous, here with two nets: a broadcast |
/// | `shared` | `ls.camera & cs.camera = env.camera;` | whose place a shared place is |
/// | `pending` | `ls.report_pending = cs.report;` | a shared place that is marked while something waits in that mailbox |
/// | `clears` | `ls.abort empties ls.start & ls.local;` | an event that empties mailboxes, whether its net uses it or not |
///
/// It makes a module with `SYSTEM` (the plain data), `SIZE`, the functions `on::NET` (an event of a
/// net) and `at::NET` (a place), the type `Program`, and the type `Player<M>`, where `M` is what
/// events carry along.
#[macro_export]
macro_rules! system {
    (
        $(#[doc = $doc:expr])*
        $vis:vis mod $name:ident {
            nets { $( $component:ident : $net:ident ),* $(,)? }
            $(links { $(
                $from:ident . $output:ident => $( $to:ident . $event:ident )&+ $(mail $capacity:literal)? $(now $($now:literal)?)? ;
            )* })?
            $(shared { $( $( $borrower:ident . $borrowed:ident )&+ = $owner:ident . $owned:ident ; )* })?
            $(pending { $( $( $watcher:ident . $watches:ident )&+ = $box_owner:ident . $box_event:ident ; )* })?
            $(clears { $( $clearer:ident . $clear_on:ident empties $( $cleared:ident . $clear_box:ident )&+ ; )* })?
        }
    ) => {
        $(#[doc = $doc])*
        $vis mod $name {
            #[allow(unused_imports)]
            use super::*;
            use $crate::system::{code as system_code, source as system_source};

            const NAME: &str = stringify!($name);
            const COMPONENTS: &[$crate::system::Component<'static>] =
                &[$( $crate::system::Component { name: stringify!($component), net: &$net::NET }, )*];

            const LINKS: &[system_source::WrittenLink<'static>] = &[$( $( (
                (stringify!($from), stringify!($output)),
                &[$( (stringify!($to), stringify!($event)), )+],
                &[$( $capacity )?],
            ), )* )?];
            const BINDINGS: &[system_source::WrittenBinding<'static>] = &[
                $( $( (
                    &[$( (stringify!($borrower), stringify!($borrowed)), )+],
                    (stringify!($owner), stringify!($owned)),
                    false,
                ), )* )?
                $( $( (
                    &[$( (stringify!($watcher), stringify!($watches)), )+],
                    (stringify!($box_owner), stringify!($box_event)),
                    true,
                ), )* )?
            ];

            /// The system as plain data.
            pub const SYSTEM: $crate::system::System<'static> = $crate::system::System {
                name: NAME,
                doc: $crate::net::source::doc(concat!($($doc,)* "")),
                components: COMPONENTS,
                links: &system_source::links::<{ system_source::count_links(LINKS) }>(NAME, COMPONENTS, LINKS),
                bindings: &system_source::bindings::<{ system_source::count_bindings(BINDINGS) }>(
                    NAME, COMPONENTS, BINDINGS,
                ),
                clears: &[$( $( $( system_source::clear(
                    NAME,
                    COMPONENTS,
                    (stringify!($clearer), stringify!($clear_on)),
                    (stringify!($cleared), stringify!($clear_box)),
                ), )+ )* )?],
            };
            /// How many words, clocks and slots its player has, and how long its packed lists are.
            pub const SIZE: system_code::Size = {
                system_source::check(&SYSTEM);
                system_code::size_of(&SYSTEM)
            };
            // A static: of a constant each crate that uses it may keep a copy.
            static ARRAYS: system_code::Arrays<
                { SIZE.words },
                { SIZE.entries },
                { SIZE.takes },
                { SIZE.rows },
                { SIZE.routes },
                { SIZE.mailboxes },
                { SIZE.components + 1 },
                { SIZE.fields },
                { SIZE.clocks },
                { SIZE.clears },
            > = system_code::Arrays::of(&SYSTEM);
            const CODE: system_code::Code<'static, { SIZE.words }> = ARRAYS.code();

            /// The system as a player runs it; no bytes.
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
            pub struct Program;

            impl $crate::system::Program<{ SIZE.words }> for Program {
                #[inline]
                fn code(&self) -> system_code::Code<'_, { SIZE.words }> {
                    CODE
                }
            }

            /// Runs the system; `M` is what events carry along.
            pub type Player<M> =
                $crate::system::Player<Program, M, { SIZE.words }, { SIZE.clocks }, { SIZE.slots }>;

            #[allow(dead_code, non_camel_case_types)]
            enum Number { $( $component, )* }

            /// Events of the nets.
            #[allow(missing_docs)]
            pub mod on {
                #[allow(unused_imports)]
                use super::*;
                $( pub fn $component(event: &$net::Event) -> $crate::system::Of<$crate::net::EventId> {
                    $crate::system::event(Number::$component as u16, event)
                } )*
            }

            /// Places of the nets.
            #[allow(missing_docs)]
            pub mod at {
                #[allow(unused_imports)]
                use super::*;
                $( pub fn $component(place: $net::Place) -> $crate::system::Of<$crate::net::PlaceId> {
                    $crate::system::Of { component: Number::$component as u16, id: place.into() }
                } )*
            }
        }
    };
}
