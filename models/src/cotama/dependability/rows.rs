//! The form of the FMECA: `rows!` makes of it what firmware needs and what people read.
//!
//! A row is: name, id, function, component, failure { cause, effect; severity (autonomous,
//! operator), class, persistence; lost (words, modules, resources); seen by (words, words, latency
//! in ms; flags always, flags sometimes, modules without which and with which it cannot be); answer
//! (report, words, what an adapter changes or why nothing is); rate (MTBF in thousandths of an
//! hour, label, source), injection }.

macro_rules! rows {
    ($($mode:ident $id:literal $function:literal $component:literal $failure:literal {
        cause $cause:literal, effect $effect:literal;
        severity $autonomous:ident $operator:ident, class $class:ident, $persistence:ident;
        lost $modules:literal $faulty:tt [$($lost:ident),*];
        seen $observer:literal $detection:literal $latency:literal ($($signature:tt)*);
        answer $report:tt $reaction:literal
        $(, adjusts $adjustment:ident)? $(, tolerated $tolerated:literal)?;
        rate $mtbf:literal $label:ident $rate:literal, injection $injection:literal;
    })+) => {
        members! {
            /// A failure mode: a row of the FMECA.
            FailureMode,
            /// Failure modes.
            FailureModes(u64) { $(#[doc = concat!($component, ": ", $failure, ".")] $mode = $id,)+ }
        }

        /// The rules of the FMECA that firmware needs, in the order of [`FailureMode`].
        pub static RULES: [Rule; FailureMode::ALL.len()] = [$(Rule {
            faulty: faulty!($faulty),
            one_module: matches!(stringify!($faulty).as_bytes(), b"one"),
            lost: Resources::of(&[$(Resource::$lost),*]),
            autonomous: Severity::$autonomous,
            operator: Severity::$operator,
            class: Class::$class,
            persistence: Persistence::$persistence,
            latency_ms: $latency,
            signature: signature!($($signature)*),
            report: report!($report),
            adjustment: adjustment!($($adjustment)?),
        }),+];

        /// The words of the FMECA, in the order of [`FailureMode`].
        pub static TEXTS: [Description; FailureMode::ALL.len()] = [$(Description {
            function: $function,
            component: $component,
            failure: $failure,
            cause: $cause,
            effect: $effect,
            modules: $modules,
            observer: $observer,
            detection: $detection,
            silent: silent!($($signature)*),
            reaction: $reaction,
            tolerated: tolerated!($($tolerated)?),
            mtbf_mh: $mtbf,
            rate_label: Label::$label,
            rate: $rate,
            injection: $injection,
        }),+];
    };
}

macro_rules! faulty {
    (all) => { Modules::ALL };
    (one) => { Modules::NONE };
    ([$($module:ident),*]) => { Modules::of(&[$(Module::$module),*]) };
}

macro_rules! signature {
    (silent $reason:literal) => { signature!(flags []) };
    (
        flags [$($always:ident),*] $(sometimes [$($sometimes:ident),+])?
        $(with $present:ident)? $(without $absent:ident)?
    ) => {
        Signature {
            always: Flags::of(&[$(Flag::$always),*]),
            sometimes: Flags::of(&[$($(Flag::$sometimes),+)?]),
            present: Modules::of(&[$(Module::$present)?]),
            absent: Modules::of(&[$(Module::$absent)?]),
        }
    };
}

macro_rules! silent {
    (silent $reason:literal) => {
        Some($reason)
    };
    (flags $($rest:tt)*) => {
        None
    };
}

macro_rules! report {
    (-) => {
        None
    };
    ($report:ident) => {
        Some(Report::$report)
    };
}

macro_rules! adjustment {
    () => {
        None
    };
    ($adjustment:ident) => {
        Some(Adjustment::$adjustment)
    };
}

macro_rules! tolerated {
    () => {
        None
    };
    ($reason:literal) => {
        Some($reason)
    };
}
