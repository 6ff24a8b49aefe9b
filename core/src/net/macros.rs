//! The language: `net!`.

/// Defines a supervisor, checks it while compiling, and makes it ready to be played.
///
/// ```
/// use cotama_core::{net, player::Outcome::{Fired, Ignored}, player::Why, units::Millis};
///
/// net! {
///     /// Stops the robot when the operator falls silent.
///     pub mod link {
///         places {
///             /// The operator was heard of late.
///             Up: 1,
///             /// The robot must stand.
///             Down,
///         }
///         events { Silence, Heard }
///         outputs { Stop, Go }
///         transitions {
///             lose    on Silence: Up => Down emit Stop;
///             recover on Heard:   Down => Up emit Go;
///         }
///         ignore { Silence in Down; Heard in Up; }
///         laws { handles(all); deadlock_free; always_can(Up); invariant(Up & Down = 1); }
///     }
/// }
///
/// let mut player = link::Player::new();
/// let outcome = player.offer(Millis(400), &link::Event::Silence);
/// assert_eq!(outcome, Fired { transition: link::Transition::lose, settled: 0 });
/// assert_eq!(player.state(), link::State::Down);
/// assert_eq!(player.offer(Millis(500), &link::Event::Silence), Ignored { why: Why::OnPurpose });
/// ```
///
/// # The sections
///
/// They come in this order; `places` and `transitions` must be there. Every item can have a
/// documentation.
///
/// | section | item | meaning |
/// | --- | --- | --- |
/// | `places` | `Idle: 1`, `Busy`, `Queue: 0 of 3` | a place, its tokens at the start (none), the most it may hold (1) |
/// | `flags` | `sonar: true`, `lost` | a boolean, false when nothing is said |
/// | `counters` | `misses: 0 of 3` | a number from 0 to its largest value |
/// | `shared` | `camera: true`, `level: 2 of 2` | a flag or counter that another net of the system owns |
/// | `events` | `Stop`, `Goal(Pose)` | what it reacts to; a payload is `Copy + Debug + PartialEq` and decides nothing |
/// | `outputs` | `Brake` | what it says |
/// | `groups` | `Driving: Slow & Fast;` | a name for several places |
/// | `transitions` | see below | |
/// | `ignore` | `Stop in Idle & Busy;` | the event is left unanswered there, on purpose |
/// | `laws` | see below | |
///
/// # Transitions
///
/// ```text
/// name on Event [guard]: Taken & Other * 2 => Given read There do counter += 1 & flag = false
///     emit Output & Another within 500..=2_000 ms priority 1;
/// ```
///
/// All but `name: Taken => Given` can be left out; `_` stands for no place. Without an event a
/// transition fires by itself: at once, or in its interval; `after 500 ms` is an interval without
/// end. A guard is a conjunction of `flag`, `!flag`, `counter < 3` (also `<=`, `==`, `>=`, `>`);
/// places can be tested as well, for presence. A group among the places that are taken or read
/// stands for each of its members: one line is then several transitions.
///
/// Flags, counters and shared ones become places with a complement each, so a guard is nothing but
/// arcs that read, and nothing that decides is hidden from whoever looks at the net. `counter += 1`
/// waits until there is room, `counter = 0` is one transition for each old value.
///
/// # Laws
///
/// Compile errors where they do not hold, with the culprit and the shortest way there. They speak
/// of the net without time and priorities (see [`Law`](crate::net::Law)), with shared places
/// changing as they please.
///
/// | law | says |
/// | --- | --- |
/// | `invariant(A & B * 2 = 1)` | the weighted sum of tokens never changes |
/// | `never_both(A, B)` | never a token in both |
/// | `reachable(A)` | some firing sequence marks it |
/// | `always_can(A)` | from wherever the net is, some firing sequence marks it |
/// | `handles(all)` | every event is used or ignored on purpose, wherever the net has settled |
/// | `settles` | transitions that fire at once by themselves come to an end; always checked |
/// | `deadlock_free`, `deadlock_free_except(A)` | some transition is enabled, except where `A` is marked |
/// | `deterministic` | no two transitions on the same event are enabled together |
/// | `left_to_checker` | the net has more than 1,024 markings: it is not explored here, its laws are for the model checker |
///
/// Bounds of places are always checked.
///
/// A payload type that is called like something the module makes (`Place`, `State`, `Event`, ...)
/// is written with its path.
///
/// # What it makes
///
/// A module with `NET` (the plain data), `KNOWN` (how it was checked), the enums `Place`, `State`,
/// `Event`, `Output` and `Transition`, the type `Program`, and the type `Player`.
#[macro_export]
macro_rules! net {
    (
        $(#[doc = $doc:expr])*
        $vis:vis mod $name:ident {
            places { $( $(#[doc = $place_doc:expr])* $place:ident $(: $tokens:literal $(of $bound:literal)?)? ),* $(,)? }
            $(flags { $( $(#[doc = $flag_doc:expr])* $flag:ident $(: $flag_is:literal)? ),* $(,)? })?
            $(counters { $( $(#[doc = $counter_doc:expr])* $counter:ident : $count:literal of $largest:literal ),* $(,)? })?
            $(shared { $( $(#[doc = $shared_doc:expr])* $shared:ident $(: $shared_is:literal $(of $shared_largest:literal)?)? ),* $(,)? })?
            $(events { $( $(#[doc = $event_doc:expr])* $event:ident $(( $payload:ty ))? ),* $(,)? })?
            $(outputs { $( $(#[doc = $output_doc:expr])* $output:ident ),* $(,)? })?
            $(groups { $( $(#[doc = $group_doc:expr])* $group:ident : $( $member:ident )&+ ; )* })?
            transitions { $(
                $(#[doc = $line_doc:expr])*
                $line:ident $(on $on:ident)? $([ $($guard:tt)* ])? :
                    $( $take:tt $(* $take_weight:literal)? )&+ => $( $give:tt $(* $give_weight:literal)? )&+
                    $(read $( $read:ident $(* $read_weight:literal)? )&+ )?
                    $(do $( $change:ident $change_by:tt $change_value:literal )&+ )?
                    $(emit $( $emit:ident )&+ )?
                    $(within $earliest:literal ..= $latest:literal ms)?
                    $(after $after:literal ms)?
                    $(priority $priority:literal)?
                ;
            )* }
            $(ignore { $( $ignored:ident in $( $ignored_in:ident )&+ ; )* })?
            $(laws { $( $law:ident $(( $($law_of:tt)* ))? ; )* })?
        }
    ) => {
        $(#[doc = $doc])*
        #[allow(long_running_const_eval)]
        $vis mod $name {
            #[allow(unused_imports)]
            use super::*;
            use $crate::net::{lower as net_lower, source as net_source};
            use $crate::player::code as net_code;

            const SOURCE: net_source::Source<'static> = net_source::Source {
                name: stringify!($name),
                doc: net_source::doc(concat!($($doc,)* "")),
                places: &[$( net_source::Declared {
                    name: stringify!($place),
                    doc: net_source::doc(concat!($($place_doc,)* "")),
                    initial: net_source::first(&[$( $tokens, )? 0]),
                    bound: net_source::first(&[$( $( $bound, )? )? 1]),
                }, )*],
                flags: &[$( $( net_source::Declared {
                    name: stringify!($flag),
                    doc: net_source::doc(concat!($($flag_doc,)* "")),
                    initial: net_source::first(&[$( $flag_is as u64, )? 0]),
                    bound: 1,
                }, )* )?],
                counters: &[$( $( net_source::Declared {
                    name: stringify!($counter),
                    doc: net_source::doc(concat!($($counter_doc,)* "")),
                    initial: $count,
                    bound: $largest,
                }, )* )?],
                shared: &[$( $( net_source::Declared {
                    name: stringify!($shared),
                    doc: net_source::doc(concat!($($shared_doc,)* "")),
                    initial: net_source::first(&[$( $shared_is as u64, )? 0]),
                    bound: net_source::first(&[$( $( $shared_largest, )? )? 1]),
                }, )* )?],
                events: &[$( $( $crate::net::Signal {
                    name: stringify!($event),
                    doc: net_source::doc(concat!($($event_doc,)* "")),
                }, )* )?],
                outputs: &[$( $( $crate::net::Signal {
                    name: stringify!($output),
                    doc: net_source::doc(concat!($($output_doc,)* "")),
                }, )* )?],
                groups: &[$( $( net_source::Group {
                    name: stringify!($group),
                    members: &[$( stringify!($member), )+],
                }, )* )?],
                lines: &[$( net_source::Line {
                    name: stringify!($line),
                    doc: net_source::doc(concat!($($line_doc,)* "")),
                    on: concat!($( stringify!($on), )? ""),
                    guard: $crate::net_guard!(($name $line) [] $($($guard)*)?),
                    take: &[$( (stringify!($take), net_source::first(&[$( $take_weight, )? 1])), )+],
                    give: &[$( (stringify!($give), net_source::first(&[$( $give_weight, )? 1])), )+],
                    read: &[$( $( (stringify!($read), net_source::first(&[$( $read_weight, )? 1])), )+ )?],
                    changes: &[$( $( net_source::Change {
                        name: stringify!($change),
                        by: $crate::net_change!(($name $line $change) $change_by $change_value),
                    }, )+ )?],
                    emits: &[$( $( stringify!($emit), )+ )?],
                    within: net_source::interval(stringify!($name), stringify!($line), &[$( ($earliest, Some($latest)), )? $( ($after, None), )?]),
                    priority: net_source::priority(&[$( $priority, )? 0]),
                }, )*],
                ignored: &[$( $( $( (stringify!($ignored), stringify!($ignored_in)), )+ )* )?],
                laws: &[$( $( $crate::net_claim!(($name) $law $(( $($law_of)* ))?), )* )?],
            };
            const SIZE: net_lower::Size = SOURCE.size();
            const LOWERED: &net_lower::Lowered<
                'static,
                { SIZE.places },
                { SIZE.transitions },
                { SIZE.arcs },
                { SIZE.emits },
                { SIZE.text },
                { SIZE.ignored },
                { SIZE.laws },
            > = &SOURCE.lower();

            /// The net as plain data.
            pub const NET: $crate::net::Net<'static> = $crate::net::Net {
                name: SOURCE.name,
                doc: SOURCE.doc,
                places: &LOWERED.places(),
                events: SOURCE.events,
                outputs: SOURCE.outputs,
                transitions: &LOWERED.transitions(),
                ignored: LOWERED.ignored(),
                laws: &LOWERED.laws(),
            };
            const ALONE: &[$crate::system::Component<'static>; 1] =
                &[$crate::system::Component::alone(&NET)];
            const SYSTEM: $crate::system::System<'static> =
                $crate::system::System::alone(ALONE);
            const CODE_SIZE: net_code::Size = net_code::size_of(&SYSTEM);
            const ARRAYS: &net_code::Arrays<
                { CODE_SIZE.words },
                { CODE_SIZE.entries },
                { CODE_SIZE.takes },
                { CODE_SIZE.rows },
                { CODE_SIZE.routes },
                { CODE_SIZE.says },
                { CODE_SIZE.mailboxes },
                { CODE_SIZE.components + 1 },
                { CODE_SIZE.fields },
                { CODE_SIZE.complements },
                { CODE_SIZE.clocks },
                { CODE_SIZE.clears },
                { CODE_SIZE.ignored },
            > = &net_code::Arrays::of(&SYSTEM);

            /// How the net was checked.
            pub const KNOWN: $crate::net::Known =
                $crate::net::check(&NET, &ARRAYS.code(0, false), SOURCE.left_to_checker());

            const CODE: net_code::Code<'static, { CODE_SIZE.words }> =
                ARRAYS.code(KNOWN.settle(), KNOWN.bounded());

            /// A place, flag, counter or shared place.
            #[allow(missing_docs, non_camel_case_types)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub enum Place {
                $( $(#[doc = $place_doc])* $place, )*
                $( $( $(#[doc = $flag_doc])* $flag, )* )?
                $( $( $(#[doc = $counter_doc])* $counter, )* )?
                $( $( $(#[doc = $shared_doc])* $shared, )* )?
            }

            impl ::core::convert::From<Place> for $crate::net::PlaceId {
                #[inline]
                fn from(place: Place) -> Self {
                    Self(place as u32)
                }
            }

            impl ::core::convert::From<Place> for $crate::system::Of<$crate::net::PlaceId> {
                #[inline]
                fn from(place: Place) -> Self {
                    Self { component: 0, id: place.into() }
                }
            }

            /// The marked place, when the net is a state machine.
            #[allow(missing_docs, non_camel_case_types)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub enum State {
                $( $(#[doc = $place_doc])* $place, )*
            }

            /// What the net reacts to.
            #[allow(missing_docs, non_camel_case_types)]
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub enum Event {
                $( $( $(#[doc = $event_doc])* $event $(($payload))?, )* )?
            }

            #[allow(dead_code, non_camel_case_types)]
            enum EventNumber {
                $( $( $event, )* )?
            }

            impl $crate::player::Kind for Event {
                #[inline]
                fn id(&self) -> $crate::system::Of<$crate::net::EventId> {
                    let number = match *self {
                        $( $( Self::$event { .. } => EventNumber::$event as u32, )* )?
                    };
                    $crate::system::Of { component: 0, id: $crate::net::EventId(number) }
                }
            }

            /// What the net says.
            #[allow(missing_docs, non_camel_case_types)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub enum Output {
                $( $( $(#[doc = $output_doc])* $output, )* )?
            }

            /// The lines of the net's transitions.
            #[allow(missing_docs, non_camel_case_types)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub enum Transition {
                $( $(#[doc = $line_doc])* $line, )*
            }

            /// The net as a player plays it; no bytes.
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
            pub struct Program;

            const LINES: [u16; SIZE.transitions] = net_lower::lines(&NET);

            impl $crate::player::Names for Program {
                type Event = Event;
                type Transition = Transition;
                type Output = Output;

                #[inline]
                fn transition(
                    &self,
                    id: $crate::system::Of<$crate::net::TransitionId>,
                ) -> Transition {
                    const BY_LINE: &[Transition] = &[$( Transition::$line, )*];
                    const ALL: [Transition; SIZE.transitions] = {
                        let mut all = [BY_LINE[0]; SIZE.transitions];
                        let mut at = 0;
                        while at < all.len() {
                            all[at] = BY_LINE[LINES[at] as usize];
                            at += 1;
                        }
                        all
                    };
                    ALL.get(id.id.0 as usize).copied().unwrap_or(ALL[0])
                }

                #[inline]
                fn output(
                    &self,
                    id: $crate::system::Of<$crate::net::TransitionId>,
                    at: usize,
                ) -> Option<Output> {
                    const BY_LINE: &[&[Output]] = &[$( &[$( $( Output::$emit, )+ )?], )*];
                    let line = *LINES.get(id.id.0 as usize)?;
                    BY_LINE.get(line as usize)?.get(at).copied()
                }
            }

            impl $crate::player::Program<{ CODE_SIZE.words }, { CODE_SIZE.clocks }> for Program {
                #[inline]
                fn code(&self) -> net_code::Code<'_, { CODE_SIZE.words }> {
                    CODE
                }

                fn system(&self) -> $crate::system::System<'_> {
                    SYSTEM
                }

                fn takes(&self, transition: u16) -> [u64; CODE_SIZE.words] {
                    let takes = STEPS.takes.get(usize::from(transition));
                    takes.copied().unwrap_or([0; CODE_SIZE.words])
                }

                fn ordered(&self, at: usize) -> Option<u16> {
                    STEPS.order.get(at).copied()
                }
            }

            const STEPS: &$crate::player::Steps<{ SIZE.transitions }, { CODE_SIZE.words }> =
                &$crate::player::Steps::of(&SYSTEM, &CODE);

            impl $crate::player::StateMachine for Program {
                type State = State;
                const STATES: &'static [State] = &[$( State::$place, )*];
                const IS_ONE: bool = $crate::player::is_state_machine(&NET);
            }

            /// Plays the net.
            pub type Player =
                $crate::player::Player<Program, { CODE_SIZE.words }, { CODE_SIZE.clocks }>;

            /// Plays the net and takes nothing to be proven: for stored markings, and for steps.
            pub type Checked = $crate::player::Player<
                $crate::player::Checked<Program>,
                { CODE_SIZE.words },
                { CODE_SIZE.clocks },
            >;

            /// A transition that has just fired, as an observer of the player is told.
            pub type Firing<'f> = $crate::player::Firing<'f, Program>;
        }
    };
}

/// The conditions of a guard.
#[doc(hidden)]
#[macro_export]
macro_rules! net_guard {
    ($of:tt [$($done:tt)*]) => { &[$($done)*] };
    ($of:tt [$($done:tt)*] & $($rest:tt)+) => { $crate::net_guard!($of [$($done)*] $($rest)+) };
    ($of:tt [$($done:tt)*] ! $name:ident $($rest:tt)*) => {
        $crate::net_guard!($of [$($done)* $crate::net_test!($name AtMost 0),] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident < $value:literal $($rest:tt)*) => {
        $crate::net_guard!($of [$($done)* $crate::net_test!($name Less $value),] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident <= $value:literal $($rest:tt)*) => {
        $crate::net_guard!($of [$($done)* $crate::net_test!($name AtMost $value),] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident == $value:literal $($rest:tt)*) => {
        $crate::net_guard!($of [$($done)* $crate::net_test!($name Equal $value),] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident >= $value:literal $($rest:tt)*) => {
        $crate::net_guard!($of [$($done)* $crate::net_test!($name AtLeast $value),] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident > $value:literal $($rest:tt)*) => {
        $crate::net_guard!($of [$($done)* $crate::net_test!($name More $value),] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident $($rest:tt)*) => {
        $crate::net_guard!($of [$($done)* $crate::net_test!($name AtLeast 1),] $($rest)*)
    };
    (($net:ident $line:ident) [$($done:tt)*] $($rest:tt)+) => {
        compile_error!(concat!(
            "net `", stringify!($net), "`, transition `", stringify!($line), "`: `", stringify!($($rest)+),
            "` cannot be part of a guard, which is a conjunction as `[flag & !other & counter < 3]`; ",
            "write an `or` as two transitions"
        ))
    };
}

/// One condition of a guard.
#[doc(hidden)]
#[macro_export]
macro_rules! net_test {
    ($name:ident $relation:ident $value:literal) => {
        $crate::net::source::Test {
            name: stringify!($name),
            relation: $crate::net::source::Relation::$relation,
            value: $value,
        }
    };
}

/// How a value changes.
#[doc(hidden)]
#[macro_export]
macro_rules! net_change {
    ($of:tt += $value:literal) => { $crate::net::source::By::Add($value) };
    ($of:tt -= $value:literal) => { $crate::net::source::By::Subtract($value) };
    ($of:tt = $value:literal) => { $crate::net::source::By::Become($value as u64) };
    (($net:ident $line:ident $change:ident) $($other:tt)*) => {
        compile_error!(concat!(
            "net `", stringify!($net), "`, transition `", stringify!($line), "`: `", stringify!($change), " ",
            stringify!($($other)*), "` is no change; there are `counter += 1`, `counter -= 1`, `counter = 0` and `flag = true`"
        ))
    };
}

/// A law.
#[doc(hidden)]
#[macro_export]
macro_rules! net_claim {
    ($of:tt invariant ( $( $place:ident $(* $weight:literal)? )&+ = $sum:literal )) => {
        $crate::net::source::Claim::Invariant(
            &[$( (stringify!($place), $crate::net::source::first(&[$( $weight, )? 1])), )+],
            $sum,
        )
    };
    ($of:tt never_both ( $a:ident, $b:ident )) => { $crate::net::source::Claim::NeverBoth(stringify!($a), stringify!($b)) };
    ($of:tt reachable ( $place:ident )) => { $crate::net::source::Claim::Reachable(stringify!($place)) };
    ($of:tt always_can ( $place:ident )) => { $crate::net::source::Claim::AlwaysCan(stringify!($place)) };
    ($of:tt handles ( all )) => { $crate::net::source::Claim::HandlesAll };
    ($of:tt settles) => { $crate::net::source::Claim::Settles };
    ($of:tt deadlock_free) => { $crate::net::source::Claim::DeadlockFree("") };
    ($of:tt deadlock_free_except ( $place:ident )) => { $crate::net::source::Claim::DeadlockFree(stringify!($place)) };
    ($of:tt deterministic) => { $crate::net::source::Claim::Deterministic };
    ($of:tt left_to_checker) => { $crate::net::source::Claim::LeftToChecker };
    (($net:ident) $law:ident $(( $($other:tt)* ))?) => {
        compile_error!(concat!(
            "net `", stringify!($net), "`: no law is written `", stringify!($law) $(, "(", stringify!($($other)*), ")")?,
            "`; there are `invariant(A & B * 2 = 1)`, `never_both(A, B)`, `reachable(A)`, `always_can(A)`, `handles(all)`, ",
            "`settles`, `deadlock_free`, `deadlock_free_except(A)`, `deterministic` and `left_to_checker`"
        ))
    };
}
