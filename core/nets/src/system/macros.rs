//! The language: `system!`.

/// Puts nets together, checks that they fit while compiling, and makes them ready to be run.
///
/// ```
/// use cotama_core::{net, system, units::Millis};
/// use cotama_core::player::Round;
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
///     let mut house = house::Player::new();
///     let arrive = house::Event::visitor(visitor::Event::arrive);
///     assert!(house.offer(Millis(0), &arrive).fired());
///     assert_eq!(house.waiting(&house::Event::door(door::Event::bell)), 1);
///     assert_eq!(house.round(Millis(100)), Round { fired: 1, ..Round::default() });
///     assert_eq!(house::state::visitor(&house), visitor::State::Inside);
/// }
/// ```
///
#[doc = include_str!("sections.md")]
///
#[doc = include_str!("laws/law.md")]
///
#[doc = include_str!("extends.md")]
#[macro_export]
macro_rules! system {
    (
        $(@ $export:ident)?
        $(#[doc = $doc:expr])*
        $vis:vis mod $name:ident {
            nets { $( $component:ident : $net:ident $(:: $net_in:ident)* ),* $(,)? }
            $(links { $(
                $from:ident . $output:ident => $( $to:ident . $event:ident )&+
                    $( $arrives:ident $( $capacity:expr )? )? ;
            )* })?
            $(shared { $(
                $( $borrower:ident . $borrowed:ident )&+ = $owner:ident . $owned:ident ;
            )* })?
            $(pending { $(
                $( $watcher:ident . $watches:ident )&+ = $box_owner:ident . $box_event:ident ;
            )* })?
            $(clears { $(
                $clearer:ident . $clear_on:ident
                    empties $( $cleared:ident . $clear_box:ident )&+ ;
            )* })?
            $(laws { $( $law:ident $(( $($law_of:tt)* ))? ; )* })?
        }
    ) => {
        impl $crate::__private::system::Written for $name::Program {
            const COMPONENTS: &'static [$crate::system::Component<'static>] = &[$(
                $crate::system::Component {
                    name: stringify!($component),
                    net: &$net $(:: $net_in)* ::NET,
                },
            )*];
            const LINKS: &'static [$crate::__private::system::WrittenLink<'static>] = &[$( $( (
                (stringify!($from), stringify!($output)),
                &[$( (stringify!($to), stringify!($event)), )+],
                $crate::__system_delivery!(
                    ($name $from $output) $( $arrives $( $capacity )? )?
                ),
            ), )* )?];
            const BINDINGS: &'static [$crate::__private::system::WrittenBinding<'static>] = &[
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
            const CLEARS: &'static [$crate::__private::system::WrittenClear<'static>] = &[
                $( $( $( (
                    (stringify!($clearer), stringify!($clear_on)),
                    (stringify!($cleared), stringify!($clear_box)),
                ), )+ )* )?
            ];
            const LAWS: &'static [$crate::__private::system::Claim] =
                &[$( $( $crate::__system_claim!($name $law $(( $($law_of)* ))?), )* )?];
        }

        $( impl $crate::__private::system::Part for $name::parts::$component {
            type Event = $net $(:: $net_in)* ::Event;
            type Place = $net $(:: $net_in)* ::Place;
            type Output = $net $(:: $net_in)* ::Output;
            type Transition = $net $(:: $net_in)* ::Transition;
            type State = $net $(:: $net_in)* ::State;
            type Program = $net $(:: $net_in)* ::Program;
            const PROGRAM: Self::Program = $net $(:: $net_in)* ::Program;
        } )*

        $(#[doc = $doc])*
        #[allow(long_running_const_eval, unreachable_pub)]
        $vis mod $name {
            use $crate::__private::system::{self as system_source, Part};
            use $crate::player::code as system_code;

            $crate::__definition! {
                ($) __system_extended [$($export)?] $name
                { $( $component { $component: $net $(:: $net_in)*, } )* }
                { $( $( $from.$output => $( $to.$event )&+ $( $arrives $( $capacity )? )?; )* )? }
                { $( $( $( $borrower.$borrowed )&+ = $owner.$owned; )* )? }
                { $( $( $( $watcher.$watches )&+ = $box_owner.$box_event; )* )? }
                { $( $( $clearer.$clear_on empties $( $cleared.$clear_box )&+; )* )? }
                { $( $( $law $(( $($law_of)* ))?; )* )? }
            }

            /// The nets, as types: a module in a function does not see its siblings.
            #[doc(hidden)]
            #[allow(missing_docs, non_camel_case_types)]
            pub mod parts {
                $( #[derive(Debug)] pub enum $component {} )*
            }

            const NAME: &str = stringify!($name);
            const COMPONENTS: &[$crate::system::Component<'static>] =
                <Program as system_source::Written>::COMPONENTS;
            const LINKS: &[system_source::WrittenLink<'static>] =
                <Program as system_source::Written>::LINKS;
            const BINDINGS: &[system_source::WrittenBinding<'static>] =
                <Program as system_source::Written>::BINDINGS;
            const CLEARS: &[system_source::WrittenClear<'static>] =
                <Program as system_source::Written>::CLEARS;

            /// The system as plain data.
            pub const SYSTEM: $crate::system::System<'static> = $crate::system::System {
                name: NAME,
                doc: $crate::__private::source::doc(concat!($($doc,)* "")),
                components: COMPONENTS,
                links: &system_source::links::<{ system_source::count_links(LINKS) }>(
                    NAME, COMPONENTS, LINKS,
                ),
                bindings: &system_source::bindings::<{ system_source::count_bindings(BINDINGS) }>(
                    NAME, COMPONENTS, BINDINGS,
                ),
                clears: &system_source::clears::<{ CLEARS.len() }>(NAME, COMPONENTS, CLEARS),
            };
            const MOST: system_code::Size = {
                system_source::check::<
                    { SYSTEM.links.len() },
                    { SYSTEM.bindings.len() },
                    { COMPONENTS.len() },
                >(&SYSTEM);
                $crate::player::size::size_of(&SYSTEM)
            };
            /// How many words, clocks and slots its player has, and how long its packed lists
            /// are.
            pub const SIZE: system_code::Size = LONG.exact(MOST);
            const LONG: &$crate::__arrays!(MOST) = &$crate::player::Arrays::of(&SYSTEM);
            // A static: of a constant each crate that uses it may keep a copy.
            static ARRAYS: $crate::__arrays!(SIZE) =
                $crate::player::Arrays::cut(&LONG.code($crate::player::SETTLE, false));
            static CODE: system_code::Code<'static, { SIZE.words }> =
                ARRAYS.code($crate::player::SETTLE, false);

            /// In how many states it rests, where its laws were checked while compiling.
            #[allow(dead_code)]
            pub const EXPLORED: Option<usize> = system_source::check_laws(
                &SYSTEM,
                &ARRAYS.code($crate::player::SETTLE, false),
                <Program as system_source::Written>::LAWS,
            );

            #[allow(dead_code, non_camel_case_types)]
            enum Number { $( $component, )* }

            /// An event of one of the nets.
            #[allow(missing_docs, non_camel_case_types, dead_code)]
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub enum Event { $( $component(<parts::$component as Part>::Event), )* }

            impl $crate::player::Kind for Event {
                #[inline]
                fn id(&self) -> $crate::system::Of<$crate::net::EventId> {
                    let (component, id) = match self {
                        $( Self::$component(it) => {
                            (Number::$component as u16, $crate::player::Kind::id(it).id)
                        } )*
                    };
                    $crate::system::Of { component, id }
                }
            }

            /// A place of one of the nets.
            #[allow(missing_docs, non_camel_case_types, dead_code)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub enum Place { $( $component(<parts::$component as Part>::Place), )* }

            impl ::core::convert::From<Place> for $crate::system::Of<$crate::net::PlaceId> {
                #[inline]
                fn from(place: Place) -> Self {
                    let (component, id) = match place {
                        $( Place::$component(it) => (Number::$component as u16, it.into()), )*
                    };
                    Self { component, id }
                }
            }

            /// The outputs that one of the nets emits.
            #[allow(missing_docs, non_camel_case_types, dead_code)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub enum Output { $( $component(<parts::$component as Part>::Output), )* }

            /// The line of a transition of one of the nets.
            #[allow(missing_docs, non_camel_case_types, dead_code)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub enum Transition { $( $component(<parts::$component as Part>::Transition), )* }

            $crate::__logged_parts! {
                Event Place Output Transition => { $( $component )* }
            }

            $crate::__event_names! {}

            /// The system as a player runs it; no bytes.
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
            pub struct Program;

            impl $crate::player::Names for Program {
                type Event = Event;
                type Transition = Transition;
                type Output = Output;

                fn transition(
                    &self,
                    id: $crate::system::Of<$crate::net::TransitionId>,
                ) -> Transition {
                    const ALL: &[fn($crate::system::Of<$crate::net::TransitionId>) -> Transition] =
                        &[$( |id| Transition::$component(
                            $crate::player::Names::transition(
                                &<parts::$component as Part>::PROGRAM, id,
                            ),
                        ), )*];
                    ALL.get(usize::from(id.component)).unwrap_or(&ALL[0])(id)
                }

                fn output(
                    &self,
                    id: $crate::system::Of<$crate::net::TransitionId>,
                    at: usize,
                ) -> Option<Output> {
                    $( if id.component == Number::$component as u16 {
                        const NET: &<parts::$component as Part>::Program =
                            &<parts::$component as Part>::PROGRAM;
                        return $crate::player::Names::output(NET, id, at).map(Output::$component);
                    } )*
                    None
                }
            }

            impl $crate::player::Program<{ SIZE.words }, { SIZE.clocks }, { SIZE.slots }>
                for Program
            {
                const ALONE: Option<bool> = Some(false);

                #[inline]
                fn code(&self) -> &system_code::Code<'_, { SIZE.words }> {
                    &CODE
                }

                fn system(&self) -> $crate::system::System<'_> {
                    SYSTEM
                }

                fn takes(&self, _: u16) -> [u64; SIZE.words] {
                    [0; SIZE.words]
                }

                fn ordered(&self, _: usize) -> Option<u16> {
                    None
                }
            }

            /// Runs the system; `M` is what events carry along.
            #[allow(dead_code)]
            pub type Carrying<M> = $crate::player::Player<
                Program,
                { SIZE.words },
                { SIZE.clocks },
                { SIZE.slots },
                M,
            >;

            /// Runs the system.
            #[allow(dead_code)]
            pub type Player = Carrying<()>;

            /// Runs the system and takes nothing to be proven: for stored markings.
            #[allow(dead_code)]
            pub type Checked<M = ()> = $crate::player::Player<
                $crate::player::Checked<Program>,
                { SIZE.words },
                { SIZE.clocks },
                { SIZE.slots },
                M,
            >;

            /// A transition that has just fired, as an observer of the player is told.
            #[allow(dead_code)]
            pub type Firing<'f, M = ()> = $crate::player::Firing<'f, Program, M>;

            /// The marked places of those nets that are state machines.
            #[allow(missing_docs, dead_code)]
            pub mod state {
                #[allow(unused_imports)]
                use super::*;
                $(
                    #[inline]
                    pub fn $component<P, const W: usize, const C: usize, const S: usize, M>(
                        player: &$crate::player::Player<P, W, C, S, M>,
                    ) -> <parts::$component as Part>::State
                    where
                        P: $crate::player::Program<W, C, S>,
                        M: ::core::marker::Copy + ::core::default::Default,
                    {
                        let component = Number::$component as u16;
                        player.state_of::<<parts::$component as Part>::Program>(component)
                    }
                )*
            }
        }
    };
    // The same with a definition that other crates may extend.
    ($(#[doc = $doc:expr])* #[macro_export] $vis:vis mod $name:ident $($rest:tt)+) => {
        $crate::system! { @macro_export $(#[doc = $doc])* $vis mod $name $($rest)+ }
    };
    // Another system with more: its definition hands its sections over.
    (
        $(@ $export:ident)?
        $(#[doc = $doc:expr])*
        $vis:vis mod $name:ident extends $base:ident $(:: $base_in:ident)* { $($more:tt)* }
    ) => {
        $base $(:: $base_in)* ::definition! {
            { $(@ $export)? $(#[doc = $doc])* $vis mod $name }
            $base $(:: $base_in)* { $($more)* }
        }
    };
    // A definition that cannot be read: the cure, and the compiler's own words at the token.
    ($(@ macro_export)? $(#[doc = $doc:expr])* $vis:vis mod $name:ident { $($body:tt)* }) => {
        $crate::__system_mistake! { $name $($body)* }
        $crate::system! { @unread $(#[doc = $doc])* $vis mod $name { $($body)* } }
    };
}
