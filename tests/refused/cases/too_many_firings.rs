//! Few markings, but twenty ways from each to the next.
cotama_core::net! {
    pub mod meter {
        places { Idle: 1 }
        counters { seen: 0 of 1_000 }
        events { Up }
        transitions {
            up0 on Up: _ => _ read Idle do seen += 1;
            up1 on Up: _ => _ read Idle do seen += 1;
            up2 on Up: _ => _ read Idle do seen += 1;
            up3 on Up: _ => _ read Idle do seen += 1;
            up4 on Up: _ => _ read Idle do seen += 1;
            up5 on Up: _ => _ read Idle do seen += 1;
            up6 on Up: _ => _ read Idle do seen += 1;
            up7 on Up: _ => _ read Idle do seen += 1;
            up8 on Up: _ => _ read Idle do seen += 1;
            up9 on Up: _ => _ read Idle do seen += 1;
            up10 on Up: _ => _ read Idle do seen += 1;
            up11 on Up: _ => _ read Idle do seen += 1;
            up12 on Up: _ => _ read Idle do seen += 1;
            up13 on Up: _ => _ read Idle do seen += 1;
            up14 on Up: _ => _ read Idle do seen += 1;
            up15 on Up: _ => _ read Idle do seen += 1;
            up16 on Up: _ => _ read Idle do seen += 1;
            up17 on Up: _ => _ read Idle do seen += 1;
            up18 on Up: _ => _ read Idle do seen += 1;
            up19 on Up: _ => _ read Idle do seen += 1;
        }
    }
}
