//! Each net handles all its events, and `stop` arrives before the drive settles.
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
        links { guard.stop => drive.stop now; }
        shared { drive.danger = guard.danger; }
        laws { handles(all); }
    }
}
