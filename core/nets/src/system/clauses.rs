//! Parts of the language `system!`: how links deliver, laws, mistakes.

/// When a link delivers.
#[doc(hidden)]
#[macro_export]
macro_rules! __system_delivery {
    ($of:tt now) => {
        $crate::system::Delivery::Now
    };
    (($system:ident $from:ident $output:ident) mail $capacity:expr) => {
        $crate::__private::system::mail(
            stringify!($system),
            (stringify!($from), stringify!($output)),
            !!($capacity) as i128,
        )
    };
    (($system:ident $from:ident $output:ident) $($other:tt)*) => {
        compile_error!(concat!(
            "system `",
            stringify!($system),
            "`, link ",
            stringify!($from),
            ".",
            stringify!($output),
            ": say when it arrives: `now`, in the same step, or `mail 1`, ",
            "at the turn of its receiver, in a mailbox with room for 1"
        ))
    };
}

/// A law.
#[doc(hidden)]
#[macro_export]
macro_rules! __system_claim {
    ($system:ident handles ( all )) => {
        $crate::__private::system::Claim::HandlesAll
    };
    ($system:ident left_to_checker) => {
        $crate::__private::system::Claim::LeftToChecker
    };
    ($system:ident $($other:tt)*) => {
        compile_error!(concat!(
            "system `",
            stringify!($system),
            "`: there is no law `",
            stringify!($($other)*),
            "`; there are `handles(all)` and `left_to_checker`"
        ))
    };
}

/// Names what is wrong with a definition that cannot be read: its sections.
#[doc(hidden)]
#[macro_export]
macro_rules! __system_mistake {
    (
        $system:ident
        nets $nets:tt
        $(links $links:tt)?
        $(shared $shared:tt)?
        $(pending $pending:tt)?
        $(clears $clears:tt)?
        $(laws $laws:tt)?
    ) => {};
    ($system:ident $( $section:ident { $($in:tt)* } )*) => {
        compile_error!(concat!(
            "system `",
            stringify!($system),
            "`: its sections are ",
            $("`", stringify!($section), "`, ",)*
            "and they come in this order, each once: `nets`, `links`, `shared`, `pending`, ",
            "`clears` and `laws`; `nets` must be there"
        ));
    };
    ($($other:tt)*) => {};
}
