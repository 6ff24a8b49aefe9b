//! Observers hear what a player does.

use super::outcome::ByName;
use super::program::Names;
use crate::net::data::{EventId, TransitionId};
use crate::system::data::Of;
use core::fmt;
use core::marker::PhantomData;
use cotama_units::units::Millis;

/// A transition that has just fired.
///
/// ```
/// use cotama_core::{net, units::Millis};
/// net! {
///     mod egg {
///         places { Raw: 1, Hard }
///         outputs { ring }
///         transitions { boil: Raw => Hard emit ring within 300..=300 ms; }
///     }
/// }
/// let (mut egg, mut rung) = (egg::Player::new(), None);
/// let mut hear = |it: &egg::Firing<'_>| rung = it.says(egg::Output::ring).then_some(it.at);
/// assert_eq!(egg.advance_with(Millis(900), &mut hear).fired, 1);
/// assert_eq!(rung, Some(Millis(300))); // told late, it fired when it was due
///
/// let mut said = String::new();
/// let mut hear = |it: &egg::Firing<'_>| said = format!("{it:?}");
/// let _ = egg::Player::new().advance_with(Millis(300), &mut hear);
/// let all = "Firing { transition: boil, on: None, says: [ring], at: Millis(300) }";
/// assert_eq!(said, all);
/// ```
///
/// `Debug` says everything by its name:
/// `Firing { transition: boil, on: None, says: [ring], at: Millis(300) }`.
pub struct Firing<'f, P: Names, M = ()> {
    /// The transition.
    pub id: Of<TransitionId>,
    /// The event on which it fired; `None` for one that fires by itself.
    pub on: Option<Of<EventId>>,
    /// The event as it was offered from outside, with its payload; `None` when another net caused
    /// it.
    pub event: Option<&'f P::Event>,
    /// The value that an event carries to everything that happens because of it. A transition that
    /// fires by itself carries the default value.
    pub carries: M,
    /// When it fired. A transition that was due earlier than the player was told so fired when it
    /// was due.
    pub at: Millis,
    pub(super) program: &'f P,
}

impl<'f, P: Names, M> Firing<'f, P, M> {
    /// The line of the definition.
    #[inline]
    pub fn transition(&self) -> P::Transition {
        self.program.transition(self.id)
    }

    /// Iterates over the outputs emitted, in this order.
    #[inline]
    pub fn outputs(&self) -> impl Iterator<Item = P::Output> + use<'f, P, M> {
        let (program, id) = (self.program, self.id);
        (0..usize::MAX).map_while(move |at| program.output(id, at))
    }

    /// Returns whether the transition emits this output.
    #[inline]
    pub fn says(&self, output: P::Output) -> bool {
        self.outputs().any(|it| it == output)
    }
}

impl<P: Names, M> fmt::Debug for Firing<'_, P, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        struct Says<'s, 'f, P: Names, M>(&'s Firing<'f, P, M>);
        impl<P: Names, M> fmt::Debug for Says<'_, '_, P, M> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_list().entries(self.0.outputs()).finish()
            }
        }
        let on = self.on.map(|it| ByName::<P::Transition>(it, PhantomData));
        f.debug_struct("Firing")
            .field("transition", &self.transition())
            .field("on", &on)
            .field("says", &Says(self))
            .field("at", &self.at)
            .finish()
    }
}

/// Hears what a player does, in the order in which it happens. Actions, logs and recorders are
/// observers. `()` observes nothing and costs nothing; any closure that takes a [`Firing`] is one.
///
/// ```
/// use cotama_core::{net, net::EventId};
/// use cotama_core::player::{Firing, Names, Observer};
/// use cotama_core::system::Of;
/// use cotama_core::units::Millis;
/// net! {
///     mod lamp {
///         places { Off: 1, On }
///         events { press }
///         transitions { on on press: Off => On; }
///     }
/// }
/// #[derive(Default)]
/// struct Log(Vec<&'static str>);
/// impl<P: Names> Observer<P> for Log {
///     fn on_fire(&mut self, _: &Firing<'_, P>) {
///         self.0.push("fired");
///     }
///     fn on_ignore(&mut self, _: Of<EventId>, _: ()) {
///         self.0.push("ignored");
///     }
/// }
/// let (mut lamp, mut log) = (lamp::Player::new(), Log::default());
/// let _ = lamp.offer_with(Millis(0), &lamp::Event::press, &mut log);
/// let _ = lamp.offer_with(Millis(1), &lamp::Event::press, &mut log);
/// assert_eq!(log.0, ["fired", "ignored"]);
/// ```
pub trait Observer<P: Names, M = ()> {
    /// A transition has fired.
    fn on_fire(&mut self, firing: &Firing<'_, P, M>);

    /// A net ignored an event for good, with what it carries along.
    #[expect(unused_variables, reason = "the names say what is heard")]
    fn on_ignore(&mut self, event: Of<EventId>, carries: M) {}

    /// Something was put into the mailbox of an event.
    #[expect(unused_variables, reason = "the names say what is heard")]
    fn on_mail(&mut self, to: Of<EventId>, carries: M) {}

    /// Something was taken out of the mailbox of an event, by an event that empties it.
    #[expect(unused_variables, reason = "the names say what is heard")]
    fn on_clear(&mut self, mailbox: Of<EventId>, carries: M) {}
}

/// Some observer of a system: one type for all of them, so that the code of a system is there once.
pub(super) struct Anyone<'o, P: Names, M>(pub(super) &'o mut dyn Observer<P, M>);

impl<P: Names, M> Observer<P, M> for Anyone<'_, P, M> {
    fn on_fire(&mut self, firing: &Firing<'_, P, M>) {
        self.0.on_fire(firing);
    }

    fn on_ignore(&mut self, event: Of<EventId>, carries: M) {
        self.0.on_ignore(event, carries);
    }

    fn on_mail(&mut self, to: Of<EventId>, carries: M) {
        self.0.on_mail(to, carries);
    }

    fn on_clear(&mut self, mailbox: Of<EventId>, carries: M) {
        self.0.on_clear(mailbox, carries);
    }
}

impl<P: Names, M> Observer<P, M> for () {
    #[inline]
    fn on_fire(&mut self, _: &Firing<'_, P, M>) {}
}

impl<P: Names, M, F: FnMut(&Firing<'_, P, M>)> Observer<P, M> for F {
    #[inline]
    fn on_fire(&mut self, firing: &Firing<'_, P, M>) {
        self(firing);
    }
}
