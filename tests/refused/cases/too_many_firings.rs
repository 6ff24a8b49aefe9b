//! Few markings, but twenty ways from each to the next.
cotama_core::net! {
    pub mod meter {
        places { Idle: 1 }
        counters { seen: 0 of 1_000 }
        events {
            Up0, Up1, Up2, Up3, Up4, Up5, Up6, Up7, Up8, Up9,
            Up10, Up11, Up12, Up13, Up14, Up15, Up16, Up17, Up18, Up19,
        }
        transitions {
            up0 on Up0: _ => _ read Idle do seen += 1;
            up1 on Up1: _ => _ read Idle do seen += 1;
            up2 on Up2: _ => _ read Idle do seen += 1;
            up3 on Up3: _ => _ read Idle do seen += 1;
            up4 on Up4: _ => _ read Idle do seen += 1;
            up5 on Up5: _ => _ read Idle do seen += 1;
            up6 on Up6: _ => _ read Idle do seen += 1;
            up7 on Up7: _ => _ read Idle do seen += 1;
            up8 on Up8: _ => _ read Idle do seen += 1;
            up9 on Up9: _ => _ read Idle do seen += 1;
            up10 on Up10: _ => _ read Idle do seen += 1;
            up11 on Up11: _ => _ read Idle do seen += 1;
            up12 on Up12: _ => _ read Idle do seen += 1;
            up13 on Up13: _ => _ read Idle do seen += 1;
            up14 on Up14: _ => _ read Idle do seen += 1;
            up15 on Up15: _ => _ read Idle do seen += 1;
            up16 on Up16: _ => _ read Idle do seen += 1;
            up17 on Up17: _ => _ read Idle do seen += 1;
            up18 on Up18: _ => _ read Idle do seen += 1;
            up19 on Up19: _ => _ read Idle do seen += 1;
        }
    }
}
