//! Models that can be asked questions.

use crate::tpn::{self, TimeNet, TimeNetDefect};
use cotama_core::net::Net;
use cotama_property::pt::Pt;

/// A net, with time or without.
///
/// ```
/// use cotama_verification::check::{Model, Options, Verdict, check};
/// use cotama_verification::tpn::Time::Finite;
/// use cotama_verification::{property, tina};
/// let net = b"tr put cold -> raw  tr boil [300,360] raw -> hard  pl cold (1)";
/// let egg = Model::from(tina::read("egg.net", net).unwrap());
/// let asked = property::parse("bound(put -> hard)", egg.pt()).unwrap();
/// let answer = check(&egg, &asked, &Options::default());
/// assert_eq!(answer.verdict, Verdict::Response(Some((Finite(300), Finite(360)))));
/// ```
#[derive(Clone, Debug)]
pub enum Model {
    /// Enabled transitions fire in any order.
    Plain(Pt),
    /// Transitions fire within their intervals.
    Timed {
        /// The net.
        net: TimeNet,
        /// The same without intervals.
        untimed: Pt,
    },
}

impl Model {
    /// The net without time.
    pub fn pt(&self) -> &Pt {
        match self {
            Self::Plain(pt) => pt,
            Self::Timed { untimed, .. } => untimed,
        }
    }

    /// A net of the core with its intervals. Events come at any time, and a transition of a higher
    /// priority does not keep others from firing: what is never reached here is never reached by a
    /// player.
    ///
    /// # Errors
    ///
    /// When a time net cannot say what the net says.
    pub fn timed(net: &Net<'_>) -> Result<Self, TimeNetDefect> {
        if net.transitions.iter().all(|it| it.within.is_none()) {
            return Ok(Self::from(net));
        }
        Ok(Self::from(tpn::from_net(net)?.net))
    }
}

/// Without its intervals.
impl From<&Net<'_>> for Model {
    fn from(net: &Net<'_>) -> Self {
        Self::Plain(Pt::from(net))
    }
}

impl From<Pt> for Model {
    fn from(pt: Pt) -> Self {
        Self::Plain(pt)
    }
}

impl From<TimeNet> for Model {
    fn from(net: TimeNet) -> Self {
        let untimed = net.untimed();
        Self::Timed { net, untimed }
    }
}
