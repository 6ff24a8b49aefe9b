//! Parts of the languages `net!` and `system!`: one that is another with more.

/// Keeps the sections of a net or system, each item with its end, for those that extend it.
#[doc(hidden)]
#[macro_export]
macro_rules! __definition {
    (($d:tt) $extended:ident [] $name:ident $($sections:tt)*) => {
        #[doc(hidden)]
        #[allow(unused_macros)]
        macro_rules! definition {
            ($d($d extension:tt)*) => {
                $crate::$extended! { $($sections)* $d($d extension)* }
            };
        }
        #[doc(hidden)]
        #[allow(unused_imports)]
        pub(crate) use definition;
    };
    (($d:tt) $extended:ident [$export:ident] $name:ident $($sections:tt)*) => {
        #[doc(hidden)]
        #[$export]
        macro_rules! $name {
            ($d($d extension:tt)*) => {
                $crate::$extended! { $($sections)* $d($d extension)* }
            };
        }
        #[doc(hidden)]
        pub use $name as definition;
    };
}

/// The sections of a net and those of its extension, as one net.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_extended {
    (
        $(@ $unread:ident)?
        { $($constants:tt)* } { $($places:tt)* } { $($flags:tt)* } { $($counters:tt)* }
        { $($shared:tt)* } { $($events:tt)* } { $($outputs:tt)* } { $($groups:tt)* }
        { $($lines:tt)* } { $($ignored:tt)* } { $($laws:tt)* }
        { $($head:tt)* } $base:ident $(:: $base_in:ident)* {
            $(constants { $($more_constants:tt)* })?
            $(places { $($more_places:tt)* })?
            $(flags { $($more_flags:tt)* })?
            $(counters { $($more_counters:tt)* })?
            $(shared { $($more_shared:tt)* })?
            $(events { $($more_events:tt)* })?
            $(outputs { $($more_outputs:tt)* })?
            $(groups { $($more_groups:tt)* })?
            $(instead { $(
                $(#[doc = $line_doc:expr])*
                $old:ident $(on $on:ident)? $([ $($guard:tt)* ])? :
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
            )* })?
            $(transitions { $($more_lines:tt)* })?
            $(ignore { $($more_ignored:tt)* })?
            $(laws { $($more_laws:tt)* })?
        }
    ) => {
        const _: () = $crate::__private::source::replaced(
            &<$base $(:: $base_in)* ::Program as $crate::__private::Written>::SOURCE,
            &[$( $( stringify!($old), )* )?],
        );
        $crate::__replaced! {
            ($) net
            {}
            { $( $( $old {
                $(#[doc = $line_doc])*
                $old $(on $on)? $([ $($guard)* ])? :
                    $( $take $(* $take_weight $(:: $take_weight_in)*)? )&+
                    => $( $give $(* $give_weight $(:: $give_weight_in)*)? )&+
                    $(read $( $read $(* $read_weight $(:: $read_weight_in)*)? )&+ )?
                    $(do $( $change $change_by $value $(:: $value_in)* )&+ )?
                    $(emit $( $emit )&+ )?
                    $(within $earliest $(:: $earliest_in)* ..= $latest $(:: $latest_in)* ms)?
                    $(after $after $(:: $after_in)* ms)?
                    $(priority $priority)?;
            } )* )? }
            { $($lines)* }
            { $($head)* }
            {
                $($constants)*
                $(constants { $($more_constants)* })?
                places { $($places)* $($($more_places)*)? }
                flags { $($flags)* $($($more_flags)*)? }
                counters { $($counters)* $($($more_counters)*)? }
                shared { $($shared)* $($($more_shared)*)? }
                events { $($events)* $($($more_events)*)? }
                outputs { $($outputs)* $($($more_outputs)*)? }
                groups { $($groups)* $($($more_groups)*)? }
                transitions
            }
            { $($($more_lines)*)? }
            {
                ignore { $($ignored)* $($($more_ignored)*)? }
                laws { $($laws)* $($($more_laws)*)? }
            }
        }
    };
    // An extension that cannot be read: the cure, and the compiler's own words at the token.
    ({ $($constants:tt)* } $a:tt $b:tt $c:tt $d:tt $e:tt $f:tt $g:tt $h:tt $i:tt $j:tt
        $head:tt $base:ident $(:: $base_in:ident)* { $($more:tt)* }
    ) => {
        $crate::__net_extension_mistake! { $base $($more)* }
        $crate::__net_extended! {
            @unread { $($constants)* } $a $b $c $d $e $f $g $h $i $j
            $head $base $(:: $base_in)* { $($more)* }
        }
    };
}

/// The sections of a system and those of its extension, as one system.
#[doc(hidden)]
#[macro_export]
macro_rules! __system_extended {
    (
        { $($nets:tt)* } { $($links:tt)* } { $($shared:tt)* } { $($pending:tt)* } { $($clears:tt)* }
        { $($laws:tt)* } { $($head:tt)* } $base:ident $(:: $base_in:ident)* {
            $(instead { $( $old:ident : $new:ident $(:: $new_in:ident)* ),* $(,)? })?
            $(nets before $place:ident {
                $( $inserted:ident : $inserted_net:ident $(:: $inserted_in:ident)* ),* $(,)?
            })*
            $(nets { $($more_nets:tt)* })?
            $(links { $($more_links:tt)* })?
            $(shared { $($more_shared:tt)* })?
            $(pending { $($more_pending:tt)* })?
            $(clears { $($more_clears:tt)* })?
            $(laws { $($more_laws:tt)* })?
        }
    ) => {
        const _: () = $crate::__private::system::replaced::<$base $(:: $base_in)* ::Program>(
            $base $(:: $base_in)* ::SYSTEM.name,
            &[$( $( stringify!($old), )* )? $( stringify!($place), )*],
        );
        $crate::__replaced! {
            ($) system
            { $( $place {
                $( $inserted: $inserted_net $(:: $inserted_in)*, )*
            } )* }
            { $( $( $old { $old: $new $(:: $new_in)*, } )* )? }
            { $($nets)* }
            { $($head)* }
            { nets }
            { $($($more_nets)*)? }
            {
                links { $($links)* $($($more_links)*)? }
                shared { $($shared)* $($($more_shared)*)? }
                pending { $($pending)* $($($more_pending)*)? }
                clears { $($clears)* $($($more_clears)*)? }
                laws { $($laws)* $($($more_laws)*)? }
            }
        }
    };
}

/// A definition in which some named parts of one section are replaced, or others stand before them:
/// what it is made with, what stands before which part, what replaces which part, the parts, the
/// beginning of the definition, the sections before, what is added, the sections after.
#[doc(hidden)]
#[macro_export]
macro_rules! __replaced {
    (
        $d:tt $made:ident {} {} { $( $part:ident { $($body:tt)* } )* }
        { $($head:tt)* } { $($before:tt)* } { $($more:tt)* } { $($after:tt)* }
    ) => {
        $crate::$made! { $($head)* { $($before)* { $( $($body)* )* $($more)* } $($after)* } }
    };
    (
        ($d:tt) $made:ident
        { $( $place:ident { $($inserted:tt)* } )* } { $( $old:ident { $($new:tt)* } )* }
        { $($parts:tt)* } { $($head:tt)* } { $($before:tt)* } { $($more:tt)* } { $($after:tt)* }
    ) => {
        // One part after the other: the names of those that are replaced are looked for as tokens.
        // A part that has others before it comes again, marked, after them.
        macro_rules! __parts {
            $( ([$d($d done:tt)*] $place { $d($d body:tt)* } $d($d rest:tt)*) => {
                __parts! { [$d($d done)* $($inserted)*] + $place { $d($d body)* } $d($d rest)* }
            }; )*
            $( ([$d($d done:tt)*] $d(+)? $old { $d($d body:tt)* } $d($d rest:tt)*) => {
                __parts! { [$d($d done)* $($new)*] $d($d rest)* }
            }; )*
            ([$d($d done:tt)*] $d(+)? $d part:ident { $d($d body:tt)* } $d($d rest:tt)*) => {
                __parts! { [$d($d done)* $d($d body)*] $d($d rest)* }
            };
            ([$d($d done:tt)*]) => {
                $crate::$made! {
                    $($head)* { $($before)* { $d($d done)* $($more)* } $($after)* }
                }
            };
        }
        __parts! { [] $($parts)* }
    };
}
