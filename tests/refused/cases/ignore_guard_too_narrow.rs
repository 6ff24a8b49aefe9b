//! The pairs are still missing without the guards of `ignore`.
cotama_core::net! {
    pub mod upload {
        places { Waiting: 1, Sent }
        counters { level: 0 of 2 }
        shared { wifi }
        events { picture, bump }
        transitions {
            send  on picture [wifi & level >= 1]: Waiting => Sent;
            again on bump [level < 2]: Waiting => Waiting do level += 1;
        }
        ignore { picture in Waiting [!wifi]; bump in Waiting [wifi & level >= 2]; }
        laws { handles(all); }
    }
}
