//! Mistakes in the language `net!`, each with its cure.
//!
//! A definition that is not of the grammar comes here. A mistake that is known is named with its
//! cure; the compiler's own words, which point at the token, stand beside it: the definition is
//! read once more, marked `@unread`. A definition that is of the grammar never comes here.

/// Names what is wrong with a definition that cannot be read: its sections, or what is in them.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_mistake {
    (
        $net:ident
        $(constants $constants:tt)*
        places { $($places:tt)* }
        $(flags { $($flags:tt)* })?
        $(counters { $($counters:tt)* })?
        $(shared { $($shared:tt)* })?
        $(events { $($events:tt)* })?
        $(outputs { $($outputs:tt)* })?
        $(groups $groups:tt)?
        $(instead { $($instead:tt)* })?
        transitions { $($lines:tt)* }
        $(ignore { $($ignored:tt)* })?
        $(laws { $($laws:tt)* })?
    ) => {
        $crate::__net_items! { $net places $($places)* }
        $( $crate::__net_items! { $net flags $($flags)* } )?
        $( $crate::__net_items! { $net counters $($counters)* } )?
        $( $crate::__net_items! { $net shared $($shared)* } )?
        $( $crate::__net_items! { $net events $($events)* } )?
        $( $crate::__net_items! { $net outputs $($outputs)* } )?
        $crate::__net_lines! { @ $net $($lines)* }
        $( $crate::__net_ignored! { $net $($ignored)* } )?
        $( $crate::__net_laws! { $net $($laws)* } )?
    };
    ($net:ident $( $section:ident { $($in:tt)* } )* ) => {
        compile_error!(concat!(
            "net `", stringify!($net), "`: its sections are ",
            $( "`", stringify!($section), "`, ", )* "and they come in this order, each once: ",
            "`constants`, `places`, `flags`, `counters`, `shared`, `events`, `outputs`, ",
            "`groups`, `transitions`, `ignore` and `laws`; `places` and `transitions` must be there"
        ));
    };
    ($($other:tt)*) => {};
}

/// Names what is wrong with an extension that cannot be read.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_extension_mistake {
    (
        $base:ident
        $(constants $constants:tt)*
        $(places $places:tt)?
        $(flags $flags:tt)?
        $(counters $counters:tt)?
        $(shared $shared:tt)?
        $(events $events:tt)?
        $(outputs $outputs:tt)?
        $(groups $groups:tt)?
        $(instead { $($instead:tt)* })?
        $(transitions $lines:tt)?
        $(ignore $ignored:tt)?
        $(laws $laws:tt)?
    ) => {
        $( $crate::__net_lines! { @ $base $($instead)* } )?
    };
    ($base:ident $( $section:ident { $($in:tt)* } )* ) => {
        compile_error!(concat!(
            "net `", stringify!($base), "` is extended by the sections ",
            $( "`", stringify!($section), "`, ", )* "and they come in this order, each once: ",
            "`constants`, `places`, `flags`, `counters`, `shared`, `events`, `outputs`, ",
            "`groups`, `instead`, `transitions`, `ignore` and `laws`"
        ));
    };
    ($($other:tt)*) => {};
}

/// Names what is wrong between the items of a section.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_items {
    (
        $net:ident $section:ident
        $( #[doc = $doc:expr] )* $item:ident $(: $is:tt $(:: $is_in:ident)*
            $(of $of:tt $(:: $of_in:ident)*)?)? $(( $payload:ty ))? ; $($rest:tt)*
    ) => {
        compile_error!(concat!(
            "net `",
            stringify!($net),
            "`, `",
            stringify!($section),
            "`: a comma stands behind `",
            stringify!($item),
            "`, not a semicolon"
        ));
    };
    ($net:ident $section:ident $(#[doc = $doc:expr])* $item:ident = $($rest:tt)*) => {
        compile_error!(concat!(
            "net `",
            stringify!($net),
            "`, `",
            stringify!($section),
            "`: a colon stands behind `",
            stringify!($item),
            "`, as in `",
            stringify!($item),
            ": 1`"
        ));
    };
    ($net:ident counters $(#[doc = $doc:expr])* $item:ident $(: $is:tt $(:: $is_in:ident)*)?
        $(, $($rest:tt)*)?
    ) => {
        compile_error!(concat!(
            "net `",
            stringify!($net),
            "`: counter `",
            stringify!($item),
            "` has its largest value beside its first, as in `",
            stringify!($item),
            ": 0 of 3`"
        ));
    };
    ($($other:tt)*) => {};
}

/// Looks for the first line that cannot be read, among as many as there are dots: a step for each
/// meets the compiler's limit of 128 soon after.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_lines {
    (@ $net:ident $($lines:tt)*) => {
        $crate::__net_lines! {
            $net
            [
                . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . .
                    . . . . . . . .
                . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . .
                    . . . . . . . .
            ]
            $($lines)*
        }
    };
    (
        $net:ident [. $($left:tt)*]
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
        $($rest:tt)*
    ) => {
        $crate::__net_lines! { $net [$($left)*] $($rest)* }
    };
    ($net:ident [. $($left:tt)*] $(#[doc = $doc:expr])* $line:ident $($rest:tt)*) => {
        $crate::__net_line! { ($net $line) $($rest)* }
    };
    ($($other:tt)*) => {};
}

/// Names what is wrong with the beginning of a line, up to its places.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_line {
    ($of:tt $(on $on:ident)? $([ $($guard:tt)* ])? : $($rest:tt)+) => {
        $crate::__net_taken! { $of $($rest)+ }
    };
    (($net:ident $line:ident) [ $($guard:tt)* ] on $on:ident $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line)
            "the event stands before the guard: `", stringify!($line), " on ", stringify!($on),
                " [",
            stringify!($($guard)*), "]: ..`",
        }
    };
    (($net:ident $line:ident) $(on $on:ident)? if $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line)
            "a guard stands in brackets: `", stringify!($line), $( " on ", stringify!($on), )?
            " [flag & counter < 3]: ..`",
        }
    };
    (($net:ident $line:ident) on $on:ident ( $($payload:tt)* ) $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line)
            "an event stands without its payload: `", stringify!($line), " on ", stringify!($on),
                ": ..`",
        }
    };
    (($net:ident $line:ident) on $on:ident & $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line) "it waits for one event; write a line for each event", }
    };
    (($net:ident $line:ident) on $on:ident | $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line) "it waits for one event; write a line for each event", }
    };
    (($net:ident $line:ident) on $on:ident, $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line) "it waits for one event; write a line for each event", }
    };
    (($net:ident $line:ident) $event:ident $([ $($guard:tt)* ])? : $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line)
            "`on` is missing before the event: `", stringify!($line), " on ", stringify!($event),
            $( " [", stringify!($($guard)*), "]", )? ": ..`",
        }
    };
    (($net:ident $line:ident) on $on:ident $([ $($guard:tt)* ])? $place:ident $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line)
            "a colon stands before its places: `", stringify!($line), " on ", stringify!($on),
            $( " [", stringify!($($guard)*), "]", )? ": ", stringify!($place), " ..`",
        }
    };
    (($net:ident $line:ident) $place:ident => $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line)
            "a colon stands before its places: `", stringify!($line), ": ", stringify!($place),
            " => ..`",
        }
    };
    (($net:ident $line:ident) => $($rest:tt)*) => {
        $crate::__net_cure! { ($net $line)
            "a line begins with a name of its own: `name on Event: ", stringify!($line), " => ..`",
        }
    };
    ($($other:tt)*) => {};
}

/// Names what is wrong with the places of a line.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_taken {
    ($of:tt $( $place:tt $(* $weight:tt $(:: $weight_in:ident)*)? )&+ => $($rest:tt)*) => {
        $crate::__net_given! { $of $($rest)* }
    };
    ($of:tt $( $place:tt $(* $weight:tt $(:: $weight_in:ident)*)? )&+ -> $($rest:tt)*) => {
        $crate::__net_cure! { $of "the arrow is `=>`, not `->`" }
    };
    ($of:tt $( $place:tt $(* $weight:tt $(:: $weight_in:ident)*)? )&+ , $($rest:tt)*) => {
        $crate::__net_and! { $of "places" "Idle & Ready" } };
    ($of:tt $( $place:tt $(* $weight:tt $(:: $weight_in:ident)*)? )&+ + $($rest:tt)*) => {
        $crate::__net_and! { $of "places" "Idle & Ready" } };
    ($of:tt => $($rest:tt)*) => {
        $crate::__net_cure! { $of "where no place is taken, `_` stands before `=>`", }
    };
    ($($other:tt)*) => {};
}

/// Names what is wrong with the places that get a token.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_given {
    ($of:tt ; $($rest:tt)*) => {
        $crate::__net_cure! { $of "where no place gets a token, `_` stands behind `=>`", }
    };
    ($of:tt $( $place:tt $(* $weight:tt $(:: $weight_in:ident)*)? )&+ $(; $($rest:tt)*)?) => {
        $crate::__net_clauses! { $of [] $(; $($rest)*)? } };
    ($of:tt $( $place:tt $(* $weight:tt $(:: $weight_in:ident)*)? )&+ $clause:ident $($rest:tt)*)
        => {
        $crate::__net_clauses! { $of [] $clause $($rest)* }
    };
    ($of:tt $( $place:tt $(* $weight:tt $(:: $weight_in:ident)*)? )&+ , $($rest:tt)*) => {
        $crate::__net_and! { $of "places" "Idle & Ready" } };
    ($of:tt $( $place:tt $(* $weight:tt $(:: $weight_in:ident)*)? )&+ + $($rest:tt)*) => {
        $crate::__net_and! { $of "places" "Idle & Ready" } };
    ($of:tt $( $place:tt $(* $weight:tt $(:: $weight_in:ident)*)? )&+ [ $($guard:tt)* ]
        $($rest:tt)*) => {
        $crate::__net_cure! { $of
            "the guard stands before the colon, behind the event: `name on Event [",
            stringify!($($guard)*), "]: ..`",
        }
    };
    ($($other:tt)*) => {};
}

/// Names what is wrong with the clauses behind the places; those before are known.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_clauses {
    ($of:tt [$($before:ident)*] read $( $read:ident $(* $weight:tt $(:: $weight_in:ident)*)? )&+
        $(; $($rest:tt)*)?) => {
        $crate::__net_clauses! { $of [$($before)* read] $(; $($rest)*)? }
    };
    ($of:tt [$($before:ident)*] read $( $read:ident $(* $weight:tt $(:: $weight_in:ident)*)? )&+
        $clause:ident $($rest:tt)*) => {
        $crate::__net_clauses! { $of [$($before)* read] $clause $($rest)* }
    };
    ($of:tt $before:tt read $( $read:ident $(* $weight:tt $(:: $weight_in:ident)*)? )&+ ,
        $($rest:tt)*) => {
        $crate::__net_and! { $of "places" "read Idle & Ready" }
    };
    ($of:tt [$($before:ident)*] do $( $change:ident $by:tt $value:tt $(:: $value_in:ident)* )&+ $(;
        $($rest:tt)*)?) => {
        $crate::__net_clauses! { $of [$($before)* do] $(; $($rest)*)? }
    };
    ($of:tt [$($before:ident)*] do $( $change:ident $by:tt $value:tt $(:: $value_in:ident)* )&+
        $clause:ident $($rest:tt)*) => {
        $crate::__net_clauses! { $of [$($before)* do] $clause $($rest)* }
    };
    ($of:tt $before:tt do $( $change:ident $by:tt $value:tt $(:: $value_in:ident)* )&+ ,
        $($rest:tt)*) => {
        $crate::__net_and! { $of "changes" "do tries += 1 & lost = false" }
    };
    ($of:tt [$($before:ident)*] emit $( $emit:ident )&+ $(; $($rest:tt)*)?) => {
        $crate::__net_clauses! { $of [$($before)* emit] $(; $($rest)*)? }
    };
    ($of:tt [$($before:ident)*] emit $( $emit:ident )&+ $clause:ident $($rest:tt)*) => {
        $crate::__net_clauses! { $of [$($before)* emit] $clause $($rest)* }
    };
    ($of:tt $before:tt emit $( $emit:ident )&+ , $($rest:tt)*) => {
        $crate::__net_and! { $of "outputs" "emit Stop & Warn" }
    };
    ($of:tt $before:tt emit $emit:ident ( $($payload:tt)* ) $($rest:tt)*) => {
        $crate::__net_cure! { $of "an output carries nothing: `emit ", stringify!($emit), "`", }
    };
    ($of:tt [$($before:ident)*] within $earliest:tt $(:: $earliest_in:ident)* ..= $latest:tt $(::
        $latest_in:ident)* ms $(; $($rest:tt)*)?) => {
        $crate::__net_clauses! { $of [$($before)* within] $(; $($rest)*)? }
    };
    ($of:tt [$($before:ident)*] within $earliest:tt $(:: $earliest_in:ident)* ..= $latest:tt $(::
        $latest_in:ident)* ms $clause:ident $($rest:tt)*) => {
        $crate::__net_clauses! { $of [$($before)* within] $clause $($rest)* }
    };
    ($of:tt $before:tt within $earliest:tt $(:: $earliest_in:ident)* ..= $latest:tt $(::
        $latest_in:ident)* $(; $($rest:tt)*)?) => {
        $crate::__net_unit! { $of }
    };
    ($of:tt $before:tt within $earliest:tt $(:: $earliest_in:ident)* ..= $latest:tt $(::
        $latest_in:ident)* $unit:ident $($rest:tt)*) => {
        $crate::__net_unit! { $of }
    };
    ($of:tt [$($before:ident)*] after $after:tt $(:: $after_in:ident)* ms $(; $($rest:tt)*)?) => {
        $crate::__net_clauses! { $of [$($before)* after] $(; $($rest)*)? }
    };
    ($of:tt [$($before:ident)*] after $after:tt $(:: $after_in:ident)* ms $clause:ident
        $($rest:tt)*) => {
        $crate::__net_clauses! { $of [$($before)* after] $clause $($rest)* }
    };
    ($of:tt $before:tt after $after:tt $(:: $after_in:ident)* $(; $($rest:tt)*)?) => {
        $crate::__net_unit! { $of }
    };
    ($of:tt $before:tt after $after:tt $(:: $after_in:ident)* $unit:ident $($rest:tt)*) => {
        $crate::__net_unit! { $of }
    };
    ($of:tt $before:tt within $at:tt $(:: $at_in:ident)* ms $($rest:tt)*) => {
        $crate::__net_interval_cure! { $of $at $(:: $at_in)* }
    };
    ($of:tt $before:tt within $at:tt $(:: $at_in:ident)* $(; $($rest:tt)*)?) => {
        $crate::__net_unit! { $of }
    };
    ($of:tt $before:tt within $at:tt $(:: $at_in:ident)* $unit:ident $($rest:tt)*) => {
        $crate::__net_unit! { $of }
    };
    ($of:tt $before:tt within $earliest:tt $(:: $earliest_in:ident)* .. $($rest:tt)*) => {
        $crate::__net_cure! { $of
            "the last instant belongs to an interval: `within ", stringify!($earliest),
            $( "::", stringify!($earliest_in), )* "..=2_000 ms`",
        }
    };
    ($of:tt [$($before:ident)*] priority $priority:tt $(; $($rest:tt)*)?) => {
        $crate::__net_clauses! { $of [$($before)* priority] $(; $($rest)*)? }
    };
    ($of:tt [$($before:ident)*] priority $priority:tt $clause:ident $($rest:tt)*) => {
        $crate::__net_clauses! { $of [$($before)* priority] $clause $($rest)* }
    };
    ($of:tt [$($before:ident)*]) => { $crate::__net_cure! { $of "a semicolon ends it", } };
    ($of:tt [$($before:ident)+] ; $($rest:tt)*) => {
        $crate::__net_cure! { $of
            "its clauses are ", $( "`", stringify!($before), "`, ", )+ "and they come in this ",
            "order, each once: `read`, `do`, `emit`, `within` or `after`, `priority`",
        }
    };
    ($of:tt $before:tt read $($rest:tt)*) => {};
    ($of:tt $before:tt do $($rest:tt)*) => {};
    ($of:tt $before:tt emit $($rest:tt)*) => {};
    ($of:tt $before:tt within $($rest:tt)*) => {};
    ($of:tt $before:tt after $($rest:tt)*) => {};
    ($of:tt $before:tt priority $($rest:tt)*) => {};
    ($of:tt $before:tt $word:ident $($rest:tt)*) => {
        $crate::__net_cure! { $of
            "`", stringify!($word), "` is no clause: a semicolon is missing before it, or one of ",
            "`read`, `do`, `emit`, `within`, `after` and `priority` is meant",
        }
    };
    ($($other:tt)*) => {};
}

/// Names what is wrong with the lines of `ignore`.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_ignored {
    ($net:ident $( $event:ident in $( $place:ident )&+ $([ $($guard:tt)* ])? ; )*) => {};
    ($net:ident $(
        $event:ident $( , $another:ident )* in $( $place:ident )&+ $( , $other:ident )*
            $([ $($guard:tt)* ])? $(;)?
    )*) => {
        compile_error!(concat!(
            "net `",
            stringify!($net),
            "`, `ignore`: a line is one event and the places where it is ",
            "left unanswered, as in `Stop in Idle & Busy;`, and a semicolon ends it"
        ));
    };
    ($($other:tt)*) => {};
}

/// Names what is wrong with the laws.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_laws {
    ($net:ident $( $law:ident $(( $($of:tt)* ))? ; )*) => {};
    ($net:ident $( $law:ident $(( $($of:tt)* ))? $(;)? $(,)? )*) => {
        compile_error!(concat!(
            "net `",
            stringify!($net),
            "`, `laws`: a semicolon ends a law, as in `handles(all);`"
        ));
    };
    ($($other:tt)*) => {};
}

/// Ends the compilation: places, changes or outputs are joined by `&`.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_and {
    ($of:tt $parts:literal $example:literal) => {
        $crate::__net_cure! { $of "several ", $parts, " are joined by `&`, as in `", $example, "`",
        }
    };
}

/// Ends the compilation: an interval has two ends.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_interval_cure {
    ($of:tt $at:tt $(:: $at_in:ident)*) => {
        $crate::__net_cure! { $of
            "an interval is `within ", stringify!($at), $( "::", stringify!($at_in), )* "..=",
            stringify!($at), $( "::", stringify!($at_in), )* " ms`, or without an end `after ",
            stringify!($at), $( "::", stringify!($at_in), )* " ms`",
        }
    };
}

/// Ends the compilation: the unit is not milliseconds.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_unit {
    ($of:tt) => {
        $crate::__net_cure! { $of
            "times are in milliseconds, and `ms` is a word of its own: `within 500..=2_000 ms`, ",
            "`after 500 ms`",
        }
    };
}

/// Ends the compilation with what is wrong with a line.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_cure {
    (($net:ident $line:ident) $($words:tt)+) => {
        compile_error!(concat!(
            "net `", stringify!($net), "`, transition `", stringify!($line), "`: ", $($words)+
        ));
    };
}
