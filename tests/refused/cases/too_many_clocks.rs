//! Nine timers run together.
cotama_core::net! {
    /// Nine timers.
    pub mod timers {
        places { A: 1, B: 1, C: 1, D: 1, E: 1, F: 1, G: 1, H: 1, I: 1 }
        events { Stop }
        transitions {
            tA: A => _ within 1..=1 ms;
            tB: B => _ within 2..=2 ms;
            tC: C => _ within 3..=3 ms;
            tD: D => _ within 4..=4 ms;
            tE: E => _ within 5..=5 ms;
            tF: F => _ within 6..=6 ms;
            tG: G => _ within 7..=7 ms;
            tH: H => _ within 8..=8 ms;
            tI: I => _ within 9..=9 ms;
        }
    }
}
