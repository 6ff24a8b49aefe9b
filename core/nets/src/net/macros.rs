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
#[doc = include_str!("sections.md")]
#[doc = include_str!("laws.md")]
#[macro_export]
macro_rules! net {
    (
        $(@ $export:ident)?
        $(#[doc = $doc:expr])*
        $vis:vis mod $name:ident {
            $(constants { $(
                $(#[doc = $constant_doc:expr])* $constant:ident : $constant_is:expr
            ),* $(,)? })*
            places { $(
                $(#[doc = $place_doc:expr])*
                $place:ident $(: $tokens:tt $(:: $tokens_in:ident)*
                    $(of $bound:tt $(:: $bound_in:ident)*)?)?
            ),* $(,)? }
            $(flags { $(
                $(#[doc = $flag_doc:expr])*
                $flag:ident $(: $flag_is:tt $(:: $flag_in:ident)*)?
            ),* $(,)? })?
            $(counters { $(
                $(#[doc = $counter_doc:expr])*
                $counter:ident : $count:tt $(:: $count_in:ident)*
                    of $largest:tt $(:: $largest_in:ident)*
            ),* $(,)? })?
            $(shared { $(
                $(#[doc = $shared_doc:expr])*
                $shared:ident $(: $shared_is:tt $(:: $shared_in:ident)*
                    $(of $shared_largest:tt $(:: $shared_largest_in:ident)*)?)?
            ),* $(,)? })?
            $(events { $(
                $(#[doc = $event_doc:expr])* $event:ident $(( $payload:ty ))?
            ),* $(,)? })?
            $(outputs { $( $(#[doc = $output_doc:expr])* $output:ident ),* $(,)? })?
            $(groups { $(
                $(#[doc = $group_doc:expr])* $group:ident : $( $member:ident )&+ ;
            )* })?
            transitions { $(
                $(#[doc = $line_doc:expr])*
                $line:ident $(on $on:ident)? $([ $($guard:tt)* ])? :
                    $( $take:tt $(* $take_weight:tt $(:: $take_weight_in:ident)*)? )&+
                    => $( $give:tt $(* $give_weight:tt $(:: $give_weight_in:ident)*)? )&+
                    $(read $( $read:ident $(* $read_weight:tt $(:: $read_weight_in:ident)*)? )&+ )?
                    $(do $( $change:ident $change_by:tt $value:tt $(:: $value_in:ident)* )&+ )?
                    $(emit $( $emit:ident )&+ )?
                    $(within $earliest:tt $(:: $earliest_in:ident)*
                        ..= $latest:tt $(:: $latest_in:ident)* ms)?
                    $(after $after:tt $(:: $after_in:ident)* ms)?
                    $(priority $priority:expr)?
                ;
            )* }
            $(ignore { $(
                $ignored:ident in $( $ignored_in:ident )&+ $([ $($only:tt)* ])? ;
            )* })?
            $(laws { $( $law:ident $(( $($law_of:tt)* ))? ; )* })?
        }
    ) => {
        impl $crate::__private::Written for $name::Program {
            const SOURCE: $crate::__private::source::Source<'static> = $crate::__net_constants!(
                $({ $( $(#[doc = $constant_doc])* $constant: $constant_is, )* })*
                $crate::__private::source::Source {
                    name: stringify!($name),
                    doc: $crate::__private::source::doc(concat!($($doc,)* "")),
                    places: &[$( $crate::__private::source::declared(
                        (stringify!($name), stringify!($place)),
                        concat!($($place_doc,)* ""),
                        &[$( !!($tokens $(:: $tokens_in)*) as i128, )? 0],
                        &[$( $( !!($bound $(:: $bound_in)*) as i128, )? )? 1],
                    ), )*],
                    flags: &[$( $( $crate::__private::source::declared(
                        (stringify!($name), stringify!($flag)),
                        concat!($($flag_doc,)* ""),
                        &[$( !!($flag_is $(:: $flag_in)*) as i128, )? 0],
                        &[1],
                    ), )* )?],
                    counters: &[$( $( $crate::__private::source::declared(
                        (stringify!($name), stringify!($counter)),
                        concat!($($counter_doc,)* ""),
                        &[!!($count $(:: $count_in)*) as i128],
                        &[!!($largest $(:: $largest_in)*) as i128],
                    ), )* )?],
                    shared: &[$( $( $crate::__private::source::declared(
                        (stringify!($name), stringify!($shared)),
                        concat!($($shared_doc,)* ""),
                        &[$( !!($shared_is $(:: $shared_in)*) as i128, )? 0],
                        &[$( $( !!($shared_largest $(:: $shared_largest_in)*) as i128, )? )? 1],
                    ), )* )?],
                    events: &[$( $( $crate::__private::source::signal(
                        stringify!($event), concat!($($event_doc,)* ""),
                    ), )* )?],
                    outputs: &[$( $( $crate::__private::source::signal(
                        stringify!($output), concat!($($output_doc,)* ""),
                    ), )* )?],
                    groups: &[$( $( $crate::__private::source::Group {
                        name: stringify!($group),
                        members: &[$( stringify!($member), )+],
                    }, )* )?],
                    lines: &[$( $crate::__private::source::Line {
                        name: stringify!($line),
                        doc: $crate::__private::source::doc(concat!($($line_doc,)* "")),
                        on: concat!($( stringify!($on), )? ""),
                        guard: $crate::__net_guard!(($name $line) [] $($($guard)*)?),
                        take: &[$( (stringify!($take), $crate::__net_number!(
                            ($name $line) $( $take_weight $(:: $take_weight_in)* )?
                        )), )+],
                        give: &[$( (stringify!($give), $crate::__net_number!(
                            ($name $line) $( $give_weight $(:: $give_weight_in)* )?
                        )), )+],
                        read: &[$( $( (stringify!($read), $crate::__net_number!(
                            ($name $line) $( $read_weight $(:: $read_weight_in)* )?
                        )), )+ )?],
                        changes: &[$( $( $crate::__private::source::Change {
                            name: stringify!($change),
                            by: $crate::__net_change!(
                                ($name $line $change) $change_by $value $(:: $value_in)*
                            ),
                        }, )+ )?],
                        emits: &[$( $( stringify!($emit), )+ )?],
                        within: $crate::__private::source::interval(
                            (stringify!($name), stringify!($line)),
                            &[
                                $( $crate::__net_interval!(
                                    ($name $line) [$earliest $(:: $earliest_in)*]
                                    $latest $(:: $latest_in)*
                                ), )?
                                $( $crate::__net_interval!(
                                    ($name $line) [$after $(:: $after_in)*]
                                ), )?
                            ],
                        ),
                        priority: $crate::__private::source::priority(
                            &[$( !!($priority) as i128, )? 0],
                        ),
                    }, )*],
                    ignored: &[$( $( $crate::__private::source::Ignore {
                        event: stringify!($ignored),
                        places: &[$( stringify!($ignored_in), )+],
                        guard: $crate::__net_guard!(($name ignore $ignored) [] $($($only)*)?),
                    }, )* )?],
                    laws: &[$( $( $crate::__net_claim!(($name) $law $(( $($law_of)* ))?), )* )?],
                }
            );
        }

        $(#[doc = $doc])*
        #[allow(long_running_const_eval, unreachable_pub)]
        $vis mod $name {
            #[allow(unused_imports)]
            use super::*;
            use $crate::__private::{lower as net_lower, source as net_source};
            use $crate::player::code as net_code;

            $crate::__definition! {
                ($) __net_extended [$($export)?] $name
                { $(constants { $( $(#[doc = $constant_doc])* $constant: $constant_is, )* })* }
                { $( $(#[doc = $place_doc])* $place $(: $tokens $(:: $tokens_in)*
                    $(of $bound $(:: $bound_in)*)?)?, )* }
                { $( $( $(#[doc = $flag_doc])* $flag $(: $flag_is $(:: $flag_in)*)?, )* )? }
                { $( $( $(#[doc = $counter_doc])* $counter: $count $(:: $count_in)*
                    of $largest $(:: $largest_in)*, )* )? }
                { $( $( $(#[doc = $shared_doc])* $shared $(: $shared_is $(:: $shared_in)*
                    $(of $shared_largest $(:: $shared_largest_in)*)?)?, )* )? }
                { $( $( $(#[doc = $event_doc])* $event $(( $payload ))?, )* )? }
                { $( $( $(#[doc = $output_doc])* $output, )* )? }
                { $( $( $(#[doc = $group_doc])* $group: $( $member )&+; )* )? }
                { $( $line {
                    $(#[doc = $line_doc])*
                    $line $(on $on)? $([ $($guard)* ])? :
                        $( $take $(* $take_weight $(:: $take_weight_in)*)? )&+
                        => $( $give $(* $give_weight $(:: $give_weight_in)*)? )&+
                        $(read $( $read $(* $read_weight $(:: $read_weight_in)*)? )&+ )?
                        $(do $( $change $change_by $value $(:: $value_in)* )&+ )?
                        $(emit $( $emit )&+ )?
                        $(within $earliest $(:: $earliest_in)*
                            ..= $latest $(:: $latest_in)* ms)?
                        $(after $after $(:: $after_in)* ms)?
                        $(priority $priority)?;
                } )* }
                { $( $( $ignored in $( $ignored_in )&+ $([ $($only)* ])?; )* )? }
                { $( $( $law $(( $($law_of)* ))?; )* )? }
            }

            const SOURCE: net_source::Source<'static> =
                <Program as $crate::__private::Written>::SOURCE;
            const SIZE: $crate::__private::lower::Size = SOURCE.size();
            const LOWERED: &net_lower::Lowered<
                'static,
                { SIZE.places },
                { SIZE.transitions },
                { SIZE.arcs },
                { SIZE.emits },
                { SIZE.text },
                { SIZE.ignored },
                { SIZE.laws },
            > = &net_lower::Lowered::of(&SOURCE);

            /// The net as plain data.
            pub const NET: $crate::net::Net<'static> = $crate::net::Net {
                name: SOURCE.name,
                doc: SOURCE.doc,
                places: &LOWERED.places(),
                events: SOURCE.events,
                outputs: SOURCE.outputs,
                transitions: &LOWERED.transitions(),
                ignored: &LOWERED.ignored(),
                laws: &LOWERED.laws(),
            };
            const ALONE: &[$crate::system::Component<'static>; 1] =
                &[$crate::system::Component::alone(&NET)];
            const SYSTEM: $crate::system::System<'static> =
                $crate::system::System::alone(ALONE);
            const MOST: net_code::Size = $crate::player::size::size_of(&SYSTEM);
            const LONG: &$crate::__arrays!(MOST) = &$crate::player::Arrays::of(&SYSTEM);
            const CODE_SIZE: net_code::Size = LONG.exact(MOST);
            const ARRAYS: &$crate::__arrays!(CODE_SIZE) =
                &$crate::player::Arrays::cut(&LONG.code(0, false));

            /// How the net was checked.
            pub const KNOWN: $crate::net::Known =
                $crate::net::check(&NET, &ARRAYS.code(0, false), SOURCE.left_to_checker());

            const CODE: net_code::Code<'static, { CODE_SIZE.words }> =
                ARRAYS.code(KNOWN.settle(), KNOWN.bounded());

            /// A place, flag, counter or shared place.
            #[allow(missing_docs, non_camel_case_types, dead_code)]
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
            #[allow(missing_docs, non_camel_case_types, dead_code)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub enum State {
                $( $(#[doc = $place_doc])* $place, )*
            }

            /// The events that the net accepts.
            #[allow(missing_docs, non_camel_case_types, dead_code)]
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub enum Event {
                $( $( $(#[doc = $event_doc])* $event $(($payload))?, )* )?
            }

            #[allow(dead_code, non_camel_case_types)]
            enum EventNumber {
                $( $( $event, )* )?
            }

            impl $crate::player::Kind for Event {
                #[inline] #[allow(unreachable_code)]
                fn id(&self) -> $crate::system::Of<$crate::net::EventId> {
                    let number = match *self {
                        $( $( Self::$event { .. } => EventNumber::$event as u32, )* )?
                    };
                    $crate::system::Of { component: 0, id: $crate::net::EventId(number) }
                }
            }

            /// The outputs that the net emits.
            #[allow(missing_docs, non_camel_case_types, dead_code)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub enum Output {
                $( $( $(#[doc = $output_doc])* $output, )* )?
            }

            /// The lines of the net's transitions.
            #[allow(missing_docs, non_camel_case_types, dead_code)]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub enum Transition {
                $( $(#[doc = $line_doc])* $line, )*
            }

            $crate::__logged_names! {
                Place {
                    $( $place )* $( $( $flag )* )? $( $( $counter )* )? $( $( $shared )* )?
                }
                State { $( $place )* }
                Event { $( $( $event )* )? }
                Output { $( $( $output )* )? }
                Transition { $( $line )* }
            }

            $crate::__event_names! {}

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
                    const ALL: &[Transition] =
                        &net_lower::by_line::<_, { SIZE.transitions }>(BY_LINE, &LINES);
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
                const ALONE: Option<bool> = Some(true);

                #[inline]
                fn code(&self) -> &net_code::Code<'_, { CODE_SIZE.words }> {
                    &CODE
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
            #[allow(dead_code)]
            pub type Player =
                $crate::player::Player<Program, { CODE_SIZE.words }, { CODE_SIZE.clocks }>;

            /// Plays the net and takes nothing to be proven: for stored markings, and for steps.
            #[allow(dead_code)]
            pub type Checked = $crate::player::Player<
                $crate::player::Checked<Program>,
                { CODE_SIZE.words },
                { CODE_SIZE.clocks },
            >;

            /// A transition that has just fired, as an observer of the player is told.
            #[allow(dead_code)]
            pub type Firing<'f> = $crate::player::Firing<'f, Program>;
        }
    };
    // The same with a definition that other crates may extend.
    ($(#[doc = $doc:expr])* #[macro_export] $vis:vis mod $name:ident $($rest:tt)+) => {
        $crate::net! { @macro_export $(#[doc = $doc])* $vis mod $name $($rest)+ }
    };
    // Another net with more: its definition hands its sections over.
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
        $crate::__net_mistake! { $name $($body)* }
        $crate::net! { @unread $(#[doc = $doc])* $vis mod $name { $($body)* } }
    };
}
