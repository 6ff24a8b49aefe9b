//! Parts of the language `net!`: constants, guards, changes and laws.

/// A value in which constants are known, each group also to those after it.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_constants {
    ({ $( $(#[doc = $doc:expr])* $constant:ident : $is:expr, )* } $($rest:tt)+) => {{
        $(
            $(#[doc = $doc])*
            #[allow(dead_code, non_upper_case_globals)]
            const $constant: i128 = !!($is) as i128;
        )*
        $crate::__net_constants!($($rest)+)
    }};
    ($value:expr) => { $value };
}

/// A number of a part of a net, one without a number.
/// Names of events for the transitions of a net or a system, which is `SYSTEM` there.
#[doc(hidden)]
#[macro_export]
macro_rules! __event_names {
    () => {
        impl $crate::player::EventNames for Transition {
            fn event(
                event: $crate::system::Of<$crate::net::EventId>,
                f: &mut ::core::fmt::Formatter<'_>,
            ) -> ::core::fmt::Result {
                <Self as $crate::player::EventNames>::event_of(&SYSTEM, event, f)
            }
        }
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! __net_number {
    ($of:tt) => { 1 };
    (($net:ident $part:ident) $($number:tt)+) => {
        $crate::__private::source::number(
            (stringify!($net), stringify!($part)), !!($($number)+) as i128,
        )
    };
    (($net:ident $part:ident $event:ident) $($number:tt)+) => {
        $crate::__net_number!(($net $part) $($number)+)
    };
}

/// An interval: when it begins, and when it ends.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_interval {
    ($of:tt [$($earliest:tt)+]) => { ($crate::__net_number!($of $($earliest)+), None) };
    ($of:tt [$($earliest:tt)+] $($latest:tt)+) => {
        (
            $crate::__net_number!($of $($earliest)+),
            Some($crate::__net_number!($of $($latest)+)),
        )
    };
}

/// The conditions of a guard.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_guard {
    ($of:tt [$($done:tt)*]) => { &[$($done)*] };
    ($of:tt [$($done:tt)*] & $($rest:tt)+) => { $crate::__net_guard!($of [$($done)*] $($rest)+) };
    ($of:tt [$($done:tt)*] ! $name:ident $($rest:tt)*) => {
        $crate::__net_guard!($of [$($done)* $crate::__net_test!($of $name AtMost 0),] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident < $value:tt $($rest:tt)*) => {
        $crate::__net_compared!($of [$($done)*] $name Less [$value] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident <= $value:tt $($rest:tt)*) => {
        $crate::__net_compared!($of [$($done)*] $name AtMost [$value] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident == $value:tt $($rest:tt)*) => {
        $crate::__net_compared!($of [$($done)*] $name Equal [$value] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident >= $value:tt $($rest:tt)*) => {
        $crate::__net_compared!($of [$($done)*] $name AtLeast [$value] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident > $value:tt $($rest:tt)*) => {
        $crate::__net_compared!($of [$($done)*] $name More [$value] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident $($rest:tt)*) => {
        $crate::__net_guard!($of [$($done)* $crate::__net_test!($of $name AtLeast 1),] $($rest)*)
    };
    (($net:ident $line:ident) $done:tt $($rest:tt)+) => {
        $crate::__net_no_guard!($net ", transition `" $line [$($rest)+] "transitions")
    };
    (($net:ident ignore $event:ident) $done:tt $($rest:tt)+) => {
        $crate::__net_no_guard!($net ", ignore of `" $event [$($rest)+] "lines")
    };
}

/// Ends the compilation: this is no guard.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_no_guard {
    ($net:ident $of:literal $line:ident [$($rest:tt)+] $several:literal) => {
        compile_error!(concat!(
            "net `", stringify!($net), "`", $of, stringify!($line), "`: `",
            stringify!($($rest)+), "` cannot be part of a guard, which is a conjunction as ",
            "`[flag & !other & counter < 3]`; write an `or` as two ", $several
        ))
    };
}

/// A comparison of a guard, whose number may be the path of a constant.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_compared {
    ($of:tt [$($done:tt)*] $name:ident $how:ident [$($value:tt)+] :: $in:ident $($rest:tt)*) => {
        $crate::__net_compared!($of [$($done)*] $name $how [$($value)+ :: $in] $($rest)*)
    };
    ($of:tt [$($done:tt)*] $name:ident $how:ident [$($value:tt)+] $($rest:tt)*) => {
        $crate::__net_guard!(
            $of [$($done)* $crate::__net_test!($of $name $how $($value)+),] $($rest)*
        )
    };
}

/// One condition of a guard.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_test {
    ($of:tt $name:ident $relation:ident $($value:tt)+) => {
        $crate::__private::source::Test {
            name: stringify!($name),
            relation: $crate::__private::source::Relation::$relation,
            value: $crate::__net_number!($of $($value)+),
        }
    };
}

/// How a value changes.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_change {
    (($net:ident $line:ident $change:ident) += $($value:tt)+) => {
        $crate::__private::source::By::Add($crate::__net_number!(($net $line) $($value)+))
    };
    (($net:ident $line:ident $change:ident) -= $($value:tt)+) => {
        $crate::__private::source::By::Subtract($crate::__net_number!(($net $line) $($value)+))
    };
    (($net:ident $line:ident $change:ident) = $($value:tt)+) => {
        $crate::__private::source::By::Become($crate::__net_number!(($net $line) $($value)+))
    };
    (($net:ident $line:ident $change:ident) $($other:tt)*) => {
        compile_error!(concat!(
            "net `", stringify!($net), "`, transition `", stringify!($line), "`: `",
            stringify!($change), " ", stringify!($($other)*), "` is no change; there are ",
            "`counter += 1`, `counter -= 1`, `counter = 0` and `flag = true`"
        ))
    };
}

/// A law.
#[doc(hidden)]
#[macro_export]
macro_rules! __net_claim {
    (($net:ident) invariant (
        $( $place:ident $(* $weight:tt $(:: $weight_in:ident)*)? )&+ = $($sum:tt)+
    )) => {
        $crate::__private::source::Claim::Invariant(
            &[$( (stringify!($place), $crate::__net_number!(
                ($net laws) $( $weight $(:: $weight_in)* )?
            )), )+],
            $crate::__net_number!(($net laws) $($sum)+),
        )
    };
    ($of:tt never_both ( $a:ident, $b:ident )) => {
        $crate::__private::source::Claim::NeverBoth(stringify!($a), stringify!($b))
    };
    ($of:tt reachable ( $place:ident )) => {
        $crate::__private::source::Claim::Reachable(stringify!($place))
    };
    ($of:tt always_can ( $place:ident )) => {
        $crate::__private::source::Claim::AlwaysCan(stringify!($place))
    };
    ($of:tt handles ( all )) => { $crate::__private::source::Claim::HandlesAll };
    ($of:tt settles) => { $crate::__private::source::Claim::Settles };
    ($of:tt deadlock_free) => { $crate::__private::source::Claim::DeadlockFree("") };
    ($of:tt deadlock_free_except ( $place:ident )) => {
        $crate::__private::source::Claim::DeadlockFree(stringify!($place))
    };
    ($of:tt deterministic) => { $crate::__private::source::Claim::Deterministic };
    ($of:tt left_to_checker) => { $crate::__private::source::Claim::LeftToChecker };
    (($net:ident) $law:ident $(( $($other:tt)* ))?) => {
        compile_error!(concat!(
            "net `", stringify!($net), "`: no law is written `", stringify!($law)
            $(, "(", stringify!($($other)*), ")")?, "`; there are `invariant(A & B * 2 = 1)`, ",
            "`never_both(A, B)`, `reachable(A)`, `always_can(A)`, `handles(all)`, `settles`, ",
            "`deadlock_free`, `deadlock_free_except(A)`, `deterministic` and `left_to_checker`"
        ))
    };
}
