//! A net has this law, a system has not.
cotama_core::net! {
    /// Asks, and may go away before the answer.
    pub mod visitor {
        places { Outside: 1, Waiting, Inside }
        events { arrive, leave, opened }
        outputs { ring }
        transitions {
            arrive on arrive: Outside => Waiting emit ring;
            leave  on leave:  Waiting => Outside;
            enter  on opened: Waiting => Inside;
        }
        ignore { arrive in Waiting & Inside; leave in Outside & Inside; }
    }
}
cotama_core::net! {
    /// Opens when somebody rings.
    pub mod door {
        places { Closed: 1, Open }
        events { bell }
        outputs { click }
        transitions { open on bell: Closed => Open emit click; }
        ignore { bell in Open; }
        laws { handles(all); }
    }
}
cotama_core::system! {
    /// A house.
    pub mod house {
        nets { visitor: visitor, door: door }
        links { visitor.ring => door.bell mail 1; door.click => visitor.opened now; }
        laws { deadlock_free; }
    }
}
