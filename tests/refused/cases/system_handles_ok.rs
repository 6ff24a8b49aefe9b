//! The twins: what waits for its turn comes when the drive has settled, a visitor who has gone
//! hears the door, and what is too large is left to the checker.
cotama_core::net! {
    /// Sees danger.
    pub mod guard {
        places { Watching: 1 }
        flags { danger }
        events { alarm, calm }
        outputs { stop }
        transitions {
            alarm on alarm [!danger]: Watching => Watching do danger = true emit stop;
            calm  on calm  [danger]:  Watching => Watching do danger = false;
        }
        ignore { alarm in danger; calm in Watching; }
        laws { handles(all); }
    }
}
cotama_core::net! {
    /// Brakes at once when there is danger.
    pub mod drive {
        places { Driving: 1, Braking }
        shared { danger }
        events { stop }
        transitions {
            brake [danger]: Driving => Braking;
            go [!danger]: Braking => Driving;
            slow on stop [!danger]: Driving => Driving;
            stay on stop: Braking => Braking;
        }
        laws { handles(all); }
    }
}
cotama_core::system! {
    /// A robot.
    pub mod robot {
        nets { guard: guard, drive: drive }
        links { guard.stop => drive.stop mail 1; }
        shared { drive.danger = guard.danger; }
        laws { handles(all); }
    }
}
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
        ignore {
            arrive in Waiting & Inside;
            leave in Outside & Inside;
            opened in Outside & Inside;
        }
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
        laws { handles(all); }
    }
}
cotama_core::net! {
    /// Somebody else, who is slow.
    pub mod guest extends visitor {
        places { Resting }
        transitions { rest: Inside => Resting after 5 ms; }
    }
}
cotama_core::system! {
    /// A house that is left to the checker.
    pub mod hotel extends house {
        instead { visitor: guest }
        laws { left_to_checker; }
    }
}
const _: () = assert!(house::EXPLORED.is_some() && hotel::EXPLORED.is_none());
